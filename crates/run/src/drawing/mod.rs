//! A wall to scale: its section with hinges, loads, thrusts and ties, and its front where that shows more.
//!
//! ```
//! use rocking_wall::wall::{Parameters, Wall};
//!
//! let parameters = Parameters::default();
//! let svg = run::drawing::svg(&Wall::new(&parameters)?, &parameters);
//! assert!(svg.starts_with("<svg") && svg.contains("h = 4 m"));
//! # Ok::<(), rocking_wall::wall::ParameterError>(())
//! ```

mod canvas;
mod front;
mod section;
mod shape;
#[cfg(test)]
mod tests;
mod words;

use report::number;
use rocking_wall::variables::EccentricityMode;
use rocking_wall::wall::{Parameters, Wall};

use canvas::{Anchor, Canvas, LETTERS, LINE};
pub use shape::{Hinge, Shape};
pub use words::Words;

/// Width of a drawing \[px\]: a phone shows it as it is.
const WIDTH: f64 = 420.0;
/// Most items of a kind that have a label.
const MOST_LABELS: usize = 10;
/// Lengths of the bar that shows the scale \[m\].
const BARS: [f64; 10] = [50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05];

/// Draws a wall to scale, as SVG for a file and for pages: on white, which pages invert in the dark.
pub fn svg(wall: &Wall, parameters: &Parameters) -> String {
    drawn(wall, parameters, Words::EN, View::Whole, true)
}

/// What a drawing shows of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The section, and below it the front where that shows more.
    Whole,
    /// The section.
    Section,
    /// The front.
    Front,
}

/// Draws a wall to scale as [`svg`] does, or a view of it, with other words and without a legend.
pub fn without_legend(wall: &Wall, parameters: &Parameters, words: Words, view: View) -> String {
    drawn(wall, parameters, words, view, false)
}

fn drawn(wall: &Wall, parameters: &Parameters, words: Words, view: View, has_legend: bool) -> String {
    let shape = Shape::new(wall, parameters);
    let mut canvas = Canvas { svg: String::new(), words };
    let mut height = 0.0;
    if view != View::Front {
        height = section::draw(&mut canvas, &shape, wall, parameters);
    }
    if view == View::Front || view == View::Whole && shape.has_front() {
        height = front::draw(&mut canvas, &shape, height);
    }
    let legend = if has_legend { legend(&shape, wall, parameters) } else { Vec::new() };
    for line in legend {
        height += LINE;
        canvas.text([12.0, height], Anchor::Start, &line);
    }
    height += 10.0;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"wall\" viewBox=\"0 0 {WIDTH} {height:.0}\" \
         style=\"max-width:36rem\" font-size=\"{LETTERS}\" font-family=\"system-ui, sans-serif\" \
         fill=\"#1c1c1c\" role=\"img\" aria-label=\"the wall to scale\">\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}</svg>\n",
        canvas.svg
    )
}

/// Says what the marks mean.
fn legend(shape: &Shape, wall: &Wall, parameters: &Parameters) -> Vec<String> {
    let follows = parameters.eccentricity_mode == EccentricityMode::FollowsPivot
        && parameters.overburden_eccentricity != 0.0;
    let turns = |wanted: f64| wall.sides().any(|sign| sign == wanted);
    let marks = [
        (turns(1.0), "● hinges for u > 0"),
        (turns(-1.0), "○ hinges for u < 0"),
        (true, "⊙ centroid"),
        (!shape.openings.is_empty(), "dashed: openings"),
        (wall.free_side().is_some(), "grey: transverse walls"),
        (follows && shape.overburden.is_some(), "the overburden follows the hinge: as for u > 0"),
        (shape.parts.is_empty(), "its shape is not known, only its integrals"),
    ];
    let text: Vec<_> = marks.iter().filter(|mark| mark.0).map(|mark| mark.1).collect();
    report::wrapped(&text.join("; "), 58)
}

/// A length in metres.
fn metres(length: f64) -> String {
    format!("{} m", number(length, 4))
}

/// A force in kilonewtons.
fn kilonewtons(force: f64) -> String {
    format!("{} kN", number(1e-3 * force, 4))
}

/// Draws a bar of a round length, which shows the scale in pixels for a metre.
fn bar(canvas: &mut Canvas, [x, y]: [f64; 2], scale: f64) {
    let length = BARS.into_iter().find(|bar| scale * bar <= 80.0).unwrap_or(0.02);
    canvas.rect([x, x + scale * length], [y - 5.0, y], "fill=\"#555\"");
    canvas.text([x + 7.0 + scale * length, y + 1.0], Anchor::Start, &metres(length));
}

/// The look of masonry: the denser, the darker.
fn masonry(density: f64) -> String {
    let fill = report::palette::mixed(
        &[[247.0, 236.0, 224.0], [222.0, 190.0, 163.0], [176.0, 160.0, 146.0]],
        (density - 1000.0) / 1800.0,
    );
    format!("data-drawn=\"part\" fill=\"{fill}\" stroke=\"#6b4a33\"")
}
