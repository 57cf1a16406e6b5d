//! Compares the record path with the path over segments, which the FMU uses.

use proptest::prelude::*;
use proptest::sample::select;
use record::{Forcing, Outcome, RecordSolver, RunEnd, RunStart};
use rocking_wall::simulation::{Progress, Simulation};
use rocking_wall::solver::{Method, Motion, Segment};
use rocking_wall::variables::{DampingModel, ForceLaw};
use rocking_wall::wall::{Parameters, Support, Wall};

use crate::configuration::{configuration, mostly_of};
use crate::properties::{motions, onset, walls};
use crate::secant_models;

/// A wall's motion and the start of a run under a forcing.
fn prepared(parameters: &Parameters, forcing: &[f64], factor: f64) -> (Motion, RunStart) {
    let wall = Wall::new(parameters).unwrap();
    let method = Method::new(parameters, &wall, parameters.tolerance).unwrap();
    let motion = Motion::new(wall, method);
    let Parameters { u_start, u_dot_start, .. } = *parameters;
    let state = motion.start_under(u_start, u_dot_start, factor * forcing[0]);
    (motion, RunStart { state, factor })
}

/// Returns the history of u and the outcome of the run.
pub(crate) fn alone(parameters: &Parameters, forcing: &[f64], step: f64, factor: f64) -> (Vec<f64>, Outcome) {
    let (motion, start) = prepared(parameters, forcing, factor);
    let mut history = vec![start.state.displacement];
    let solver = RecordSolver::new(&motion, step);
    let mut observe = |index: usize, u, _| {
        assert_eq!(index, history.len());
        history.push(u);
    };
    let outcome =
        solver.run_observed(start, Forcing::Samples(forcing), RunEnd::OfRecord, &mut observe).unwrap();
    assert_eq!(history.len(), forcing.len());
    (history, outcome)
}

proptest! {
    #![proptest_config(configuration())]

    /// The same for walls that start in motion, with steps from far below any period to longer than a swing.
    #[test]
    fn any_step_agrees(parameters in moving(), motion in motions(), exponent in -4.0_f64..1.0) {
        let wall = Wall::new(&parameters).unwrap();
        let accelerations: Vec<f64> = motion.iter().map(|a| onset(&wall) * a).collect();
        let step = 10.0_f64.powf(exponent) / wall.rocking_rate();
        agree(&parameters, &accelerations, step)?;
    }

    /// Steps over a record and segments one by one agree in u, extremes and events: to rounding, and with
    /// secant damping to the tolerance 1e-13.
    #[test]
    fn records_and_segments_agree(parameters in walls(), motion in motions(), refinement in 1_u32..40) {
        records_agree(&parameters, &motion, refinement)?;
    }

    /// With secant damping and the default tolerance, record and segments stay within a tenth of it of the
    /// motion at a tolerance of 1e-14.
    #[test]
    fn secant_damping_stays_within_the_tolerance(
        wall in walls(),
        damping_model in select(secant_models().collect::<Vec<_>>()),
        motion in motions(),
        exponent in -3.0_f64..0.3,
    ) {
        let force_law = match wall.force_law {
            ForceLaw::RigidLinear => ForceLaw::Bilinear,
            law => law,
        };
        let tight = Parameters { damping_model, force_law, tolerance: 1e-14, ..wall };
        prop_assume!(Wall::new(&tight).is_ok());
        let wall = Wall::new(&tight).unwrap();
        let accelerations: Vec<f64> = motion.iter().map(|a| onset(&wall) * a).collect();
        let step = 10.0_f64.powf(exponent) / wall.rocking_rate();
        let usual = Parameters { tolerance: 1e-8, ..tight.clone() };
        let (history, _) = alone(&usual, &forcing(&wall, &accelerations), step, 1.0);
        let by_segments = displacements(&segments(&usual, &accelerations, step));
        let reference = Reference::new(&tight, &accelerations, step);
        prop_assume!(reference.amplification < 1e5);
        let allowed = 1e-9 * reference.amplification;
        for difference in [history, by_segments].map(|history| reference.apart(&history)) {
            prop_assert!(difference <= allowed, "differs by {difference:e}, allowed {allowed:e}");
        }
    }
}

