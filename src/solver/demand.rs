//! Demands on a wall: extremes with their times, first crossings of limit states, half cycles.

use serde::{Serialize, Serializer};

use crate::wall::{Ends, Sides, Tie, TieMemory, Wall};

/// A value and its time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Instant {
    /// The value, in SI units.
    pub value: f64,
    /// Time \[s\].
    pub time: f64,
}

/// The highest and the lowest value of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Extremes {
    /// The highest value.
    pub highest: Instant,
    /// The lowest value.
    pub lowest: Instant,
}

impl Extremes {
    fn at(value: f64, time: f64) -> Self {
        let instant = Instant { value, time };
        Self { highest: instant, lowest: instant }
    }

    /// Returns the extreme of the larger size, the highest where both are equal.
    pub fn largest(&self) -> Instant {
        if self.lowest.value.abs() > self.highest.value.abs() { self.lowest } else { self.highest }
    }

    /// Includes a quantity between two times from its values there, if it exceeds these by no more than
    /// `above` in between and no search is needed: no value can be a new extreme, or there is none between
    /// the ends. Returns `false` where a search is needed.
    #[inline]
    pub(super) fn include_ends(&mut self, [start, end]: [f64; 2], above: f64, times: [f64; 2]) -> bool {
        if start.max(end) + above <= self.highest.value && start.min(end) - above >= self.lowest.value {
            return true;
        }
        if !is_monotone([start, end], above) {
            return false;
        }
        self.include(start, times[0]);
        self.include(end, times[1]);
        true
    }

    pub(super) fn include(&mut self, value: f64, time: f64) {
        if value > self.highest.value {
            self.highest = Instant { value, time };
        }
        if value < self.lowest.value {
            self.lowest = Instant { value, time };
        }
    }
}

/// Returns whether a quantity g with these values at the ends of an interval δ is monotone in between.
///
/// With |g̈| ≤ M, g exceeds its values at the ends by `above` = M δ²/8 at most, and ġ differs by M δ/2 at
/// most from its mean over the interval.
pub(super) fn is_monotone([start, end]: [f64; 2], above: f64) -> bool {
    (end - start).abs() > 4.0 * above
}

/// The first time |u| reaches a fraction of `u_ins` of its side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Fraction of `u_ins` \[-\].
    pub fraction: f64,
    /// When, and u with its sign \[m\]; `None` if it never did.
    pub first: Option<Instant>,
}

impl Serialize for Crossing {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Named {
            fraction: f64,
            time: Option<f64>,
            u: Option<f64>,
        }
        let Self { fraction, first } = *self;
        Named { fraction, time: first.map(|at| at.time), u: first.map(|at| at.value) }.serialize(serializer)
    }
}

/// The demands of a motion on a tie, until the wall leaves its supports.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TieDemands {
    /// Height of the tie above the base \[m\].
    #[serde(skip)]
    pub height: f64,
    /// The largest force \[N\].
    #[serde(rename = "tie_force")]
    pub force: Instant,
    /// When the force first reached the strength \[N\]; `None` if it never did, or where none is given.
    #[serde(rename = "tie_strength")]
    pub strength: Option<Instant>,
    /// Yielding and fracture; `None` for a tie that stays elastic.
    #[serde(flatten)]
    pub yielding: Option<Yielding>,
}

impl TieDemands {
    /// Returns the demands on a tie whose force at one instant is `force`.
    fn at(tie: &Tie, force: Instant) -> Self {
        let reached = tie.strength.filter(|strength| force.value >= *strength);
        let strength = reached.map(|value| Instant { value, time: force.time });
        let yielding = tie.ultimate.map(|_| Yielding::default());
        Self { height: tie.height, force, strength, yielding }
    }

    /// Enters the time at which the tie is found to have broken.
    pub(crate) fn break_with(&mut self, tie: &Tie, memory: &TieMemory, time: f64) {
        let Some(Yielding { breaks, .. }) = &mut self.yielding else { return };
        for (sign, broke) in [1.0, -1.0].into_iter().zip(breaks) {
            if tie.is_broken(sign, memory) {
                broke.get_or_insert(time);
            }
        }
    }
}

