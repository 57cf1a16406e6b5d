//! Tests the search for extremes on a motion whose extremes are known. Pins its number of evaluations, too:
//! only this number shows a search that goes on beyond the stated accuracy.

use std::cell::Cell;

use oscillator::{Bounds, Oscillator};

use super::super::demand::Extremes;
use super::super::event::tests::Sway;
use super::super::exact::ClosedForm;
use super::*;
use crate::variables::{Mechanism, TieSide};
use crate::wall::{Parameters, Tie, Wall};

/// ω of the motion \[1/s\].
const RATE: f64 = 20.0;
/// Start of the segment, and of the piece in it \[s\].
const START: [f64; 2] = [3.0, 0.05];

/// Returns u = A sin ω(t + τ) over a length, τ being `earlier`.
fn sway(amplitude: f64, earlier: f64, horizon: f64) -> Sway {
    Sway::new([amplitude, RATE, RATE * earlier, 0.0], horizon)
}

/// Returns the demands of a motion between supports whose motion does not change, and the number of
/// evaluations.
fn watched(wall: &Wall, piece: &Sway, support: Support) -> (Demands, u32) {
    let KinematicState { displacement, velocity, acceleration } = piece.start();
    let branch = wall.branch_of(displacement, 1.0);
    let couple = wall.branches()[branch].couple;
    let reactions = wall.body().reactions(support, acceleration, couple.at(displacement));
    let from = START[0] + START[1];
    let tie_force = |tie: &Tie| tie.force(displacement);
    let motion = [displacement, velocity, acceleration];
    let mut demands = Demands::new(wall, from, motion, reactions, tie_force, &[]);
    let segment = Segment { duration: START[1] + piece.horizon(), from: support, to: support };
    let displacement = piece.motion(piece.horizon()).displacement;
    let followed = Followed { piece, branch, from: START[1], length: piece.horizon(), displacement };
    let mut watch = Watch { demands: &mut demands, wall, segment: &segment, time: START[0] };
    watch.piece(&followed).unwrap();
    watch.ties(&followed).unwrap();
    (demands, piece.evaluations())
}

/// At rest the reactions are extreme at an end of the rest.
#[test]
fn a_rest_has_its_extremes_at_its_ends() {
    let wall = Wall::new(&Parameters { u_start: 0.0, ..Parameters::default() }).unwrap();
    let (from, to) = (Support::rigid(-1.0), Support::rigid(3.0));
    let at = |ground: f64| wall.body().reactions(Support::rigid(ground), 0.0, 0.0);
    let mut demands = Demands::new(&wall, START[0], [0.0; 3], at(1.0), |_| 0.0, &[]);
    let segment = Segment { duration: 0.4, from, to };
    Watch { demands: &mut demands, wall: &wall, segment: &segment, time: START[0] }.rest(0.1, 0.4);
    let ends = [(at(0.0).bottom, START[0] + 0.1), (at(3.0).bottom, START[0] + 0.4)];
    let Extremes { lowest, highest } = demands.reaction_bottom;
    let found = [(lowest.value, lowest.time), (highest.value, highest.time)];
    assert_eq!(found, ends);
}

/// Reactions are linear in u here, so that their extremes are those at ±A. They are accurate relative to
/// their terms, also where these cancel.
#[test]
fn reactions_are_accurate_relative_to_their_terms() {
    let mut evaluations = vec![];
    for mechanism in [Mechanism::Parapet, Mechanism::VerticalSpanning] {
        let overburden = if mechanism == Mechanism::Parapet { 0.0 } else { 1e4 };
        let wall = Wall::new(&Parameters { mechanism, overburden, u_start: 0.0, ..Parameters::default() });
        let wall = wall.unwrap();
        let body = wall.body();
        for (amplitude, bottom, top) in
            [(1e-2, 2.0, 1.0), (1e-2, 4.0, -30.0), (1e-2, 2e-3, 1e-3), (10.0, 4e3, 2e3), (1e-6, 0.0, 0.0)]
        {
            let support = Support { bottom, top, drift: 1e-3 };
            let (found, count) = watched(&wall, &sway(amplitude, 0.01, 0.4), support);
            evaluations.push(count);
            let largest = amplitude * RATE * RATE + bottom.abs() + top.abs();
            // the size to which `forces` is accurate: the terms of ü, as large as all accelerations, and of u
            let couple = wall.branches()[wall.branch_of(amplitude * libm::sin(RATE * 0.01), 1.0)].couple;
            let [of_a, of_u] = [[largest, 0.0], [0.0, couple.at_zero.abs() + couple.slope * amplitude]]
                .map(|[a, couple]| body.reactions(Support::default(), a, couple));
            let at = |u: f64| body.reactions(support, -RATE * RATE * u, couple.at(u));
            let [low, high] = [at(-amplitude), at(amplitude)];
            for (extremes, values, size) in [
                (found.reaction_bottom, [low.bottom, high.bottom], of_a.bottom.abs() + of_u.bottom.abs()),
                (found.reaction_top, [low.top, high.top], of_a.top.abs() + of_u.top.abs()),
            ] {
                let expected = [values[0].min(values[1]), values[0].max(values[1])];
                for (found, expected) in [extremes.lowest, extremes.highest].into_iter().zip(expected) {
                    let missed = (found.value - expected).abs();
                    // rounding beside the stated accuracy
                    let allowed = 1.01 * ACCURACY * size;
                    assert!(missed <= allowed, "{mechanism:?} {amplitude}: {missed:e} of {size:e}");
                }
            }
        }
    }
    assert_eq!(evaluations, [230, 225, 230, 228, 230, 410, 398, 412, 287, 388]);
}

