//! A wall of a study: its parameters under a name, and which of them its file states.

use rocking_wall::wall::Parameters;
use scene::Floors;

/// A wall of a study. It starts upright and at rest, with the damping and impact of the study's models.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedWall {
    /// Name in tables and messages.
    pub name: String,
    /// Parameters. The coefficient of restitution that they state or imply serves every model, ξ and c̄ each
    /// model that takes it and has none of its own.
    pub parameters: Parameters,
    /// Storeys between ground and wall. Records shake the ground, and intensities are those of the ground.
    pub floors: Option<Floors>,
    /// Whether an oscillator stands in place of its geometry.
    pub is_oscillator: bool,
    /// Those of [`DECIDING`] that nobody stated.
    pub assumed: Vec<&'static str>,
    /// Parameters that its file states, and numbers of its bar by their names outside of `[tie.bar]`; `None`
    /// of a wall of no file, of which nothing is a default.
    pub stated: Option<Vec<&'static str>>,
    /// The place of its table in the list of walls that was read.
    pub entry: usize,
    /// What a row of a table states of its check: keys of the table `[check]` and their values.
    pub check: Vec<(&'static str, String)>,
}

/// Parameters without which a wall is not checked, with their groups: no default decides a verdict.
pub const DECIDING: [(&str, &str); 5] = [
    ("geometry", "height"),
    ("geometry", "thickness"),
    ("geometry", "density"),
    ("geometry", "hinge_ratio"),
    ("force_law", "a1"),
];

/// Returns those of [`DECIDING`] that are not stated.
pub fn assumed(is_stated: impl Fn(&str, &str) -> bool) -> Vec<&'static str> {
    DECIDING.into_iter().filter(|(group, name)| !is_stated(group, name)).map(|(_, name)| name).collect()
}

impl NamedWall {
    /// Takes the names of the parameters that its file states; no other is stated.
    #[must_use]
    pub(crate) fn stating(self, stated: Vec<&'static str>) -> Self {
        Self { assumed: assumed(|_, name| stated.contains(&name)), stated: Some(stated), ..self }
    }

    /// Makes a wall on the ground, all of whose parameters are stated.
    pub fn new(name: impl Into<String>, parameters: Parameters) -> Self {
        Self {
            name: name.into(),
            parameters,
            floors: None,
            is_oscillator: false,
            assumed: Vec::new(),
            stated: None,
            entry: 0,
            check: Vec::new(),
        }
    }
}
