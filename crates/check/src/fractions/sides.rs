//! The check of each side of a wall, in d* = u/λ and a* = F/(λ `m_eff`).

use std::f64::consts::TAU;

use rocking_wall::wall::{Tie, Wall};

use crate::error::CheckError;
use crate::words::ledger::{Ledger, Quantity, Unit};
use crate::words::names::Side;
use crate::words::{Sentence, say};

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

impl SideCheck {
    /// The numbers of the side.
    pub(super) fn ledger(&self) -> Ledger {
        let (mm, acceleration) = (Unit::MILLIMETRES, Unit::ACCELERATION);
        let mut ledger = Ledger::default();
        ledger.fact("side", Side::of(self.sign).name());
        ledger.fact("limited_by_tie", self.limited_by_tie);
        let mut add = |key, equation, unit, value: f64, words| {
            ledger.add(Quantity::new(key, equation, unit, value, words));
        };
        let words = say!("Acceleration at which the wall rocks", "Accelerazione di attivazione");
        add("onset_acceleration", "a0*", acceleration, self.onset_acceleration, words);
        let words = say!("Zero of the force", "Annullamento della forza");
        add("zero_displacement", "d0*", mm, self.zero_displacement, words);
        let words = say!("Displacement capacity", "Capacità di spostamento");
        add("displacement_capacity", "d_u*", mm, self.displacement_capacity, words);
        let words = say!("Displacement of the secant", "Spostamento della secante");
        add("secant_displacement", "d_s*", mm, self.secant_displacement, words);
        let words = say!("Acceleration of the secant", "Accelerazione della secante");
        add("secant_acceleration", "a_s*", acceleration, self.secant_acceleration, words);
        let words = say!("Period of the secant", "Periodo della secante");
        add("secant_period", "T_s", Unit::SECONDS, self.secant_period, words);
        let words = say!("Demand of acceleration", "Domanda di accelerazione");
        add("peak_acceleration", "S_a(0)", acceleration, self.peak_acceleration, words);
        let words = say!("Demand of displacement", "Domanda di spostamento");
        add("displacement_demand", "S_d(T_s)", mm, self.displacement_demand, words);
        let words = say!("Capacity over demand, onset", "Rapporto capacità/domanda, attivazione");
        add("acceleration_ratio", "a0*/S_a(0)", Unit::NONE, self.acceleration_ratio, words);
        let words = say!("Capacity over demand, displacement", "Rapporto capacità/domanda, spostamento");
        add("displacement_ratio", "d_u*/S_d(T_s)", Unit::NONE, self.displacement_ratio, words);
        ledger
    }
}

/// A result: its ratio, and what it says.
pub(super) struct Outcome {
    /// Its name.
    pub(super) name: &'static str,
    pub(super) ratio: fn(&SideCheck) -> f64,
    /// The same for people.
    pub(super) title: Sentence,
    /// Where it holds, and where it does not.
    pub(super) says: [Sentence; 2],
}

/// Both results: they mean different things, and neither stands for the other.
pub(super) fn outcomes() -> [Outcome; 2] {
    [
        Outcome {
            name: "onset",
            ratio: |side| side.acceleration_ratio,
            title: say!("onset", "attivazione"),
            says: [
                say!("the wall does not rock", "la parete non oscilla"),
                say!("the wall rocks", "la parete oscilla"),
            ],
        },
        Outcome {
            name: "displacement",
            ratio: |side| side.displacement_ratio,
            title: say!("displacement", "spostamento"),
            says: [
                say!("within the capacity", "entro la capacità"),
                say!("beyond the capacity", "oltre la capacità"),
            ],
        },
    ]
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
    let tie = wall.ties().first().filter(|tie| tie.holds(sign));
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
