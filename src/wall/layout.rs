//! Lays out the branches and corners of a wall.

use super::branch::{Branch, Corner};
use super::damping::DampingLaw;
use super::force_law::{Line, RestoringForce};
use super::mechanism::{Body, Sides};
use super::tie::{Tie, TieAction, TieMemory};

/// Returns the corners in order of displacement, the two landings first and last. A tie has those that
/// belong to its memory. `fully` says that rotations are full. A wall with one free side has no landing on
/// the other: the corner at u = 0 is its end there.
pub(super) fn corners(
    body: &Body,
    force: &RestoringForce,
    damping: &DampingLaw,
    tie: Option<(&Tie, &TieMemory)>,
    impact: bool,
    fully: bool,
    free_side: Option<f64>,
) -> Vec<Corner> {
    let passage = impact || force.elastic_stiffness.is_none();
    let mut corners =
        vec![Corner { displacement: 0.0, passage, stop: free_side.is_some(), ..Corner::default() }];
    for sign in [1.0, -1.0].into_iter().filter(|sign| free_side.is_none_or(|free| free == *sign)) {
        let side = force.side(sign);
        let of = |sides: Sides| sides.of(sign);
        let mut place = |displacement: f64, mark: fn(&mut Corner)| {
            if displacement <= of(body.landing) {
                insert(&mut corners, sign * displacement, mark);
            }
        };
        if !fully {
            for &corner in &side.corners {
                place(corner, |_| {});
            }
            place(side.end, |_| {});
            place(side.end * damping.rocking.end(), |_| {});
        }
        if let Some(hold) = tie.and_then(|(tie, memory)| tie.hold(sign, memory)) {
            let mut before_departure = |displacement: f64, mark: fn(&mut Corner)| {
                if displacement < of(body.departure) {
                    place(displacement, mark);
                }
            };
            before_departure(hold.onset, |_| {});
            before_departure(hold.yields, |_| {});
            before_departure(hold.breaks, |corner| corner.fracture = true);
        }
        place(of(body.instability), |corner| corner.overturning = true);
        place(of(body.departure), |corner| corner.departure = true);
        place(of(body.landing), |corner| corner.landing = true);
    }
    corners.sort_by(|a, b| a.displacement.total_cmp(&b.displacement));
    let pulls_at_once = |(tie, memory): (&Tie, &TieMemory)| {
        [1.0, -1.0].into_iter().any(|sign| tie.hold(sign, memory).is_some_and(|hold| hold.onset == 0.0))
    };
    if !passage && force.is_straight() && !tie.is_some_and(pulls_at_once) {
        // One elastic line runs through the origin.
        corners.retain(|corner| corner.displacement != 0.0);
    }
    corners
}

/// Returns the branches between the corners.
pub(super) fn branches(
    corners: &[Corner],
    body: &Body,
    force: &RestoringForce,
    damping: &DampingLaw,
    tie: Option<(&Tie, &TieMemory)>,
) -> Vec<Branch> {
    let m = body.effective_mass;
    let between = |pair: &[Corner]| {
        let (lower, upper) = (pair[0].displacement, pair[1].displacement);
        let middle = 0.5 * (lower + upper);
        let side = if middle < 0.0 { &force.negative } else { &force.positive };
        let reach = middle.abs();
        let index = side.corners.partition_point(|&corner| corner <= reach);
        let line = side.lines[index];
        let damping = damping.on_branch(line.is_elastic(), reach > side.end * damping.rocking.end());
        let own = Line { anchor: line.anchor, force: line.force / m, slope: line.slope / m };
        let action = tie.map_or(TieAction::None, |(tie, memory)| tie.action(lower, upper, memory));
        let line = tie.map_or(own, |(tie, memory)| tie.added_to(own, (action, middle), memory, m));
        let Line { anchor, force, slope: stiffness } = line;
        Branch { lower, upper, anchor, force, stiffness, own, tie: action, damping }
    };
    corners.windows(2).map(between).collect()
}

fn insert(corners: &mut Vec<Corner>, displacement: f64, mark: fn(&mut Corner)) {
    let found = corners.iter_mut().find(|corner| corner.displacement == displacement);
    if let Some(corner) = found {
        mark(corner);
    } else {
        let mut corner = Corner { displacement, ..Corner::default() };
        mark(&mut corner);
        corners.push(corner);
    }
}
