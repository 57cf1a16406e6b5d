//! Tests parts along which ü keeps its sign, on motions in closed form.

use super::*;
use crate::line::{LinearBranch, tests::line};
use crate::numbering::LaneBranches;
use crate::table::terms;

/// A part of `length` on a line from u, u̇ under p and its rate, and what its series needs.
fn part(
    line: LinearBranch<f64>,
    [u, v]: [f64; 2],
    [forcing, rate]: [f64; 2],
    length: f64,
) -> (Part<f64>, usize) {
    let terms = terms((line.c + line.k.abs().sqrt()) * length);
    let from = [u, v, line.acceleration([u, v], forcing)];
    let [to_u, to_v, _] = line.after(terms, length, from, rate);
    let (lanes, to, impacts) = (true, [to_u, to_v], 0.0);
    let branch = LaneBranches::default().load((), 0);
    (Part { lanes, branch, line, from, to, length, forcing, rate, impacts }, terms)
}

fn bounds([lower, upper]: [f64; 2], speed: f64) -> Bounds<f64> {
    Bounds { ends: [lower, upper], within: [lower, upper], speed }
}

/// Where u goes is known up to the bound on what it may reach on its way, A L²/8 beyond its chord, and up to
/// the speed for which bounds hold.
#[test]
fn turns_are_sure_within_their_bounds() {
    for side in [1.0, -1.0] {
        let turn = |v: f64, p: [f64; 2], far: f64, speed: f64| {
            let ends = if side > 0.0 { [0.0, far] } else { [-far, 0.0] };
            let (part, _) = part(line(0.0, 0.0), [0.0, side * v], p.map(|p| side * p), 1.0);
            part.turn(&bounds(ends, speed))
        };
        // ü = −4: u̇ from 1 to −3, A L²/8 = 1/2
        assert_eq!(turn(1.0, [-4.0, 0.0], 0.51, 3.01), Turn::Leaves);
        assert_eq!(turn(1.0, [-4.0, 0.0], 0.49, 3.01), Turn::Unclear);
        assert_eq!(turn(1.0, [-4.0, 0.0], 0.51, 2.99), Turn::Unclear);
        // ü = −1: u ends at 1/2, A L²/8 = 1/8
        assert_eq!(turn(1.0, [-1.0, 0.0], 0.626, 3.0), Turn::Stays);
        assert_eq!(turn(1.0, [-1.0, 0.0], 0.624, 3.0), Turn::Unclear);
        // ü changes its sign, or points away from the end that u leaves by
        assert_eq!(turn(1.0, [-4.0, 5.0], 9.0, 9.0), Turn::Unclear);
        assert_eq!(turn(-1.0, [1.0, 0.0], 9.0, 9.0), Turn::Unclear);
    }
}

/// Where a turn is sure, ü keeps its sign, u keeps its bounds, and it passes its corner once: at the time
/// that is found, with the u̇ there.
#[test]
fn sure_turns_pass_their_corner_once() {
    const INSTANTS: u32 = 200;
    let length = 0.01;
    let (mut stays, mut leaves, mut unclear) = (0, 0, 0);
    for (damping, stiffness) in [(0.0, -3.0), (2.0, 0.0), (4.0, 900.0), (30.0, -2000.0)] {
        for (speed, forcing, rate) in (1..40).flat_map(|n| {
            let speed = 0.002 * f64::from(n);
            [[-4.0, 0.0], [-4.0, 500.0], [-20.0, -900.0], [-9.0, 700.0]].map(|[p, rate]| (speed, p, rate))
        }) {
            let (part, terms) = part(line(damping, stiffness), [0.0, speed], [forcing, rate], length);
            let far = 5e-4;
            let turn = part.turn(&bounds([0.0, far], 1.0));
            if turn == Turn::Unclear {
                unclear += 1;
                continue;
            }
            let at =
                |n: u32| part.line.after(terms, length * f64::from(n) / f64::from(INSTANTS), part.from, rate);
            let way: Vec<_> = (1..=INSTANTS).map(at).collect();
            assert!(way.iter().all(|[u, _, a]| *a < 0.0 && *u <= far));
            let passages = way.windows(2).filter(|pair| pair[0][0] > 0.0 && pair[1][0] <= 0.0).count();
            assert_eq!(passages, usize::from(turn == Turn::Leaves));
            if turn == Turn::Stays {
                stays += 1;
                continue;
            }
            leaves += 1;
            let Passage { found, time, velocity } = part.find_after_turn(0.0, terms);
            let [u, v, _] = part.line.after(terms, time, part.from, rate);
            assert!(found && v < 0.0);
            // u rounds like the way out and back, u̇ t; u̇ like ü over that time
            assert!(u.abs() <= 16.0 * f64::EPSILON * speed * time, "{u:e} after {time:e}");
            assert!((velocity - v).abs() <= 16.0 * f64::EPSILON * speed.max(v.abs()), "{velocity} {v}");
        }
    }
    assert!(stays > 100 && leaves > 100 && unclear > 10, "{stays} {leaves} {unclear}");
}

/// A guess that a large jerk takes back to the start does not find the corner from which u starts.
#[test]
fn the_corner_at_the_start_is_not_found() {
    let (speed, length) = (1e-3, 0.01);
    let found = |rate: f64| {
        let (part, terms) = part(line(0.0, 0.0), [0.0, speed], [-1.0, rate], length);
        part.find_after_turn(0.0, terms).found
    };
    // u = 0 after 2 ms without the jerk, and 1.1 ms with it
    assert!(found(0.0) && !found(-2000.0));
}
