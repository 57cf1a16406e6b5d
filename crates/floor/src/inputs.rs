//! What pushes the floor: the base's motion and the walls.

use crate::choices::Coupling;
use crate::floor::Floor;
use crate::motion::Load;
use crate::variables::RealVariable as V;

/// Walls that can push one floor.
const WALLS: usize = 8;
const REACTIONS: [V; WALLS] = [
    V::Reaction1,
    V::Reaction2,
    V::Reaction3,
    V::Reaction4,
    V::Reaction5,
    V::Reaction6,
    V::Reaction7,
    V::Reaction8,
];
const IMPULSES: [V; WALLS] =
    [V::Impulse1, V::Impulse2, V::Impulse3, V::Impulse4, V::Impulse5, V::Impulse6, V::Impulse7, V::Impulse8];

/// Returns which wall an input is of, counted from 0, and the coupling that it takes part in.
pub(crate) fn wall_of(variable: V) -> Option<(Coupling, usize)> {
    let lists = [(Coupling::Reactions, REACTIONS), (Coupling::Impulses, IMPULSES)];
    lists
        .into_iter()
        .find_map(|(coupling, list)| Some((coupling, list.iter().position(|&own| own == variable)?)))
}

/// A continuous input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Input {
    pub(crate) value: f64,
    /// Rate for the next step; zero after it.
    pub(crate) rate: f64,
    /// Rate over the last step, for output derivatives.
    pub(crate) last_rate: f64,
}

impl Input {
    pub(crate) fn set(&mut self, value: f64) {
        *self = Self { value, ..Self::default() };
    }

    /// After a step the input counts as extrapolated to its end.
    fn pass(&mut self, duration: f64) {
        *self = Self { value: self.value + self.rate * duration, rate: 0.0, last_rate: self.rate };
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
    pub(crate) fn get(&self, variable: V) -> f64 {
        match wall_of(variable) {
            Some((Coupling::Reactions, wall)) => self.reactions[wall].value,
            Some((Coupling::Impulses, wall)) => self.impulses[wall],
            None => self.ground.value,
        }
    }

    /// Returns a continuous input; `None` for other variables.
    pub(crate) fn continuous(&mut self, variable: V) -> Option<&mut Input> {
        match wall_of(variable) {
            Some((Coupling::Reactions, wall)) => Some(&mut self.reactions[wall]),
            None if variable == V::AG => Some(&mut self.ground),
            _ => None,
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

    /// After a step.
    pub(crate) fn pass(&mut self, duration: f64) {
        for input in self.reactions.iter_mut().chain([&mut self.ground]) {
            input.pass(duration);
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
