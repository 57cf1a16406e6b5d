//! Rocking spectra: closed-form overturning thresholds, dimensionless groups, rest and threads.

use std::f64::consts::{PI, TAU};

use ground_motion::{GroundMotion, SyntheticMotion};
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Mechanism};
use rocking_wall::wall::{Parameters, Wall};
use scene::Scene;
use scene::response::Response;
use study::spectrum::{
    PulseForm, RecordPulse, RecordPulses, RockingSpectrum, Size, Slenderness, SpectrumError, onset,
    over_pulses, over_walls,
};

use crate::uplift::{Uplift, root, straight};

fn rigid(restitution: f64) -> Parameters {
    Parameters {
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        restitution,
        ..Parameters::default()
    }
}

/// Returns a bilinear wall whose damping does not depend on its shape.
fn bilinear() -> Parameters {
    Parameters { xi: 0.03, ..Parameters::default() }
}

/// A wall rocks where u leaves the elastic branch, also where an impact parts that branch at u = 0.
#[test]
fn walls_rock_beyond_their_elastic_branch() {
    let damped = Parameters { a1: 0.05, ..bilinear() };
    let bouncing = Parameters { impact: Impact::Restitution, restitution: 0.9, ..damped.clone() };
    for wall in [damped, bouncing] {
        let spectrum = over_pulses(&wall, PulseForm::Ricker, &[1.0], &[0.02, 0.1, 0.5, 1.5], 1).unwrap();
        let points: Vec<_> = spectrum.points.concat();
        assert!(points.iter().all(|point| point.rocked == (point.ratio > 0.05)), "{points:?}");
        assert!(!points[0].rocked && points[3].rocked, "{points:?}");
    }
}

/// Returns the least a_p/a₀ that overturns, by bisection to rounding.
fn threshold(form: PulseForm, frequency: f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let overturns = |amplitude: f64| {
        let spectrum = over_pulses(&rigid(0.9), form, &[frequency], &[amplitude], 1).unwrap();
        spectrum.points[0][0].overturning.is_some()
    };
    assert!(!overturns(low) && overturns(high), "{low} to {high} at {frequency}");
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if overturns(middle) { high = middle } else { low = middle }
    }
    high
}

/// After a half sine the block overturns if z > 0 at its end: √(η² − 1) + η exp(−(π − asin(1/η))/β) = β.
/// Without the exponential this is Housner's η² = 1 + β² (The behavior of inverted pendulum structures during
/// earthquakes, Bulletin of the Seismological Society of America 53, 1963), whose pulse starts at uplift.
///
/// The pulse's samples are off by (ωΔt)² a″/12 or less between them and in the mean not at all, but for the
/// step in which the block uplifts: what is left there is below (ωΔt)³/80 = 4e-10 of a_p/p.
#[test]
fn a_half_sine_overturns_at_the_closed_form() {
    for beta in [1.0, 2.0, 3.5, 6.0] {
        let end = std::f64::consts::PI / beta;
        let expected = root(1.0 + 1e-12, 1e3, |eta| Uplift::new(eta, beta).growing(end));
        let housner = (1.0 + beta * beta).sqrt();
        assert!(expected < housner && expected > 0.5 * housner, "{expected}, {housner}");
        let found = threshold(PulseForm::HalfSine, beta, [1.0, 2.0 * expected]);
        assert!((found / expected - 1.0).abs() < 4e-10, "ω_p/p = {beta}: {found}, {expected}");
    }
}

/// The samples of straight pulses are the pulses themselves. What is left are some roundings of y′ + y − 1 in
/// each of 1000 steps, 5e-13, over its slope, 0.1 and more: 5e-12.
#[test]
fn rectangles_and_triangles_overturn_at_the_closed_form() {
    for d in [0.25, 0.5, 1.0, 2.0] {
        for form in [PulseForm::Rectangle, PulseForm::FallingTriangle, PulseForm::Triangle] {
            let expected = straight(form, d);
            let found = threshold(form, std::f64::consts::PI / d, [1.0, 2.0 * expected]);
            assert!((found / expected - 1.0).abs() < 5e-12, "{form:?} of {d}/p: {found}, {expected}");
        }
    }
}

