//! Rigid-linear walls with small rotations, in closed form: which pulses overturn them, and their steady
//! rocking.
//!
//! With y = `u/u_ins`, τ = p t and f = a/a₀, y″ = y − 1 + f while y > 0. Then c = y′ + y − 1 obeys
//! c′ = c + f, so after a pulse the wall falls if c > 0 and returns if c < 0. All references come from that,
//! in arithmetic of 40 digits.

use std::f64::consts::PI;

use ground_motion::{Pulse, Shape};
use rocking_wall::simulation::{Excitation, RunError, Simulation, segment_of};
use rocking_wall::solver::Segment;
use rocking_wall::variables::{DampingModel, ForceLaw, Impact};
use rocking_wall::wall::{Parameters, Support};
use run::bisection::first_true;
use scene::SceneError;
use study::spectrum::{PulseForm, over_pulses};

use super::given::{Comparisons, within};
use crate::EvidenceError;

/// p of a parapet of 4 m without overburden \[1/s\], and a₀ of one with b/h = 0.1 \[m/s²\].
const RATE_SQUARED: f64 = 1.5 * 9.81 / 4.0;
const ONSET: f64 = 0.1 * 9.81;
/// `u_ins` of that parapet \[m\].
const INSTABILITY: f64 = 0.2;
/// Free motion after a pulse \[1/p\], in which c grows by e²⁰.
const FREE: f64 = 20.0;
/// Halvings of the bracket of a threshold.
const HALVINGS: u32 = 16;
/// Half the bracket of a threshold over it: of pulses that are sampled, and of those that are not.
const SAMPLED: f64 = 1e-6;
const UNSAMPLED: f64 = 1e-9;

/// The default wall with the rigid-linear law, without damping.
pub(super) fn rigid() -> Parameters {
    Parameters {
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        ..Parameters::default()
    }
}

fn restituted(restitution: f64) -> Parameters {
    Parameters { impact: Impact::Restitution, restitution, u_start: 0.0, ..rigid() }
}

/// Finds the `a_p/a₀` from which on a wall falls, near a given one.
fn threshold<E>(given: f64, half: f64, falls: impl FnMut(f64) -> Result<bool, E>) -> Result<f64, E> {
    first_true([given * (1.0 - half), given * (1.0 + half)], HALVINGS, falls)
}

/// Thresholds of pulses that are straight between corners, without an impact.
pub(super) fn straight_pulses() -> Comparisons {
    // 1/(1 − e^−d); 1/(1 − (1 − e^−d)/d); the root of ∫ e^−s f(τ_u + s) ds = 1 with uplift at τ_u = d/(2η)
    const RECTANGLE: [f64; 3] = [2.541_494_082_536_798, 1.581_976_706_869_326_4, 1.156_517_642_749_665_7];
    const FALLING: [f64; 3] = [4.693_484_498_723_19, std::f64::consts::E, 1.761_594_155_955_765];
    const ISOSCELES: [f64; 3] = [4.983_389_430_863_206, 2.972_590_911_909_553_7, 1.960_323_544_076_612_5];
    let pulses: [(_, &[[f64; 2]], _); 3] = [
        ("rectangle", &[[1.0, 1.0]], RECTANGLE),
        ("triangle that falls", &[[1.0, 0.0]], FALLING),
        ("triangle that rises first", &[[0.0, 1.0], [1.0, 0.0]], ISOSCELES),
    ];
    let mut rows = Vec::new();
    for (name, parts, given) in pulses {
        for (length, given) in [0.5, 1.0, 2.0].into_iter().zip(given) {
            let found = threshold(given, UNSAMPLED, |ratio| falls_under(parts, length, ratio))?;
            rows.push((name, format!("a_p/a0, duration {length}/p"), "-", found, given));
        }
    }
    Ok(within(1e-13, rows))
}

