//! Charts as plain data: axes, lines and marks. Drawing them is left to the caller.
//!
//! ```
//! use study::chart::{Axis, Chart, Series};
//!
//! let line = Series::line("u", 0, vec![(0.0, 0.0), (1.0, 2.0)]);
//! let chart = Chart::new("a history", Axis::over("time (s)", [0.0, 1.0]), Axis::new("u (m)"), vec![line]);
//! assert_eq!(chart.y.range, None);
//! ```

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
    /// Creates a chart.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Self { title: title.into(), x, y, series }
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
