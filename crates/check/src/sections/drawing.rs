//! The wall to scale with its hinges, loads and tie.

use std::fmt::Write;

use rocking_wall::variables::{EccentricityMode, Mechanism};
use rocking_wall::wall::{Parameters, Tie, Wall};
use run::drawing::{View, Words};

use crate::words::{Language, Sentence, at_most, say, shown};

/// Width and height of the drawing, axis of the wall and its foot \[px\].
const SIZE: [f64; 2] = [640.0, 410.0];
const AXIS: f64 = 235.0;
const FOOT: f64 = 335.0;
/// Room for the wall: width and height \[px\].
const ROOM: [f64; 2] = [110.0, 265.0];
/// Half the width of supports, and places of dimensions \[px\].
const SUPPORT: f64 = 95.0;
const OUTER: f64 = 545.0;
const INNER: f64 = 445.0;
/// Lengths of the bar that shows the scale \[m\].
const BARS: [f64; 7] = [10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1];

const BRICK: &str = "fill=\"#ecd9c9\" stroke=\"#6b4a33\"";
const STONE: &str = "fill=\"#e4e1dc\" stroke=\"#777\"";

/// The wall in pixels.
struct Drawing<'a> {
    of: &'a Wall,
    parameters: &'a Parameters,
    /// px for a metre.
    scale: f64,
    language: Language,
    svg: String,
}

/// The figure, with what its marks mean. `view` is that of a body of parts. A body above a `level` \[m\] of
/// another one that is drawn says that its heights count from there.
pub(crate) fn figure(
    of: &Wall,
    parameters: &Parameters,
    view: View,
    level: Option<f64>,
    language: Language,
) -> String {
    let body = of.body();
    let said = match level {
        _ if view == View::Front => vec![say!("The front.", "Il prospetto.")],
        Some(z) => vec![say!("Heights count from {z} m.", "Quote a partire da {z} m.", z)],
        None => marks(of, parameters),
    };
    let said: Vec<_> = said.iter().map(|said| said.markup(language)).collect();
    let said = said.join(" ");
    if !body.is_rectangle {
        return of_body(of, parameters, &said, view, language);
    }
    let thickness = parameters.thickness;
    let scale = (ROOM[0] / thickness).min(ROOM[1] / body.height);
    let mut drawing = Drawing { of, parameters, scale, language, svg: String::new() };
    drawing.supports();
    drawing.wall();
    drawing.hinges();
    drawing.loads();
    drawing.ties();
    drawing.dimensions();
    let [width, height] = SIZE;
    // without an overburden nothing stands above the wall
    let from = if body.overburden > 0.0 { 0.0 } else { drawing.top() - 20.0 };
    let height = height - from;
    let label = say!("the wall to scale", "la parete in scala");
    let label = label.of(language);
    format!(
        "<figure><figcaption>{said}</figcaption><svg class=\"wall\" \
         viewBox=\"0 {from:.0} {width} {height:.0}\" role=\"img\" aria-label=\"{label}\" \
         font-size=\"15\" font-family=\"system-ui, sans-serif\" fill=\"#1c1c1c\">\n{}</svg></figure>\n",
        drawing.svg
    )
}

/// The figure of a body: its section with loads, thrusts and ties, and its front.
fn of_body(of: &Wall, parameters: &Parameters, said: &str, view: View, language: Language) -> String {
    let words = match language {
        Language::En => Words::EN,
        Language::It => Words::IT,
    };
    let svg = run::drawing::without_legend(of, parameters, words, view);
    let label = say!("the wall to scale", "la parete in scala");
    let svg =
        svg.replace("aria-label=\"the wall to scale\"", &format!("aria-label=\"{}\"", label.of(language)));
    format!("<figure><figcaption>{said}</figcaption>{svg}</figure>\n")
}

/// What the marks of a drawing mean.
fn marks(of: &Wall, parameters: &Parameters) -> Vec<Sentence> {
    let follows = parameters.eccentricity_mode == EccentricityMode::FollowsPivot;
    let is_set_back = parameters.a3 < 1.0 && parameters.multilinear.is_none();
    let all = [
        (true, say!("The wall to scale.", "La parete in scala.")),
        (of.sides().any(|sign| sign > 0.0), say!("● Hinges for u > 0.", "● Cerniere per u > 0.")),
        (of.sides().any(|sign| sign < 0.0), say!("○ Hinges for u < 0.", "○ Cerniere per u < 0.")),
        (
            of.free_side().is_some(),
            say! {
                "Grey beside the wall: transverse walls.",
                "In grigio accanto alla parete: pareti trasversali."
            },
        ),
        (
            follows && parameters.overburden_eccentricity != 0.0,
            say! {
                "The overburden follows the hinge: it is drawn for u > 0.",
                "Il carico segue la cerniera: è disegnato per u > 0."
            },
        ),
        (
            is_set_back,
            say! {
                "Hinges are set back from the edges: `a3` = {a3}.",
                "Le cerniere sono arretrate dagli spigoli: `a3` = {a3}.", a3 = at_most(parameters.a3, 6)
            },
        ),
        (
            !of.body().is_rectangle,
            say! {
                "Arrows: loads and thrusts. ⊙ Centroid of the masonry.",
                "Frecce: carichi e spinte. ⊙ Baricentro della muratura."
            },
        ),
    ];
    all.into_iter().filter_map(|(is_there, said)| is_there.then_some(said)).collect()
}

