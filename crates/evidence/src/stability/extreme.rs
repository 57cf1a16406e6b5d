//! Extremes: cases at the edges of the model, each with a value that proves it and the limit derived for it.

use crate::{Comparison, EvidenceError};

use super::released::Released;
use crate::accuracy::refined;
use crate::reproduce::rotations::largest_difference;
use record::{Forcing, RecordSolver, RunEnd, RunStart};
use rocking_wall::solver::{Memo, Method, Motion, Phase, Segment, State};
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Mechanism};
use rocking_wall::wall::{Parameters, Support, Wall};
use run::bisection::first_true;

type Value = Result<f64, EvidenceError>;
/// Name, criterion, limit, and how the value is found.
type ExtremeCase = (&'static str, &'static str, f64, fn() -> Value);

const AGREE: &str = "exact against adaptive (1e-13): |Δu|/u_ins";
const GROUPS: &str = "|Δu|/u_ins from the default wall, equal groups";

/// All cases. The limits follow from ε = 2.2e-16, from the amplification of the case and from the tolerance
/// 1e-13.
const CASES: [ExtremeCase; 24] = [
    // u(t) = u_ins − δ cosh(pt) is 0 at t = acosh(u_ins/δ)/p; pt = 28 rounds to 28 ε, times the slope u_ins p
    ("u₀ = (1 − 1e-12) u_ins", "falls back; |u|/u_ins when it should pass 0", 1e-13, separatrix),
    ("overdamped, ξ = 2", "creeps back; growth of the energy in 5 ms steps", 64.0 * f64::EPSILON, overdamped),
    ("undamped for 1e5 s, one segment", "relative drift of the energy", 1e-11, || drift(&free(), 1e5)),
    ("undamped for 1e5 s, 5 ms steps", "relative drift of the energy", 1e-8, undamped_in_steps),
    ("a wall of 1 cm", GROUPS, 1e-11, || groups(&Parameters { height: 0.01, thickness: 0.001, ..free() })),
    ("a wall of 100 m", GROUPS, 1e-11, || groups(&Parameters { height: 100.0, thickness: 10.0, ..free() })),
    ("gravity 1.6 m/s²", GROUPS, 1e-11, || groups(&Parameters { gravity: 1.6, ..free() })),
    ("gravity 0.1 m/s²", GROUPS, 1e-11, || groups(&Parameters { gravity: 0.1, ..free() })),
    ("pulse of 10 g", "overturns: exact against adaptive, time in s", 1e-11, strong_pulse),
    ("a₃ = 0.5", AGREE, 1e-10, || agreement(&Parameters { a3: 0.5, ..free() }, 1.0)),
    ("d₁ within 1e-12 of its limit", AGREE, 1e-10, || {
        let law = ForceLaw::Trilinear;
        agreement(&Parameters { force_law: law, a1: 0.05, a3: 0.9, d1: 0.85 - 1e-12, ..free() }, 1.0)
    }),
    ("hinge ratio 0.05", AGREE, 1e-10, || agreement(&strip(0.05, 0.0), 1.0)),
    ("hinge ratio 0.95", AGREE, 1e-10, || agreement(&strip(0.95, 0.0), 1.0)),
    ("overburden 100 W", AGREE, 1e-10, || agreement(&strip(0.5, 100.0), 1.0)),
    ("steps of 1e-12 s", "1000 against one: larger of |Δu|/u_ins, |Δu̇/u̇|", 1e-12, || {
        splitting(1e-9, 1000)
    }),
    ("steps of 10 s", "one against 1000: larger of |Δu|/u_ins, |Δu̇/u̇|", 1e-11, || {
        splitting(10.0, 1000)
    }),
    ("record at 10 kHz", "against the same motion at 100 Hz: |Δu|/u_ins", 1e-10, fine_record),
    ("a₁ = 1e-6", AGREE, 1e-9, || agreement(&Parameters { a1: 1e-6, ..free() }, 1.0)),
    ("e = 0", "stops at its first impact; |u̇| after it", 0.0, plastic),
    ("e = 1", "never rests; relative energy drift over 100 s", 1e-11, || drift(&rigid(1.0), 100.0)),
    // it rests at 1e-13 u_ins p; the impacts left out take 2e-13/(1 − e)/p = 7e-13/p of some 6/p
    ("impacts accumulating", "rests at the limit of impact times; relative error", 1e-12, accumulating),
    ("motion of 1e-310 m/s²", "subnormal: |u| stays finite and below 1e-300 m", 1e-300, || tiny(1e-310)),
    ("motion of 1e-160 m/s²", "its square underflows: relative response error", 1e-12, underflow),
    // the step to u_ins and √ take a few roundings
    ("motion of 1e300 m/s²", "overturns at √(2 u_ins/p); relative error", 1e-15, huge),
];

