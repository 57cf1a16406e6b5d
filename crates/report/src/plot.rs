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

use crate::escaped;
use crate::frame::{CHARACTER, Frame, LEGEND, legend, legend_height};
use crate::palette::{Mark, SERIES};
use crate::points::within;

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

impl From<(&str, [f64; 2])> for Axis {
    fn from((label, range): (&str, [f64; 2])) -> Self {
        Self::over(label, range)
    }
}

/// Points that belong together, and how they look.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// x and y; one whose y is NaN is a gap in a line.
    pub points: Vec<(f64, f64)>,
    /// A colour of the [palette](crate::palette).
    pub color: &'static str,
    /// A line, or marks.
    pub look: Look,
    /// Width of a line or size of a mark \[px\].
    pub width: f64,
    /// Name in a legend; empty for none, and for a series that belongs to a named one.
    pub name: String,
    /// The text shown when a mark or a line is pointed at: none, one for each mark, or one for the line.
    pub titles: Vec<String>,
}

/// How a series looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Look {
    Solid,
    Dashed,
    Dotted,
    /// A pale line, one of many; on a page it stands out when pointed at.
    Faint,
    Marks(Mark),
}

impl Series {
    /// A solid line with a name, in a colour of the palette by its number; series that belong together share
    /// one.
    pub fn line(name: &str, color: usize, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), ..Self::stroke(SERIES[color % SERIES.len()].0, 1.4, points) }
    }

    /// A dashed line, as [`Self::line`].
    pub fn dashed(name: &str, color: usize, points: Vec<(f64, f64)>) -> Self {
        Self { look: Look::Dashed, ..Self::line(name, color, points) }
    }

    /// Marks without a line, as [`Self::line`].
    pub fn marks(name: &str, color: usize, points: Vec<(f64, f64)>) -> Self {
        let look = Look::Marks(SERIES[color % SERIES.len()].1);
        Self { look, width: 3.5, ..Self::line(name, color, points) }
    }

    /// A solid line of a colour and a width \[px\].
    pub fn stroke(color: &'static str, width: f64, points: Vec<(f64, f64)>) -> Self {
        Self { points, color, look: Look::Solid, width, name: String::new(), titles: Vec::new() }
    }

    /// The pieces of a line inside ranges of x and y, cut at their edges; the first keeps the name. Of a line
    /// all outside, one piece without points keeps it.
    ///
    /// ```
    /// use report::plot::Series;
    ///
    /// let line = Series::line("above", 0, vec![(0.0, 5.0), (1.0, 6.0)]);
    /// let names: Vec<_> = line.within([[0.0, 1.0], [0.0, 3.0]]).map(|piece| piece.name).collect();
    /// assert_eq!(names, ["above"]);
    /// ```
    pub fn within(&self, ranges: [[f64; 2]; 2]) -> impl Iterator<Item = Self> {
        let mut pieces = within(&self.points, ranges);
        if pieces.is_empty() {
            pieces.push(Vec::new());
        }
        pieces.into_iter().enumerate().map(|(index, points)| {
            let name = if index == 0 { self.name.clone() } else { String::new() };
            Self { points, name, ..self.clone() }
        })
    }

    /// Writes the line or its marks at places \[px\].
    pub(crate) fn write(&self, svg: &mut String, places: &[[f64; 2]]) {
        // writing to a String cannot fail
        let Look::Marks(mark) = self.look else {
            let mut path = String::new();
            let mut step = "M";
            for [x, y] in places {
                // a point without a value is a gap
                if y.is_nan() {
                    step = "M";
                    continue;
                }
                let _ = write!(path, "{step}{x:.2} {y:.2}");
                step = "L";
            }
            let look = match self.look {
                Look::Dashed => " stroke-dasharray=\"8 4\"",
                Look::Dotted => " stroke-dasharray=\"2 4\"",
                Look::Faint => " opacity=\"0.4\" class=\"faint\"",
                Look::Solid | Look::Marks(_) => "",
            };
            let (color, width) = (self.color, self.width);
            let look = format!(" stroke=\"{color}\" stroke-width=\"{width}\" fill=\"none\"{look}");
            self.write_path(svg, 0, &path, &look);
            return;
        };
        let look = match mark {
            Mark::Dot => format!("stroke-width=\"{}\" stroke-linecap=\"round\" opacity=\"0.5\"", self.width),
            _ => "stroke-width=\"1.4\"".to_owned(),
        };
        let _ = write!(svg, "<g class=\"marks\" stroke=\"{0}\" fill=\"{0}\" {look}>", self.color);
        let outline = mark.outline(self.width);
        // without titles one path is enough for thousands of marks
        let at_once = if self.titles.is_empty() { places.len().max(1) } else { 1 };
        for (index, places) in places.chunks(at_once).enumerate() {
            let mut path = String::new();
            for [x, y] in places {
                let _ = write!(path, "M{x:.2} {y:.2}{outline}");
            }
            self.write_path(svg, index, &path, "");
        }
        svg.push_str("</g>");
    }

    /// Writes a path, with its title if it has one.
    fn write_path(&self, svg: &mut String, index: usize, path: &str, look: &str) {
        let _ = match self.titles.get(index) {
            Some(title) => write!(svg, "<path d=\"{path}\"{look}><title>{}</title></path>", escaped(title)),
            None => write!(svg, "<path d=\"{path}\"{look}/>"),
        };
    }
}

/// What the axes count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Both count the values.
    Linear,
    /// x counts the values, spaced by their logarithms; y counts the values.
    LogarithmicAcross,
    /// x counts the values, spaced by their logarithms. y counts exponents of ten.
    Logarithmic,
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
}

impl Plot {
    /// A plot without a title, of linear axes and no limits.
    pub fn new(size: [f64; 2], axes: [Axis; 2], series: Vec<Series>) -> Self {
        Self { size, title: String::new(), axes, scale: Scale::Linear, series, limits: Vec::new() }
    }

    /// Draws inline SVG that takes the width of its place: it has a view box instead of a size, rounded to
    /// pixels.
    pub fn svg(&self) -> String {
        let frame = self.frame(MARGINS, NUMBERS[0]);
        let [width, height] = self.size.map(f64::round);
        format!(
            "<svg viewBox=\"0 0 {width} {height}\" font-family=\"system-ui, sans-serif\" role=\"img\" \
             aria-label=\"{} over {}\"><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>{}</svg>",
            escaped(&self.axes[1].label),
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
        Frame { size: self.size, margins, ranges, labels, scale: self.scale, number_size, numbers: None }
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
