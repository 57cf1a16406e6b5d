//! The charts of a run.

use report::plot::{Plot, stacked};
use rocking_wall::wall::Wall;
use run::figure as plots;
use run::page::tie;
use scene::response::{Response, Sample};
use serde::Serialize;
use serde_json::{Value, json};

/// Part of the time before a fall that is shown after it.
const AFTER_FALL: f64 = 0.15;
/// Limits of the width of a chart \[px\].
const WIDTHS: [f64; 2] = [280.0, 1200.0];

/// The history, the motion and the restoring force of a run, and those of its tie, by the names of their
/// places on the page.
pub(crate) type Charts = Vec<(&'static str, Plot)>;

/// Draws a run at a width \[px\].
pub(crate) fn charts(wall: &Wall, response: &Response, width: f64) -> Charts {
    let width = width.clamp(WIDTHS[0], WIDTHS[1]);
    let end = shown_end(response);
    let shown: Vec<&Sample> = response.samples.iter().take_while(|sample| sample.time <= end).collect();
    let ratios = plots::cut(shown.iter().map(|sample| (sample.time, sample.outputs.ratio)).collect());
    let ground: Vec<_> = shown.iter().map(|sample| (sample.time, sample.support.bottom)).collect();
    let force = plots::force_path(wall, shown.iter().copied(), &ratios);
    let sized = |height: f64, plot: Plot| Plot { size: [width, height], ..plot };
    let of_tie = tie::plots(wall, response, end).into_iter().map(|(id, _, plot)| (id, sized(150.0, plot)));
    let charts = [
        ("history", sized((0.42 * width).clamp(170.0, 250.0), plots::history(&ratios, end))),
        ("motion", sized(150.0, plots::motion(&ground, None, end))),
        ("force", sized((0.5 * width).clamp(200.0, 270.0), force)),
    ];
    charts.into_iter().chain(of_tie).collect()
}

/// Returns the captions of the charts of a tie, by the names of their places; empty without one.
pub(crate) fn captions(wall: &Wall, response: &Response) -> Vec<(&'static str, String)> {
    let plots = tie::plots(wall, response, shown_end(response));
    plots.into_iter().map(|(id, caption, _)| (id, caption)).collect()
}

/// Returns charts as inline SVG, with what a cursor needs.
pub(crate) fn inline(charts: Charts) -> Value {
    let chart = |plot: Plot| json!({ "svg": plot.svg(), "area": plot.area(), "ranges": plot.ranges() });
    charts.into_iter().map(|(name, plot)| (name.to_owned(), chart(plot))).collect()
}

/// Returns charts as one SVG file.
pub(crate) fn file(charts: Charts) -> String {
    stacked(&charts.into_iter().map(|(_, plot)| plot).collect::<Vec<_>>())
}

/// The end of the time axes \[s\]: soon after a fall.
fn shown_end(response: &Response) -> f64 {
    let end = response.summary.end_time;
    response.summary.fate.falling().map_or(end, |time| end.min((1.0 + AFTER_FALL) * time + 0.5))
}

/// The motion of the wall for its drawing, with the digits that a drawing needs.
#[derive(Debug, Serialize)]
pub(crate) struct Frames {
    /// Times \[s\].
    t: Vec<f32>,
    /// Displacements \[m\].
    u: Vec<f32>,
    /// Restoring forces \[kN\].
    f: Vec<f32>,
    /// What ties do.
    ties: Value,
}

impl Frames {
    pub(crate) fn of(wall: &Wall, response: &Response) -> Self {
        let end = shown_end(response);
        let shown: Vec<&Sample> = response.samples.iter().take_while(|sample| sample.time <= end).collect();
        #[allow(clippy::cast_possible_truncation, reason = "a drawing has no more digits")]
        let column = |pick: fn(&Sample) -> f64| shown.iter().map(|sample| pick(sample) as f32).collect();
        Self {
            t: column(|sample| sample.time),
            u: column(|sample| sample.outputs.displacement),
            f: column(|sample| 1e-3 * sample.outputs.restoring_force),
            ties: tie::data(wall, response, &(0..shown.len()).collect::<Vec<_>>()),
        }
    }
}
