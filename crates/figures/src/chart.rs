//! The charts of a study as figures of a page, with their legends as text below them.
//!
//! ```
//! use figures::chart::figure;
//! use study::chart::{Axis, Chart, Series};
//!
//! let series = vec![Series::line("free rocking", 0, vec![(0.0, 1.0), (1.0, 0.5)])];
//! let (x, y) = (Axis::new("t (s)"), Axis::over("u / u_ins", [0.0, 1.0]));
//! let html = figure(&Chart { title: "Decay".into(), x, y, series });
//! assert!(html.contains("<figcaption>Decay</figcaption><svg"));
//! ```

use std::fmt::Write;

use study::chart::{Axis, Chart, Look, Series};

use crate::escaped;
use crate::palette::SERIES;
use crate::plot::{self, MARGINS, Plot};
use crate::points::{simplified, within};

/// How charts and their legends look on a page, as CSS.
pub const STYLE: &str = include_str!("chart.css");

/// Size \[px\].
const SIZE: [f64; 2] = [460.0, 300.0];

/// Draws a figure element: title, chart, legend.
pub fn figure(chart: &Chart) -> String {
    let mut key = String::new();
    for series in chart.series.iter().filter(|series| !series.name.is_empty()) {
        let (color, _, mark) = SERIES[series.color % SERIES.len()];
        let sample = match series.look {
            Look::Line => format!("<i style=\"border-top:2px solid {color}\"></i>"),
            Look::Dashed => format!("<i style=\"border-top:2px dashed {color}\"></i>"),
            Look::Marks => format!("<b style=\"color:{color}\">{mark}</b>"),
        };
        let _ = write!(key, "<span>{sample}{}</span>", escaped(&series.name));
    }
    format!(
        "<figure><figcaption>{}</figcaption>{}<p class=\"key\">{key}</p></figure>\n",
        escaped(&chart.title),
        svg(chart)
    )
}

fn svg(chart: &Chart) -> String {
    let of = |pick: fn(&(f64, f64)) -> f64| chart.series.iter().flat_map(move |s| s.points.iter().map(pick));
    let marks = chart.series.iter().any(|series| series.look == Look::Marks);
    let ranges = [range(&chart.x, of(|point| point.0), marks), range(&chart.y, of(|point| point.1), true)];
    let [left, right, top, bottom] = MARGINS;
    let area = [SIZE[0] - left - right, SIZE[1] - top - bottom];
    let scale = [0, 1].map(|axis| area[axis] / (ranges[axis][1] - ranges[axis][0]));
    let mut series = Vec::new();
    for Series { look, color, points, .. } in &chart.series {
        let (color, mark, _) = SERIES[color % SERIES.len()];
        let (look, pieces) = match look {
            Look::Marks => {
                let look = plot::Look::Marks(mark);
                series.push(plot::Series { look, ..plot::Series::line(color, 3.5, points.clone()) });
                continue;
            }
            Look::Line => (plot::Look::Solid, within(points, ranges)),
            Look::Dashed => (plot::Look::Dashed, within(points, ranges)),
        };
        series.extend(
            pieces.iter().map(|piece| plot::Series {
                look,
                ..plot::Series::line(color, 1.4, simplified(piece, scale))
            }),
        );
    }
    let axes = [Axis::over(&chart.x.label, ranges[0]), Axis::over(&chart.y.label, ranges[1])];
    Plot::new(SIZE, axes, series).svg()
}

/// The range of an axis: its own, or that of the data with room around it.
fn range(axis: &Axis, values: impl Iterator<Item = f64>, room: bool) -> [f64; 2] {
    if let Some(range) = axis.range {
        return range;
    }
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let room = if room { 0.06 * (high - low).max(1e-9) } else { 0.0 };
    // an axis that starts near zero starts there
    let low = if low >= 0.0 && low < 0.3 * high { 0.0 } else { low - room };
    [low, (high + room).max(low + 1e-9)]
}
