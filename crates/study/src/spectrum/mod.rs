//! Rocking spectra: `u_max/u_ins` over walls under one motion, or over pulses on one wall.
//!
//! These are not the elastic response spectra of [`ground_motion::spectrum`]: each point is a rocking wall,
//! which may overturn (Makris and Konstantinidis, The rocking spectrum and the limitations of practical
//! design methodologies, Earthquake Engineering and Structural Dynamics 32, 2003).
//!
//! Over pulses the axes are dimensionless: `ω_p/p` along the columns with p = √(k₀/`m_eff`), and `a_p/a₀`
//! along the rows with the acceleration a₀ = F₀/(λ `m_eff`) at which the rigid wall begins to rock. For a
//! parapet without overburden p = √(3g/(2h)), which is Housner's √(3g/(4R)) with h for 2R, as everywhere in
//! the linearised model, and a₀ = g tan α. Two walls with the same damping and restitution then have the same
//! spectrum, whatever their size (Zhang and Makris, Rocking response of free-standing blocks under cycloidal
//! pulses, Journal of Engineering Mechanics 127, 2001).
//!
//! Each wall starts upright and at rest. After the motion it is followed until it lacks the energy to exceed
//! its peak. A run ends at overturning. Results do not depend on the number of threads.
//!
//! ```
//! use rocking_wall::wall::Parameters;
//! use study::spectrum::{PulseForm, over_pulses};
//!
//! let spectrum = over_pulses(&Parameters::default(), PulseForm::Ricker, &[2.0, 4.0], &[0.5, 5.0], 1)?;
//! assert!(!spectrum.points[0][0].rocked && spectrum.points[1][1].ratio > 0.0);
//! # Ok::<(), study::spectrum::SpectrumError>(())
//! ```

mod axes;
pub mod figure;
pub mod page;
mod record_pulse;

use std::f64::consts::{FRAC_PI_4, TAU};

use fmu_export::VariableId;

use ground_motion::GroundMotion;
use record::{Forcing, Outcome, RecordSolver, RunEnd, RunStart};
use report::table::Table;
use rocking_wall::solver::{Memo, Motion, Peaks, SolverError};
use rocking_wall::variables::{Mechanism, RealVariable};
use rocking_wall::wall::{Parameters, Wall};
use scene::{Scene, SceneError, check_limits};

use run::free_motion::{advance, peak_is_final};
use run::parallel;

pub use axes::{MOST_POINTS, PulseForm, QUANTITIES, Quantity, Size, Slenderness, SpectrumError};
pub use record_pulse::{RecordPulse, RecordPulses};

/// Step of the free motion after the record, over 1/p.
const FREE_STEP: f64 = 0.25;
/// Most steps of the free motion. A wall near the instability departs from it as e^{pt}, so every peak comes
/// within 100/p.
const MOST_FREE_STEPS: u32 = 400;

/// Result of one wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Largest |u|/`u_ins`, with the `u_ins` of the side that the wall is on \[-\]; at most 1.
    pub ratio: f64,
    /// Whether the wall left its elastic branch, or u = 0 with the rigid-linear law.
    pub rocked: bool,
    /// Time of overturning from the start of the motion \[s\].
    pub overturning: Option<f64>,
}

/// The wall of a scene among those of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Own {
    /// Its place on the axes.
    pub place: [f64; 2],
    /// Its result.
    pub point: Point,
}

/// A rocking spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct RockingSpectrum {
    /// What the columns and the rows count.
    pub quantities: [Quantity; 2],
    /// Values along the columns.
    pub columns: Vec<f64>,
    /// Values along the rows.
    pub rows: Vec<f64>,
    /// Results: `points[row][column]`.
    pub points: Vec<Vec<Point>>,
}

impl RockingSpectrum {
    /// Returns a row for each point, row by row.
    pub fn table(&self) -> Table {
        let [column, row] = self.quantities.map(|quantity| quantity.name);
        let points =
            self.rows.iter().zip(&self.points).flat_map(|(y, points)| {
                self.columns.iter().zip(points).map(move |(x, point)| (*x, *y, *point))
            });
        Table::over(points)
            .value(column, |(x, ..)| *x)
            .value(row, |(_, y, _)| *y)
            .value("u_ratio_max", |(.., point)| point.ratio)
            .value("rocked", |(.., point)| point.rocked)
            .value("overturned", |(.., point)| point.overturning.is_some())
            .value("overturn_time_s", |(.., point)| point.overturning)
            .done()
    }
}

