//! `--both-polarities`: each motion as it is and with the other sign.

use rocking_wall::wall::{Parameters, Wall};

/// The signs of the motions of a command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Polarities {
    /// As they are.
    Given,
    /// Both signs.
    Both,
    /// Both were asked for, but the wall is alike on both sides and starts upright and at rest: one run is
    /// both.
    Alike,
}

impl Polarities {
    pub(crate) fn of(both: bool, parameters: &Parameters, wall: &Wall) -> Self {
        let upright = parameters.u_start == 0.0 && parameters.u_dot_start == 0.0;
        match (both, wall.has_equal_sides() && upright) {
            (false, _) => Self::Given,
            (true, false) => Self::Both,
            (true, true) => Self::Alike,
        }
    }

    /// The signs, with the factors on a motion.
    pub(crate) fn signs(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Given => &[("+", 1.0)],
            Self::Both => &[("+", 1.0), ("-", -1.0)],
            Self::Alike => &[("±", 1.0)],
        }
    }

    /// What the user should know.
    pub(crate) fn note(self) -> &'static str {
        match self {
            Self::Given | Self::Both => "",
            Self::Alike => {
                "the wall is alike on both sides: both signs of a motion give the same, one was run\n"
            }
        }
    }
}