/// Runs all cases.
///
/// # Errors
/// [`EvidenceError`] if one cannot be run.
pub fn extremes() -> Result<Vec<Comparison>, EvidenceError> {
    let run = |&(case, criterion, limit, value): &ExtremeCase| {
        Ok(Comparison::limited(case, criterion, value()?, limit))
    };
    CASES.iter().map(run).collect()
}

/// The default wall, undamped and at rest.
fn free() -> Parameters {
    Parameters { damping_model: DampingModel::None, u_start: 0.0, ..Parameters::default() }
}

/// The default wall with ξ of a constant damping coefficient.
fn damped(xi: f64) -> Parameters {
    Parameters { damping_model: DampingModel::ConstantCoefficient, xi, ..free() }
}

fn rigid(restitution: f64) -> Parameters {
    Parameters { force_law: ForceLaw::RigidLinear, impact: Impact::Restitution, restitution, ..free() }
}

fn strip(hinge_ratio: f64, overburden_in_weights: f64) -> Parameters {
    let height = 3.0;
    let thickness = 0.1 * hinge_ratio * height;
    let weight = 1800.0 * 9.81 * height * thickness;
    Parameters {
        mechanism: Mechanism::VerticalSpanning,
        height,
        thickness,
        hinge_ratio,
        overburden: overburden_in_weights * weight,
        ..damped(0.02)
    }
}

/// Releases a wall from a fraction of `u_ins`, to be followed by the exact solver.
fn released(parameters: &Parameters, fraction: f64) -> Result<Released, EvidenceError> {
    Ok(Released::new(Motion::new(Wall::new(parameters)?, Method::Exact), fraction))
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest, value| largest.max(value.abs()))
}

fn separatrix() -> Value {
    let mut wall = released(&rigid(1.0), 1.0 - 1e-12)?;
    let u_ins = wall.motion.wall().body().instability.positive;
    let distance = (u_ins - wall.state.displacement) / u_ins;
    wall.advance(libm::acosh(1.0 / distance) / wall.motion.wall().rocking_rate())?;
    Ok(wall.state.displacement.abs() / u_ins)
}

fn overdamped() -> Value {
    let mut wall = released(&damped(2.0), 0.9)?;
    let mut growth = 0.0_f64;
    for _ in 0..4000 {
        growth = growth.max(wall.advance(5e-3)?);
    }
    Ok(growth)
}

/// Relative drift of the energy over one segment.
fn drift(parameters: &Parameters, duration: f64) -> Value {
    Ok(released(parameters, 0.9)?.advance(duration)?.abs())
}

fn undamped_in_steps() -> Value {
    let wall = released(&free(), 0.9)?;
    let solver = RecordSolver::new(&wall.motion, 5e-3);
    let start = RunStart { state: wall.state, factor: 1.0 };
    let State { displacement, velocity, .. } =
        solver.run(start, Forcing::Still(20_000_001), RunEnd::OfRecord)?.state;
    Ok((wall.motion.wall().energy(displacement, velocity) / wall.first_energy - 1.0).abs())
}