/// Computes the rocking spectrum of one motion: columns are `sizes`, rows are values of slenderness. The
/// walls are otherwise as `parameters` state.
///
/// # Errors
/// [`SpectrumError`] of the first wall in the order of rows and columns.
pub fn over_walls(
    parameters: &Parameters,
    motion: &GroundMotion,
    size: Size,
    sizes: &[f64],
    slenderness: Slenderness,
    rows: &[f64],
    threads: usize,
) -> Result<RockingSpectrum, SpectrumError> {
    check_count(sizes.len() * rows.len())?;
    if !parameters.is_rectangle() {
        return Err(SpectrumError::Body);
    }
    if parameters.mechanism != Mechanism::Parapet {
        let names = [
            (size.quantity().label, size == Size::SemiDiagonal),
            (slenderness.quantity().label, slenderness == Slenderness::Angle),
        ];
        if let Some(&(name, _)) = names.iter().find(|(_, parapet_only)| *parapet_only) {
            return Err(SpectrumError::ParapetOnly { name });
        }
    }
    let places = || rows.iter().flat_map(|&row| sizes.iter().map(move |&column| (row, column)));
    let walls = places().map(|(row, column)| shaped(parameters, size, column, slenderness, row));
    let walls = walls.collect::<Result<Vec<_>, _>>()?;
    let run = |index: usize| -> Result<Point, SpectrumError> {
        let wall = Prepared::new(&walls[index])?;
        Ok(wall.points(&[-wall.participation()], motion)?[0])
    };
    let points = parallel::map(walls.len(), threads, run)?;
    let points = points.chunks(sizes.len().max(1)).map(<[Point]>::to_vec).collect();
    let quantities = [size.quantity(), slenderness.quantity()];
    Ok(RockingSpectrum { quantities, columns: sizes.to_vec(), rows: rows.to_vec(), points })
}

/// Runs the wall itself, with its size and slenderness; `None` for one that such axes cannot have.
pub fn own_point(
    parameters: &Parameters,
    motion: &GroundMotion,
    size: Size,
    slenderness: Slenderness,
) -> Option<Own> {
    let place = [size.of(parameters), slenderness.of(parameters)];
    let alone = over_walls(parameters, motion, size, &place[..1], slenderness, &place[1..], 1).ok()?;
    Some(Own { place, point: alone.points[0][0] })
}

/// Computes the rocking spectrum of one wall under pulses of one form: columns are `ω_p/p`, rows are
/// `a_p/a₀`.
///
/// # Errors
/// [`SpectrumError`] of the first pulse in the order of columns.
pub fn over_pulses(
    parameters: &Parameters,
    form: PulseForm,
    columns: &[f64],
    rows: &[f64],
    threads: usize,
) -> Result<RockingSpectrum, SpectrumError> {
    check_count(columns.len() * rows.len())?;
    for (name, values, lowest) in [("ω_p/p", columns, f64::MIN_POSITIVE), ("a_p/a₀", rows, 0.0)] {
        if let Some(&value) = values.iter().find(|value| !(lowest..=1e6).contains(*value)) {
            let limit = if lowest > 0.0 { "above 0 and at most 1e6" } else { "from 0 to 1e6" };
            return Err(SpectrumError::Value { name, value, limit: limit.into() });
        }
    }
    let wall = Prepared::new(&upright(parameters))?;
    let (p, at_onset, factor) =
        (wall.motion.wall().rocking_rate(), onset(wall.motion.wall()), wall.participation());
    let run = |column: usize| -> Result<Vec<Point>, SpectrumError> {
        let motion = form.motion(columns[column] * p / TAU)?;
        let factors: Vec<f64> = rows.iter().map(|amplitude| -factor * at_onset * amplitude).collect();
        wall.points(&factors, &motion)
    };
    let found = parallel::map(columns.len(), threads, run)?;
    let points = (0..rows.len()).map(|row| found.iter().map(|column| column[row]).collect()).collect();
    let quantities = [QUANTITIES[4], QUANTITIES[5]];
    Ok(RockingSpectrum { quantities, columns: columns.to_vec(), rows: rows.to_vec(), points })
}

/// Returns the motion that both supports of a scene have.
///
/// # Errors
/// [`SceneError::Value`] for a scene without motion, or with one for each support.
pub fn common_motion(scene: &Scene) -> Result<GroundMotion, SceneError> {
    let refused = |message: &str| Err(SceneError::Value { message: message.into() });
    match scene.support_motion()? {
        Some(motion) if motion.top().is_some() => {
            refused("a rocking spectrum takes one motion for both supports; the scene has one for each")
        }
        Some(motion) => Ok(motion.bottom().clone()),
        None => refused("a rocking spectrum needs a record, or a scene with a motion"),
    }
}

/// Returns a₀ = F₀/(λ `m_eff`), at which the rigid wall begins to rock to u > 0 \[m/s²\].
pub fn onset(wall: &Wall) -> f64 {
    let body = wall.body();
    body.strength.positive / (body.participation * body.effective_mass)
}

