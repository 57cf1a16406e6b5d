//! Lines and marks over two axes, as SVG.
//!
//! ```
//! use report::palette::{BLUE, RED};
//! use report::plot::{Axis, Plot, Series};
//!
//! let points = vec![(0.0, 0.0), (1.0, 2.0), (2.0, -1.0)];
//! let plot = Plot {
//!     limits: vec![(1.5, RED)],
//!     ..Plot::new(
//!         [460.0, 300.0],
//!         [Axis::over("time (s)", [0.0, 2.0]), Axis::over("u (m)", [-2.0, 3.0])],
//!         vec![Series::stroke(BLUE, 1.2, points)],
//!     )
//! };
//! assert!(plot.svg().starts_with("<svg"));
//! ```

use std::fmt::Write;

pub use crate::axes::Scale;
use crate::escaped;
use crate::frame::{CHARACTER, Frame, LEGEND, legend, legend_height};
pub use crate::series::{Look, Series};

/// Margins around the plot area of an inline plot \[px\]: left, right, top, bottom.
pub(crate) const MARGINS: [f64; 4] = [70.0, 18.0, 14.0, 48.0];
/// Size of the numbers on the axes \[px\]: inline, and in a picture.
const NUMBERS: [f64; 2] = [13.0, 12.0];
/// Margins above and below the plot area of a picture without a title \[px\].
const PICTURE: [f64; 2] = [10.0, 51.0];
/// Space between plots one above the other \[px\].
const SPACING: f64 = 4.0;

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Quantity, and its unit in brackets.
    pub label: String,
    /// First and last value; the extremes of the data where `None`.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    /// An axis that takes its range from the data.
    pub fn new(label: &str) -> Self {
        Self { label: label.into(), range: None }
    }

    /// An axis over a range.
    pub fn over(label: &str, range: [f64; 2]) -> Self {
        Self { label: label.into(), range: Some(range) }
    }
}

impl From<&str> for Axis {
    fn from(label: &str) -> Self {
        Self::new(label)
    }
}

/// How a picture writes its numbers, and what it says of its axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Locale {
    /// What stands between the labels of y and x for those who hear them: `over`.
    pub over: &'static str,
    /// Whether numbers have a decimal comma.
    pub comma: bool,
}

impl Default for Locale {
    fn default() -> Self {
        Self { over: "over", comma: false }
    }
}

/// A pair of axes and what is on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Width and height \[px\].
    pub size: [f64; 2],
    /// Title in a [picture](Plot::picture) or a [figure](Plot::figure); empty for none.
    pub title: String,
    /// The horizontal and the vertical axis.
    pub axes: [Axis; 2],
    /// What the axes count.
    pub scale: Scale,
    /// Lines and marks, the last one on top.
    pub series: Vec<Series>,
    /// Dashed horizontal lines and their colours.
    pub limits: Vec<(f64, &'static str)>,
    /// Its language.
    pub locale: Locale,
}

impl Plot {
    /// A plot without a title, of linear axes and no limits.
    pub fn new(size: [f64; 2], axes: [Axis; 2], series: Vec<Series>) -> Self {
        let (title, scale, limits, locale) = (String::new(), Scale::Linear, Vec::new(), Locale::default());
        Self { size, title, axes, scale, series, limits, locale }
    }

    /// Draws inline SVG that takes the width of its place: it has a view box instead of a size, rounded to
    /// pixels.
    pub fn svg(&self) -> String {
        let frame = self.frame(MARGINS, NUMBERS[0]);
        let [width, height] = self.size.map(f64::round);
        format!(
            "<svg viewBox=\"0 0 {width} {height}\" font-family=\"system-ui, sans-serif\" role=\"img\" \
             aria-label=\"{} {} {}\"><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>{}</svg>",
            escaped(&self.axes[1].label),
            self.locale.over,
            escaped(&self.axes[0].label),
            self.body(&frame)
        )
    }

    /// Draws a picture with title and legend, as SVG for a file of its own.
    pub fn picture(&self) -> String {
        stacked(std::slice::from_ref(self))
    }

    /// Returns the sides of the plot area of the inline SVG, as parts of its width and height: left, right,
    /// top, bottom.
    pub fn area(&self) -> [f64; 4] {
        let ([width, height], [left, right, top, bottom]) = (self.size, MARGINS);
        [left / width, 1.0 - right / width, top / height, 1.0 - bottom / height]
    }

