//! The code `fractions`: the capacity curve of a wall read at fractions of the displacement at which its
//! force vanishes, over a response spectrum.
//!
//! ```
//! use check::fractions::{Fractions, check};
//! use rocking_wall::wall::{Parameters, Wall};
//!
//! // 1 m/s² at every period
//! let wall = Wall::new(&Parameters::default())?;
//! let sides = check(&wall, Fractions::default(), |_| Ok(1.0))?;
//! assert_eq!(sides.len(), 2);
//! assert!((sides[0].onset_acceleration - 0.97 * 0.981).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod inputs;
mod rows;

use std::f64::consts::TAU;

use ground_motion::{GroundMotion, Maxima, Spectrum};
use report::palette::{BLUE, DARK_GREY, RED};
use report::plot::{Axis, Look, Plot, Series};
use rocking_wall::scene::Floors;
use rocking_wall::wall::{Tie, Wall};
use run::sample::sample_median;

use crate::error::CheckError;
use crate::site::{felt, interpolated};

pub use inputs::{FractionsTable, SpectrumTable, read};

/// The code, in `[check]`.
pub const CODE: &str = "fractions";

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

/// The demand of a check.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand(Of);

#[derive(Clone, Debug, PartialEq)]
enum Of {
    /// Points (T, `S_a`) \[s, m/s²\].
    Points(Vec<(f64, f64)>),
    Records(Spectrum, Vec<GroundMotion>),
}

impl Demand {
    /// Makes the demand of points (T, `S_a`) \[s, m/s²\].
    ///
    /// # Errors
    /// [`CheckError::Value`] of the first whose period does not rise or whose `S_a` is not above 0, or if the
    /// first is not that of T = 0; `place` names a point, the first with the number 0.
    pub fn of_points(points: Vec<(f64, f64)>, place: impl Fn(usize) -> String) -> Result<Self, CheckError> {
        let mut before: Option<f64> = None;
        for (index, &(period, acceleration)) in points.iter().enumerate() {
            let fault = |expected: String, found: String| {
                Err(refused(format!("{}: expected {expected}, found {found}", place(index))))
            };
            let rises = before.map_or(period >= 0.0, |before| period > before);
            if !(rises && period.is_finite()) {
                let expected = before.map_or_else(
                    || "a finite period from 0 on".to_owned(),
                    |before| format!("periods that rise: a finite one above T = {before} s"),
                );
                return fault(expected, format!("T = {period} s"));
            }
            if !(acceleration.is_finite() && acceleration > 0.0) {
                return fault("a finite Sa above 0".to_owned(), format!("Sa = {acceleration} m/s²"));
            }
            before = Some(period);
        }
        match points.first() {
            Some(first) if first.0 == 0.0 => Ok(Self(Of::Points(points))),
            _ => Err(refused(
                "the spectrum has no T = 0, the peak acceleration; give it with that point".into(),
            )),
        }
    }

    /// Makes the demand of records, their median spectrum with a damping ratio: of the ground, or of the
    /// floors that a wall stands on; those of a strip wall count by their weights.
    ///
    /// # Errors
    /// [`CheckError`] without records, for a damping ratio outside its limits, or where the wall does not go
    /// with its floors.
    pub fn of_records(
        records: Vec<GroundMotion>,
        floors: Option<&Floors>,
        wall: &Wall,
        damping: f64,
    ) -> Result<Self, CheckError> {
        if records.is_empty() {
            let message = "the demand needs at least one record";
            return Err(CheckError::value(&["records"], message));
        }
        let spectrum = Spectrum::new(damping, Maxima::Everywhere)?;
        let records = records.into_iter().map(|record| felt(record, floors, wall));
        let records = records.collect::<Result<_, CheckError>>()?;
        Ok(Self(Of::Records(spectrum, records)))
    }

    /// Returns `S_a` at a period \[m/s²\].
    ///
    /// # Errors
    /// [`CheckError`] for a period that the demand does not have.
    pub fn at(&self, period: f64) -> Result<f64, CheckError> {
        match &self.0 {
            Of::Points(points) => interpolated(points, period).ok_or_else(|| {
                let end = |point: Option<&(f64, f64)>| point.map_or(f64::NAN, |point| point.0);
                let [from, to] = [points.first(), points.last()].map(end);
                refused(format!(
                    "the spectrum goes from {from} to {to} s and has no T = {period} s; give it with that \
                     period"
                ))
            }),
            Of::Records(spectrum, motions) => {
                let at = |motion| spectrum.acceleration(motion, period);
                let mut values = motions.iter().map(at).collect::<Result<Vec<f64>, _>>()?;
                Ok(sample_median(&mut values))
            }
        }
    }

    /// Points (`S_d`, `S_a`) up to twice a period, to draw \[m, m/s²\].
    fn drawn(&self, period: f64) -> Result<Vec<(f64, f64)>, CheckError> {
        let longest = match &self.0 {
            Of::Points(points) => points.last().map_or(0.0, |point| point.0).min(2.0 * period),
            Of::Records(..) => 2.0 * period,
        };
        let at = |part: u32| {
            let period = longest * f64::from(part) / 200.0;
            let acceleration = self.at(if part < 3 { 0.0 } else { period })?;
            Ok((acceleration * (period / TAU).powi(2), acceleration))
        };
        (0..=200).map(at).collect()
    }
}

