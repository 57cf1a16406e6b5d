//! Plots of thousands of lines and points as SVG of few bytes: [`STYLE`] has the classes of their paths.
//!
//! ```
//! let mut plot = report::many_lines::ManyLines::new([300.0, 250.0], [0.0, 1.0], [0.0, 2.0]);
//! plot.line(&[[0.0, 0.0], [0.5, 1.0]], "record", report::palette::BLUE);
//! assert!(plot.svg(["u_max / u_ins", "PGA (g)"]).contains("class=\"record\""));
//! ```

use std::fmt::Write;

use crate::escaped;
use crate::frame::Frame;
use crate::palette::Mark;
use crate::plot::Scale;

/// How the plots look on a page or in a file, as CSS.
pub const STYLE: &str = include_str!("many_lines.css");

/// Margins around the plot area \[px\]: left, right, top, bottom.
const MARGINS: [f64; 4] = [58.0, 12.0, 10.0, 44.0];
/// Size of the numbers on the axes \[px\].
const NUMBERS: f64 = 11.0;
/// Radius of a mark \[px\].
const MARK: f64 = 3.3;

/// A plot under construction.
#[derive(Clone, Debug)]
pub struct ManyLines {
    size: [f64; 2],
    x: [f64; 2],
    y: [f64; 2],
    body: String,
}

impl ManyLines {
    /// A plot of a size \[px\] over ranges of x and y.
    pub fn new(size: [f64; 2], x: [f64; 2], y: [f64; 2]) -> Self {
        Self { size, x, y, body: String::new() }
    }

    fn frame<'a>(&self, labels: [&'a str; 2]) -> Frame<'a> {
        Frame {
            size: self.size,
            margins: MARGINS,
            ranges: [self.x, self.y],
            labels,
            scale: Scale::Linear,
            number_size: NUMBERS,
            numbers: None,
        }
    }

    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        self.frame([""; 2]).place((x, y))
    }

    /// Adds a broken line of a class and a colour; the plot area cuts off what lies outside.
    pub fn line(&mut self, points: &[[f64; 2]], class: &str, color: &str) {
        self.named_line(points, class, color, "");
    }

    /// Adds a line that says its name when pointed at.
    pub fn named_line(&mut self, points: &[[f64; 2]], class: &str, color: &str, name: &str) {
        if points.len() < 2 {
            return;
        }
        let mut path = String::new();
        let mut last = String::new();
        for (index, &point) in points.iter().enumerate() {
            let [x, y] = self.place(point);
            let here = format!("{x:.1} {y:.1}");
            if here != last {
                let _ = write!(path, "{}{here}", if index == 0 { "M" } else { "L" });
            }
            last = here;
        }
        let _ = write!(self.body, "<path class=\"{class}\" stroke=\"{color}\" d=\"{path}\"");
        let _ = match name {
            "" => write!(self.body, "/>"),
            _ => write!(self.body, "><title>{}</title></path>", escaped(name)),
        };
    }

    /// Adds points of a class and a colour.
    pub fn points(&mut self, points: &[[f64; 2]], class: &str, color: &str) {
        let mut path = String::new();
        for &point in points {
            let [x, y] = self.place(point);
            let _ = write!(path, "M{x:.1} {y:.1}h0");
        }
        let _ = write!(self.body, "<path class=\"{class}\" stroke=\"{color}\" d=\"{path}\"/>");
    }

    /// Adds a mark at each point.
    pub fn marks(&mut self, points: &[[f64; 2]], mark: Mark, color: &str) {
        let shape = mark.outline(MARK);
        let mut path = String::new();
        for &point in points {
            let [x, y] = self.place(point);
            let _ = write!(path, "M{x:.1} {y:.1}{shape}");
        }
        let _ = write!(self.body, "<path class=\"mark\" stroke=\"{color}\" fill=\"{color}\" d=\"{path}\"/>");
    }

    /// Draws the plot with its axes and their labels.
    pub fn svg(self, labels: [&str; 2]) -> String {
        let [width, height] = self.size;
        let [x_label, y_label] = labels.map(escaped);
        let inside = format!("<g fill=\"none\">{}</g>", self.body);
        format!(
            "<svg class=\"lines\" viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" \
             aria-label=\"{y_label} over {x_label}\">{}</svg>",
            self.frame(labels).around(&inside)
        )
    }
}