/// Compares free vibrations over p t with those of the default wall. Without damping the groups are equal.
fn groups(parameters: &Parameters) -> Value {
    let mut walls = [released(&free(), 0.9)?, released(parameters, 0.9)?];
    let mut largest = 0.0_f64;
    for _ in 0..400 {
        let mut ratios = [0.0; 2];
        for (wall, ratio) in walls.iter_mut().zip(&mut ratios) {
            wall.advance(0.1 / wall.motion.wall().rocking_rate())?;
            *ratio = wall.state.displacement / wall.motion.wall().displacement_scale();
        }
        largest = largest.max((ratios[0] - ratios[1]).abs());
    }
    Ok(largest)
}

/// Returns the forcing F₀/`m_eff` at which a rigid wall begins to rock \[m/s²\].
fn onset(wall: &Wall) -> f64 {
    wall.body().strength.positive / wall.body().effective_mass
}

/// Forcing of a Ricker pulse with a peak of twice `strength` times the onset, one time constant 1/p wide, and
/// its step.
fn pulse(wall: &Wall, strength: f64) -> (Vec<f64>, f64) {
    let (onset, duration) = (onset(wall), 1.0 / wall.rocking_rate());
    let step = duration / 200.0;
    let sample = |index: u32| {
        let z = std::f64::consts::PI * (f64::from(index) * step / duration - 1.0);
        strength * onset * 2.0 * (1.0 - 2.0 * z * z) * libm::exp(-z * z)
    };
    ((0..4000).map(sample).collect(), step)
}

/// Displacements over `u_ins` under a record of forcing, and the time of overturning.
type RunOfForcing = (Vec<f64>, Option<f64>);

fn history(
    parameters: &Parameters,
    method: Method,
    forcing: &[f64],
    step: f64,
) -> Result<RunOfForcing, EvidenceError> {
    let motion = Motion::new(Wall::new(parameters)?, method);
    let solver = RecordSolver::new(&motion, step);
    let start = RunStart { state: motion.start_under(0.0, 0.0, forcing[0]), factor: 1.0 };
    let mut displacements = vec![0.0];
    let scale = motion.wall().displacement_scale();
    let mut observe = |_, u: f64, _| displacements.push(u / scale);
    let outcome =
        solver.run_observed(start, Forcing::Samples(forcing), RunEnd::AtOverturning, &mut observe)?;
    Ok((displacements, outcome.overturning))
}

/// Returns the histories of the exact and of the adaptive solver under a pulse.
fn both(parameters: &Parameters, strength: f64) -> Result<[RunOfForcing; 2], EvidenceError> {
    let (forcing, step) = pulse(&Wall::new(parameters)?, strength);
    let exact = history(parameters, Method::Exact, &forcing, step)?;
    Ok([exact, history(parameters, Method::Adaptive { tolerance: 1e-13 }, &forcing, step)?])
}

fn agreement(parameters: &Parameters, strength: f64) -> Value {
    let [(exact, _), (adaptive, _)] = both(parameters, strength)?;
    // the comparison proves something only if the wall moves far
    let moved = largest(exact.iter().copied()) > 0.05;
    Ok(if moved { largest_difference(&exact, &adaptive) } else { f64::INFINITY })
}

fn strong_pulse() -> Value {
    let wall = Wall::new(&free())?;
    // the pulse's peak is twice its strength; λ a = 10 g
    let strength = 0.5 * wall.body().participation * 98.1 / onset(&wall);
    Ok(match both(&free(), strength)?.map(|(_, overturning)| overturning) {
        [Some(exact), Some(adaptive)] => (exact - adaptive).abs(),
        _ => f64::INFINITY,
    })
}

fn splitting(duration: f64, parts: u32) -> Value {
    let (mut whole, mut split) = (released(&damped(0.02), 0.9)?, released(&damped(0.02), 0.9)?);
    whole.advance(duration)?;
    for _ in 0..parts {
        split.advance(duration / f64::from(parts))?;
    }
    let scale = whole.motion.wall().displacement_scale();
    let (u, v) = (whole.state.displacement, whole.state.velocity);
    Ok(((u - split.state.displacement).abs() / scale).max(((v - split.state.velocity) / v).abs()))
}

