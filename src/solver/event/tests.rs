//! Tests the search for events on motions whose exits and turning points are known. Pins its number of
//! evaluations, too: later steps mend most errors of a first guess, so that only this number shows them.

use std::cell::{Cell, RefCell};

use super::*;

/// u = A sin(ωt + φ) + v t, which counts how often it is evaluated.
pub(in crate::solver) struct Sway {
    amplitude: f64,
    rate: f64,
    phase: f64,
    drift: f64,
    horizon: f64,
    evaluations: Cell<u32>,
}

impl Sway {
    /// Makes the motion with \[A, ω, φ, v\] over a length.
    pub(in crate::solver) fn new([amplitude, rate, phase, drift]: [f64; 4], horizon: f64) -> Self {
        Self { amplitude, rate, phase, drift, horizon, evaluations: Cell::new(0) }
    }

    /// Returns how often the motion has been evaluated.
    pub(in crate::solver) fn evaluations(&self) -> u32 {
        self.evaluations.get()
    }

    /// Returns the motion `time` seconds after the start.
    pub(in crate::solver) fn motion(&self, time: f64) -> KinematicState {
        let Self { amplitude, rate, phase, drift, .. } = self;
        let (sine, cosine) = (libm::sin(rate * time + phase), libm::cos(rate * time + phase));
        KinematicState {
            displacement: amplitude * sine + drift * time,
            velocity: amplitude * rate * cosine + drift,
            acceleration: -amplitude * rate * rate * sine,
        }
    }
}

impl Piece for Sway {
    fn start(&self) -> KinematicState {
        self.motion(0.0)
    }

    fn horizon(&self) -> f64 {
        self.horizon
    }

    fn at(&self, time: f64) -> KinematicState {
        self.evaluations.set(self.evaluations.get() + 1);
        self.motion(time)
    }

    fn bounds(&self, _from: KinematicState, _length: f64) -> Bounds {
        let acceleration = self.amplitude * self.rate * self.rate;
        Bounds { acceleration, jerk: acceleration * self.rate }
    }

    fn curvatures(&self, _between: [f64; 2], from: KinematicState) -> [f64; 3] {
        let Bounds { acceleration, jerk } = self.bounds(from, 0.0);
        [acceleration, jerk, jerk * self.rate]
    }

    fn displacement_integral(&self, _time: f64) -> f64 {
        unreachable!("no search asks for it")
    }
}

fn sway(phase: f64, drift: f64, horizon: f64) -> Sway {
    Sway::new([0.3, 2.0, phase, drift], horizon)
}

/// Without drift the exit through b is at asin(b/A), and at π − asin(b/A) for a motion that comes down.
#[test]
fn exits_have_their_closed_form() {
    let (mut evaluations, mut exits) = (0, 0);
    for part in 1..60 {
        let bound = 0.005 * f64::from(part);
        let angle = libm::asin(bound / 0.3);
        let down = [bound, f64::INFINITY];
        for (phase, bounds, expected) in [
            (0.0, [-bound, bound], angle),
            (std::f64::consts::PI, [-bound, bound], angle),
            (0.5 * std::f64::consts::PI, down, 0.5 * std::f64::consts::PI - angle),
        ] {
            let piece = sway(phase, 0.0, 3.0);
            let mut peaks = Peaks::at(piece.start().displacement);
            let Ok(Ending::Exit(exit)) = find_ending(&piece, bounds, &mut peaks) else {
                panic!("no exit through {bound}")
            };
            // where u is steep a rounding of u is one of time, and near the turn more
            let slope = 0.6 * (1.0 - (bound / 0.3).powi(2)).sqrt();
            let error = (exit.time - 0.5 * expected).abs();
            assert!(error <= 4.0 * f64::EPSILON * (1.0 + 0.3 / slope), "{bound}: off by {error:e}");
            assert_eq!(exit.upwards, phase == 0.0);
            assert!((exit.velocity.abs() - slope).abs() <= 1e-13 / slope, "{bound}: {}", exit.velocity);
            evaluations += piece.evaluations.get();
            exits += 1;
        }
    }
    assert_eq!((exits, evaluations), (177, 1223));
}