fn check_count(found: usize) -> Result<(), SpectrumError> {
    if found > MOST_POINTS { Err(SpectrumError::TooManyPoints { found }) } else { Ok(()) }
}

/// Returns the wall upright and at rest.
fn upright(parameters: &Parameters) -> Parameters {
    Parameters { u_start: 0.0, u_dot_start: 0.0, ..parameters.clone() }
}

/// Returns the wall of a size and a slenderness, within the limits of the model description.
fn shaped(
    parameters: &Parameters,
    size: Size,
    column: f64,
    slenderness: Slenderness,
    row: f64,
) -> Result<Parameters, SpectrumError> {
    let ratio = match slenderness {
        Slenderness::Ratio => row,
        // the tangent repeats itself beyond the angles of walls
        Slenderness::Angle if !(row > 0.0 && row <= FRAC_PI_4) => {
            let limit = format!("above 0 and at most {FRAC_PI_4:.4}");
            return Err(SpectrumError::Value { name: slenderness.quantity().label, value: row, limit });
        }
        Slenderness::Angle => 1.0 / libm::tan(row),
    };
    let height = match size {
        Size::Height => column,
        // 2R = √(h² + b²) = h √(1 + (b/h)²)
        Size::SemiDiagonal => 2.0 * column / (1.0 + 1.0 / (ratio * ratio)).sqrt(),
    };
    let thickness = height / ratio;
    for (variable, value) in [(RealVariable::Height, height), (RealVariable::Thickness, thickness)] {
        let place = [size.quantity().label, slenderness.quantity().label];
        check_limits(variable.variable(), value).map_err(|reason| SpectrumError::Shape {
            place,
            values: [column, row],
            reason,
        })?;
    }
    Ok(Parameters { height, thickness, ..upright(parameters) })
}

/// A wall ready to run.
struct Prepared {
    height: f64,
    thickness: f64,
    motion: Motion,
}

impl Prepared {
    fn new(parameters: &Parameters) -> Result<Self, SpectrumError> {
        let Parameters { height, thickness, .. } = *parameters;
        let failed = |source| SpectrumError::Wall { height, thickness, source };
        let motion = Motion::of(parameters, parameters.tolerance).map_err(failed)?;
        Ok(Self { height, thickness, motion })
    }

    /// Returns λ, the factor of the ground acceleration \[-\].
    fn participation(&self) -> f64 {
        self.motion.wall().body().participation
    }

    /// Runs from upright and at rest through a motion, with each of some factors times its accelerations as
    /// forcing, and through the free motion after it.
    fn points(&self, factors: &[f64], motion: &GroundMotion) -> Result<Vec<Point>, SpectrumError> {
        let Self { height, thickness, .. } = *self;
        let first = motion.samples()[0];
        let start =
            |&factor: &f64| RunStart { state: self.motion.start_under(0.0, 0.0, factor * first), factor };
        let starts: Vec<_> = factors.iter().map(start).collect();
        let solver = RecordSolver::new(&self.motion, motion.step());
        let (samples, end) = (Forcing::Samples(motion.samples()), RunEnd::AtOverturning);
        let outcomes = match starts[..] {
            // it has no use for what many runs share
            [alone] => solver.run(alone, samples, end).map(|outcome| vec![outcome]),
            _ => solver.batch(samples).run(&starts, end),
        };
        let followed = |outcome| self.followed(outcome, motion.duration());
        let points = outcomes.and_then(|outcomes| outcomes.into_iter().map(followed).collect());
        points.map_err(|source| SpectrumError::Run { height, thickness, source })
    }

    /// Follows the free motion after a record of `duration` \[s\].
    fn followed(&self, outcome: Outcome, duration: f64) -> Result<Point, SolverError> {
        let Outcome { mut state, mut overturning, .. } = outcome;
        let step = FREE_STEP / self.motion.wall().rocking_rate();
        let mut memo = Memo::default();
        for index in 0..MOST_FREE_STEPS {
            if overturning.is_some() || peak_is_final(self.motion.wall(), &state) {
                break;
            }
            let report = advance(&self.motion, &mut state, step, &mut memo)?;
            overturning = report.overturning.map(|offset| duration + f64::from(index) * step + offset);
        }
        let wall = self.motion.wall();
        let Peaks { positive, negative } = state.peaks;
        let rocked =
            positive > wall.statics().elastic_end(1.0) || negative > wall.statics().elastic_end(-1.0);
        let [_, ratio] = state.reported_peak(wall.body().instability, overturning.is_some());
        Ok(Point { ratio, rocked, overturning })
    }
}
