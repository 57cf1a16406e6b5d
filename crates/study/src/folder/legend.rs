//! Colours and marks of the damping models of a study.

use std::fmt::Write;

use report::escaped;
use report::palette::{Mark, SERIES, sign};
use report::sheet::sheet;
use run::model::{EnergyLoss, Label, colors};

use super::contents::Manifest;

/// Returns the colour and the mark of each model.
pub(crate) fn looks(manifest: &Manifest) -> Vec<(&'static str, Mark)> {
    let names: Vec<_> = manifest.contents.models.iter().map(|model| &*model.name).collect();
    colors(&names).into_iter().map(|color| SERIES[color % SERIES.len()]).collect()
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

/// Spells out the damping models of a study, each once.
pub(crate) fn spelled_out(manifest: &Manifest) -> String {
    let models = &manifest.contents.models;
    let is = |damping: &str, short: &str| {
        let rest = damping.strip_prefix(short);
        // a ratio or an equation may follow the name
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(' ') && rest != " rigid")
    };
    let labels = EnergyLoss::models().map(EnergyLoss::label);
    let used = labels.filter(|label| models.iter().any(|model| is(&model.damping, label.name)));
    let words: Vec<_> = used.map(|Label { name, meaning, .. }| format!("{name}: {meaning}")).collect();
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
