//! Extremes: what happens at the edges, each with the figure that proves it and the limit derived for it.

use super::{FreeMotion, StabilityError};
use rocking_wall::solver::record::{RecordSolver, Samples, Start, Still};
use rocking_wall::solver::{Memo, Method, Motion, Phase, Segment, State};
use rocking_wall::variables::{DampingModel, DampingSource, ForceLaw, Impact, Mechanism, RestitutionSource};
use rocking_wall::wall::{Parameters, Support, Wall};

/// One extreme.
#[derive(Clone, Debug, PartialEq)]
pub struct Extreme {
    /// The case.
    pub name: &'static str,
    /// What happens, and what the figure is.
    pub what: &'static str,
    /// The figure.
    pub figure: f64,
    /// The largest it may be.
    pub limit: f64,
}

impl Extreme {
    /// Whether the figure keeps its limit.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.figure <= self.limit
    }
}

type Outcome = Result<f64, StabilityError>;
/// Name, what happens, limit, and how the figure is found.
type Case = (&'static str, &'static str, f64, fn() -> Outcome);

const AGREE: &str = "exact against adaptive (1e-13): |Δu|/u_ins";
const GROUPS: &str = "|Δu|/u_ins from the default wall, equal groups";

/// Every case; the limits follow from ε = 2.2e-16, from the amplification of the case and from the tolerance 1e-13.
const CASES: [Case; 24] = [
    // u(t) = u_ins − δ cosh(pt) is 0 at t = acosh(u_ins/δ)/p; pt = 28 rounds to 28 ε, times the slope u_ins p
    ("u₀ = (1 − 1e-12) u_ins", "falls back; |u|/u_ins when it should pass 0", 1e-13, separatrix),
    ("overdamped, ξ = 2", "creeps back; growth of the energy in 5 ms steps", 64.0 * f64::EPSILON, overdamped),
    ("undamped for 1e5 s, one segment", "relative drift of the energy", 1e-11, undamped_at_once),
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
    ("e = 1", "never rests; relative energy drift over 100 s", 1e-11, elastic_impacts),
    ("impacts accumulating", "rests at the limit of impact times; relative error", 1e-9, accumulating),
    ("motion of 1e-310 m/s²", "subnormal: |u| stays finite and below 1e-300 m", 1e-300, || tiny(1e-310)),
    ("motion of 1e-160 m/s²", "its square underflows: relative response error", 1e-12, underflow),
    ("motion of 1e300 m/s²", "overturns at once or reports an error; 0 if so", 0.0, huge),
];

/// Runs every case.
///
/// # Errors
/// [`StabilityError`], if one cannot be run.
pub fn extremes() -> Result<Vec<Extreme>, StabilityError> {
    let run = |&(name, what, limit, figure): &Case| Ok(Extreme { name, what, figure: figure()?, limit });
    CASES.iter().map(run).collect()
}

/// The default wall, undamped and at rest.
fn free() -> Parameters {
    Parameters {
        damping_model: DampingModel::None,
        damping_source: DampingSource::Given,
        u_start: 0.0,
        ..Parameters::default()
    }
}

fn rigid(restitution: f64) -> Parameters {
    Parameters {
        force_law: ForceLaw::RigidLinear,
        impact: Impact::Restitution,
        restitution_source: RestitutionSource::Given,
        restitution,
        ..free()
    }
}

fn strip(hinge_ratio: f64, overburden_in_weights: f64) -> Parameters {
    let height = 3.0;
    let thickness = 0.1 * hinge_ratio * height;
    let damping = DampingModel::ConstantCoefficient;
    let weight = 1800.0 * 9.81 * height * thickness;
    Parameters {
        mechanism: Mechanism::VerticalSpanning,
        height,
        thickness,
        hinge_ratio,
        overburden: overburden_in_weights * weight,
        damping_model: damping,
        xi: 0.02,
        ..free()
    }
}

fn released(parameters: &Parameters, method: Method, fraction: f64) -> Result<FreeMotion, StabilityError> {
    let wall = Wall::new(parameters)?;
    let start = fraction * wall.body().instability.positive;
    Ok(FreeMotion::new(Motion::new(wall, method), start))
}

fn separatrix() -> Outcome {
    let mut free = released(&rigid(1.0), Method::Exact, 1.0 - 1e-12)?;
    let (wall, u_ins) = (free.motion.wall().clone(), free.motion.wall().body().instability.positive);
    let distance = (u_ins - free.state.displacement) / u_ins;
    free.advance(libm::acosh(1.0 / distance) / wall.rocking_rate())?;
    Ok(free.state.displacement.abs() / u_ins)
}