/// During one cycle of a sine the block reaches u_ins from the amplitude at which the closed form does. Just
/// below that amplitude it returns.
#[test]
fn a_sine_cycle_reaches_instability_at_the_closed_form() {
    // longer pulses overturn it after an impact, while they last
    for beta in [2.0, 3.0, 5.0] {
        let end = 2.0 * std::f64::consts::PI / beta;
        let highest = |eta: f64| {
            let uplift = Uplift::new(eta, beta);
            let at = |part: f64| uplift.reach(uplift.start + part * (end - uplift.start));
            // on a grid, and by golden section around its highest point
            let best =
                (0..=400_u32).map(|i| f64::from(i) / 400.0).max_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap();
            let (mut low, mut high) = ((best - 0.0025).max(0.0), (best + 0.0025).min(1.0));
            for _ in 0..60 {
                let (a, b) = (low + 0.382 * (high - low), high - 0.382 * (high - low));
                if at(a) < at(b) { low = a } else { high = b }
            }
            at(low)
        };
        let expected = root(1.0 + 1e-9, 1e3, |eta| highest(eta) - 1.0);
        let p = (1.5 * 9.81 / 4.0_f64).sqrt();
        let during = |factor: f64| {
            let spectrum =
                over_pulses(&rigid(0.9), PulseForm::SineCycle, &[beta], &[factor * expected], 1).unwrap();
            spectrum.points[0][0].overturning.is_some_and(|time| p * time <= end)
        };
        assert_eq!([1.0 - 1e-9, 1.0 + 1e-9].map(during), [false, true], "ω_p/p = {beta}: {expected}");
    }
}

fn assert_alike(a: &RockingSpectrum, b: &RockingSpectrum, tolerance: f64) {
    for (a, b) in a.points.iter().flatten().zip(b.points.iter().flatten()) {
        assert_eq!((a.rocked, a.overturning.is_some()), (b.rocked, b.overturning.is_some()));
        assert!((a.ratio - b.ratio).abs() < tolerance, "{} and {}", a.ratio, b.ratio);
    }
}

/// Walls of any size, slenderness and mechanism have the same dimensionless spectrum if damping and
/// restitution agree.
#[test]
fn pulses_have_one_dimensionless_spectrum() {
    let (columns, rows) = ([0.7, 2.0, 5.0], [0.5, 1.5, 2.5, 4.0, 8.0]);
    for form in [PulseForm::Ricker, PulseForm::SineCycle] {
        for wall in [rigid(0.85), bilinear()] {
            let other =
                Parameters { height: 1.3, thickness: 0.25, width: 3.0, density: 2200.0, ..wall.clone() };
            let strip = Parameters { mechanism: Mechanism::VerticalSpanning, ..other.clone() };
            let first = over_pulses(&wall, form, &columns, &rows, 2).unwrap();
            // rounding, amplified near the instability
            for parameters in [other, strip] {
                assert_alike(&first, &over_pulses(&parameters, form, &columns, &rows, 2).unwrap(), 1e-9);
            }
            let points = || first.points.iter().flatten();
            assert!(
                points().any(|point| point.overturning.is_some()) && points().any(|point| point.ratio < 0.9)
            );
        }
    }
}

/// At one size, a record k times as strong has the same effect on a wall k times as stocky.
#[test]
fn a_stocky_wall_needs_a_stronger_motion() {
    let motion = SyntheticMotion::default().motion().unwrap();
    let spectrum = |scale: f64, ratio: f64| {
        let rows = [ratio, 2.0 * ratio];
        over_walls(
            &bilinear(),
            &motion.scaled(scale),
            Size::Height,
            &[1.0, 3.0],
            Slenderness::Ratio,
            &rows,
            1,
        )
        .unwrap()
    };
    assert_alike(&spectrum(0.5, 10.0), &spectrum(1.0, 5.0), 1e-6);
}