/// A motion that turns below a known peak and comes back leaves at π − asin(b/A), with fewer evaluations than
/// one whose turn is a new peak.
#[test]
fn exits_after_a_known_turn_have_their_closed_form() {
    let (mut evaluations, mut exits) = ([0; 2], 0);
    for part in 1..40 {
        let bound = 0.005 * f64::from(part);
        let angle = libm::asin(bound / 0.3);
        let pi = std::f64::consts::PI;
        for (phase, bounds) in [(angle, [bound, 9.0]), (angle + pi, [-9.0, -bound])] {
            // to the turn at 0.3, and beyond the bound on the way back
            let piece = sway(phase, 0.0, 0.5 * (3.2 - 2.0 * angle));
            let known = Peaks { positive: 0.4, negative: 0.4 };
            for (reached, evaluations) in [known, Peaks::at(0.0)].into_iter().zip(&mut evaluations) {
                let (mut peaks, before) = (reached, piece.evaluations());
                let ending = find_ending(&piece, bounds, &mut peaks);
                let Ok(Ending::Exit(exit)) = ending else { panic!("{bound}: {ending:?}") };
                assert_eq!((peaks == reached, exit.upwards), (reached == known, phase != angle));
                let slope = 0.6 * (1.0 - (bound / 0.3).powi(2)).sqrt();
                let error = (exit.time - 0.5 * (pi - 2.0 * angle)).abs();
                assert!(error <= 8.0 * f64::EPSILON * (1.0 + 0.3 / slope), "{bound}: off by {error:e}");
                assert!((exit.velocity.abs() - slope).abs() <= 1e-13 / slope, "{bound}: {}", exit.velocity);
                *evaluations += piece.evaluations() - before;
            }
            exits += 1;
        }
    }
    assert!(exits == 78 && evaluations[0] < evaluations[1], "{evaluations:?}");
}

/// The motion turns at cos(ωt) = −v/(Aω). Over several periods the search goes by halves.
#[test]
fn turning_points_have_their_closed_form() {
    let period = std::f64::consts::PI;
    for (horizon, periods, expected) in [(1.5, 0.0, 280), (20.5, 6.0, 2961)] {
        let mut evaluations = 0;
        for part in 0..50 {
            let drift = 0.011 * f64::from(part);
            let piece = sway(0.0, drift, horizon);
            let u = |time: f64| piece.motion(time).displacement;
            let mut peaks = Peaks::at(0.0);
            assert!(matches!(find_ending(&piece, [-99.0, 99.0], &mut peaks), Ok(Ending::Horizon(_))));
            let turn = 0.5 * libm::acos(-drift / 0.6);
            let highest = u(turn + periods * period);
            let lowest = if periods > 0.0 { u(period - turn).min(0.0) } else { 0.0 };
            // the last step δ is made along constant ü, which leaves jerk δ³/6 of u, as soon as
            // jerk² δ⁴/(8 ü) is no more than ε u/4
            let (jerk, acceleration) = (2.4, 1.2 * libm::sin(2.0 * turn));
            let last = (2.0 * f64::EPSILON * highest * acceleration).sqrt().sqrt() / f64::sqrt(jerk);
            let error = (peaks.positive - highest).abs().max((peaks.negative + lowest).abs());
            let allowed = jerk * last.powi(3) / 6.0;
            assert!(error <= allowed, "{drift}: {error:e} of {allowed:e}");
            evaluations += piece.evaluations();
        }
        assert_eq!(evaluations, expected, "{horizon} s");
    }
}

/// A parabola is followed to its zero in the direction of Newton's step, also to a double one. Without a zero
/// the step is Newton's.
#[test]
fn a_parabola_is_followed_to_its_zero() {
    // (t − 1)(t − 3), (t − 1)², a line, and t² + 2t + 5
    for (terms, step) in
        [([3.0, -4.0, 2.0], 1.0), ([1.0, -2.0, 2.0], 1.0), ([3.0, -2.0, 0.0], 1.5), ([5.0, 2.0, 2.0], -2.5)]
    {
        assert_eq!(parabola(terms), step, "{terms:?}");
        assert_eq!(parabola(terms.map(|term: f64| -term)), step, "{terms:?}");
    }
}

