//! What pages with a moving picture share: style, player, and plots with a cursor.

use std::fmt::Write;

use crate::plot::Plot;
use crate::{escaped, template};
use serde_json::{Value, json};

/// Frames the slider moves through.
pub const MOST_FRAMES: usize = 1500;
/// Width of a plot on a phone \[px\], where letters keep their size.
const NARROW: f64 = 390.0;

/// What a page shows; times, frames and peaks of all that moves are in `data`, as its script knows them.
#[allow(missing_docs, reason = "the parts of the template, by their names")]
pub struct Moving<'a> {
    pub title: &'a str,
    pub subtitle: &'a str,
    pub verdict: &'a str,
    /// What moves, in words for screen readers.
    pub name: &'a str,
    pub style: &'a str,
    pub picture: &'a str,
    /// Choices of how the motion is drawn.
    pub choices: &'a str,
    pub facts: &'a str,
    pub figures: &'a str,
    pub data: &'a Value,
    pub script: &'a str,
    pub frames: usize,
}

/// Makes a page.
pub fn page(moving: &Moving<'_>) -> String {
    let parts = [
        ("title", &*escaped(moving.title)),
        ("subtitle", &escaped(moving.subtitle)),
        ("verdict", moving.verdict),
        ("name", moving.name),
        ("style", &[include_str!("moving.css"), moving.style].concat()),
        ("picture", moving.picture),
        ("last_frame", &(moving.frames - 1).to_string()),
        ("choices", moving.choices),
        ("facts", moving.facts),
        ("figures", moving.figures),
        // a closing tag inside the data would end the script
        ("data", &moving.data.to_string().replace("</", "<\\/")),
        ("script", &[include_str!("moving.js"), include_str!("player.js"), moving.script].concat()),
    ];
    template::page(include_str!("moving.html"), &parts)
}

/// Makes a choice of factors by which a motion is drawn larger; one of them is selected.
pub fn factors(label: &str, all: &[f64], chosen: f64) -> String {
    let option = |&factor: &f64| {
        let selected = if factor == chosen { " selected" } else { "" };
        let name = if factor == 1.0 { "to scale".to_owned() } else { format!("× {factor}") };
        format!("<option value=\"{factor}\"{selected}>{name}</option>")
    };
    let options: String = all.iter().map(option).collect();
    format!("<label>{label} <select id=\"{label}\">{options}</select></label>\n")
}

/// Indices of evenly spaced frames of a history, the last one among them.
pub fn frames(count: usize) -> Vec<usize> {
    let every = count.div_ceil(MOST_FRAMES).max(1);
    let mut frames: Vec<_> = (0..count).step_by(every).collect();
    if count > 0 && !(count - 1).is_multiple_of(every) {
        frames.push(count - 1);
    }
    frames
}

/// Numbers with five significant figures: a page is not a data file.
pub fn rounded(values: impl Iterator<Item = f64>) -> Vec<f64> {
    values.map(|value| format!("{value:.4e}").parse().unwrap_or(0.0)).collect()
}

/// A line for the verdict, which comes first.
pub fn verdict(text: &str, falls: bool) -> String {
    let class = if falls { "verdict falls" } else { "verdict" };
    format!("<p class=\"{class}\">{}</p>", escaped(text))
}

/// A plot with what moves over it: a cursor on histories, a dot on what is no history. It has a narrow form
/// for phones.
pub fn plot(id: &str, caption: &str, figure: &Plot, marks: &[(f64, &str)], is_history: bool) -> String {
    let narrow = Plot { size: [NARROW, figure.size[1]], ..figure.clone() };
    format!(
        "<figure><figcaption>{caption}</figcaption>{}{}</figure>",
        one(&format!("plot wide\" id=\"{id}"), figure, marks, is_history),
        one("plot narrow", &narrow, marks, is_history)
    )
}

fn one(class: &str, figure: &Plot, marks: &[(f64, &str)], is_history: bool) -> String {
    let [left, right, top, bottom] = figure.area();
    let [from, to, _, _] = figure.ranges();
    let span = format!("top:{:.4}%;height:{:.4}%", 100.0 * top, 100.0 * (bottom - top));
    let mut over = if is_history {
        format!("<div class=\"cursor\" style=\"{span}\"></div>")
    } else {
        "<div class=\"dot\"></div>".to_owned()
    };
    for (time, name) in marks {
        let part = (time - from) / (to - from);
        let x = 100.0 * (left + (right - left) * part);
        let late = if part > 0.7 { " late" } else { "" };
        // writing to a String cannot fail
        let _ =
            write!(over, "<div class=\"mark{late}\" style=\"left:{x:.4}%;{span}\"><span>{name}</span></div>");
    }
    let [area, ranges] = [figure.area(), figure.ranges()].map(|numbers| json!(numbers));
    let svg = figure.svg();
    format!("<div class=\"{class}\" data-area=\"{area}\" data-ranges=\"{ranges}\">{svg}{over}</div>")
}