fn fine_record() -> Value {
    let parameters = damped(0.02);
    let onset = onset(&Wall::new(&parameters)?);
    let coarse: Vec<f64> = (0..1000_u32).map(|i| 0.7 * onset * libm::sin(0.37 * f64::from(i))).collect();
    let (fine, _) = history(&parameters, Method::Exact, &refined(&coarse, 100), 1e-4)?;
    let (coarse, _) = history(&parameters, Method::Exact, &coarse, 1e-2)?;
    let fine: Vec<f64> = fine.into_iter().step_by(100).collect();
    Ok(largest_difference(&coarse, &fine))
}

fn plastic() -> Value {
    let mut wall = released(&rigid(0.0), 0.9)?;
    wall.advance(100.0)?;
    Ok(wall.state.velocity.abs())
}

/// Half cycles of a rigid wall last 2 atanh(v/(p `u_ins`))/p, and v falls by e at each impact.
fn accumulating() -> Value {
    let e = 0.7;
    let p = Wall::new(&rigid(e))?.rocking_rate();
    let mut time = libm::acosh(1.0 / (1.0 - 0.5)) / p;
    let mut ratio = libm::sqrt(1.0 - 0.25);
    for _ in 0..200 {
        ratio *= e;
        time += 2.0 * libm::atanh(ratio) / p;
    }
    let rests_by = |end: f64| -> Result<bool, EvidenceError> {
        let mut wall = released(&rigid(e), 0.5)?;
        wall.advance(end)?;
        Ok(wall.state.phase == Phase::Resting)
    };
    let [moving, resting] = [0.9 * time, 1.1 * time];
    if rests_by(moving)? || !rests_by(resting)? {
        return Ok(f64::INFINITY);
    }
    // halved down to neighbouring doubles
    let rests = first_true([moving, resting], f64::MANTISSA_DIGITS, rests_by)?;
    Ok((rests / time - 1.0).abs())
}

/// History of the default wall under 10 s of a sine.
fn under_sine(peak: f64) -> Result<Vec<f64>, EvidenceError> {
    let forcing: Vec<f64> = (0..1000_u32).map(|i| peak * libm::sin(0.1 * f64::from(i))).collect();
    Ok(history(&free(), Method::Exact, &forcing, 1e-2)?.0)
}

fn tiny(peak: f64) -> Value {
    let scale = Wall::new(&free())?.displacement_scale();
    Ok(largest(under_sine(peak)?.iter().map(|u| u * scale)))
}

/// On the elastic branch the response is linear: a motion 1e157 times smaller moves the wall 1e157 times
/// less.
fn underflow() -> Value {
    let (small, large) = (under_sine(1e-160)?, under_sine(1e-3)?);
    let raised: Vec<f64> = small.iter().map(|u| u * 1e157).collect();
    Ok(largest_difference(&raised, &large) / largest(large.iter().copied()))
}

/// F(u) is negligible beside such a push: |u| = ½ p t² with the forcing p, and the wall reaches `u_ins` at
/// √(2 `u_ins`/p).
fn huge() -> Value {
    let motion = Motion::new(Wall::new(&free())?, Method::Exact);
    let push = Support::rigid(1e300);
    let mut state = motion.start(0.0, 0.0, push);
    let segment = Segment { duration: 1e-3, from: push, to: push };
    let report = motion.advance(&mut state, &segment, false, &mut Memo::default())?;
    let body = motion.wall().body();
    let due = libm::sqrt(2.0 * body.instability.negative / body.forcing(push).abs());
    let is_finite = state.displacement.is_finite() && state.velocity.is_finite();
    Ok(match report.overturning.filter(|_| is_finite) {
        Some(time) => (time / due - 1.0).abs(),
        None => f64::INFINITY,
    })
}
