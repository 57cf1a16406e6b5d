//! The elastic one-way tie of a parapet, anchored to its own support.
//!
//! A tie at the height y, of stiffness K and slack g₀, that resists the side of σ = ±1 has the force N at the
//! displacement w = 2 u y/h of the wall there:
//!
//! ```text
//! N = K max(0, σ w − g₀)        F_tie(u) = σ (2y/h) N
//! ```
//!
//! It is one corner more, at |u| = g₀ h/(2y), and a slope of F more beyond it. F₀, `u_ins`, ω₁ and secant
//! damping stay those of the wall alone.

use crate::choices::{Mechanism, TieSide};

use super::error::ParameterError;
use super::force_law::{Line, RestoringForce};
use super::mechanism::{Body, Sides};
use super::parameters::{Kinematics, Parameters};

/// The tie of a parapet.
#[derive(Clone, Debug, PartialEq)]
pub struct Tie {
    /// Stiffness K \[N/m\].
    pub stiffness: f64,
    /// Slack g₀ \[m\].
    pub slack: f64,
    /// The force it resists \[N\]; `None` where none is given.
    pub strength: Option<f64>,
    /// The side it holds.
    pub side: TieSide,
    /// dw/du = 2y/h.
    pub lever: f64,
    /// |u| from which on the wall has left its supports, and the tie with them \[m\].
    departure: Sides,
}

impl Tie {
    /// Returns the tie that the parameters ask for; `None` for a stiffness of 0.
    ///
    /// # Errors
    /// [`ParameterError::TieNeedsParapet`], [`ParameterError::Trigonometric`], [`ParameterError::TieHeight`].
    pub(super) fn new(parameters: &Parameters, body: &Body) -> Result<Option<Self>, ParameterError> {
        let Parameters { height, tie_height, tie_stiffness: stiffness, tie_slack: slack, .. } = *parameters;
        if stiffness == 0.0 {
            return Ok(None);
        }
        if parameters.mechanism != Mechanism::Parapet {
            return Err(ParameterError::TieNeedsParapet { mechanism: parameters.mechanism.name() });
        }
        if parameters.kinematics == Kinematics::Trigonometric {
            let (name, value) = ("tie_stiffness", stiffness.to_string());
            return Err(ParameterError::Trigonometric { name, value, remedy: "0" });
        }
        if !(tie_height > 0.0 && tie_height <= height) {
            return Err(ParameterError::TieHeight { tie_height, height });
        }
        Ok(Some(Self {
            stiffness,
            slack,
            strength: Some(parameters.tie_strength).filter(|strength| *strength > 0.0),
            side: parameters.tie_side,
            lever: 2.0 * tie_height / height,
            departure: body.departure,
        }))
    }

    /// Returns whether the tie resists displacements of a sign.
    pub fn holds(&self, sign: f64) -> bool {
        match self.side {
            TieSide::Positive => sign > 0.0,
            TieSide::Negative => sign < 0.0,
            TieSide::Both => true,
        }
    }

    /// Returns the |u| at which the tie begins to pull, g₀ h/(2y) \[m\].
    pub fn onset(&self) -> f64 {
        self.slack / self.lever
    }

    /// Returns the |u| at which the force of the tie reaches its strength \[m\]; `None` without a strength.
    pub fn strength_displacement(&self) -> Option<f64> {
        self.strength.map(|strength| (strength / self.stiffness + self.slack) / self.lever)
    }

    /// Returns the slope that the tie adds to F, K (2y/h)² \[N/m\].
    pub fn slope(&self) -> f64 {
        self.stiffness * self.lever * self.lever
    }

    /// Returns the force N of the tie at a displacement \[N\].
    pub fn force(&self, displacement: f64) -> f64 {
        if self.holds(displacement) && displacement.abs() < self.departure.of(displacement) {
            self.tension(displacement)
        } else {
            0.0
        }
    }

    /// Returns K (|w| − g₀), the force of the tie where it pulls \[N\].
    pub(super) fn tension(&self, displacement: f64) -> f64 {
        (self.stiffness * (self.lever * displacement.abs() - self.slack)).max(0.0)
    }

    /// Returns whether the tie pulls between two displacements that no corner separates.
    pub(super) fn pulls(&self, lower: f64, upper: f64) -> bool {
        let middle = 0.5 * (lower + upper);
        let within = middle.abs() > self.onset() && middle.abs() < self.departure.of(middle);
        within && self.holds(middle)
    }

    /// Returns whether the tie pulls the wall back even where the wall leaves its supports, so that no
    /// equilibrium is unstable beyond the wall's own.
    pub(super) fn steadies(&self, force: &RestoringForce, sign: f64) -> bool {
        let end = self.departure.of(sign);
        let reaches = |line: &Line| {
            line.slope + self.slope() > 0.0
                && sign * line.at(sign * end) + self.slope() * (end - self.onset()) > 0.0
        };
        self.onset() < end && force.side(sign).lines.last().is_some_and(reaches)
    }

    /// Adds the force of the tie to a line of the wall alone on the side of `sign`, both per unit effective
    /// mass `m` \[kg\].
    pub(super) fn added_to(&self, own: Line, sign: f64, m: f64) -> Line {
        let anchor = self.onset().copysign(sign);
        Line { anchor, force: own.at(anchor), slope: own.slope + self.slope() / m }
    }
}