impl Drawing<'_> {
    /// A number and its unit in the language of the drawing.
    fn said(&self, text: &str) -> String {
        self.language.decimal(text)
    }

    /// Half the thickness \[px\].
    fn half(&self) -> f64 {
        0.5 * self.scale * self.parameters.thickness
    }

    /// The place of a height above the base \[px\].
    fn y(&self, height: f64) -> f64 {
        FOOT - self.scale * height
    }

    fn top(&self) -> f64 {
        self.y(self.of.body().height)
    }

    /// The height of the hinge in the wall; `None` for a parapet.
    fn hinge(&self) -> Option<f64> {
        let body = self.of.body();
        (body.mechanism == Mechanism::VerticalSpanning).then_some(body.hinge_height)
    }

    fn rect(&mut self, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2], look: &str) {
        let (width, height) = (x1 - x0, y1 - y0);
        let place = format!("x=\"{x0:.1}\" y=\"{y0:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"");
        let _ = writeln!(self.svg, "<rect {place} {look}/>");
    }

    fn line(&mut self, from: [f64; 2], to: [f64; 2], look: &str) {
        let ([x0, y0], [x1, y1]) = (from, to);
        let _ = writeln!(self.svg, "<path d=\"M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}\" fill=\"none\" {look}/>");
    }

    fn text(&mut self, [x, y]: [f64; 2], anchor: &str, text: &str) {
        // a white edge keeps it apart from lines behind it
        let edge = "stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"";
        let place = format!("x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\"");
        let _ = writeln!(self.svg, "<text {place} {edge}>{text}</text>");
    }

    /// An arrow that points down to a place.
    fn weight(&mut self, [x, y]: [f64; 2], length: f64) {
        self.line([x, y - length], [x, y - 6.0], "stroke=\"#c8440f\" stroke-width=\"2\"");
        let _ = writeln!(self.svg, "<path d=\"M{x:.1} {y:.1}l-4.5 -9h9z\" fill=\"#c8440f\"/>");
    }

    fn supports(&mut self) {
        self.rect([AXIS - SUPPORT, AXIS + SUPPORT], [FOOT, FOOT + 10.0], STONE);
        let (half, top) = (self.half(), self.top());
        if self.hinge().is_some() {
            self.rect([AXIS - SUPPORT, AXIS + SUPPORT], [top - 10.0, top], STONE);
        }
        match self.of.free_side() {
            Some(side) if side > 0.0 => self.rect([AXIS - SUPPORT, AXIS - half], [top, FOOT], STONE),
            Some(_) => self.rect([AXIS + half, AXIS + SUPPORT], [top, FOOT], STONE),
            None => {}
        }
    }

    fn wall(&mut self) {
        let (half, top) = (self.half(), self.top());
        self.rect([AXIS - half, AXIS + half], [top, FOOT], BRICK);
        if let Some(hinge) = self.hinge() {
            let y = self.y(hinge);
            self.line([AXIS - half, y], [AXIS + half, y], "stroke=\"#6b4a33\"");
        }
    }

    /// Both bodies of a strip turn about the edge towards u at their outer ends, and about the other in the
    /// middle.
    fn hinges(&mut self) {
        let (half, top) = (self.half(), self.top());
        let signs: Vec<f64> = self.of.sides().collect();
        for sign in signs {
            let towards = AXIS + half.copysign(sign);
            let mut places = vec![[towards, FOOT]];
            if let Some(hinge) = self.hinge() {
                places.extend([[AXIS - half.copysign(sign), self.y(hinge)], [towards, top]]);
            }
            let fill = if sign > 0.0 { "#1f5fa8" } else { "#fff" };
            for [x, y] in places {
                let look = format!("r=\"5\" fill=\"{fill}\" stroke=\"#1f5fa8\" stroke-width=\"2\"");
                let _ = writeln!(self.svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" {look}/>");
            }
        }
    }

    fn loads(&mut self) {
        let body = self.of.body();
        let (weight, height, overburden) = (body.weight, body.height, body.overburden);
        let half = self.half();
        let parts = match self.hinge() {
            None => vec![(0.0, height, "W")],
            Some(hinge) => vec![(0.0, hinge, "W₁"), (hinge, height, "W₂")],
        };
        for (from, to, name) in parts {
            let y = self.y(0.5 * (from + to));
            let _ = writeln!(self.svg, "<circle cx=\"{AXIS}\" cy=\"{y:.1}\" r=\"3\" fill=\"#c8440f\"/>");
            self.weight([AXIS, y + 34.0], 34.0);
            let force = 1e-3 * weight * (to - from) / height;
            let text = self.said(&format!("{name} = {} kN", ::report::number(force, 4)));
            // on the side without transverse walls
            if self.of.free_side().is_some_and(|side| side > 0.0) {
                self.text([AXIS + half + 10.0, y + 22.0], "start", &text);
            } else {
                self.text([AXIS - half - 10.0, y + 22.0], "end", &text);
            }
        }
        if overburden > 0.0 {
            let c = self.parameters.overburden_eccentricity;
            let (x, top) = (AXIS + self.scale * c, self.top());
            let top = if self.hinge().is_some() { top - 10.0 } else { top };
            self.weight([x, top], 36.0);
            let mut text = format!("O = {} kN", ::report::number(1e-3 * overburden, 4));
            if c != 0.0 {
                let _ = write!(text, ", c = {} m", ::report::number(c, 6));
            }
            self.text([x + 10.0, top - 20.0], "start", &self.said(&text));
        }
    }

    fn ties(&mut self) {
        let of = self.of;
        of.ties().iter().for_each(|tie| self.tie(tie));
    }

    fn tie(&mut self, tie: &Tie) {
        let y = self.y(tie.height);
        let half = self.half();
        for sign in [1.0, -1.0] {
            if tie.holds(sign) {
                // through the wall, with a plate on the face that would move away
                let (face, far) = (AXIS + half.copysign(sign), AXIS - 130.0_f64.copysign(sign));
                let look = "stroke=\"#009e73\" stroke-width=\"2.5\"";
                self.line([face, y], [far, y], look);
                let plate = face + 2.0_f64.copysign(sign);
                self.line([plate, y - 9.0], [plate, y + 9.0], look);
            }
        }
        let mut texts = vec![format!("K = {} kN/m", shown(1e-3 * tie.stiffness))];
        texts.extend(tie.strength.map(|strength| format!("N_y = {} kN", shown(1e-3 * strength))));
        if tie.slack > 0.0 {
            texts.push(format!("g₀ = {} mm", shown(1e3 * tie.slack)));
        }
        // clear of the wall and of what stands beside it
        let (x, anchor) =
            if tie.holds(1.0) { (AXIS - SUPPORT - 10.0, "end") } else { (AXIS + half + 8.0, "start") };
        for (index, text) in texts.iter().enumerate() {
            let text = ::report::label(&self.said(text));
            // one line above the tie, the others below it
            let y = if index == 0 { y - 8.0 } else { y + 3.0 + 17.0 * index as f64 };
            self.text([x + 4.0, y], anchor, &text);
        }
    }

    /// The line of a dimension, with a stroke across each end.
    fn dimension(&mut self, from: [f64; 2], to: [f64; 2]) {
        let look = "stroke=\"#777\"";
        self.line(from, to, look);
        for [x, y] in [from, to] {
            self.line([x - 5.0, y + 5.0], [x + 5.0, y - 5.0], look);
        }
    }

    /// A vertical dimension from the base to a height.
    fn height(&mut self, x: f64, height: f64, name: &str) {
        let y = self.y(height);
        self.dimension([x, FOOT], [x, y]);
        // one that is searched has all its digits
        let text = self.said(&format!("{name} = {} m", shown(height)));
        self.text([x + 7.0, 0.5 * (FOOT + y) + 5.0], "start", &text);
    }

    fn dimensions(&mut self) {
        let body = self.of.body();
        self.height(OUTER, body.height, "h");
        if let Some(hinge) = self.hinge() {
            self.height(INNER, hinge, "h₁");
        }
        for tie in self.of.ties().iter() {
            self.height(INNER, tie.height, "y");
        }
        let (half, y) = (self.half(), FOOT + 24.0);
        self.dimension([AXIS - half, y], [AXIS + half, y]);
        let text = format!("b = {} m", self.language.stated(self.parameters.thickness));
        self.text([AXIS + half + 12.0, y + 5.0], "start", &text);
        let bar = BARS.into_iter().find(|bar| self.scale * bar <= 110.0).unwrap_or(0.1);
        let y = SIZE[1] - 12.0;
        self.rect([12.0, 12.0 + self.scale * bar], [y - 5.0, y], "fill=\"#555\"");
        self.text([18.0 + self.scale * bar, y + 1.0], "start", &format!("{} m", self.language.stated(bar)));
        let y = y - 3.0;
        self.line([AXIS, y], [AXIS + 44.0, y], "stroke=\"#1f5fa8\" stroke-width=\"2\"");
        let _ = writeln!(self.svg, "<path d=\"M{:.1} {y:.1}l-9 -4.5v9z\" fill=\"#1f5fa8\"/>", AXIS + 50.0);
        self.text(
            [AXIS + 58.0, y + 5.0],
            "start",
            say!("u &gt; 0: outwards", "u &gt; 0: verso l'esterno").of(self.language),
        );
        // the sides of the wall, below its foot
        let sides = [say!("inside", "interno"), say!("outside", "esterno")];
        for (x, side) in [AXIS - SUPPORT, AXIS + SUPPORT].into_iter().zip(sides) {
            self.text([x, FOOT + 44.0], "middle", side.of(self.language));
        }
    }
}
