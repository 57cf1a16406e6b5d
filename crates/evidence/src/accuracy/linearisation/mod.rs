//! Error of small rotations: Eq. (1) beside full rotations, Figures 2 and 3 of the paper.
//!
//! Displacements are fractions of the unstable equilibrium: u/`u_ins` for small rotations, θ/`θ_ins` for full
//! ones, so that both start at the same θ₀/α of Eq. (5).
//!
//! ```
//! use evidence::accuracy::linearisation::figure_2_wall;
//! use rocking_wall::variables::Mechanism;
//! use run::rotations::period;
//!
//! let period = period(&figure_2_wall(Mechanism::Parapet), 0.9)?;
//! assert!((period.ratio() - 0.9975).abs() < 1e-3);
//! # Ok::<(), evidence::EvidenceError>(())
//! ```

pub mod page;

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::Parameters;
use run::rotations::{FreeMotion, Period, SLENDERNESS, both, period};

use crate::EvidenceError;

/// Output step of Figure 2 \[s\].
const STEP: f64 = 0.01;

/// Default initial rotations θ₀/α at which the period is compared; the last is that of Figure 2.
pub const STARTS: [f64; 3] = [0.1, 0.5, 0.9];

/// Free motions of one wall, released from one fraction of its unstable equilibrium, in small and in full
/// rotations.
#[derive(Clone, Debug, PartialEq)]
pub struct Histories {
    /// Small rotations, Eq. (1).
    pub linear: FreeMotion,
    /// Full rotations.
    pub trigonometric: FreeMotion,
}

impl Histories {
    /// Returns time \[s\] and displacement in small rotations, and in full ones.
    pub fn points(&self) -> [Vec<(f64, f64)>; 2] {
        let timed = |(index, u): (usize, &f64)| (index as f64 * STEP, *u);
        [&self.linear, &self.trigonometric]
            .map(|motion| motion.history.iter().enumerate().map(timed).collect())
    }

    /// Returns the largest difference between the two histories \[-\].
    pub fn largest_difference(&self) -> f64 {
        largest_difference(&self.linear.history, &self.trigonometric.history)
    }

    /// Returns the largest difference between amplitudes of half cycles, which do not depend on phase \[-\].
    pub fn largest_amplitude_difference(&self) -> f64 {
        largest_difference(&self.linear.amplitudes, &self.trigonometric.amplitudes)
    }

    /// Returns the time of an impact in small rotations over that in full ones; `None` where either has
    /// fewer.
    pub fn time_ratio(&self, impact: usize) -> Option<f64> {
        Some(self.linear.impacts.get(impact)? / self.trigonometric.impacts.get(impact)?)
    }
}

pub(crate) fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Returns the walls of Figure 2: b = 0.4 m, h = 4 m, no overburden, e = 0.985 (parapet) or 0.955 (strip,
/// hinge at mid-height).
pub fn figure_2_wall(mechanism: Mechanism) -> Parameters {
    let restitution = match mechanism {
        Mechanism::Parapet => 0.985,
        Mechanism::VerticalSpanning => 0.955,
    };
    Parameters {
        mechanism,
        height: 4.0,
        thickness: 0.4,
        hinge_ratio: 0.5,
        restitution,
        ..Parameters::default()
    }
}

/// Computes Figure 2: the wall released at rest from 0.9 of its unstable equilibrium, over `duration` \[s\].
///
/// # Errors
/// [`EvidenceError::Rotations`] if a run fails.
pub fn figure_2(mechanism: Mechanism, duration: f64) -> Result<Histories, EvidenceError> {
    let [linear, trigonometric] =
        both(&figure_2_wall(mechanism), |release| release.run(0.9, duration, STEP))?;
    Ok(Histories { linear, trigonometric })
}

/// Computes Figure 3: periods at each of `slenderness` \[rad\], which sets the thickness of a wall of 4 m
/// with its hinge at mid-height. Ratios of periods depend only on the slenderness, the hinge ratio and the
/// start.
///
/// # Errors
/// [`EvidenceError`] if a slenderness makes no wall or a run fails.
pub fn figure_3(mechanism: Mechanism, slenderness: &[f64], start: f64) -> Result<Vec<Period>, EvidenceError> {
    let wall = figure_2_wall(mechanism);
    let lower = match mechanism {
        Mechanism::Parapet => wall.height,
        Mechanism::VerticalSpanning => wall.hinge_ratio * wall.height,
    };
    let at = |alpha: &f64| {
        Ok(period(&Parameters { thickness: lower * libm::tan(*alpha), ..wall.clone() }, start)?)
    };
    slenderness.iter().map(at).collect()
}

/// Figures 2 and 3 for the wall of one mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct BothRotations {
    /// What tables call the wall.
    pub name: &'static str,
    /// How long Figure 2 follows it \[s\].
    pub duration: f64,
    /// Its coefficient of restitution \[-\].
    pub restitution: f64,
    /// Figure 2.
    pub history: Histories,
    /// Figure 3: for each of [`STARTS`] one period for each of [`SLENDERNESS`].
    pub periods: Vec<Vec<Period>>,
}

/// Computes Figures 2 and 3 for both mechanisms, the parapet first.
///
/// # Errors
/// [`EvidenceError::Run`] if a run fails.
pub fn both_rotations() -> Result<Vec<BothRotations>, EvidenceError> {
    let mechanisms = [(Mechanism::Parapet, "parapet", 20.0), (Mechanism::VerticalSpanning, "strip", 12.0)];
    let measured = |(mechanism, name, duration)| {
        let periods = STARTS.iter().map(|&start| figure_3(mechanism, &SLENDERNESS, start));
        Ok(BothRotations {
            name,
            duration,
            restitution: figure_2_wall(mechanism).restitution,
            history: figure_2(mechanism, duration)?,
            periods: periods.collect::<Result<_, _>>()?,
        })
    };
    mechanisms.into_iter().map(measured).collect()
}
