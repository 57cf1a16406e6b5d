//! Lines, arrows, dimensions and labels on a drawing, in pixels.

use std::fmt::Write;

use report::escaped;

use super::words::Words;

/// Distance of the lines of labels \[px\].
pub(super) const LINE: f64 = 17.0;
/// Size of the letters \[px\].
pub(super) const LETTERS: f64 = 13.0;

pub(super) const INK: &str = "stroke=\"#777\"";
pub(super) const FORCE: &str = "#c8440f";
pub(super) const HINGE: &str = "#1f5fa8";
pub(super) const TIE: &str = "stroke=\"#009e73\" stroke-width=\"2.5\"";
pub(super) const OPENING: &str = "fill=\"none\" stroke=\"#333\" stroke-dasharray=\"4 3\"";
pub(super) const STONE: &str = "fill=\"#e4e1dc\" stroke=\"#777\"";

/// Where a text begins, ends or has its middle.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// What has been drawn, and the words of labels.
pub(super) struct Canvas {
    pub(super) svg: String,
    pub(super) words: Words,
}

impl Canvas {
    pub(super) fn line(&mut self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2], look: &str) {
        let _ = writeln!(self.svg, "<path d=\"M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}\" fill=\"none\" {look}/>");
    }

    pub(super) fn rect(&mut self, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2], look: &str) {
        self.polygon(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], look);
    }

    pub(super) fn polygon(&mut self, corners: &[[f64; 2]], look: &str) {
        let points: Vec<_> = corners.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let _ = writeln!(self.svg, "<polygon points=\"{}\" {look}/>", points.join(" "));
    }

    pub(super) fn circle(&mut self, [x, y]: [f64; 2], radius: f64, look: &str) {
        let _ = writeln!(self.svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" {look}/>");
    }

    pub(super) fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        // a white edge keeps it apart from lines behind it
        let edge = "stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"";
        let place = format!("x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\"");
        let _ = writeln!(self.svg, "<text {place} {edge}>{}</text>", self.written(text));
    }

    /// A text as markup, its numbers as the words have them.
    fn written(&self, text: &str) -> String {
        escaped(&if self.words.has_commas { with_commas(text) } else { text.to_owned() })
    }

    /// An arrow whose tip is at a place, from `[dx, dy]` away, along an axis.
    pub(super) fn arrow(&mut self, kind: &str, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) {
        let length = dx.hypot(dy);
        let along = [dx / length, dy / length];
        let back = |by: f64, across: f64| {
            [x + by * along[0] - across * along[1], y + by * along[1] + across * along[0]]
        };
        let ([x0, y0], [x1, y1]) = (back(length, 0.0), back(6.0, 0.0));
        let ([x2, y2], [x3, y3]) = (back(9.0, 4.5), back(9.0, -4.5));
        let _ = writeln!(
            self.svg,
            "<path data-drawn=\"{kind}\" d=\"M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}M{x:.1} {y:.1}L{x2:.1} {y2:.1}\
             L{x3:.1} {y3:.1}z\" stroke=\"{FORCE}\" stroke-width=\"1.8\" fill=\"{FORCE}\" \
             stroke-linejoin=\"round\"/>"
        );
    }

    /// A horizontal dimension with its text in the middle below it, or beside one that is short.
    pub(super) fn across(&mut self, [x0, x1]: [f64; 2], y: f64, text: &str) {
        self.line([x0, y], [x1, y], INK);
        self.strokes([[x0, y], [x1, y]]);
        if x1 - x0 > 7.0 * text.len() as f64 {
            self.text([0.5 * (x0 + x1), y + 16.0], Anchor::Middle, text);
        } else {
            self.text([x1 + 9.0, y + 5.0], Anchor::Start, text);
        }
    }

    /// A vertical dimension with its text along it.
    pub(super) fn upwards(&mut self, x: f64, [y0, y1]: [f64; 2], text: &str) {
        self.line([x, y0], [x, y1], INK);
        self.strokes([[x, y0], [x, y1]]);
        let place = format!("translate({:.1} {:.1}) rotate(-90)", x + 15.0, 0.5 * (y0 + y1));
        let text = self.written(text);
        let _ = writeln!(self.svg, "<text transform=\"{place}\" text-anchor=\"middle\">{text}</text>");
    }

    fn strokes(&mut self, ends: [[f64; 2]; 2]) {
        for [x, y] in ends {
            self.line([x - 4.0, y + 4.0], [x + 4.0, y - 4.0], INK);
        }
    }

    /// Writes labels one below the other at x, each as near to its place as the others and `room` let it; a
    /// thin line leads from its place to one that has moved or is far.
    pub(super) fn labels(&mut self, labels: Vec<Label>, x: f64, anchor: Anchor, room: [f64; 2]) {
        let gap = if matches!(anchor, Anchor::End) { 4.0 } else { -4.0 };
        for (Label { from, text }, y) in spread(labels, room) {
            if (y - from[1]).abs() > 1.0 || (x - from[0]).abs() > 20.0 {
                self.line(from, [x + gap, y], "stroke=\"#999\" stroke-dasharray=\"1 2\"");
            }
            self.text([x, y + 0.35 * LETTERS], anchor, &text);
        }
    }
}

/// A text beside a place.
pub(super) struct Label {
    pub(super) from: [f64; 2],
    pub(super) text: String,
}

/// Moves labels up or down so that none lies on another, and returns each with its y.
fn spread(mut labels: Vec<Label>, [top, bottom]: [f64; 2]) -> Vec<(Label, f64)> {
    labels.sort_by(|a, b| a.from[1].total_cmp(&b.from[1]));
    let mut places: Vec<f64> = labels.iter().map(|label| label.from[1].clamp(top, bottom)).collect();
    for index in 1..places.len() {
        places[index] = places[index].max(places[index - 1] + LINE);
    }
    // what has come too low pushes the others up
    let mut most = bottom;
    for place in places.iter_mut().rev() {
        *place = place.min(most);
        most = *place - LINE;
    }
    labels.into_iter().zip(places).collect()
}

/// Returns a text with commas in place of the points of its numbers.
fn with_commas(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let is_digit = |at: Option<usize>| at.and_then(|at| letters.get(at)).is_some_and(char::is_ascii_digit);
    let of_number = |at: usize| is_digit(at.checked_sub(1)) && is_digit(Some(at + 1));
    letters
        .iter()
        .enumerate()
        .map(|(at, own)| if *own == '.' && of_number(at) { ',' } else { *own })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{LINE, Label, spread};

    #[test]
    fn labels_keep_apart_and_within_their_room() {
        let wanted = [50.0, 51.0, 52.0, 99.0, 100.0];
        let labels = wanted.map(|y| Label { from: [0.0, y], text: String::new() });
        let places: Vec<f64> = spread(labels.into(), [0.0, 100.0]).into_iter().map(|label| label.1).collect();
        assert!(places.windows(2).all(|pair| pair[1] - pair[0] >= LINE - 1e-9), "{places:?}");
        assert!(places[0] >= 0.0 && *places.last().unwrap() <= 100.0, "{places:?}");
    }
}
