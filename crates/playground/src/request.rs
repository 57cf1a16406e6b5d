//! What the page asks for, and what is wrong with it, field by field.

use std::collections::BTreeMap;

use check::Language;
use serde::Deserialize;

/// Fields of the page and their texts.
pub(crate) type Fields = BTreeMap<String, String>;
/// Fields of the page and what is wrong with each.
pub(crate) type Faults = BTreeMap<String, String>;

/// A request of the page.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Request {
    /// Describe the parameters.
    Parameters,
    /// List the parameters that do not matter beside the others.
    Unused(Fields),
    /// Run a wall under a motion.
    Run(Inputs),
    /// Start the fragility of a wall.
    Fragility(Inputs),
    /// Run the next motion of the fragility.
    NextMotion,
    /// Return the frames of the last run.
    Frames,
    /// Return the history of the last run as CSV.
    Csv,
    /// Return the charts of the last run as one SVG file.
    Svg,
    /// Return the report of the check of the last run, in a language, as a page.
    Report(Language),
}

/// What the user has chosen.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Inputs {
    /// Parameters of the wall by the names of the model description, those that differ from the default.
    pub(crate) parameters: Fields,
    /// Parts, openings and loads as tables of a scene file, in place of a rectangle; none where empty.
    #[serde(default)]
    pub(crate) parts: String,
    /// `kind`, and the keys of this kind of motion.
    pub(crate) motion: Fields,
    /// Keys of the table `[check]`, those of its tables with a dot: `SLV.ag`.
    #[serde(default)]
    pub(crate) check: Fields,
    /// Width of the charts \[px\].
    pub(crate) width: f64,
    /// Language of the check.
    #[serde(default)]
    pub(crate) language: Language,
}

/// Says what is wrong with one field.
pub(crate) fn fault_of(field: impl Into<String>, message: impl Into<String>) -> Faults {
    Faults::from([(field.into(), message.into())])
}