/// A run of a batch gives the same bits alone and beside others, for any number and order, and agrees with a
/// single run.
#[test]
fn lanes_do_not_disturb_each_other() {
    batches_agree(1, prop_oneof![walls(), moving()]);
}

/// Least share of the runs that can be compared with single runs. Found were 99 %.
const COMPARED: f64 = 0.95;

/// Compares batches of walls with single runs, and counts the runs that could be compared.
pub(crate) fn batches_agree(one_of: u32, walls: impl Strategy<Value = Parameters>) {
    // fine steps go side by side, coarse ones one by one
    let refinement = prop_oneof![1_u32..20, 20_u32..200];
    let end = prop_oneof![Just(RunEnd::OfRecord), Just(RunEnd::AtOverturning)];
    let cases = (walls, motions(), refinement, 2_usize..20, end);
    mostly_of(one_of, COMPARED, cases, |(wall, motion, refinement, count, end)| {
        Ok([lanes_agree(&wall, &motion, refinement, count, end)?, count])
    });
}

/// Compares the runs of a batch with each alone in one, and with single runs, for a motion in units of the
/// strength. Returns how many could be compared with single runs.
fn lanes_agree(
    parameters: &Parameters,
    motion: &[f64],
    refinement: u32,
    count: usize,
    end: RunEnd,
) -> Result<usize, TestCaseError> {
    let wall = Wall::new(parameters).unwrap();
    let onset = wall.body().strength.positive / wall.body().effective_mass;
    let forcing: Vec<f64> = refined(motion, refinement).iter().map(|p| p * onset).collect();
    let step = 0.3 / wall.rocking_rate() / f64::from(refinement);
    let factors: Vec<f64> = (0..count).map(|i| 1.3 - 0.15 * i as f64).collect();
    let started: Vec<_> = factors.iter().map(|&factor| prepared(parameters, &forcing, factor)).collect();
    let starts: Vec<_> = started.iter().map(|(_, start)| *start).collect();
    let solver = RecordSolver::new(&started[0].0, step);
    let samples = Forcing::Samples(&forcing);
    let batch = solver.batch(samples);
    let together = batch.run(&starts, end).unwrap();
    prop_assert_eq!(together.len(), count);
    let mut compared = 0;
    for (start, outcome) in starts.iter().zip(together) {
        let one = batch.run(&[*start], end).unwrap()[0];
        prop_assert_eq!(one, outcome);
        prop_assert_eq!(one.state.displacement.to_bits(), outcome.state.displacement.to_bits());
        if wall.has_constant_damping() {
            // a number is a vector of one lane
            prop_assert_eq!(solver.run(*start, samples, end).unwrap(), outcome);
        }
        compared += usize::from(outcomes_agree(&wall, &solver, samples, *start, end, &outcome)?);
    }
    Ok(compared)
}

/// Compares a run over a record with segments one by one, for a motion in units of the strength; each of its
/// intervals in a number of steps. Returns the outcome of the run.
pub(crate) fn records_agree(
    parameters: &Parameters,
    motion: &[f64],
    refinement: u32,
) -> Result<Outcome, TestCaseError> {
    let wall = Wall::new(parameters).unwrap();
    // fine steps are plain ones, coarse ones are searched
    let accelerations: Vec<f64> = refined(motion, refinement).iter().map(|a| onset(&wall) * a).collect();
    let step = 0.3 / wall.rocking_rate() / f64::from(refinement);
    agree(parameters, &accelerations, step)
}