/// Whether a wall falls under equal parts of a pulse of unit height, which lasts `length` \[1/p\].
fn falls_under(parts: &[[f64; 2]], length: f64, ratio: f64) -> Result<bool, EvidenceError> {
    let mut simulation = Simulation::new(&restituted(1.0), None, 0.0, Support::default())?;
    let rate = RATE_SQUARED.sqrt();
    let part = length / rate / parts.len() as f64;
    let pulse = parts.iter().map(|ends| (part, ends.map(|height| Support::rigid(-ratio * ONSET * height))));
    for (duration, [from, to]) in pulse.chain([(FREE / rate, [Support::default(); 2])]) {
        let time = simulation.progress().time;
        let moved = simulation.advance(&Segment { duration, from, to });
        moved.map_err(|source| SceneError::from(RunError::Solver { time, source }))?;
    }
    Ok(simulation.progress().state.overturned)
}

/// Thresholds of a half sine without an impact, and of a full sine after one.
pub(super) fn sines() -> Comparisons {
    let half = [
        (1.0, 1.322_396_597_907_876_6),
        (2.0, 1.800_723_930_560_745_8),
        (3.0, 2.293_872_313_439_292),
        (5.0, 3.289_146_777_523_003),
    ];
    let full = [
        (1.0, 1.132_047_110_597_683_7),
        (2.0, 1.225_179_423_268_313_6),
        (3.0, 1.403_565_355_642_782_7),
        (4.0, 1.795_441_595_631_480_4),
        (5.0, 3.018_599_860_871_796),
    ];
    let mut rows = Vec::new();
    for (name, wall, form, given) in [
        ("half sine", rigid(), PulseForm::HalfSine, &half[..]),
        ("sine, after one impact", restituted(0.9), PulseForm::SineCycle, &full[..]),
    ] {
        for &(frequency, given) in given {
            let found = threshold(given, SAMPLED, |ratio| {
                let spectrum = over_pulses(&wall, form, &[frequency], &[ratio], 1)?;
                Ok::<_, EvidenceError>(spectrum.points[0][0].overturning.is_some())
            })?;
            rows.push((name, format!("a_p/a0, ω_p/p = {frequency}"), "-", found, given));
        }
    }
    Ok(within(4e-10, rows))
}

/// Half cycles of steady rocking before the one that is looked at; even.
const BEFORE: f64 = 20.0;

/// Steady rocking under a sine from an impact at τ = 0, phase and velocity after which belong to it: u in the
/// middle of a half cycle.
pub(super) fn steady_rocking() -> Comparisons {
    // a_p/a₀, ω/p, e; phase, velocity over p u_ins, u/u_ins in the middle
    let orbits = [
        ([3.0, 5.0, 0.9], [3.019_613_695_235_699, 0.830_702_470_891_912_5, 0.161_924_266_061_690_5]),
        ([1.5, 4.0, 0.85], [2.893_252_768_604_902_7, 0.657_760_624_146_193_9, 0.157_972_623_124_583]),
        ([2.0, 6.0, 0.9], [2.997_297_135_322_084_4, 0.546_566_738_831_853_4, 0.086_809_631_492_899]),
    ];
    let rate = RATE_SQUARED.sqrt();
    let mut rows = Vec::new();
    for ([ratio, frequency, restitution], [phase, velocity, middle]) in orbits {
        let half_cycle = PI / (frequency * rate);
        let shape = Shape::Harmonic { phase: phase + PI, end: None };
        let (amplitude, frequency) = (ratio * ONSET, 0.5 / half_cycle);
        let motion = Pulse { shape, amplitude, frequency }.motion(Some((BEFORE + 1.0) * half_cycle));
        let excitation = Excitation::new(motion?, None);
        let start = Parameters { u_dot_start: velocity * rate * INSTABILITY, ..restituted(restitution) };
        let support = segment_of(Some(&excitation), 0.0, 0.0).from;
        let mut simulation = Simulation::new(&start, None, 0.0, support)?;
        for cycles in [0.0, BEFORE] {
            let end = (cycles + 0.5) * half_cycle;
            simulation.advance_to(end, Some(&excitation), None).map_err(SceneError::from)?;
            let case = format!("a_p/a0 = {ratio}, e = {restitution}");
            let found = simulation.progress().state.displacement / INSTABILITY;
            rows.push((case, format!("u/u_ins after {cycles} impacts"), "-", found, middle));
        }
    }
    Ok(within(1e-11, rows))
}