/// A point of the spectrum equals the result of a scene of the wall.
#[test]
fn a_point_is_a_run() {
    let motion = SyntheticMotion::default().motion().unwrap().scaled(0.8);
    let (mut fallen, mut standing) = (0, 0);
    for base in [bilinear(), Parameters::default(), rigid(0.9)] {
        let (radii, angles) = ([1.0, 2.5], [0.08, 0.12]);
        let spectrum =
            over_walls(&base, &motion, Size::SemiDiagonal, &radii, Slenderness::Angle, &angles, 2).unwrap();
        for (row, angle) in spectrum.points.iter().zip(angles) {
            for (point, radius) in row.iter().zip(radii) {
                let mut scene = Scene::default();
                scene.shake(Excitation::new(motion.clone(), None), 20.0, Vec::new());
                scene.parameters = Parameters {
                    height: 2.0 * radius * angle.cos(),
                    thickness: 2.0 * radius * angle.sin(),
                    u_start: 0.0,
                    ..base.clone()
                };
                let summary = Response::of(&scene).unwrap().summary;
                assert_eq!(point.overturning.is_some(), summary.overturned, "R = {radius}, α = {angle}");
                if summary.overturned {
                    assert!((point.overturning.unwrap() - summary.overturn_time.unwrap()).abs() < 1e-5);
                    assert_eq!(point.ratio, 1.0);
                    fallen += 1;
                } else {
                    standing += 1;
                    assert!((point.ratio - summary.u_ratio_max).abs() < 1e-7, "R = {radius}, α = {angle}");
                }
            }
        }
    }
    assert!(fallen > 0 && standing > 0, "{fallen} fallen, {standing} standing");
}

/// The peak may come long after a short pulse: free motion is followed until then, even without damping.
#[test]
fn peaks_after_the_motion_count() {
    let wall = Parameters { damping_model: DampingModel::None, ..Parameters::default() };
    let push = GroundMotion::new(0.01, vec![3.0; 12]).unwrap();
    let spectrum = over_walls(&wall, &push, Size::Height, &[4.0], Slenderness::Ratio, &[10.0], 1).unwrap();
    let mut scene = Scene::default();
    scene.parameters.damping_model = DampingModel::None;
    scene.shake(Excitation::new(push, None), 60.0, Vec::new());
    let summary = Response::of(&scene).unwrap().summary;
    let point = spectrum.points[0][0];
    assert!(point.rocked && !summary.overturned);
    assert!((point.ratio - summary.u_ratio_max).abs() < 1e-12, "{} {}", point.ratio, summary.u_ratio_max);
}

#[test]
fn nothing_moves_without_motion_and_threads_change_nothing() {
    let motion = SyntheticMotion::default().motion().unwrap();
    let (heights, ratios) = ([1.0, 2.0, 4.0], [5.0, 8.0, 12.0, 16.0]);
    let spectrum = |motion: &GroundMotion, threads: usize| {
        over_walls(&bilinear(), motion, Size::Height, &heights, Slenderness::Ratio, &ratios, threads).unwrap()
    };
    let still = spectrum(&motion.scaled(0.0), 2);
    assert!(still.points.iter().flatten().all(|point| point.ratio == 0.0 && !point.rocked));
    let one = spectrum(&motion, 1);
    assert_eq!((one.points.len(), one.points[0].len()), (4, 3));
    for threads in [2, 3, 16] {
        assert_eq!(spectrum(&motion, threads), one);
    }
    let below = over_pulses(&rigid(0.9), PulseForm::Ricker, &[3.0], &[0.0, 0.999, 1.001], 2).unwrap();
    assert_eq!([0, 1, 2].map(|row| below.points[row][0].rocked), [false, false, true]);
}