fn overdamped() -> Outcome {
    let parameters = Parameters { damping_model: DampingModel::ConstantCoefficient, xi: 2.0, ..free() };
    let mut motion = released(&parameters, Method::Exact, 0.9)?;
    let mut growth = 0.0_f64;
    for _ in 0..4000 {
        growth = growth.max(motion.advance(5e-3)?);
    }
    Ok(growth)
}

fn undamped_at_once() -> Outcome {
    let mut motion = released(&free(), Method::Exact, 0.9)?;
    Ok(motion.advance(1e5)?.abs())
}

fn undamped_in_steps() -> Outcome {
    let free = released(&free(), Method::Exact, 0.9)?;
    let solver = RecordSolver::new(&free.motion, 5e-3);
    let start = Start { state: free.state, factor: 1.0 };
    let passage = solver.run(start, &Still(20_000_001), false, |_, _, _| {})?;
    let State { displacement, velocity, .. } = passage.state;
    Ok((free.motion.wall().energy(displacement, velocity) / free.first_energy - 1.0).abs())
}

/// Free vibrations on the wall's own clock against those of the default wall; no damping, so that the groups are equal.
fn groups(parameters: &Parameters) -> Outcome {
    let mut one = released(&free(), Method::Exact, 0.9)?;
    let mut other = released(parameters, Method::Exact, 0.9)?;
    let mut largest = 0.0_f64;
    for _ in 0..400 {
        for motion in [&mut one, &mut other] {
            let tick = 0.1 / motion.motion.wall().rocking_rate();
            motion.advance(tick)?;
        }
        let ratio =
            |motion: &FreeMotion| motion.state.displacement / motion.motion.wall().displacement_scale();
        largest = largest.max((ratio(&one) - ratio(&other)).abs());
    }
    Ok(largest)
}

/// Forcing of a Ricker pulse with a peak of `strength` times F₀/`m_eff`, one tenth of the wall's time constant wide.
fn pulse(wall: &Wall, strength: f64) -> (Vec<f64>, f64) {
    let body = wall.body();
    let onset = body.strength.positive / body.effective_mass;
    let duration = 1.0 / wall.rocking_rate();
    let step = duration / 200.0;
    let sample = |index: u32| {
        let z = std::f64::consts::PI * (f64::from(index) * step / duration - 1.0);
        strength * onset * 2.0 * (1.0 - 2.0 * z * z) * libm::exp(-z * z)
    };
    ((0..4000).map(sample).collect(), step)
}

