//! The section of a page that shows all walls together: medians with intervals, damping models side by side.

use std::fmt::Write;

use fragility::Interval;
use report::escaped;
use report::palette::sign;

use crate::ida::Layout;
use crate::results::WallResults;

use super::contents::Manifest;
use super::legend::looks;
use super::tables::OF_INTENSITY;

/// Height of the lane of a model \[px\].
const LANE: usize = 13;
/// Round steps of the axis \[g\], about this many along it.
const STEPS: f64 = 6.0;

/// Median collapse intensities, wall by wall and model by model.
#[derive(Debug, Default)]
pub(crate) struct Comparison(Vec<Vec<Interval>>);

impl Comparison {
    /// Adds the next wall, if the collapse is among the limit states.
    pub(crate) fn add(&mut self, manifest: &Manifest, results: &WallResults) {
        let collapse = manifest.report.fractions.iter().position(|fraction| *fraction == 1.0);
        let medians = |state| results.summaries(state).map(|summary| summary.median).collect();
        self.0.extend(collapse.map(medians));
    }

    /// Draws the section of the page; it is empty for a single wall and model, or without the collapse.
    pub(crate) fn section(&self, manifest: &Manifest) -> String {
        let all = || self.0.iter().flatten();
        if all().count() < 2 {
            return String::new();
        }
        let unit = manifest.contents.unit;
        let bounds = all().flat_map(|median| [median.estimate, median.range[1], median.least[0]]);
        let end = 1.06 * bounds.filter(|value| value.is_finite()).map(|x| unit.of(x)).fold(1e-6, f64::max);
        let ticks = report::ticks([0.0, end], STEPS);
        let step = 100.0 * ticks.get(1).map_or(end, |tick| tick.0) / end;
        let mut html = format!(
            "<section><h2>Median collapse intensity of every wall, {}</h2>\
             <p class=\"subtitle\">Marks: {}; lines: their 95&nbsp;% intervals, {}.</p>\
             <div class=\"forest\" style=\"--step:{step:.3}%;--high:{}px\">",
            escaped(&manifest.contents.axis()),
            if manifest.contents.layout == Layout::Cloud {
                "θ of the regressions"
            } else {
                "medians over the records"
            },
            manifest.contents.interval_of_medians(),
            LANE * manifest.contents.models.len()
        );
        for (wall, medians) in manifest.contents.walls.iter().zip(&self.0) {
            let _ = write!(html, "<span>{}</span><div class=\"track\">", escaped(&wall.name));
            for (model, median) in medians.iter().enumerate() {
                html.push_str(&lane(manifest, model, median, end));
            }
            html.push_str("</div>\n");
        }
        html.push_str("<span></span><div class=\"axis\">");
        for (tick, text) in ticks {
            let _ = write!(html, "<small style=\"left:{:.2}%\">{text}</small>", 100.0 * tick / end);
        }
        html + "</div></div></section>\n"
    }
}

/// Draws the interval of a model as a line and its median as a mark, or writes a bound of a median that the
/// levels leave open.
fn lane(manifest: &Manifest, model: usize, median: &Interval, end: f64) -> String {
    if median.estimate.is_nan() {
        return String::new();
    }
    let (color, mark) = looks(manifest)[model];
    let unit = manifest.contents.unit;
    let place = |intensity: f64| 100.0 * (unit.of(intensity) / end).clamp(0.0, 1.0);
    let [text, low, high] = median.texts(unit.size(), OF_INTENSITY).map(|text| escaped(&text));
    let (from, to) = (place(median.least[1]), place(median.range[1]));
    let mut html = format!(
        "<div style=\"top:{}px\" title=\"{}: {text} ({low} … {high})\">\
         <i class=\"chip\" style=\"left:{from:.2}%;width:{:.2}%;background:{color}\"></i>",
        LANE * model,
        escaped(&manifest.contents.models[model].name),
        to - from
    );
    let _ = if median.estimate.is_finite() {
        write!(html, "<span style=\"left:{:.2}%\">{}</span>", place(median.estimate), sign(color, mark))
    } else {
        write!(html, "<small>{} {text} ▸</small>", sign(color, mark))
    };
    html + "</div>"
}
