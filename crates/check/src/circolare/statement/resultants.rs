//! Which resultants the weights of a body have.

use serde::Deserialize;

/// Which resultants the weights of a body have, C8.7.1.2.1.1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Resultants {
    /// One on each body, of its own weight and of the loads that move along.
    #[default]
    Body,
    /// One of the own weight of each body, and each moving load.
    Each,
}
