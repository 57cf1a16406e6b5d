//! All walls of a study together: what was found of each, and its fractiles.

use rocking_wall::wall::Wall;
use run::walls::NamedWall;

use crate::rules::Turned;
use crate::wall::WallReliability;

/// Fractiles over the walls.
pub(crate) const FRACTILES: [f64; 5] = [0.05, 0.16, 0.5, 0.84, 0.95];

/// What a class is drawn over: a name, and the value of a wall.
pub(crate) const QUANTITIES: [&str; 4] = ["h/b", "h (m)", "overburden/W", "floor"];

/// A wall among the others.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub(crate) name: String,
    /// Of the [`QUANTITIES`].
    pub(crate) quantities: [f64; 4],
    pub(crate) found: Vec<Found>,
    /// The check that governs.
    pub(crate) governs: &'static str,
    pub(crate) turned: Vec<Vec<Turned>>,
}

/// Margin and probability of an event with a model, where a check has ζ = 1.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub(crate) model: usize,
    pub(crate) check: &'static str,
    pub(crate) event: String,
    pub(crate) margin: f64,
    pub(crate) probability: f64,
}

/// The walls, and those without a check.
#[derive(Clone, Debug, Default)]
pub(crate) struct Class {
    pub(crate) members: Vec<Member>,
    /// The probability below which a number says nothing \[-\].
    pub(crate) least: f64,
    /// Names, and the reasons.
    pub(crate) refused: Vec<(String, String)>,
    /// Walls whose hinge the check has elsewhere than the runs, with both places.
    pub(crate) hinges: Vec<(String, [f64; 2])>,
    /// Walls of which the check has another body than the runs.
    pub(crate) other_bodies: Vec<String>,
}

impl Class {
    /// Adds a wall.
    pub(crate) fn add(&mut self, wall: &NamedWall, found: &Result<WallReliability, String>) {
        let found = match found {
            Ok(found) => found,
            Err(reason) => return self.refused.push((wall.name.clone(), reason.clone())),
        };
        self.least = found.least;
        self.hinges.extend(found.hinges.map(|hinges| (wall.name.clone(), hinges)));
        self.other_bodies.extend(found.is_other_body.then(|| wall.name.clone()));
        let all = found.answers.iter().filter_map(|answer| {
            Some(Found {
                model: answer.model,
                check: found.checks[answer.check].check,
                event: found.events[answer.event].name.clone(),
                margin: answer.margin?.estimate,
                probability: answer.probability?.estimate,
            })
        });
        self.members.push(Member {
            name: wall.name.clone(),
            quantities: quantities(wall),
            found: all.collect(),
            governs: found.checks.get(found.governs).map_or("", |check| check.check),
            turned: found.turned.clone(),
        });
    }

    /// Returns the fall of each wall with a model, where the check that governs has ζ = 1.
    pub(crate) fn falls(&self, model: usize) -> impl Iterator<Item = (&Member, &Found)> {
        self.members.iter().filter_map(move |member| {
            let is = |found: &&Found| {
                found.model == model && found.check == member.governs && found.event == crate::wall::FALL
            };
            Some((member, member.found.iter().find(is)?))
        })
    }
}

/// Puts values of the same key together, by the order of models and then of the first value.
pub(crate) fn grouped<K: PartialEq, V>(
    values: impl Iterator<Item = (K, V)>,
    model: impl Fn(&K) -> usize,
) -> Vec<(K, Vec<V>)> {
    let mut groups: Vec<(K, Vec<V>)> = Vec::new();
    for (key, value) in values {
        match groups.iter_mut().find(|(own, _)| *own == key) {
            Some((_, group)) => group.push(value),
            None => groups.push((key, vec![value])),
        }
    }
    groups.sort_by_key(|(key, _)| model(key));
    groups
}

fn quantities(wall: &NamedWall) -> [f64; 4] {
    let p = &wall.parameters;
    let weight = Wall::new(p).map_or(f64::NAN, |wall| wall.body().weight);
    let floor = wall.floors.as_ref().and_then(|floors| floors.supports(p.mechanism).ok());
    [p.height / p.thickness, p.height, p.overburden / weight, floor.map_or(0.0, |(bottom, _)| bottom as f64)]
}