    /// Returns the ends of the axes, of x and then of y; NaN where an axis takes its range from the data.
    pub fn ranges(&self) -> [f64; 4] {
        let [[x0, x1], [y0, y1]] = self.axes.each_ref().map(|axis| axis.range.unwrap_or([f64::NAN; 2]));
        [x0, x1, y0, y1]
    }

    fn frame(&self, margins: [f64; 4], number_size: f64) -> Frame<'_> {
        let labels = self.axes.each_ref().map(|axis| &*axis.label);
        let ranges = [0, 1].map(|axis| self.range(axis, true));
        let comma = self.locale.comma;
        Frame {
            size: self.size,
            margins,
            ranges,
            labels,
            scale: self.scale,
            number_size,
            numbers: None,
            comma,
        }
    }

    /// The range of an axis, x or y: its own, or that of the data, with or without room around them.
    pub(crate) fn range(&self, axis: usize, room: bool) -> [f64; 2] {
        let pick = |&(x, y): &(f64, f64)| [x, y][axis];
        let values = self.series.iter().flat_map(|series| series.points.iter().map(pick));
        self.axes[axis].range.unwrap_or_else(|| extremes(values, room))
    }

    /// Draws the frame, and in it the limits and the series.
    fn body(&self, frame: &Frame<'_>) -> String {
        let mut inside = String::new();
        for &(limit, color) in &self.limits {
            let [_, y] = frame.place((frame.ranges[0][0], limit));
            let [left, right, ..] = frame.area();
            let line = Series { look: Look::Dashed, ..Series::stroke(color, 1.0, Vec::new()) };
            line.write(&mut inside, &[[left, y], [right, y]]);
        }
        for series in &self.series {
            let places: Vec<_> = series.points.iter().map(|&point| frame.place(point)).collect();
            series.write(&mut inside, &places);
        }
        frame.around(&inside)
    }
}

/// Returns how much higher than lines from 0 on an axis is, so that a legend of some rows stands above them,
/// in a picture without a title of a height \[px\].
pub fn room_for_legend(height: f64, rows: usize) -> f64 {
    let area = height - PICTURE[0] - PICTURE[1];
    area / (area - 2.0 * LEGEND - legend_height(rows))
}

/// The range of an axis that takes it from the data: their extremes, with or without room around them.
fn extremes(values: impl Iterator<Item = f64>, room: bool) -> [f64; 2] {
    let finite = values.filter(|value| value.is_finite());
    let (low, high) =
        finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low > high {
        return [0.0, 1.0];
    }
    let least = 1e-9 * high.abs().max(1.0);
    let room = if room { 0.06 * (high - low).max(least) } else { 0.0 };
    // an axis that starts near zero starts there
    let low = if low >= 0.0 && low < 0.3 * high { 0.0 } else { low - room };
    [low, (high + room).max(low + least)]
}

/// Draws plots of one width, one above the other, as SVG for a file of its own.
pub fn stacked(plots: &[Plot]) -> String {
    let (mut body, mut width, mut height) = (String::new(), 0.0_f64, 0.0);
    for plot in plots {
        let y = if height > 0.0 { height + SPACING } else { 0.0 };
        let top = if plot.title.is_empty() { PICTURE[0] } else { 32.0 };
        let mut frame = plot.frame([0.0, 14.0, top, PICTURE[1]], NUMBERS[1]);
        frame.margins[0] = 38.0 + CHARACTER * frame.longest_number();
        let _ = write!(body, "<g transform=\"translate(0 {y})\">{}", plot.body(&frame));
        if !plot.title.is_empty() {
            let (x, title) = (0.5 * plot.size[0], escaped(&plot.title));
            let _ = write!(
                body,
                "<text x=\"{x:.1}\" y=\"20\" font-size=\"14\" text-anchor=\"middle\">{title}</text>"
            );
        }
        legend(&mut body, &plot.series, frame.area());
        body.push_str("</g>");
        (width, height) = (width.max(plot.size[0]), y + plot.size[1]);
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"system-ui, sans-serif\">\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>{body}</svg>"
    )
}
