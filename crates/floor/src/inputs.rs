//! What pushes the floor: the base's motion and the walls.

use fmu_export::Input;

use crate::choices::Coupling;
use crate::floor::Floor;
use crate::motion::Load;
use crate::variables::RealVariable;

/// Walls that can push one floor.
const WALLS: usize = 8;

// the inputs of the walls follow one another
const _: () = assert!(RealVariable::Reaction8 as usize + 1 == RealVariable::Reaction1 as usize + WALLS);
const _: () = assert!(RealVariable::Impulse8 as usize + 1 == RealVariable::Impulse1 as usize + WALLS);

/// What an input belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Owner {
    /// The base.
    Base,
    /// A wall, counted from 0, and the coupling in which the input takes part.
    Wall(Coupling, usize),
}

impl Owner {
    /// Returns what an input belongs to; `None` for other variables.
    pub(crate) fn of(variable: RealVariable) -> Option<Self> {
        let wall_from = |first: RealVariable| {
            (variable as usize).checked_sub(first as usize).filter(|wall| *wall < WALLS)
        };
        let reactions = wall_from(RealVariable::Reaction1).map(|wall| (Coupling::Reactions, wall));
        let impulses = wall_from(RealVariable::Impulse1).map(|wall| (Coupling::Impulses, wall));
        match reactions.or(impulses) {
            Some((coupling, wall)) => Some(Self::Wall(coupling, wall)),
            None => (variable == RealVariable::AG).then_some(Self::Base),
        }
    }
}

/// The inputs as they stand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Inputs {
    /// Acceleration of the base \[m/s²\].
    pub(crate) ground: Input,
    /// Forces of the floor on the walls \[N\].
    pub(crate) reactions: [Input; WALLS],
    /// Impulses of the floor on the walls \[N s\].
    pub(crate) impulses: [f64; WALLS],
    /// Length of the last step \[s\]; zero before the first.
    pub(crate) last_duration: f64,
}

impl Inputs {
    /// Returns the value of an input; 0 for other variables.
    pub(crate) fn get(&self, variable: RealVariable) -> f64 {
        match Owner::of(variable) {
            Some(Owner::Base) => self.ground.value,
            Some(Owner::Wall(Coupling::Reactions, wall)) => self.reactions[wall].value,
            Some(Owner::Wall(Coupling::Impulses, wall)) => self.impulses[wall],
            None => 0.0,
        }
    }

    /// Sets an input.
    pub(crate) fn set(&mut self, variable: RealVariable, value: f64) {
        if let Some(Owner::Wall(Coupling::Impulses, wall)) = Owner::of(variable) {
            self.impulses[wall] = value;
        } else if let Some(input) = self.continuous(variable) {
            input.set(value);
        }
    }

    /// Returns a continuous input; `None` for other variables.
    pub(crate) fn continuous(&mut self, variable: RealVariable) -> Option<&mut Input> {
        match Owner::of(variable)? {
            Owner::Base => Some(&mut self.ground),
            Owner::Wall(Coupling::Reactions, wall) => Some(&mut self.reactions[wall]),
            Owner::Wall(Coupling::Impulses, _) => None,
        }
    }

    /// Returns the derivative of the walls' force by an input of `coupling`, where the coupling in use is
    /// `used`.
    pub(crate) fn weight(&self, coupling: Coupling, used: Coupling) -> f64 {
        match coupling {
            _ if coupling != used => 0.0,
            Coupling::Reactions => 1.0,
            Coupling::Impulses if self.last_duration > 0.0 => 1.0 / self.last_duration,
            Coupling::Impulses => 0.0,
        }
    }

    /// Force of the floor on all walls now, and its rate \[N, N/s\]. An impulse counts as its mean force over
    /// a step: before the coming step is known, over the last one.
    fn walls(&self, coupling: Coupling, duration: f64, rate: fn(&Input) -> f64) -> Load {
        match coupling {
            Coupling::Reactions => Load {
                value: self.reactions.iter().map(|input| input.value).sum(),
                rate: self.reactions.iter().map(rate).sum(),
            },
            Coupling::Impulses if duration > 0.0 => {
                Load { value: self.impulses.iter().sum::<f64>() / duration, rate: 0.0 }
            }
            Coupling::Impulses => Load::default(),
        }
    }

    /// Acceleration by the walls alone \[m/s²\], now, with its rate over the last step.
    pub(crate) fn by_walls(&self, floor: &Floor, coupling: Coupling) -> Load {
        let Load { value, rate } = self.walls(coupling, self.last_duration, |input| input.last_rate);
        Load { value: -value / floor.mass, rate: -rate / floor.mass }
    }

    /// Acceleration by base and walls now, with its rate over the last step.
    pub(crate) fn present(&self, floor: &Floor, coupling: Coupling) -> Load {
        let Load { value, rate } = self.by_walls(floor, coupling);
        Load { value: value - self.ground.value, rate: rate - self.ground.last_rate }
    }

    /// Acceleration by base and walls over a step.
    pub(crate) fn ahead(&self, floor: &Floor, coupling: Coupling, duration: f64) -> Load {
        let Load { value, rate } = self.walls(coupling, duration, |input| input.rate);
        Load { value: -value / floor.mass - self.ground.value, rate: -rate / floor.mass - self.ground.rate }
    }

    /// Impulse of the floor on all walls over a step \[N s\].
    pub(crate) fn impulse(&self, coupling: Coupling, duration: f64) -> f64 {
        match coupling {
            Coupling::Impulses => self.impulses.iter().sum(),
            Coupling::Reactions => {
                let Load { value, rate } = self.walls(coupling, duration, |input| input.rate);
                duration * (value + 0.5 * rate * duration)
            }
        }
    }

    /// Extrapolates the inputs to the end of a step of `duration` \[s\].
    pub(crate) fn extrapolate(&mut self, duration: f64) {
        for input in self.reactions.iter_mut().chain([&mut self.ground]) {
            input.extrapolate(duration);
        }
        self.last_duration = duration;
    }
}

/// The base's motion, integrated from rest, and what it has given the floor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Base {
    /// \[m\]
    pub(crate) displacement: f64,
    /// \[m/s\]
    pub(crate) velocity: f64,
    /// Impulse on the floor over the last step \[N s\].
    pub(crate) impulse: f64,
}
