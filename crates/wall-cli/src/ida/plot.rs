//! Line plots as small inline SVG.

use std::fmt::Write;

use crate::figure::escaped;
use crate::heat_map::round_step;

/// Margins around the plot area \[px\]: left, right, top, bottom.
const MARGINS: [f64; 4] = [48.0, 12.0, 10.0, 42.0];
/// Ticks on an axis, about.
const TICKS: f64 = 5.0;

/// A plot under construction.
pub(super) struct Plot {
    size: [f64; 2],
    x: [f64; 2],
    y: [f64; 2],
    body: String,
}

impl Plot {
    /// A plot of a size \[px\] over ranges of x and y.
    pub(super) fn new(size: [f64; 2], x: [f64; 2], y: [f64; 2]) -> Self {
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

    /// A broken line; what lies outside is cut off by the plot area.
    pub(super) fn line(&mut self, points: &[[f64; 2]], class: &str, color: &str) {
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
        let _ = write!(self.body, "<path class=\"{class}\" stroke=\"{color}\" d=\"{path}\"/>");
    }

    /// The plot with its axes, their labels in HTML-free text; `id` is unlike any other of the page.
    pub(super) fn finish(self, id: &str, [x_label, y_label]: [&str; 2]) -> String {
        let [width, height] = self.size;
        let [left, right, top, bottom] = self.area();
        let mut svg = format!(
            "<svg viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" aria-label=\"{} over {}\"><clipPath id=\"{id}\">\
             <rect x=\"{left}\" y=\"{top}\" width=\"{:.0}\" height=\"{:.0}\"/></clipPath>",
            escaped(y_label),
            escaped(x_label),
            right - left,
            bottom - top
        );
        for tick in ticks(self.x) {
            let [x, _] = self.place([tick, self.y[0]]);
            let _ = write!(
                svg,
                "<path class=\"grid\" d=\"M{x:.1} {top}V{bottom}\"/><text x=\"{x:.1}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>",
                bottom + 14.0,
                number(tick)
            );
        }
        for tick in ticks(self.y) {
            let [_, y] = self.place([self.x[0], tick]);
            let _ = write!(
                svg,
                "<path class=\"grid\" d=\"M{left} {y:.1}H{right}\"/><text x=\"{:.0}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                left - 5.0,
                y + 4.0,
                number(tick)
            );
        }
        let (middle_x, middle_y) = (0.5 * (left + right), 0.5 * (top + bottom));
        let _ = write!(
            svg,
            "<g clip-path=\"url(#{id})\">{}</g><path class=\"axis\" d=\"M{left} {top}V{bottom}H{right}\"/>\
             <text class=\"label\" x=\"{middle_x:.0}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>\
             <text class=\"label\" x=\"12\" y=\"{middle_y:.0}\" text-anchor=\"middle\" transform=\"rotate(-90 12 {middle_y:.0})\">{}</text></svg>",
            self.body,
            height - 8.0,
            escaped(x_label),
            escaped(y_label)
        );
        svg
    }
}

/// Round numbers within a range.
fn ticks([low, high]: [f64; 2]) -> Vec<f64> {
    let step = round_step((high - low) / TICKS);
    let first = (low / step - 1e-9).ceil();
    // at most one more than twice the ticks aimed at
    (0..=10).map(|k| (first + f64::from(k)) * step).take_while(|tick| *tick <= high + 1e-9 * step).collect()
}

/// A tick's number without the digits of its rounding.
fn number(tick: f64) -> String {
    let text = format!("{tick:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
