//! The check of each side of a wall, in d* = u/λ and a* = F/(λ `m_eff`).

use std::f64::consts::TAU;

use rocking_wall::wall::{Tie, Wall};
use serde::Serialize;

use crate::error::CheckError;
use crate::names::Side;

/// The displacements at which capacity is read, as fractions of `u_ins`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fractions {
    /// `d_u*` over the d* at which the force of the wall alone vanishes \[-\].
    pub displacement: f64,
    /// The displacement of the secant period over `d_u*` \[-\].
    pub secant: f64,
}

impl Default for Fractions {
    /// 0.4 both.
    fn default() -> Self {
        Self { displacement: 0.4, secant: 0.4 }
    }
}

/// The check of one side, in d* = u/λ and a* = F/(λ `m_eff`).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SideCheck {
    /// Sign of u.
    #[serde(rename = "side", serialize_with = "named")]
    pub sign: f64,
    /// a₀*, the acceleration of the onset of rocking: the largest a* of the law, with a tie the largest up to
    /// `d_u*` \[m/s²\].
    pub onset_acceleration: f64,
    /// d* at which the force of the wall alone vanishes \[m\].
    pub zero_displacement: f64,
    /// Displacement capacity `d_u*` \[m\].
    pub displacement_capacity: f64,
    /// Whether the strength of the tie limits it.
    pub limited_by_tie: bool,
    /// Displacement of the secant \[m\].
    pub secant_displacement: f64,
    /// Its acceleration \[m/s²\].
    pub secant_acceleration: f64,
    /// Its period `T_s` = 2π √(d*/a*) \[s\].
    pub secant_period: f64,
    /// `S_a(0)` of the demand \[m/s²\].
    pub peak_acceleration: f64,
    /// `S_d(T_s) = S_a(T_s) T_s²/(4π²)` of the demand \[m\].
    pub displacement_demand: f64,
    /// `a₀*/S_a(0)`.
    pub acceleration_ratio: f64,
    /// `d_u*/S_d(T_s)`.
    pub displacement_ratio: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
fn named<S: serde::Serializer>(sign: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(Side::of(*sign).name())
}

/// Returns the side with the smallest ratio, which governs.
pub(super) fn governing(sides: &[SideCheck], ratio: fn(&SideCheck) -> f64) -> &SideCheck {
    let worst = sides.iter().min_by(|a, b| ratio(a).total_cmp(&ratio(b)));
    worst.expect("a wall has a side")
}

/// Checks each side to which a wall can rock against the `S_a(T)` of a demand \[m/s²\].
///
/// ```
/// use check::fractions::{Fractions, check};
/// use rocking_wall::wall::{Parameters, Wall};
///
/// // 1 m/s² at every period
/// let wall = Wall::new(&Parameters::default())?;
/// let sides = check(&wall, Fractions::default(), |_| Ok(1.0))?;
/// assert_eq!(sides.len(), 2);
/// assert!((sides[0].onset_acceleration - 0.97 * 0.981).abs() < 1e-12);
/// let error = check(&wall, Fractions { secant: 0.0, ..Fractions::default() }, |_| Ok(1.0)).unwrap_err();
/// assert_eq!(error.to_string(), "secant_fraction = 0 must be above 0 and at most 1");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`CheckError`]: a fraction that is not above 0 and at most 1, no secant period, or a period that the
/// demand lacks.
pub fn check(
    wall: &Wall,
    fractions: Fractions,
    demand: impl Fn(f64) -> Result<f64, CheckError>,
) -> Result<Vec<SideCheck>, CheckError> {
    let Fractions { displacement, secant } = fractions;
    for (key, value) in [("displacement_fraction", displacement), ("secant_fraction", secant)] {
        if !(value > 0.0 && value <= 1.0) {
            let message = format!("{key} = {value} must be above 0 and at most 1");
            return Err(CheckError::value(&[key], message));
        }
    }
    wall.sides().map(|sign| check_side(wall, sign, fractions, &demand)).collect()
}

fn check_side(
    wall: &Wall,
    sign: f64,
    fractions: Fractions,
    demand: &impl Fn(f64) -> Result<f64, CheckError>,
) -> Result<SideCheck, CheckError> {
    let participation = wall.body().participation;
    let at = |u: f64| wall.capacity_at(sign, u / wall.body().instability.of(sign));
    let zero = wall.force_end().of(sign);
    let tie = wall.tie().filter(|tie| tie.holds(sign));
    let of_wall = fractions.displacement * zero;
    let ultimate = tie.and_then(Tie::strength_displacement).map_or(of_wall, |u| of_wall.min(u));
    let corners = wall.capacity_corners(sign);
    let counts = corners.iter().filter(|corner| tie.is_none() || corner.displacement <= ultimate);
    let largest = counts.map(|corner| corner.spectral_acceleration).fold(0.0, f64::max);
    let onset = if tie.is_some() { largest.max(at(ultimate).spectral_acceleration) } else { largest };
    let secant = at(fractions.secant * ultimate);
    let [d_s, a_s] = [secant.spectral_displacement, secant.spectral_acceleration];
    if a_s <= 0.0 {
        let message = format!(
            "the force at d* = {d_s} m is not positive: it has no secant period; reduce the fractions"
        );
        return Err(CheckError::value(&["displacement_fraction"], message));
    }
    let secant_period = TAU * (d_s / a_s).sqrt();
    let peak_acceleration = demand(0.0)?;
    let displacement_demand = demand(secant_period)? * (secant_period / TAU).powi(2);
    let displacement_capacity = ultimate / participation;
    Ok(SideCheck {
        sign,
        onset_acceleration: onset,
        zero_displacement: zero / participation,
        displacement_capacity,
        limited_by_tie: ultimate < of_wall,
        secant_displacement: d_s,
        secant_acceleration: a_s,
        secant_period,
        peak_acceleration,
        displacement_demand,
        acceleration_ratio: onset / peak_acceleration,
        displacement_ratio: displacement_capacity / displacement_demand,
    })
}
