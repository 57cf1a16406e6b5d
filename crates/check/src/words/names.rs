//! Names that codes share: limit states, sides of a wall, and which check decides.

use std::fmt;

/// A limit state of NTC 2018, 3.2.1, in the order in which they are reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub enum LimitState {
    /// Damage.
    #[serde(rename = "SLD")]
    Sld,
    /// Life safety.
    #[serde(rename = "SLV")]
    Slv,
    /// Collapse.
    #[serde(rename = "SLC")]
    Slc,
}

impl LimitState {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Sld, Self::Slv, Self::Slc];

    /// The key of its table.
    pub fn key(self) -> &'static str {
        match self {
            Self::Sld => "SLD",
            Self::Slv => "SLV",
            Self::Slc => "SLC",
        }
    }

    /// P of being exceeded in `V_R`, NTC Tab. 3.2.I \[-\].
    pub fn exceeded(self) -> f64 {
        match self {
            Self::Sld => 0.63,
            Self::Slv => 0.10,
            Self::Slc => 0.05,
        }
    }

    /// ξ of the mechanism where nothing better is known, C8.7.1.2.1.5 and C8.7.1.2.1.8 \[-\].
    pub fn damping(self) -> f64 {
        match self {
            Self::Sld => 0.05,
            Self::Slv => 0.08,
            Self::Slc => 0.10,
        }
    }
}

impl fmt::Display for LimitState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

/// A side of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// u > 0.
    Positive,
    /// u < 0.
    Negative,
}

impl Side {
    /// Both of them.
    pub const ALL: [Self; 2] = [Self::Positive, Self::Negative];

    /// The side of a sign of u.
    pub fn of(sign: f64) -> Self {
        if sign < 0.0 { Self::Negative } else { Self::Positive }
    }

    /// The sign of u.
    pub fn sign(self) -> f64 {
        match self {
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }

    /// Its name in JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::Positive => "positive",
            Self::Negative => "negative",
        }
    }

    /// Returns the name of the side in tables, `u > 0` or `u < 0`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Positive => "u > 0",
            Self::Negative => "u < 0",
        }
    }
}

/// What a number is of: one side, or both where they are alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// Both, which are alike.
    Alike,
    /// One of them.
    One(Side),
}

impl Sides {
    /// A side of a wall whose sides may be `alike`.
    pub fn of(side: Side, alike: bool) -> Self {
        if alike { Self::Alike } else { Self::One(side) }
    }

    /// The sign of u, of both that of `u > 0`.
    pub fn sign(self) -> f64 {
        if self == Self::One(Side::Negative) { -1.0 } else { 1.0 }
    }

    /// Returns the name in tables, `u > 0`, `u < 0` or `both sides`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Alike => "both sides",
            Self::One(side) => side.name(),
        }
    }
}

/// Which of the checks governs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub enum Deciding {
    /// Activation.
    #[serde(rename = "SLD")]
    Sld,
    /// SLV with q.
    #[serde(rename = "SLV_q")]
    SlvWithQ,
    /// SLV by displacement, or dynamic.
    #[serde(rename = "SLV")]
    Slv,
    /// SLC by displacement, or dynamic.
    #[serde(rename = "SLC")]
    Slc,
}

impl Deciding {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Sld, Self::SlvWithQ, Self::Slv, Self::Slc];

    /// Returns the name of the check.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sld => "SLD",
            Self::SlvWithQ => "SLV with q",
            Self::Slv => "SLV",
            Self::Slc => "SLC",
        }
    }

    /// Returns its limit state.
    pub fn state(self) -> LimitState {
        match self {
            Self::Sld => LimitState::Sld,
            Self::SlvWithQ | Self::Slv => LimitState::Slv,
            Self::Slc => LimitState::Slc,
        }
    }
}