/// The capacity curve of the governing side over the demand, to draw: accelerations \[m/s²\] over
/// displacements \[m\].
#[derive(Clone, Debug, PartialEq)]
pub struct CapacityOverDemand {
    /// Corners (d*, a*) of the capacity curve.
    pub capacity: Vec<(f64, f64)>,
    /// Points (`S_d`, `S_a`) of the demand.
    pub spectrum: Vec<(f64, f64)>,
    /// The secant's point on the curve.
    pub secant: (f64, f64),
    /// Its period \[s\].
    pub period: f64,
    /// `d_u*`.
    pub capacity_displacement: f64,
    /// `S_d` at the period.
    pub displacement: f64,
}

impl CapacityOverDemand {
    /// Lays the curve of the governing side over the demand.
    ///
    /// # Errors
    /// [`CheckError`] for a period that the demand does not have.
    ///
    /// # Panics
    /// If there is no side.
    pub fn new(wall: &Wall, demand: &Demand, sides: &[SideCheck]) -> Result<Self, CheckError> {
        let worst = governing(sides, |side| side.displacement_ratio);
        let corners = wall.capacity_corners(worst.sign);
        let corners = corners.iter().map(|point| (point.spectral_displacement, point.spectral_acceleration));
        Ok(Self {
            capacity: corners.collect(),
            spectrum: demand.drawn(worst.secant_period)?,
            secant: worst.secant.into(),
            period: worst.secant_period,
            capacity_displacement: worst.displacement_capacity,
            displacement: worst.displacement_demand,
        })
    }
}

/// The check of one side, in d* = u/λ and a* = F/(λ `m_eff`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideCheck {
    /// Sign of u.
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
    /// Displacement and acceleration of the secant \[m, m/s²\].
    pub secant: [f64; 2],
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

/// Returns the side with the smallest ratio, which governs.
///
/// # Panics
/// If there is no side.
pub fn governing(sides: &[SideCheck], ratio: fn(&SideCheck) -> f64) -> &SideCheck {
    let worst = sides.iter().min_by(|a, b| ratio(a).total_cmp(&ratio(b)));
    worst.expect("a wall has a side")
}

/// Checks each side to which a wall can rock against the `S_a(T)` of a demand \[m/s²\].
///
/// # Errors
/// [`CheckError`]: a fraction outside its limits, no secant period, or a period that the demand lacks.
pub fn check(
    wall: &Wall,
    fractions: Fractions,
    demand: impl Fn(f64) -> Result<f64, CheckError>,
) -> Result<Vec<SideCheck>, CheckError> {
    let Fractions { displacement, secant } = fractions;
    for (name, value) in [("displacement_fraction", displacement), ("secant_fraction", secant)] {
        if !(value > 0.0 && value <= 1.0) {
            let message = format!("{name} = {value} must be above 0 and at most 1");
            return Err(CheckError::value(&[name], message));
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
        return Err(CheckError::NoSecant { displacement: d_s });
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
        secant: [d_s, a_s],
        secant_period,
        peak_acceleration,
        displacement_demand,
        acceleration_ratio: onset / peak_acceleration,
        displacement_ratio: displacement_capacity / displacement_demand,
    })
}

fn refused(message: String) -> CheckError {
    CheckError::value(&["spectrum"], message)
}

/// Draws a capacity curve over the demand.
pub fn over_demand(demand: &CapacityOverDemand) -> Plot {
    let shown = |&(d, a): &(f64, f64)| (1000.0 * d, a);
    let (d_s, a_s) = demand.secant;
    let right = 1.25 * demand.capacity_displacement.max(demand.displacement);
    let points = || demand.capacity.iter().chain(&demand.spectrum).filter(|point| point.0 <= right);
    let top = 1.08 * points().map(|point| point.1).fold(0.0, f64::max);
    let named = |name: &str, line: Series| Series { name: name.to_owned(), ..line };
    let within = |points: &[(f64, f64)]| {
        let inside = points.iter().take_while(|point| point.0 <= right).count();
        let mut cut: Vec<_> = points[..inside].to_vec();
        if let (Some(&(d0, a0)), Some(&(d1, a1))) = (cut.last(), points.get(inside)) {
            cut.push((right, a0 + (a1 - a0) * (right - d0) / (d1 - d0)));
        }
        cut.iter().map(shown).collect::<Vec<_>>()
    };
    let ray = |factor: f64| (1000.0 * factor * d_s, factor * a_s);
    let longest = (right / d_s).min(top / a_s);
    let capacity = 1000.0 * demand.capacity_displacement;
    let dashed = |points| Series { look: Look::Dashed, ..Series::line(DARK_GREY, 1.3, points) };
    let secant = format!("secant, T = {:.3} s", demand.period);
    let series = vec![
        named("demand", Series::line(RED, 1.6, within(&demand.spectrum))),
        named("capacity curve", Series::line(BLUE, 2.0, within(&demand.capacity))),
        named(&secant, dashed(vec![(0.0, 0.0), ray(longest)])),
        named("displacement capacity", dashed(vec![(capacity, 0.0), (capacity, top)])),
    ];
    let axes = [Axis::over("d*, S_d (mm)", [0.0, 1000.0 * right]), Axis::over("a*, S_a (m/s²)", [0.0, top])];
    Plot::new([820.0, 460.0], axes, series)
}