/// Searches for √`square` in a bracket from a guess. `step` turns a Newton step into the one that is
/// proposed, `sign` is the sign of the slope, and with `settled` every step may be the last. Returns the node
/// found and the times of the evaluations.
fn root_of(
    square: f64,
    bracket: [f64; 2],
    guess: f64,
    (sign, settled): (f64, bool),
    step: impl Fn(f64) -> f64,
) -> (Node, Vec<f64>) {
    let times = RefCell::new(vec![]);
    let found = root(bracket, guess, sign > 0.0, |time| {
        times.borrow_mut().push(time);
        let value = sign * (time * time - square);
        let motion =
            KinematicState { displacement: value, velocity: sign * 2.0 * time, acceleration: sign * 2.0 };
        Trial { value, step: step(-value / (sign * 2.0 * time)), settled, node: Node { time, motion } }
    });
    (found, times.into_inner())
}

#[test]
fn a_root_takes_few_steps() {
    let newton = |step: f64| step;
    for sign in [1.0, -1.0] {
        // a guess at an end or outside is replaced by the middle
        for (guess, first, count) in
            [(1.0, 1.0, 7), (0.25, 8.0, 9), (15.75, 8.0, 9), (0.1, 8.0, 9), (16.0, 8.0, 9)]
        {
            let (found, times) = root_of(2.0, [0.25, 15.75], guess, (sign, false), newton);
            assert!((found.time - 2.0_f64.sqrt()).abs() <= f64::EPSILON, "{guess}: {}", found.time);
            assert_eq!((times[0], times.len()), (first, count), "{guess}: {times:?}");
        }
        let (exact, times) = root_of(2.25, [0.0, 2.0], 1.5, (sign, false), newton);
        assert_eq!((exact.time, times), (1.5, vec![1.5]));
        // the last step is made along the motion
        let (Node { time, motion }, times) = root_of(2.0, [0.0, 2.0], 1.4, (sign, true), newton);
        assert!((time - (1.4 + 0.04 / 2.8)).abs() <= 4.0 * f64::EPSILON && times == [1.4], "{time}");
        assert!((motion.displacement - sign * (time * time - 2.0)).abs() <= 4.0 * f64::EPSILON, "{motion:?}");
        assert!((motion.velocity - sign * 2.0 * time).abs() <= 4.0 * f64::EPSILON, "{motion:?}");
    }
}

/// A step must stay inside the bracket and be shorter than 3/4 of the last one, the bracket at first.
#[test]
fn bisection_takes_over_where_steps_fail() {
    for sign in [1.0, -1.0] {
        let search = |bracket: [f64; 2], guess: f64, settled: bool, length: f64| {
            root_of(3e7, bracket, guess, (sign, settled), move |step: f64| length * step.signum())
        };
        let root = 3e7_f64.sqrt();
        let from = |length: f64, settled: bool| search([0.0, 8e3], 3e3, settled, length);
        // steps away from the root, settled or not; steps too short to arrive; steps out of the bracket
        for (length, settled, second, count) in [
            (-0.3, false, 5.5e3, 53),
            (-0.3, true, 5.5e3, 53),
            (0.3, false, 3000.3, 64),
            (5100.0, false, 5.5e3, 53),
        ] {
            let (found, times) = from(length, settled);
            assert!((found.time - root).abs() <= 1e-12, "{length}: {}", found.time);
            assert_eq!((times[1], times.len()), (second, count), "{length}: {times:?}");
        }
        // steps inside the bracket: two of at least 3/4 of its length, and one just below
        for (length, second) in [(1600.0, 5005.0), (1500.0, 5005.0), (1499.0, 5509.0)] {
            assert_eq!(search([4e3, 6e3], 4010.0, false, length).1[1], second, "{length}");
        }
    }
}
