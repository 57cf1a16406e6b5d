//! Runs of each motion as it is and with the opposite sign.

use rocking_wall::wall::{Parameters, Wall};

/// The signs with which motions are run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Polarities {
    /// As they are.
    AsRecorded,
    /// Both signs.
    Both,
    /// Both were asked for, but the wall is alike on both sides and starts upright and at rest, so that one
    /// run stands for both.
    Alike,
}

impl Polarities {
    /// Returns the signs for a wall: both where they are asked for and differ.
    pub fn of(both: bool, parameters: &Parameters, wall: &Wall) -> Self {
        let upright = parameters.u_start == 0.0 && parameters.u_dot_start == 0.0;
        match (both, wall.has_equal_sides() && upright) {
            (false, _) => Self::AsRecorded,
            (true, false) => Self::Both,
            (true, true) => Self::Alike,
        }
    }

    /// Returns the signs, with the factors on a motion.
    pub fn signs(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::AsRecorded => &[("+", 1.0)],
            Self::Both => &[("+", 1.0), ("-", -1.0)],
            Self::Alike => &[("±", 1.0)],
        }
    }

    /// Returns a line for the user where one run stands for both signs; otherwise nothing.
    pub fn note(self) -> &'static str {
        match self {
            Self::AsRecorded | Self::Both => "",
            Self::Alike => {
                "both sides of the wall are alike, so both signs of a motion give the same result; only \
                 one was run\n"
            }
        }
    }
}
