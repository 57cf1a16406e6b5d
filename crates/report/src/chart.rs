//! The charts of a study: axes, lines and marks, drawn as figures of a page with their legends as text below.
//!
//! ```
//! use report::chart::{Axis, Chart, Series, figure};
//!
//! let series = vec![Series::line("free rocking", 0, vec![(0.0, 1.0), (1.0, 0.5)])];
//! let html = figure(&Chart::new("Decay", Axis::new("t (s)"), Axis::over("u / u_ins", [0.0, 1.0]), series));
//! assert!(html.contains("<figcaption>Decay</figcaption><svg"));
//! ```

use std::fmt::Write;

use crate::escaped;
use crate::palette::{SERIES, sign};
use crate::plot::{self, MARGINS, Picture, Plot, extremes};
use crate::points::{simplified, within};

/// Size \[px\].
const SIZE: [f64; 2] = [460.0, 300.0];
/// Marks along a line that is one of several.
const MARKS: usize = 4;

/// A pair of axes and the series on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Lines and marks, the last one on top.
    pub series: Vec<Series>,
}

impl Chart {
    /// Creates a chart; an axis is also its label, or its label with its range.
    pub fn new(
        title: impl Into<String>,
        x: impl Into<Axis>,
        y: impl Into<Axis>,
        series: Vec<Series>,
    ) -> Self {
        Self { title: title.into(), x: x.into(), y: y.into(), series }
    }
}

/// An axis of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Quantity, and its unit in brackets.
    pub label: String,
    /// First and last value; the extremes of the data where `None`.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    /// Creates an axis that takes its range from the data.
    pub fn new(label: &str) -> Self {
        Self { label: label.into(), range: None }
    }

    /// Creates an axis over a range.
    pub fn over(label: &str, range: [f64; 2]) -> Self {
        Self { label: label.into(), range: Some(range) }
    }
}

impl From<&str> for Axis {
    fn from(label: &str) -> Self {
        Self::new(label)
    }
}

impl From<(&str, [f64; 2])> for Axis {
    fn from((label, range): (&str, [f64; 2])) -> Self {
        Self::over(label, range)
    }
}

/// Look of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Look {
    Line,
    Dashed,
    Marks,
}

/// Points drawn alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; empty for a series that belongs to a named one.
    pub name: String,
    /// Line, dashed line or marks.
    pub look: Look,
    /// Number of its colour; series that belong together share one.
    pub color: usize,
    /// Points (x, y).
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// Creates a line.
    pub fn line(name: &str, color: usize, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), look: Look::Line, color, points }
    }

    /// Creates a dashed line.
    pub fn dashed(name: &str, color: usize, points: Vec<(f64, f64)>) -> Self {
        Self { look: Look::Dashed, ..Self::line(name, color, points) }
    }

    /// Creates marks without a line.
    pub fn marks(name: &str, color: usize, points: Vec<(f64, f64)>) -> Self {
        Self { look: Look::Marks, ..Self::line(name, color, points) }
    }
}

/// Draws a figure element: title, chart, legend.
pub fn figure(chart: &Chart) -> String {
    let mut key = String::new();
    for series in chart.series.iter().filter(|series| !series.name.is_empty()) {
        let (color, mark) = SERIES[series.color % SERIES.len()];
        let line = |style| format!("<i class=\"chip line\" style=\"border-top:2px {style} {color}\"></i>");
        let mut sample = match series.look {
            Look::Line => line("solid"),
            Look::Dashed => line("dashed"),
            Look::Marks => String::new(),
        };
        if series.look == Look::Marks || is_marked(chart, series) {
            sample += &sign(color, mark);
        }
        let _ = write!(key, "<span>{sample}{}</span>", escaped(&series.name));
    }
    format!(
        "<figure><figcaption>{}</figcaption>{}<p class=\"key\">{key}</p></figure>\n",
        escaped(&chart.title),
        plot(chart, SIZE, false).svg()
    )
}

/// Draws a chart with its legend at the top right, for a file. It has no title, so that it fits on a phone.
pub fn picture(chart: &Chart) -> Picture {
    plot(chart, [460.0, 400.0], true).picture()
}

/// Returns whether a line carries marks too: the chart has lines of several colours, and no marks of its own.
fn is_marked(chart: &Chart, line: &Series) -> bool {
    let marks = chart.series.iter().any(|series| series.look == Look::Marks);
    !marks && chart.series.iter().any(|series| series.color != line.color)
}

fn plot(chart: &Chart, size: [f64; 2], is_named: bool) -> Plot {
    let of = |pick: fn(&(f64, f64)) -> f64| chart.series.iter().flat_map(move |s| s.points.iter().map(pick));
    let marks = chart.series.iter().any(|series| series.look == Look::Marks);
    let ranges = [
        chart.x.range.unwrap_or_else(|| extremes(of(|point| point.0), marks)),
        chart.y.range.unwrap_or_else(|| extremes(of(|point| point.1), true)),
    ];
    let [left, right, top, bottom] = MARGINS;
    let area = [size[0] - left - right, size[1] - top - bottom];
    let scale = [0, 1].map(|axis| area[axis] / (ranges[axis][1] - ranges[axis][0]));
    let (mut drawn, mut on_top) = (Vec::new(), Vec::new());
    for (index, series) in chart.series.iter().enumerate() {
        let first = drawn.len();
        let (color, mark) = SERIES[series.color % SERIES.len()];
        let marks =
            |points| plot::Series { look: plot::Look::Marks(mark), ..plot::Series::line(color, 3.5, points) };
        let look = match series.look {
            Look::Marks => {
                let name = if is_named { series.name.clone() } else { String::new() };
                drawn.push(plot::Series { name, ..marks(series.points.clone()) });
                continue;
            }
            Look::Line => plot::Look::Solid,
            Look::Dashed => plot::Look::Dashed,
        };
        let pieces = within(&series.points, ranges);
        drawn.extend(
            pieces.iter().map(|piece| plot::Series {
                look,
                ..plot::Series::line(color, 1.4, simplified(piece, scale))
            }),
        );
        if let Some(piece) = drawn.get_mut(first).filter(|_| is_named) {
            piece.name.clone_from(&series.name);
        }
        if is_marked(chart, series) {
            let part = (index as f64 + 0.5) / chart.series.len() as f64;
            on_top.push(marks(spread(&pieces.concat(), scale, part)));
        }
    }
    drawn.extend(on_top);
    let axes = [Axis::over(&chart.x.label, ranges[0]), Axis::over(&chart.y.label, ranges[1])];
    Plot::new(size, axes, drawn)
}

/// Returns [`MARKS`] points of a line, evenly along it; `part` of a distance from its start is the first.
fn spread(points: &[(f64, f64)], scale: [f64; 2], part: f64) -> Vec<(f64, f64)> {
    let length = |a: &(f64, f64), b: &(f64, f64)| ((b.0 - a.0) * scale[0]).hypot((b.1 - a.1) * scale[1]);
    let all: f64 = points.windows(2).map(|pair| length(&pair[0], &pair[1])).sum();
    let (mut gone, mut spread) = (0.0, Vec::new());
    for pair in points.windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let piece = length(&pair[0], &pair[1]);
        while piece > 0.0 && gone + piece >= all * (spread.len() as f64 + part) / MARKS as f64 {
            let part = (all * (spread.len() as f64 + part) / MARKS as f64 - gone) / piece;
            spread.push((x0 + part * (x1 - x0), y0 + part * (y1 - y0)));
        }
        gone += piece;
    }
    spread
}
