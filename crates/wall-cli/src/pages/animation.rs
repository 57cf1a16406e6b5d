//! Animated SVG without a script: what the pictures of a wall and of a building share.

use std::fmt::Write;

use figures::escaped;
use figures::palette::{DARK_GREY, RED};
use figures::response::cut;

/// Width and height of a picture \[px\].
pub(crate) const SIZE: [f64; 2] = [640.0, 300.0];
/// Level of the ground \[px\].
pub(crate) const GROUND: f64 = 262.0;
/// The history: left, right, top, bottom \[px\].
const PLOT: [f64; 4] = [258.0, 626.0, 62.0, 262.0];
/// Most frames of an animation.
pub(crate) const MOST_FRAMES: usize = 400;
/// Least end of the axis of u/`u_ins`; a tie may hold a wall far beyond 1.
const EDGE: f64 = 1.25;

/// Part of a wall: from a height, of a length \[m\].
pub(crate) type Part = [f64; 2];

/// A wall in the picture: where it stands \[px\], pixels per metre, height, thickness and, for a strip,
/// height of the hinge \[m\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) foot: [f64; 2],
    pub(crate) px: f64,
    pub(crate) height: f64,
    pub(crate) thickness: f64,
    pub(crate) hinge: Option<f64>,
}

/// Draws a picture: title, verdict, what stands on the left, and histories on the right.
pub(crate) fn picture(title: &str, verdict: (&str, &str), parts: &str) -> String {
    let ([width, height], title, (said, colour)) = (SIZE, escaped(title), verdict);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"system-ui, sans-serif\" role=\"img\" aria-label=\"{title}\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n\
         <text x=\"14\" y=\"26\" font-size=\"15\" font-weight=\"600\" fill=\"#1c1c1c\">{title}</text>\n\
         <text x=\"14\" y=\"46\" font-size=\"13\" fill=\"{colour}\">{}</text>\n{parts}</svg>\n",
        escaped(said)
    )
}

/// An animation of a transform through values evenly spaced in time.
pub(crate) fn animated(kind: &str, values: impl Iterator<Item = String>, period: &str) -> String {
    let values = values.collect::<Vec<_>>().join(";");
    format!(
        "<animateTransform attributeName=\"transform\" type=\"{kind}\" dur=\"{period}\" \
         repeatCount=\"indefinite\" values=\"{values}\"/>"
    )
}

impl Shape {
    fn body(&self, [from, length]: Part, animation: &str) -> String {
        let Self { foot: [axis, ground], px, thickness, .. } = *self;
        let [x, width, height] = [axis - px * thickness / 2.0, px * thickness, px * length];
        let y = ground - px * from - height;
        format!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\">{animation}</rect>"
        )
    }

    /// Draws the wall through its displacements u and, for a strip, drifts of its top \[m\]. Each body turns
    /// about the corner that the motion is towards.
    pub(crate) fn rocking(&self, motion: &[[f64; 2]], period: &str) -> String {
        let Self { foot: [axis, ground], px, height: h, thickness: b, hinge } = *self;
        let angle = |sine: f64| sine.clamp(-1.0, 1.0).asin();
        let toe = |u: f64| u.signum() * b / 2.0;
        let turn = |[u, d]: [f64; 2]| hinge.map_or(angle(2.0 * u / h), |h1| angle((u + d * h1 / h) / h1));
        let lower = motion
            .iter()
            .map(|&at| format!("{:.2} {:.1} {ground:.1}", turn(at).to_degrees(), axis + px * toe(at[0])));
        let first = self.body([0.0, hinge.unwrap_or(h)], &animated("rotate", lower, period));
        let Some(h1) = hinge else { return first };
        // the corner of the lower body that carries the upper one moves; the upper one turns back about it
        let moved = motion.iter().map(|&at| {
            let (turn, toe) = (turn(at), toe(at[0]));
            let x = 2.0 * toe * (1.0 - turn.cos()) + h1 * turn.sin();
            let y = 2.0 * toe * turn.sin() + h1 * (turn.cos() - 1.0);
            format!("{:.2} {:.2}", px * x, -px * y)
        });
        let back = motion.iter().map(|&[u, d]| {
            let (turn, toe) = (angle((u - d * (h - h1) / h) / (h - h1)), toe(u));
            format!("{:.2} {:.1} {:.1}", -turn.to_degrees(), axis - px * toe, ground - px * h1)
        });
        let body = self.body([h1, h - h1], &animated("rotate", back, period));
        format!("{first}<g>{}{body}</g>", animated("translate", moved, period))
    }
}

/// u/`u_ins` of a wall over time, its colour, and its name among several.
pub(crate) type Line<'a> = (Vec<(f64, f64)>, &'a str, String);

/// Draws u/`u_ins` of walls over time with a cursor.
pub(crate) fn history(lines: &[Line<'_>], span: [f64; 2], period: &str) -> String {
    let [left, right, top, bottom] = PLOT;
    let x = |time: f64| left + (right - left) * (time - span[0]) / (span[1] - span[0]);
    let lines: Vec<_> =
        lines.iter().map(|(points, colour, name)| (cut(points.clone()), colour, name)).collect();
    let ratios = lines.iter().flat_map(|(points, ..)| points.iter().map(|point| point.1.abs()));
    let edge = ratios.fold(EDGE, f64::max);
    let y = |ratio: f64| 0.5 * (top + bottom) - 0.5 * (bottom - top) * ratio / edge;
    let mut svg = format!(
        "<g font-size=\"11\" fill=\"{DARK_GREY}\"><path d=\"M{left} {top}V{bottom}H{right}\" fill=\"none\" \
         stroke=\"{DARK_GREY}\"/>"
    );
    for ratio in [-1.0, 0.0, 1.0] {
        let (dash, colour) = if ratio == 0.0 { ("", "#d9d9d9") } else { ("5 4", RED) };
        // writing to a String cannot fail
        let _ = write!(
            svg,
            "<path d=\"M{left} {y:.1}H{right}\" stroke=\"{colour}\" stroke-dasharray=\"{dash}\"/>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{ratio}</text>",
            left - 5.0,
            y(ratio) + 4.0,
            y = y(ratio)
        );
    }
    let low = bottom + 16.0;
    let _ = writeln!(
        svg,
        "<text x=\"{right}\" y=\"{}\" text-anchor=\"end\">u / u_ins</text>\
         <text x=\"{left}\" y=\"{low}\">{:.1} s</text>\
         <text x=\"{right}\" y=\"{low}\" text-anchor=\"end\">{:.1} s</text></g>",
        top - 8.0,
        span[0],
        span[1]
    );
    for (points, colour, _) in &lines {
        let shown: Vec<_> =
            points.iter().map(|(time, ratio)| format!("{:.1},{:.1}", x(*time), y(*ratio))).collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\"/>",
            shown.join(" ")
        );
    }
    let names = lines
        .iter()
        .map(|(_, colour, name)| format!("<tspan dx=\"8\" fill=\"{colour}\">{}</tspan>", escaped(name)));
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{low}\" font-size=\"12\" text-anchor=\"middle\">{}</text>",
        0.5 * (left + right),
        names.collect::<String>()
    );
    let cursor = [0.0, right - left].map(|x| format!("{x} 0"));
    let cursor = animated("translate", cursor.into_iter(), period);
    let _ = writeln!(svg, "<path d=\"M{left} {top}V{bottom}\" stroke=\"#1c1c1c\">{cursor}</path>");
    svg
}
