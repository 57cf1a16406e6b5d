//! Plots of thousands of lines and points as SVG of few bytes: [`STYLE`] has the classes of their paths.
//!
//! ```
//! let mut plot = report::many_lines::ManyLines::new([300.0, 250.0], [0.0, 1.0], [0.0, 2.0]);
//! plot.line(&[[0.0, 0.0], [0.5, 1.0]], "record", report::palette::BLUE);
//! assert!(plot.svg("c0", ["u_max / u_ins", "PGA (g)"]).contains("class=\"record\""));
//! ```

use std::fmt::Write;

use crate::axes::{ticks, write_text, write_upwards};
use crate::escaped;
use crate::palette::Mark;

/// How the plots look on a page or in a file, as CSS.
pub const STYLE: &str = include_str!("many_lines.css");

/// Margins around the plot area \[px\]: left, right, top, bottom.
const MARGINS: [f64; 4] = [48.0, 12.0, 10.0, 42.0];
/// Radius of a mark \[px\].
const MARK: f64 = 3.3;
/// Ticks on an axis, about.
const TICKS: f64 = 5.0;

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

    /// Corners of the plot area: left, right, top, bottom \[px\].
    fn area(&self) -> [f64; 4] {
        let [left, right, top, bottom] = MARGINS;
        [left, self.size[0] - right, top, self.size[1] - bottom]
    }

    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, right, top, bottom] = self.area();
        let part = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        [left + (right - left) * part(x, self.x), bottom - (bottom - top) * part(y, self.y)]
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

    /// Draws the plot with its axes and their labels; `id` is unique on the page.
    pub fn svg(self, id: &str, [x_label, y_label]: [&str; 2]) -> String {
        let [width, height] = self.size;
        let [left, right, top, bottom] = self.area();
        let mut svg = format!(
            "<svg class=\"lines\" viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" \
             aria-label=\"{} over {}\">\
             <clipPath id=\"{id}\">\
             <rect x=\"{left}\" y=\"{top}\" width=\"{:.0}\" height=\"{:.0}\"/></clipPath>",
            escaped(y_label),
            escaped(x_label),
            right - left,
            bottom - top
        );
        for (tick, text) in ticks(self.x, TICKS) {
            let [x, _] = self.place([tick, self.y[0]]);
            let _ = write!(svg, "<path class=\"grid\" d=\"M{x:.1} {top}V{bottom}\"/>");
            write_text(&mut svg, [x, bottom + 14.0], "middle", &text);
        }
        for (tick, text) in ticks(self.y, TICKS) {
            let [_, y] = self.place([self.x[0], tick]);
            let _ = write!(svg, "<path class=\"grid\" d=\"M{left} {y:.1}H{right}\"/>");
            write_text(&mut svg, [left - 5.0, y + 4.0], "end", &text);
        }
        let _ = write!(
            svg,
            "<g clip-path=\"url(#{id})\" fill=\"none\">{}</g>\
             <path class=\"axis\" d=\"M{left} {top}V{bottom}H{right}\"/>\
             <g class=\"label\">",
            self.body
        );
        write_text(&mut svg, [0.5 * (left + right), height - 8.0], "middle", &escaped(x_label));
        write_upwards(&mut svg, [12.0, 0.5 * (top + bottom)], &escaped(y_label));
        svg + "</g></svg>"
    }
}