/// Compares a run of a batch with a single run: its end, or the time of overturning where it stops there.
/// Returns false where slightly more or less forcing changes the events or much of the motion.
fn outcomes_agree(
    wall: &Wall,
    solver: &RecordSolver<'_>,
    samples: Forcing<'_>,
    start: RunStart,
    end: RunEnd,
    outcome: &Outcome,
) -> Result<bool, TestCaseError> {
    let run = |factor: f64, probe: f64| {
        let mut state = start.state;
        state.displacement *= 1.0 + probe;
        state.velocity *= 1.0 + probe;
        solver.run(RunStart { state, factor }, samples, end).unwrap()
    };
    let (scale, rate) = (wall.displacement_scale(), wall.rocking_rate());
    let one = run(start.factor, 0.0);
    prop_assert_eq!(one.overturning.is_some(), outcome.overturning.is_some());
    let apart = |a: &Outcome, b: &Outcome| {
        if let (RunEnd::AtOverturning, Some(a), Some(b)) = (end, a.overturning, b.overturning) {
            return (a - b).abs() * rate;
        }
        let of = |f: &dyn Fn(&Outcome) -> f64| (f(a) - f(b)).abs();
        of(&|p| p.state.displacement)
            .max(of(&|p| p.state.velocity) / rate)
            .max(of(&|p| p.state.peaks.positive))
            .max(of(&|p| p.state.peaks.negative))
            .max(of(&|p| p.state.tie.yielded.positive))
            .max(of(&|p| p.state.tie.yielded.negative))
            / scale
    };
    let mut amplification = 1.0_f64;
    for probe in [1e-8, -1e-8] {
        let changed = run(start.factor * (1.0 + probe), probe);
        if changed.overturning.is_some() != one.overturning.is_some() {
            return Ok(false);
        }
        amplification = amplification.max(apart(&one, &changed) / 1e-8);
    }
    if amplification > 1e5 {
        return Ok(false);
    }
    // as of `agree`
    let allowed = amplification * (32.0 * f64::EPSILON * (one.work.pieces + 1) as f64 + 1e-13);
    let difference = apart(&one, outcome);
    prop_assert!(difference <= allowed, "differs by {difference:e}, allowed {allowed:e}");
    Ok(true)
}

/// A broken line with each interval cut into `parts`.
fn refined(motion: &[f64], parts: u32) -> Vec<f64> {
    let mut refined = Vec::new();
    for ends in motion.windows(2) {
        let at = |part: u32| ends[0] + (ends[1] - ends[0]) * f64::from(part) / f64::from(parts);
        refined.extend((0..parts).map(at));
    }
    refined
}

/// A motion over segments one by one, up to where it overturns, and how much the wall amplifies a change.
struct Reference {
    progress: Vec<Progress>,
    /// Number of samples at which the wall stands, with slightly more motion too.
    standing: usize,
    scale: f64,
    amplification: f64,
}

impl Reference {
    fn new(parameters: &Parameters, accelerations: &[f64], step: f64) -> Self {
        let (probe, more) = (1e-8, 1.0 + 1e-8);
        let progress = segments(parameters, accelerations, step);
        let changed: Vec<f64> = accelerations.iter().map(|a| a * more).collect();
        let (u_start, u_dot_start) = (parameters.u_start * more, parameters.u_dot_start * more);
        let changed = segments(&Parameters { u_start, u_dot_start, ..parameters.clone() }, &changed, step);
        let both = progress.iter().zip(&changed);
        let standing = both.take_while(|(a, b)| !a.state.overturned && !b.state.overturned).count();
        let scale = Wall::new(parameters).unwrap().displacement_scale();
        let mut reference = Self { progress, standing, scale, amplification: 1.0 };
        reference.amplification += reference.apart(&displacements(&changed)) / probe;
        reference
    }

    /// Returns the largest |Δu|/u_ins of another history while the wall stands.
    fn apart(&self, history: &[f64]) -> f64 {
        let pairs = self.progress.iter().zip(history).take(self.standing);
        pairs.map(|(own, u)| (own.state.displacement - u).abs() / self.scale).fold(0.0, f64::max)
    }
}

fn displacements(history: &[Progress]) -> Vec<f64> {
    history.iter().map(|progress| progress.state.displacement).collect()
}

fn forcing(wall: &Wall, accelerations: &[f64]) -> Vec<f64> {
    accelerations.iter().map(|&a| wall.body().forcing(Support::rigid(a))).collect()
}

