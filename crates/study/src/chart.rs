//! Charts as plain data: axes, lines and marks. Drawing them is left to the caller.
//!
//! ```
//! use study::chart::{Axis, Chart, Series};
//!
//! let line = Series::line("u", 0, vec![(0.0, 0.0), (1.0, 2.0)]);
//! let chart = Chart::new("a history", Axis::over("time (s)", [0.0, 1.0]), Axis::new("u (m)"), vec![line]);
//! assert_eq!(chart.y.range, None);
//! ```

/// Damping models in the order of their colours: a model keeps its colour in every figure.
pub const MODELS: [&str; 8] = ["CDC", "CDR", "SDR", "CDR Eq. 14", "block", "CR", "CR rigid", "none"];

/// Returns the number of the colour of each damping model of a study.
///
/// A name such as `CDC 0.05` has the number of `CDC`, unless another model of the study has it already.
///
/// ```
/// use study::chart::model_colors;
///
/// assert_eq!(model_colors(&["CR", "CDR 0.05", "CDR"]), [5, 0, 1]);
/// assert_eq!(model_colors(&["mine", "CDC 0.05"]), [1, 0]);
/// ```
pub fn model_colors(names: &[&str]) -> Vec<usize> {
    let number = |name: &str| MODELS.iter().position(|model| *model == name);
    let is_free = |colors: &[Option<usize>], color: &usize| !colors.contains(&Some(*color));
    // first the models themselves, then their variants, then what has another name
    let mut colors: Vec<Option<usize>> = names.iter().map(|name| number(name)).collect();
    for (index, name) in names.iter().enumerate() {
        let model = name.split(' ').next().and_then(number);
        colors[index] = colors[index].or(model.filter(|color| is_free(&colors, color)));
    }
    for index in 0..names.len() {
        let free = || (0..=names.len()).find(|color| is_free(&colors, color));
        colors[index] = colors[index].or_else(free);
    }
    colors.into_iter().flatten().collect()
}

/// Returns the number of the colour of a damping model.
pub fn model_color(name: &str) -> usize {
    model_colors(&[name])[0]
}

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