/// Displacements over `u_ins` under a record of forcing, and the time of overturning.
fn history(
    parameters: &Parameters,
    method: Method,
    forcing: &[f64],
    step: f64,
) -> Result<(Vec<f64>, Option<f64>), StabilityError> {
    let motion = Motion::new(Wall::new(parameters)?, method);
    let solver = RecordSolver::new(&motion, step);
    let start = Start { state: motion.start_under(0.0, 0.0, forcing[0]), factor: 1.0 };
    let mut displacements = vec![0.0];
    let scale = motion.wall().displacement_scale();
    let passage = solver.run(start, &Samples(forcing), true, |_, u, _| displacements.push(u / scale))?;
    Ok((displacements, passage.overturning))
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn agreement(parameters: &Parameters, strength: f64) -> Outcome {
    let (forcing, step) = pulse(&Wall::new(parameters)?, strength);
    let (exact, _) = history(parameters, Method::Exact, &forcing, step)?;
    let (adaptive, _) = history(parameters, Method::Adaptive { tolerance: 1e-13 }, &forcing, step)?;
    // a wall that hardly moved would prove nothing
    let moved = exact.iter().fold(0.0, |largest: f64, u| largest.max(u.abs())) > 0.05;
    Ok(if moved { apart(&exact, &adaptive) } else { f64::INFINITY })
}

fn strong_pulse() -> Outcome {
    let parameters = free();
    let wall = Wall::new(&parameters)?;
    let onset = wall.body().strength.positive / wall.body().effective_mass;
    // the pulse's peak is twice its strength; λ a = 10 g
    let strength = 0.5 * wall.body().participation * 98.1 / onset;
    let (forcing, step) = pulse(&wall, strength);
    let (_, exact) = history(&parameters, Method::Exact, &forcing, step)?;
    let (_, adaptive) = history(&parameters, Method::Adaptive { tolerance: 1e-13 }, &forcing, step)?;
    Ok(match (exact, adaptive) {
        (Some(exact), Some(adaptive)) => (exact - adaptive).abs(),
        _ => f64::INFINITY,
    })
}

fn splitting(duration: f64, parts: u32) -> Outcome {
    let parameters = Parameters { damping_model: DampingModel::ConstantCoefficient, xi: 0.02, ..free() };
    let mut whole = released(&parameters, Method::Exact, 0.9)?;
    let mut split = released(&parameters, Method::Exact, 0.9)?;
    whole.advance(duration)?;
    for _ in 0..parts {
        split.advance(duration / f64::from(parts))?;
    }
    let scale = whole.motion.wall().displacement_scale();
    let (u, v) = (whole.state.displacement, whole.state.velocity);
    Ok(((u - split.state.displacement).abs() / scale).max(((v - split.state.velocity) / v).abs()))
}

fn fine_record() -> Outcome {
    let parameters = Parameters { damping_model: DampingModel::ConstantCoefficient, xi: 0.02, ..free() };
    let onset = {
        let wall = Wall::new(&parameters)?;
        wall.body().strength.positive / wall.body().effective_mass
    };
    let coarse: Vec<f64> = (0..1000_u32).map(|i| 0.7 * onset * libm::sin(0.37 * f64::from(i))).collect();
    let mut fine = Vec::with_capacity(100 * coarse.len());
    for ends in coarse.windows(2) {
        fine.extend((0..100_u32).map(|part| ends[0] + (ends[1] - ends[0]) * f64::from(part) / 100.0));
    }
    fine.extend(coarse.last());
    let (coarse, _) = history(&parameters, Method::Exact, &coarse, 1e-2)?;
    let (fine, _) = history(&parameters, Method::Exact, &fine, 1e-4)?;
    let fine: Vec<f64> = fine.into_iter().step_by(100).collect();
    Ok(apart(&coarse, &fine))
}

fn plastic() -> Outcome {
    let mut motion = released(&rigid(0.0), Method::Exact, 0.9)?;
    motion.advance(100.0)?;
    Ok(motion.state.velocity.abs())
}

fn elastic_impacts() -> Outcome {
    let mut motion = released(&rigid(1.0), Method::Exact, 0.9)?;
    Ok(motion.advance(100.0)?.abs())
}

/// Half cycles of a rigid wall last 2 atanh(v/(p `u_ins`))/p, and v falls by e at each impact.
fn accumulating() -> Outcome {
    let e = 0.7;
    let mut motion = released(&rigid(e), Method::Exact, 0.5)?;
    let wall = motion.motion.wall().clone();
    let p = wall.rocking_rate();
    let mut time = libm::acosh(1.0 / (1.0 - 0.5)) / p;
    let mut ratio = libm::sqrt(1.0 - 0.25);
    for _ in 0..200 {
        ratio *= e;
        time += 2.0 * libm::atanh(ratio) / p;
    }
    // it rests at that time: not 1e-9 before, and 1e-9 after
    let segment = |duration| Segment { duration, from: Support::default(), to: Support::default() };
    let mut memo = Memo::default();
    motion.motion.advance(&mut motion.state, &segment(time * (1.0 - 1e-9)), false, &mut memo)?;
    let too_early = motion.state.phase == Phase::Resting;
    motion.motion.advance(&mut motion.state, &segment(2e-9 * time), false, &mut memo)?;
    let in_time = motion.state.phase == Phase::Resting;
    Ok(if in_time && !too_early { 1e-9 } else { f64::INFINITY })
}

fn tiny(peak: f64) -> Outcome {
    let forcing: Vec<f64> = (0..1000_u32).map(|i| peak * libm::sin(0.1 * f64::from(i))).collect();
    let parameters = free();
    let scale = Wall::new(&parameters)?.displacement_scale();
    let (history, _) = history(&parameters, Method::Exact, &forcing, 1e-2)?;
    Ok(history.iter().fold(0.0, |largest: f64, u| largest.max((u * scale).abs())))
}

/// On the elastic branch the response is linear: a motion 1e160 times smaller moves the wall 1e160 times less.
fn underflow() -> Outcome {
    let parameters = free();
    let forcing =
        |peak: f64| -> Vec<f64> { (0..1000_u32).map(|i| peak * libm::sin(0.1 * f64::from(i))).collect() };
    let (small, _) = history(&parameters, Method::Exact, &forcing(1e-160), 1e-2)?;
    let (large, _) = history(&parameters, Method::Exact, &forcing(1e-3), 1e-2)?;
    let scale = large.iter().fold(0.0, |largest: f64, u| largest.max(u.abs()));
    let raised: Vec<f64> = small.iter().map(|u| u * 1e157).collect();
    Ok(apart(&raised, &large) / scale)
}

fn huge() -> Outcome {
    let parameters = free();
    let motion = Motion::new(Wall::new(&parameters)?, Method::Exact);
    let mut state = motion.start(0.0, 0.0, Support::rigid(1e300));
    let push = Support::rigid(1e300);
    let segment = Segment { duration: 1e-3, from: push, to: push };
    let before = state;
    let fine = match motion.advance(&mut state, &segment, false, &mut Memo::default()) {
        Ok(_) => state.overturned && state.displacement.is_finite() && state.velocity.is_finite(),
        Err(_) => state == before,
    };
    Ok(if fine { 0.0 } else { 1.0 })
}