#[test]
fn what_is_no_wall_is_refused_by_name() {
    let motion = SyntheticMotion::default().motion().unwrap();
    let walls = |parameters: &Parameters, size: (Size, &[f64]), slenderness: (Slenderness, &[f64])| {
        over_walls(parameters, &motion, size.0, size.1, slenderness.0, slenderness.1, 2)
            .unwrap_err()
            .to_string()
    };
    let height: (Size, &[f64]) = (Size::Height, &[3.0]);
    for (error, words) in [
        (
            walls(&bilinear(), (Size::Height, &[-1.0]), (Slenderness::Ratio, &[8.0])),
            &["height h (m) = -1", "height = -1.0 m is below its minimum, 0.001 m"][..],
        ),
        (
            walls(&bilinear(), height, (Slenderness::Ratio, &[f64::NAN])),
            &["h/b = NaN", "thickness = NaN is not a finite number"],
        ),
        (walls(&bilinear(), height, (Slenderness::Angle, &[0.0])), &["α (rad) = 0 ", "above 0"]),
        (walls(&bilinear(), height, (Slenderness::Angle, &[2.0])), &["α (rad) = 2", "at most 0.7854"]),
        // their tangents are those of walls
        (walls(&bilinear(), height, (Slenderness::Angle, &[3.3])), &["α (rad) = 3.3", "at most 0.7854"]),
        (walls(&bilinear(), height, (Slenderness::Angle, &[16.0])), &["α (rad) = 16", "at most 0.7854"]),
        (
            walls(&bilinear(), (Size::Height, &[1e-5]), (Slenderness::Ratio, &[8.0])),
            &["= 0.00001", "is below its minimum, 0.001 m"],
        ),
        (
            walls(&bilinear(), (Size::Height, &[1.0; 600]), (Slenderness::Ratio, &[8.0; 600])),
            &["360000 points"],
        ),
        // the first wall in order, for any number of threads
        (
            walls(&Parameters { a1: 0.99, a3: 0.9, ..bilinear() }, height, (Slenderness::Ratio, &[8.0, 9.0])),
            &["wall of 3 m by 0.375 m", "a1 = 0.99"],
        ),
    ] {
        for word in words {
            assert!(error.contains(word), "no {word:?} in {error}");
        }
    }
    let strip = Parameters { mechanism: Mechanism::VerticalSpanning, ..bilinear() };
    let error = over_walls(&strip, &motion, Size::SemiDiagonal, &[2.0], Slenderness::Ratio, &[20.0], 1);
    assert!(matches!(error, Err(SpectrumError::ParapetOnly { .. })));
    let error = over_pulses(&bilinear(), PulseForm::Ricker, &[0.0], &[1.0], 1).unwrap_err().to_string();
    assert!(error.contains("ω_p/p = 0"), "{error}");
}

/// A pulse over the time \[s\].
type At = fn(f64) -> f64;

/// A record of pulses with the amplitude 1 m/s² at times, 0 elsewhere, in steps of 0.01 s.
fn record(pulses: &[(At, f64, f64)]) -> GroundMotion {
    let at = |time: f64| pulses.iter().map(|(pulse, from, scale)| scale * pulse(time - from)).sum();
    GroundMotion::new(0.01, (0..800).map(|index| at(0.01 * f64::from(index))).collect()).unwrap()
}

fn sine(time: f64) -> f64 {
    if (0.0..=1.0).contains(&time) { libm::sin(TAU * time) } else { 0.0 }
}

fn cosine(time: f64) -> f64 {
    if (0.0..=1.0).contains(&time) { libm::cos(TAU * time) } else { 0.0 }
}

fn ricker(time: f64) -> f64 {
    let square = (PI * (time - 2.0)).powi(2);
    (1.0 - 2.0 * square) * (-square).exp()
}