/// Writes the demands on one tie among those on the wall, those on several as a list.
fn one_or_list<S: Serializer>(ties: &[TieDemands], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Of<'a> {
        tie_height: f64,
        #[serde(flatten)]
        demands: &'a TieDemands,
    }
    #[derive(Serialize)]
    struct Several<'a> {
        ties: Vec<Of<'a>>,
    }
    match ties {
        [] => serializer.serialize_none(),
        [one] => one.serialize(serializer),
        several => {
            let ties = several.iter().map(|demands| Of { tie_height: demands.height, demands }).collect();
            Several { ties }.serialize(serializer)
        }
    }
}

/// How far a tie has yielded on each side, and when it broke.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Yielding {
    /// Plastic elongation p \[m\].
    pub elongation: Sides,
    /// When the tie of each side broke, u > 0 first \[s\]; `None` where it did not.
    pub breaks: [Option<f64>; 2],
}

impl Serialize for Yielding {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Named {
            #[serde(rename = "tie_elongation")]
            positive: f64,
            #[serde(rename = "tie_elongation_negative")]
            negative: f64,
            #[serde(rename = "tie_break_time")]
            broke: Option<f64>,
            #[serde(rename = "tie_break_time_negative")]
            broke_negative: Option<f64>,
        }
        let Self { elongation: Sides { positive, negative }, breaks: [broke, broke_negative] } = *self;
        Named { positive, negative, broke, broke_negative }.serialize(serializer)
    }
}

/// The demands of a motion on a wall, up to overturning; those on its ties go on until the wall leaves its
/// supports. Serialised, they have the names of the FMU's outputs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Demands {
    /// u \[m\].
    #[serde(rename = "u")]
    pub displacement: Extremes,
    /// u̇ \[m/s\].
    #[serde(rename = "u_dot")]
    pub velocity: Extremes,
    /// ü \[m/s²\].
    #[serde(rename = "u_ddot")]
    pub acceleration: Extremes,
    /// Force of the bottom support on the wall \[N\].
    pub reaction_bottom: Extremes,
    /// Force of the top support on the wall \[N\]; 0 for a parapet.
    pub reaction_top: Extremes,
    /// First crossings, in the order of the fractions asked for.
    #[serde(rename = "thresholds")]
    pub crossings: Vec<Crossing>,
    /// Rocking half cycles: excursions beyond the elastic branch with a passage of u = 0 between them. For
    /// the rigid-linear law each motion away from u = 0 is one.
    pub half_cycles: u64,
    /// Demands on each tie, in their order.
    #[serde(flatten, serialize_with = "one_or_list")]
    pub ties: Vec<TieDemands>,
    /// The sign of an excursion that has not ended at u = 0 yet.
    #[serde(skip)]
    pub(super) excursion: Option<f64>,
}

impl Demands {
    /// Returns the demands of u, u̇ and ü, of the reactions and of the ties at one instant. `fractions` of
    /// `u_ins` are the limit states whose first crossings are wanted.
    pub(crate) fn new(
        wall: &Wall,
        time: f64,
        [displacement, velocity, acceleration]: [f64; 3],
        reactions: Ends,
        tie_forces: impl Fn(&Tie) -> f64,
        fractions: &[f64],
    ) -> Self {
        let u_ins = wall.body().instability.of(displacement);
        let crossing = |&fraction: &f64| Crossing {
            fraction,
            first: (displacement.abs() >= fraction * u_ins).then_some(Instant { value: displacement, time }),
        };
        let ties = wall.ties().iter();
        Self {
            displacement: Extremes::at(displacement, time),
            velocity: Extremes::at(velocity, time),
            acceleration: Extremes::at(acceleration, time),
            reaction_bottom: Extremes::at(reactions.bottom, time),
            reaction_top: Extremes::at(reactions.top, time),
            crossings: fractions.iter().map(crossing).collect(),
            half_cycles: 0,
            ties: ties.map(|tie| TieDemands::at(tie, Instant { value: tie_forces(tie), time })).collect(),
            excursion: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The time of an extreme is the first at which it was reached.
    #[test]
    fn extremes_keep_their_first_instant() {
        let mut extremes = Extremes::at(0.0, 1.0);
        for (value, time) in [(2.0, 2.0), (-3.0, 3.0), (2.0, 4.0), (-3.0, 5.0), (1.0, 6.0)] {
            extremes.include(value, time);
        }
        assert_eq!(extremes.highest, Instant { value: 2.0, time: 2.0 });
        assert_eq!(extremes.lowest, Instant { value: -3.0, time: 3.0 });
        assert_eq!(extremes.largest(), extremes.lowest);
    }
}
