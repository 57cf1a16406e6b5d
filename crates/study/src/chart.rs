//! Charts as data: what is drawn, over which axes. Drawing them is the affair of who shows them.

/// One pair of axes and what is on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What it shows, in a few words.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Lines and marks, the last one on top.
    pub series: Vec<Series>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Quantity, and its unit in brackets.
    pub label: String,
    /// From and to; of the data where `None`.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    /// An axis that takes its range from the data.
    #[must_use]
    pub fn new(label: &str) -> Self {
        Self { label: label.into(), range: None }
    }

    /// An axis over a range.
    #[must_use]
    pub fn over(label: &str, range: [f64; 2]) -> Self {
        Self { label: label.into(), range: Some(range) }
    }
}

/// How a series looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// A line.
    Line,
    /// A dashed line.
    Dashed,
    /// Marks.
    Marks,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; none for a series that repeats another one.
    pub name: String,
    /// How it looks.
    pub look: Look,
    /// Number of its colour; series that belong together share one.
    pub color: usize,
    /// The points.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// A line.
    #[must_use]
    pub fn line(name: &str, color: usize, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), look: Look::Line, color, points }
    }

    /// A dashed line.
    #[must_use]
    pub fn dashed(name: &str, color: usize, points: Vec<(f64, f64)>) -> Self {
        Self { look: Look::Dashed, ..Self::line(name, color, points) }
    }

    /// Marks.
    #[must_use]
    pub fn marks(name: &str, color: usize, points: Vec<(f64, f64)>) -> Self {
        Self { look: Look::Marks, ..Self::line(name, color, points) }
    }
}