/// A record that is a pulse of 1 s has this pulse, for the record and for the wall, with its sign: samples
/// are 1 % of the period, so that the period is known to less.
#[test]
fn a_pulse_is_its_own_pulse() {
    let forms: [(PulseForm, At); 3] =
        [(PulseForm::SineCycle, sine), (PulseForm::CosineCycle, cosine), (PulseForm::Ricker, ricker)];
    for ((form, pulse), scale) in forms.into_iter().zip([1.2, -1.2, 1.2]) {
        let found = RecordPulses::new(&bilinear(), record(&[(pulse, 3.0, scale)]), 1).unwrap();
        let [best, second, _] = found.pulses[..] else { panic!("three forms") };
        assert_eq!(best.form, form);
        assert!(best.index > 0.999 && best.index > second.index, "{found:?}");
        for (found, expected) in [(best.period, 1.0), (best.fitted, scale), (best.amplitude.unwrap(), scale)]
        {
            assert!((found - expected).abs() < 0.01 * expected.abs(), "{form:?}: {found} for {expected}");
        }
    }
}

/// The index is that of energies: of two sine cycles of one period with amplitudes 3 and 1 the larger one is
/// found, with √(9/10) of the root of the energy. Twice the record is twice the fitted amplitude.
#[test]
fn the_misfit_is_the_energy_that_is_left() {
    let [once, twice] = [1.0, 2.0].map(|scale| {
        let record = record(&[(sine, 2.0, 3.0 * scale), (sine, 5.0, scale)]);
        RecordPulses::new(&bilinear(), record, 2).unwrap().pulses[0]
    });
    assert_eq!(once.form, PulseForm::SineCycle);
    // the optimum may lie between samples
    assert!((once.index - 0.9_f64.sqrt()).abs() < 1e-3 && (once.centre - 2.5).abs() < 0.005, "{once:?}");
    assert!((twice.fitted - 2.0 * once.fitted).abs() < 1e-12 && twice.index == once.index);
}

/// Periods end at 10 steps and at the duration of the record, also where shorter or longer ones fit better.
#[test]
fn periods_stay_within_the_record() {
    let spike: At = |time| if (0.0..0.015).contains(&time) { 20.0 } else { 0.0 };
    let rise: At = |time| time;
    for pulse in [spike, rise] {
        let record = record(&[(pulse, 0.0, 1.0)]);
        let found = RecordPulses::new(&bilinear(), record.clone(), 1).unwrap();
        for RecordPulse { period, .. } in found.pulses {
            assert!((10.0 * record.step()..=record.duration()).contains(&period), "{period}");
        }
    }
}

/// The amplitude just overturns the wall where the record does: 1e-6 less does not.
#[test]
fn the_amplitude_just_does_what_the_record_does() {
    let wall = rigid(0.9);
    let found = RecordPulses::new(&wall, record(&[(sine, 2.0, 9.0), (cosine, 5.0, 1.0)]), 1).unwrap();
    assert!(found.point.overturning.is_some());
    let pulse = found.pulses.iter().find(|pulse| pulse.form == PulseForm::SineCycle).unwrap();
    let body = Wall::new(&wall).unwrap();
    let frequency = TAU / (pulse.period * body.rocking_rate());
    let amplitude = pulse.amplitude.unwrap() / onset(&body);
    let rows = [1.0 - 1e-6, 1.0 + 1e-6].map(|factor| factor * amplitude);
    let spectrum = over_pulses(&wall, PulseForm::SineCycle, &[frequency], &rows, 1).unwrap();
    let overturns = [0, 1].map(|row: usize| spectrum.points[row][0].overturning.is_some());
    assert_eq!(overturns, [false, true]);
    let still = RecordPulses::new(&wall, record(&[(sine, 2.0, 0.5)]), 1).unwrap_err();
    assert!(still.to_string().contains("stays at rest under the record"), "{still}");
}
