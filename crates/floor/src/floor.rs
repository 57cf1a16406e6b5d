//! Parameters of a floor, and the validated floor they make.
//!
//! ```
//! use rocking_floor::floor::{Floor, Parameters};
//!
//! let floor = Floor::new(&Parameters { mass: 1e4, stiffness: 1e6, ..Parameters::default() })?;
//! assert_eq!(floor.omega(), 10.0);
//! # Ok::<(), rocking_floor::floor::ParameterError>(())
//! ```

use oscillator::Oscillator;

use crate::choices::{Coupling, Hysteresis, start_values};

/// What a floor is made of, in SI units: one field per parameter of the model description, of the same name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Mass without the walls' \[kg\].
    pub mass: f64,
    /// Lateral stiffness before yielding \[N/m\].
    pub stiffness: f64,
    /// Fraction of critical damping at `stiffness` and `mass`.
    pub damping_ratio: f64,
    /// Damping coefficient in addition \[N s/m\].
    pub damping_coefficient: f64,
    /// Behaviour beyond the yield force.
    pub hysteresis: Hysteresis,
    /// Force at which yielding starts \[N\].
    pub yield_force: f64,
    /// Stiffness after yielding over stiffness before.
    pub hardening_ratio: f64,
    /// Inputs that carry the forces of the walls.
    pub coupling: Coupling,
    /// Displacement at the start \[m\].
    pub displacement_start: f64,
    /// Velocity at the start \[m/s\].
    pub velocity_start: f64,
}

impl Default for Parameters {
    /// The start values of the model description.
    fn default() -> Self {
        start_values!(Self {})
    }
}

/// Parameters that contradict each other.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum ParameterError {
    /// A bilinear spring without stiffness.
    #[error(
        "hysteresis = bilinear needs a stiffness above 0, but stiffness = {stiffness} N/m; raise it or \
         choose hysteresis = none"
    )]
    NothingYields { stiffness: f64 },
    /// A number that is not finite.
    #[error(
        "mass = {mass} kg, stiffness = {stiffness} N/m and damping give frequencies that are not finite; \
         choose usual magnitudes"
    )]
    NotFinite { mass: f64, stiffness: f64 },
}

/// Branch of the spring's law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// Stiffness before yielding.
    Elastic,
    /// Yielding towards +x.
    YieldingUp,
    /// Yielding towards −x.
    YieldingDown,
}

impl Branch {
    /// Returns +1 or −1 while yielding, 0 otherwise.
    pub fn sign(self) -> f64 {
        match self {
            Self::Elastic => 0.0,
            Self::YieldingUp => 1.0,
            Self::YieldingDown => -1.0,
        }
    }
}

/// The part of a bilinear spring that yields: an elasto-plastic element beside a spring that hardens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yielding {
    /// Displacement at which a fresh spring starts to yield \[m\].
    pub displacement: f64,
    /// Largest force of the elasto-plastic element \[N\].
    pub force: f64,
}

/// A valid floor. It never changes.
#[derive(Clone, Copy, Debug)]
pub struct Floor {
    /// Mass \[kg\].
    pub mass: f64,
    /// Damping coefficient in use \[N s/m\].
    pub damping: f64,
    /// Stiffness before yielding \[N/m\].
    pub stiffness: f64,
    /// Stiffness while yielding \[N/m\].
    pub hardening: f64,
    /// None for a linear spring.
    pub yielding: Option<Yielding>,
    elastic: Oscillator,
    plastic: Oscillator,
}

impl Floor {
    /// Makes the floor of these parameters.
    ///
    /// # Errors
    /// When they contradict each other.
    pub fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        let Parameters { mass, stiffness, hardening_ratio, .. } = *parameters;
        // c = 2 ξ √(k M) + c₀
        let damping =
            2.0 * parameters.damping_ratio * (stiffness * mass).sqrt() + parameters.damping_coefficient;
        let yielding = match parameters.hysteresis {
            Hysteresis::None => None,
            Hysteresis::Bilinear if stiffness <= 0.0 => {
                return Err(ParameterError::NothingYields { stiffness });
            }
            Hysteresis::Bilinear => Some(Yielding {
                displacement: parameters.yield_force / stiffness,
                force: (1.0 - hardening_ratio) * parameters.yield_force,
            }),
        };
        if !((stiffness / mass).is_finite() && (damping / mass).is_finite()) {
            return Err(ParameterError::NotFinite { mass, stiffness });
        }
        let hardening = hardening_ratio * stiffness;
        Ok(Self {
            mass,
            damping,
            stiffness,
            hardening,
            yielding,
            elastic: Oscillator::new(damping / mass, stiffness / mass),
            plastic: Oscillator::new(damping / mass, hardening / mass),
        })
    }

    /// Returns √(k/M) before yielding \[rad/s\].
    pub fn omega(&self) -> f64 {
        (self.stiffness / self.mass).sqrt()
    }

    /// Computes the spring's force \[N\], positive towards −x.
    pub fn spring_force(&self, displacement: f64, plastic: f64, branch: Branch) -> f64 {
        match self.yielding {
            None => self.stiffness * displacement,
            Some(Yielding { force, .. }) => {
                let element = match branch {
                    Branch::Elastic => (self.stiffness - self.hardening) * (displacement - plastic),
                    Branch::YieldingUp => force,
                    Branch::YieldingDown => -force,
                };
                self.hardening * displacement + element
            }
        }
    }

    /// Returns the slope of the spring's force \[N/m\].
    pub fn tangent(&self, branch: Branch) -> f64 {
        match branch {
            Branch::Elastic => self.stiffness,
            Branch::YieldingUp | Branch::YieldingDown => self.hardening,
        }
    }

    pub(crate) fn oscillator(&self, branch: Branch) -> Oscillator {
        match branch {
            Branch::Elastic => self.elastic,
            Branch::YieldingUp | Branch::YieldingDown => self.plastic,
        }
    }
}
