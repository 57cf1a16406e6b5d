//! Colours and marks of the damping models of a study.

use std::fmt::Write;

use figures::escaped;
use figures::palette::{Mark, SERIES, sign};
use figures::sheet::sheet;
use study::chart::model_colors;

use crate::contents::Manifest;

/// Returns the colour and the mark of each model.
pub(crate) fn looks(manifest: &Manifest) -> Vec<(&'static str, Mark)> {
    let names: Vec<_> = manifest.contents.models.iter().map(|model| &*model.name).collect();
    model_colors(&names).into_iter().map(|color| SERIES[color % SERIES.len()]).collect()
}

/// Puts drawings of the walls on a sheet with a legend, as an SVG file.
pub(crate) fn file(
    manifest: &Manifest,
    title: &str,
    drawings: &[(String, String)],
    size: [f64; 2],
) -> String {
    let models = manifest.contents.models.iter().zip(looks(manifest));
    let legend: Vec<_> = models.map(|(model, (color, mark))| (color, mark, &*model.name)).collect();
    sheet(title, &legend, drawings, size)
}

/// What the short names of damping models stand for.
const NAMES: [(&str, &str); 6] = [
    ("CR", "coefficient of restitution, applied at each impact"),
    ("CR rigid", "coefficient of restitution on the rigid-linear force law"),
    ("CDC", "constant damping coefficient"),
    ("CDR", "constant damping ratio"),
    ("SDR", "stiffness-proportional damping ratio"),
    ("block", "damping of a free-standing block, Eq. (7)"),
];

/// Spells out the damping models of a study, each once.
pub(crate) fn spelled_out(manifest: &Manifest) -> String {
    let models = &manifest.contents.models;
    let is = |damping: &str, short: &str| {
        let rest = damping.strip_prefix(short);
        // a ratio or an equation may follow the name
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(' ') && rest != " rigid")
    };
    let used = NAMES.iter().filter(|(short, _)| models.iter().any(|model| is(&model.damping, short)));
    let words: Vec<_> = used.map(|(short, meaning)| format!("{short}: {meaning}")).collect();
    words.join("; ")
}

/// Lists the models for the top of the page.
pub(crate) fn key(manifest: &Manifest) -> String {
    let mut key = String::new();
    for (model, (color, mark)) in manifest.contents.models.iter().zip(looks(manifest)) {
        let _ = write!(key, "<span>{}{}</span>", sign(color, mark), escaped(&model.name));
    }
    key
}