/// The force of a tie is linear in u. It is largest with u, and reaches the strength where u reaches
/// `strength_displacement`.
#[test]
fn the_force_of_a_tie_is_accurate_relative_to_its_terms() {
    let mut evaluations = vec![];
    for (side, turned) in [(TieSide::Positive, 0.0), (TieSide::Negative, std::f64::consts::PI / RATE)] {
        let tied = Parameters {
            u_start: 0.0,
            tie_side: side,
            tie_height: 2.0,
            tie_stiffness: 3e5,
            tie_slack: 2e-3,
            tie_strength: 1e3,
            ..Parameters::default()
        };
        let wall = Wall::new(&tied).unwrap();
        let tie = wall.ties().first().unwrap();
        let reach = tie.strength_displacement().unwrap();
        let start = START[0] + START[1];
        for (share, earlier) in [(0.9, 0.05), (1.1, 0.05), (5.0, 0.05), (1.1, 0.08)] {
            let amplitude = share * reach;
            let piece = sway(amplitude, turned + earlier, 0.04);
            let (found, count) = watched(&wall, &piece, Support::default());
            evaluations.push(count);
            let TieDemands { force, strength, .. } = found.ties[0];
            let turn = f64::max(0.5 * std::f64::consts::PI / RATE - earlier, 0.0);
            let largest = amplitude * libm::sin(RATE * (turn + earlier));
            let size = tie.stiffness * tie.lever * largest;
            let expected = size - tie.stiffness * tie.slack;
            assert!((force.value - expected).abs() <= 1.01 * ACCURACY * size, "{share}: {force:?}");
            // u misses its largest by ω² t²/2 of it
            let late = (2.0 * ACCURACY).sqrt() / RATE;
            assert!((force.time - start - turn).abs() <= 1.01 * late, "{share}: {force:?}");
            // the first time, which may be the start of the piece
            let passage = f64::max(libm::asin(1.0 / share) / RATE - earlier, 0.0);
            match strength {
                None => assert!(share < 1.0),
                Some(Instant { value, time }) => {
                    assert_eq!(value, 1e3);
                    // a few roundings of the time
                    let rounding = 4.0 * f64::EPSILON * time;
                    assert!((time - start - passage).abs() <= rounding, "{share}: {time} for {passage}");
                }
            }
        }
    }
    assert_eq!(evaluations, [76, 81, 76, 5, 76, 81, 76, 5]);
}

/// A wall that hovers near its instability and falls back, u = 1 − A cosh ω(t − τ), is searched in few
/// intervals: its bounds over the whole piece are e³⁰ times those near the turn.
#[test]
fn a_wall_that_hovers_is_searched_in_few_intervals() {
    let wall = Wall::new(&Parameters { u_start: 0.0, ..Parameters::default() }).unwrap();
    let oscillator = Oscillator::new(0.0, -RATE * RATE);
    for nearest in [1e-2, 1e-5, 1e-8, 1e-11] {
        // from u = 0.9 up to the turn and back
        let before = libm::acosh(0.1 / nearest) / RATE;
        let [sine, cosine] =
            [libm::sinh(-RATE * before), libm::cosh(-RATE * before)].map(|part| nearest * part);
        let start = KinematicState {
            displacement: 1.0 - cosine,
            velocity: -RATE * sine,
            acceleration: -RATE * RATE * cosine,
        };
        let bounds = [f64::NEG_INFINITY, f64::INFINITY];
        let inner = ClosedForm::new(&oscillator, start, 0.0, 2.0 * before, bounds, &Peaks::at(0.9));
        let piece = Counted { inner, evaluations: Cell::new(0) };
        let mut demands = Demands::new(
            &wall,
            0.0,
            [start.displacement, start.velocity, start.acceleration],
            wall.body().reactions(Support::default(), start.acceleration, 0.0),
            |_| 0.0,
            &[],
        );
        let still = Support::default();
        let segment = Segment { duration: 2.0 * before, from: still, to: still };
        let mut watch = Watch { demands: &mut demands, wall: &wall, segment: &segment, time: 0.0 };
        let search = ExtremeSearch::new(&piece, 2.0 * before, [0.0, 0.0]);
        watch.search(&search, &wall.branches()[0]).unwrap();
        let highest = demands.displacement.highest;
        // of u the accuracy of the search, and the rounding that growth by e^ω(t − τ) adds to it
        let allowed = ACCURACY + 8.0 * f64::EPSILON / nearest * 0.1;
        assert!((highest.value - (1.0 - nearest)).abs() <= allowed, "{nearest}: {highest:?}");
        assert!(piece.evaluations.get() < 1500, "{nearest}: {} evaluations", piece.evaluations.get());
    }
}

/// A piece that counts how often it is evaluated.
struct Counted<P> {
    inner: P,
    evaluations: Cell<u32>,
}

impl<P: Piece> Piece for Counted<P> {
    fn start(&self) -> KinematicState {
        self.inner.start()
    }

    fn horizon(&self) -> f64 {
        self.inner.horizon()
    }

    fn at(&self, time: f64) -> KinematicState {
        self.evaluations.set(self.evaluations.get() + 1);
        self.inner.at(time)
    }

    fn bounds(&self, from: KinematicState, length: f64) -> Bounds {
        self.inner.bounds(from, length)
    }

    fn curvatures(&self, between: [f64; 2], from: KinematicState) -> [f64; 3] {
        self.inner.curvatures(between, from)
    }

    fn displacement_integral(&self, time: f64) -> f64 {
        self.inner.displacement_integral(time)
    }
}