/// Compares a run over a record with segments one by one, and returns its outcome.
fn agree(parameters: &Parameters, accelerations: &[f64], step: f64) -> Result<Outcome, TestCaseError> {
    let forcing = forcing(&Wall::new(parameters).unwrap(), accelerations);
    let (history, outcome) = alone(parameters, &forcing, step, 1.0);
    let reference = Reference::new(parameters, accelerations, step);
    prop_assume!(reference.amplification < 1e5);
    // 32 ε for each piece, 16 ε in each of the two motions, amplified as the wall amplifies; the tolerance
    // 1e-13 likewise
    let end = reference.progress[reference.standing - 1];
    let allowed = reference.amplification * (32.0 * f64::EPSILON * (end.work.pieces + 1) as f64 + 1e-13);
    let difference = reference.apart(&history);
    prop_assert!(difference <= allowed, "differs by {difference:e}, allowed {allowed:e}");
    if reference.standing == reference.progress.len() {
        let peaks = outcome.state.peaks.largest() - end.state.peaks.largest();
        prop_assert!(peaks.abs() / reference.scale <= allowed, "peaks differ by {peaks:e} m");
        for sign in [1.0, -1.0] {
            let [ours, theirs] = [&outcome.state, &end.state].map(|state| state.tie.yielded.of(sign));
            prop_assert!((ours - theirs).abs() / reference.scale <= allowed, "yielded {ours} and {theirs} m");
        }
        prop_assert_eq!(outcome.overturning, None);
    }
    Ok(outcome)
}

/// A wall of a multilinear law of two to five corners, on one side or other ones on each, or another, that
/// starts on its way.
fn moving() -> impl Strategy<Value = Parameters> {
    let points = proptest::collection::vec((0.02_f64..0.3, 0.05_f64..0.9), 2..5);
    (walls(), points, any::<bool>(), -0.95_f64..0.95, -1.0_f64..1.0).prop_map(
        |(mut parameters, points, multilinear, start, speed)| {
            let secant = secant_models().any(|model| model == parameters.damping_model);
            if multilinear && !secant {
                let mut corner = 0.0;
                let mut corners: Vec<[f64; 2]> = Vec::new();
                for (width, force) in points {
                    corner += width;
                    corners.push([corner, force]);
                }
                corners.push([corner + 0.2, 0.0]);
                let reach = corners[corners.len() - 1][0];
                parameters.force_law = ForceLaw::Bilinear;
                let side = corners.iter().map(|[u, f]| [u / reach, *f]);
                // the other side is stiffer and weaker, or the same
                let other = side.clone().rev().map(|[u, f]| [-u * u.sqrt(), -0.8 * f]);
                parameters.multilinear = Some(other.filter(|_| speed > 0.0).chain(side).collect());
            }
            let wall = Wall::new(&parameters).expect("a valid wall");
            let u_ins = wall.body().instability;
            parameters.u_start = start * u_ins.of(start);
            parameters.u_dot_start = speed * wall.rocking_rate() * u_ins.of(speed);
            parameters
        },
    )
}

fn segments(parameters: &Parameters, accelerations: &[f64], step: f64) -> Vec<Progress> {
    let mut simulation = Simulation::new(parameters, None, 0.0, Support::rigid(accelerations[0])).unwrap();
    let mut history = vec![*simulation.progress()];
    for ends in accelerations.windows(2) {
        let (from, to) = (Support::rigid(ends[0]), Support::rigid(ends[1]));
        simulation.advance(&Segment { duration: step, from, to }).unwrap();
        history.push(*simulation.progress());
    }
    history
}

/// Corners, overturning and work of a run that goes through all of them.
#[test]
fn a_run_counts_what_happened() {
    let parameters = Parameters {
        force_law: ForceLaw::Trilinear,
        a1: 0.05,
        a3: 0.95,
        d1: 0.6,
        damping_model: DampingModel::ConstantCoefficient,
        u_start: 0.0,
        ..Parameters::default()
    };
    let wall = Wall::new(&parameters).unwrap();
    let onset = wall.body().strength.positive / wall.body().effective_mass;
    let forcing: Vec<f64> =
        (0..2000_u32).map(|i| onset * (f64::from(i) / 1500.0) * libm::sin(0.02 * f64::from(i))).collect();
    let (_, outcome) = alone(&parameters, &forcing, 0.01, 1.0);
    let accelerations: Vec<f64> =
        forcing.iter().map(|p| p / wall.body().forcing(Support::rigid(1.0))).collect();
    let reference = segments(&parameters, &accelerations, 0.01);
    let end = reference.last().unwrap();
    assert!(outcome.state.overturned && end.state.overturned);
    assert_eq!((outcome.work.corners, outcome.work.impacts), (end.work.corners, end.work.impacts));
    let (ours, theirs) = (outcome.overturning.unwrap(), end.overturn_time.unwrap());
    assert!((ours - theirs).abs() < 1e-10, "{ours} {theirs}");
}
