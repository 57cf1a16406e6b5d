//! Plots with title and legend: figures of a page, and pictures that fit on a phone.

use std::fmt::Write;

use crate::escaped;
use crate::palette::{Mark, SERIES, sign, stroke};
use crate::plot::{Axis, Look, MARGINS, Plot, Series};
use crate::points::simplified;

/// Size of a figure, and of a picture of it \[px\].
const SIZES: [[f64; 2]; 2] = [[460.0, 300.0], [460.0, 400.0]];
/// Marks along a line that is one of several.
const MARKS: usize = 4;

impl Plot {
    /// A plot for a [figure](Self::figure), with a title and series that have names. An axis without a range
    /// is also its label.
    ///
    /// ```
    /// use report::plot::{Axis, Plot, Series};
    ///
    /// let series = vec![Series::line("free rocking", 0, vec![(0.0, 1.0), (1.0, 0.5)])];
    /// let plot = Plot::titled("Decay", "t (s)", Axis::over("u / u_ins", [0.0, 1.0]), series);
    /// assert!(plot.figure().contains("<figcaption>Decay</figcaption><svg"));
    /// ```
    pub fn titled(
        title: impl Into<String>,
        x: impl Into<Axis>,
        y: impl Into<Axis>,
        series: Vec<Series>,
    ) -> Self {
        Self { title: title.into(), ..Self::new(SIZES[0], [x.into(), y.into()], series) }
    }

    /// Draws a figure element: title, plot, and the legend as text below.
    pub fn figure(&self) -> String {
        format!(
            "<figure><figcaption>{}</figcaption>{}<p class=\"key\">{}</p></figure>\n",
            escaped(&self.title),
            self.traced(SIZES[0]).svg(),
            self.key(true, escaped)
        )
    }

    /// The legend as text of a page: a sample and the name of each series that has one; `marked` says whether
    /// lines have the marks of a figure, and `markup` makes the markup of a name.
    pub fn key(&self, marked: bool, markup: impl Fn(&str) -> String) -> String {
        let mut key = String::new();
        for series in self.series.iter().filter(|series| !series.name.is_empty()) {
            let color = series.color;
            let mut sample = match series.look {
                Look::Solid | Look::Faint => stroke(color, "solid"),
                Look::Dashed => stroke(color, "dashed"),
                Look::Dotted => stroke(color, "dotted"),
                Look::Marks(_) => String::new(),
            };
            let is_shown = marked || matches!(series.look, Look::Marks(_));
            if let Some(mark) = self.mark(series).filter(|_| is_shown) {
                sample += &sign(color, mark);
            }
            let _ = write!(key, "<span>{sample}{}</span>", markup(&series.name));
        }
        key
    }

    /// Draws a figure with its legend at the top right, for a file. It has no title, so that it fits on a
    /// phone.
    pub fn figure_file(&self) -> String {
        self.traced(SIZES[1]).picture()
    }

    /// Whether series are marks.
    fn has_marks(&self) -> bool {
        self.series.iter().any(|series| matches!(series.look, Look::Marks(_)))
    }

    /// Returns the mark of a series: that of its colour for a line where lines have several colours, unless
    /// the plot has marks of its own.
    fn mark(&self, series: &Series) -> Option<Mark> {
        match series.look {
            Look::Marks(mark) => Some(mark),
            _ if self.has_marks() || self.series.iter().all(|other| other.color == series.color) => None,
            _ => SERIES.iter().find(|(color, _)| *color == series.color).map(|(_, mark)| *mark),
        }
    }

    /// Returns the plot with lines cut at the axes, without points that nobody would see, and with marks.
    fn traced(&self, size: [f64; 2]) -> Self {
        let ranges = [self.range(0, self.has_marks()), self.range(1, true)];
        let [left, right, top, bottom] = MARGINS;
        let area = [size[0] - left - right, size[1] - top - bottom];
        let scale = [0, 1].map(|axis| area[axis] / (ranges[axis][1] - ranges[axis][0]));
        let (mut drawn, mut on_top) = (Vec::new(), Vec::new());
        for (index, series) in self.series.iter().enumerate() {
            if matches!(series.look, Look::Marks(_)) {
                drawn.push(series.clone());
                continue;
            }
            let pieces: Vec<_> = series.within(ranges).collect();
            if let Some(mark) = self.mark(series) {
                let part = (index as f64 + 0.5) / self.series.len() as f64;
                let all: Vec<_> = pieces.iter().flat_map(|piece| piece.points.iter().copied()).collect();
                let points = spread(&all, scale, part);
                on_top.push(Series { look: Look::Marks(mark), ..Series::stroke(series.color, 3.5, points) });
            }
            drawn.extend(
                pieces.into_iter().map(|piece| Series { points: simplified(&piece.points, scale), ..piece }),
            );
        }
        drawn.extend(on_top);
        let [x, y] = self.axes.each_ref().map(|axis| axis.label.as_str());
        Self::new(size, [Axis::over(x, ranges[0]), Axis::over(y, ranges[1])], drawn)
    }
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
