//! The page of `wall simulate`: the rocking wall, its histories and its force, in one file.

use report::moving::{Moving, factors, frames, page, plot, rounded, verdict};
use report::{escaped, number};
use rocking_wall::variables::Impact;
use rocking_wall::wall::{Parameters, Sides, Wall, usage};
use scene::Scene;
use scene::response::{Fate, Response, Sample};

use crate::counterpart::Counterpart;
use crate::{demands, figure as plots};

/// Seconds that are drawn after a fall.
const AFTER_FALL: f64 = 2.0;
/// Exaggerations of the drawn rotation; the default is the largest that keeps it below this angle (rad).
const FACTORS: [f64; 4] = [1.0, 2.0, 5.0, 10.0];
const LARGEST_DRAWN: f64 = 0.3;
/// Height of the figures on rotations \[px\].
const HEIGHT: f64 = 250.0;

/// Why a run has no page.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// No time passes.
    #[error("the response is empty: there is nothing to draw")]
    Empty,
    /// A number is not finite.
    #[error("the response holds numbers that are not finite: there is nothing to draw")]
    NotFinite,
}

/// Makes the page of a run.
///
/// # Errors
/// [`PageError`] if there is nothing to draw.
pub fn render(scene: &Scene, wall: &Wall, response: &Response) -> Result<String, PageError> {
    let Some(end) = response.samples.last().map(|sample| sample.time).filter(|&end| end > 0.0) else {
        return Err(PageError::Empty);
    };
    if response.samples.iter().any(|sample| !sample.outputs.displacement.is_finite()) {
        return Err(PageError::NotFinite);
    }
    let (overturned, falls) = (response.summary.overturn_time, response.summary.fate.falling());
    // slider and histories end together
    let end = falls.map_or(end, |time| end.min(time + AFTER_FALL));
    let drawn = response.samples.partition_point(|sample| sample.time <= end);
    let chosen: Vec<usize> = frames(drawn).into_iter().collect();
    let frames: Vec<_> = chosen.iter().map(|i| &response.samples[*i]).collect();
    let column = |pick: fn(&Sample) -> f64| rounded(frames.iter().map(|sample| pick(sample)));
    let body = wall.body();
    let (u_ins, hinge) = (body.instability, body.hinge());
    // the top of a parapet, or the rotation of a strip's lower body in %
    let [second, scale] = hinge.map_or([body.height / body.centroid_height, 1000.0], |h1| [1.0 / h1, 100.0]);
    let above = |u: f64| match (wall.rotations(), hinge) {
        // the place above the centroid
        (Some(full), None) => {
            1000.0 * (u + (body.height - body.centroid_height) * libm::sin(full.rotation(u)))
        }
        _ => scale * second * u,
    };
    let moving = bodies::Moving::new(wall, &scene.parameters);
    let data = serde_json::json!({
        "t": column(|sample| sample.time),
        "u": column(|sample| sample.outputs.displacement),
        "second": rounded(frames.iter().map(|sample| above(sample.outputs.displacement))),
        "a": column(|sample| sample.support.bottom),
        "f": column(|sample| sample.outputs.restoring_force),
        "u_ins": [u_ins.positive, u_ins.negative],
        "height": body.height,
        "thickness": moving.base(),
        "shape": moving.data(),
        "ties": tie::data(wall, response, &chosen),
        "hinge": hinge,
        "full": wall.rotations().is_some(),
        "overturned": overturned,
        "open": telling(&frames, falls),
    });
    let subtitle =
        if scene.motion_notes.is_empty() { "free rocking".to_owned() } else { scene.motion_notes.join(", ") };
    let figures = figures(scene, wall, response, end)
        + &rotations(scene, response, end)
        + &demands(wall, response)
        + &section(scene, wall);
    Ok(page(&Moving {
        title: &scene.title,
        subtitle: &subtitle,
        verdict: &said(response),
        name: "the wall",
        style: include_str!("wall.css"),
        picture: &drawing(scene, wall, response),
        choices: &factors("shown", &FACTORS, factor(wall, response)),
        facts: &format!(
            "<p class=\"overturned\" id=\"overturned\"></p>\n<table>{}</table>",
            facts(scene, wall, response)
        ),
        figures: &figures,
        data: &data,
        script: include_str!("wall.js"),
        frames: frames.len(),
    }))
}

/// Finds the frame shown first: that of the largest |u|, or the last one before the wall falls.
fn telling(frames: &[&Sample], falls: Option<f64>) -> usize {
    let standing = frames.iter().take_while(|sample| falls.is_none_or(|time| sample.time < time));
    let ratio = |sample: &Sample| sample.outputs.ratio.abs();
    let peak = standing.enumerate().max_by(|a, b| ratio(a.1).total_cmp(&ratio(b.1)));
    peak.map_or(0, |(frame, _)| frame)
}

/// Describes what becomes of the wall.
fn said(response: &Response) -> String {
    let (ratio, tie) = (100.0 * response.summary.u_ratio_max, tie::said(response));
    match response.summary.fate.words(1) {
        Some(words) => verdict(&format!("The wall {words}.{tie}"), true),
        None => verdict(&format!("The wall stands: {} % of u_ins.{tie}", number(ratio, 3)), false),
    }
}

/// Draws the wall at rest, to scale, y upwards, as `wall.css` styles it; scripts turn its bodies.
pub fn drawing(scene: &Scene, wall: &Wall, response: &Response) -> String {
    let moving = bodies::Moving::new(wall, &scene.parameters);
    let (h, b) = (wall.body().height, moving.breadth());
    let half = if response.summary.overturned { 1.1 * h + b } else { (0.42 * h).max(1.4 * b) };
    let (top, bottom) = (0.12 * h, 0.1 * h);
    let line = 0.004 * h.max(half);
    // the ground goes on beyond the view box, which the window may widen
    let far = 10.0 * half;
    let rect = |class: &str, [x, y]: [f64; 2], [width, height]: [f64; 2]| {
        format!(
            "<rect class=\"{class}\" x=\"{x:.4}\" y=\"{y:.4}\" width=\"{width:.4}\" height=\"{height:.4}\"/>"
        )
    };
    let load = if wall.body().overburden > 0.0 {
        format!(
            "<path class=\"load\" transform=\"translate(0 {h:.4}) scale({line:.4})\" \
             d=\"M0 1l-3 6h2v18h2v-18h2z\"/>"
        )
    } else {
        String::new()
    };
    let body = |id: &str, from: f64, to: f64| {
        if !scene.parameters.is_rectangle() {
            return format!("<g id=\"{id}\">{}</g>", moving.body([from, to], line));
        }
        let load = if to == h { &*load } else { "" };
        format!("<g id=\"{id}\">{}{load}</g>", rect("body", [-b / 2.0, from], [b, to - from]))
    };
    let bodies = match wall.body().hinge() {
        None => body("lower", 0.0, h),
        Some(h1) => {
            let support = rect("support", [-0.6 * half, h], [1.2 * half, 0.05 * h]);
            support + &body("lower", 0.0, h1) + &body("upper", h1, h)
        }
    };
    let transverse = wall.free_side().map_or_else(String::new, |side| {
        let from = if side > 0.0 { -far } else { b / 2.0 };
        rect("support", [from, 0.0], [far - b / 2.0, h])
    });
    format!(
        "<svg viewBox=\"{:.4} {:.4} {:.4} {:.4}\" preserveAspectRatio=\"xMidYMax\" role=\"img\" \
         aria-label=\"the wall to scale\"><g transform=\"scale(1 -1)\" stroke-width=\"{line:.4}\">{ground}\
         <path d=\"M0 0V{:.4}\" stroke=\"#999\" stroke-dasharray=\"{:.3}\"/>{transverse}{ties}{bodies}\
         </g></svg>",
        -half,
        -(h + top),
        2.0 * half,
        h + top + bottom,
        h + 0.6 * top,
        0.02 * h,
        ties = tie::lines(wall, half, 2.0 * line),
        ground = rect("support", [-far, -far], [2.0 * far, far])
    )
}

/// The largest exaggeration of the drawn rotation that keeps it below its limit.
pub fn factor(wall: &Wall, response: &Response) -> f64 {
    let arm = wall.body().hinge().map_or(wall.body().centroid_height, |h1| h1.min(wall.body().height - h1));
    let largest = response.summary.u_max / arm;
    let fits = |factor: &&f64| largest * **factor <= LARGEST_DRAWN && !response.summary.overturned;
    FACTORS.iter().rev().find(fits).copied().unwrap_or(1.0)
}

fn facts(scene: &Scene, wall: &Wall, response: &Response) -> String {
    let parameters = &scene.parameters;
    let body = wall.body();
    let summary = &response.summary;
    let law = if parameters.multilinear.is_some() { "multilinear" } else { parameters.force_law.name() };
    let rows = [
        ("largest |u|", demands::largest(summary, "mm", 1)),
        ("overturned", demands::overturned(summary.fate, 3)),
        what_rocks(scene, wall),
        ("static instability u_ins", of_sides(body.instability.map(|u| 1000.0 * u), 1, "mm")),
        ("strength F0", of_sides(body.strength.map(|force| force / 1000.0), 3, "kN")),
        ("force law", if_any(law, "ω1", wall.omega1(), "rad/s")),
        ("damping", if_any(parameters.damping_model.name(), "ξ", 100.0 * wall.damping_ratio(), "%")),
        ("rotations", if wall.rotations().is_some() { "full".to_owned() } else { "small".to_owned() }),
        ("impact", impact(parameters, wall.restitution().positive)),
    ];
    let ties = tie::facts(wall, parameters);
    let name = |number: usize| if ties.len() > 1 { format!("tie {number}") } else { "tie".to_owned() };
    let of_ties = ties.iter().zip(1..).map(|(tie, number)| row(&name(number), tie));
    let curve = scene.curve.iter().map(|curve| row("capacity curve", &curve.note()));
    rows.iter().map(|(name, value)| row(name, value)).chain(curve).chain(of_ties).collect()
}

/// The mechanism with its size, or the constants of an oscillator.
fn what_rocks(scene: &Scene, wall: &Wall) -> (&'static str, String) {
    let (body, parameters) = (wall.body(), &scene.parameters);
    if scene.is_of_oscillator() {
        let [mass, participation] = [body.effective_mass, body.participation].map(|value| number(value, 6));
        return ("oscillator", format!("m_eff = {mass} kg, λ = {participation}; drawn as a rigid body"));
    }
    let mechanism = parameters.mechanism.name().replace('_', " ");
    let base = bodies::Moving::new(wall, parameters).base();
    ("wall", format!("{mechanism}, {} m × {} m", number(body.height, 6), number(base, 6)))
}

/// A number with its unit, of both sides where they differ.
fn of_sides(Sides { positive, negative }: Sides, decimals: usize, unit: &str) -> String {
    let [out, back] = [positive, negative].map(|number| format!("{number:.decimals$}"));
    if out == back { format!("{out} {unit}") } else { format!("{out} {unit} (u > 0), {back} {unit} (u < 0)") }
}

/// A name with its number, without the number if it is 0: a rigid wall has no ω₁.
fn if_any(name: &str, symbol: &str, value: f64, unit: &str) -> String {
    let name = name.replace('_', " ");
    if value == 0.0 { name } else { format!("{name}, {symbol} = {value:.2} {unit}") }
}

/// Describes what happens at u = 0. Without impacts, e matters only where the damping is computed from it.
fn impact(parameters: &Parameters, e: f64) -> String {
    let computed = usage(parameters).any(|usage| usage.name == "restitution" && usage.matters);
    match parameters.impact {
        Impact::Restitution => format!("restitution, e = {e:.3}"),
        Impact::None if computed => format!("none; the damping stands for e = {e:.3}"),
        Impact::None => "none".to_owned(),
    }
}

fn row(name: &str, value: &str) -> String {
    format!("<tr><td>{}</td><td>{}</td></tr>", escaped(name), escaped(value))
}

fn demands(wall: &Wall, response: &Response) -> String {
    let lines = demands::lines(response, wall.body().hinge().is_some());
    let rows: String = lines.iter().map(|(name, value)| row(name, value)).collect();
    let until = demands::until(response).map_or_else(String::new, |until| format!(", {until}"));
    format!("<figure><figcaption>Demands{until}</figcaption><table>{rows}</table></figure>")
}

/// Draws a body that is no rectangle with what its picture leaves out: forces, dimensions and its front.
fn section(scene: &Scene, wall: &Wall) -> String {
    if scene.parameters.is_rectangle() || scene.is_of_oscillator() {
        return String::new();
    }
    let svg = crate::drawing::svg(wall, &scene.parameters);
    format!("<figure><figcaption>The wall to scale</figcaption>{svg}</figure>")
}

/// What turns a wall that is no rectangle, as `moving.js` reads it; null for a rectangle.
pub fn shape(wall: &Wall, parameters: &Parameters) -> serde_json::Value {
    bodies::Moving::new(wall, parameters).data()
}

fn figures(scene: &Scene, wall: &Wall, response: &Response, end: f64) -> String {
    let column = |pick: &dyn Fn(&Sample) -> f64| -> Vec<(f64, f64)> {
        response.samples.iter().map(|sample| (sample.time, pick(sample))).collect()
    };
    let ratio = plots::cut(column(&|sample| sample.outputs.ratio));
    let motion = column(&|sample| sample.support.bottom);
    let force = plots::force_path(wall, response.samples.iter(), &ratio);
    let (circles, force) = match scene.curve.as_ref().filter(|curve| !curve.points.is_empty()) {
        Some(curve) => ("; circles: the capacity curve as given", plots::with_points(force, wall, curve)),
        None => ("", force),
    };
    let caption = format!("Restoring force; dashed: its backbone{circles}");
    let has_top = response.samples.iter().any(|sample| sample.support.top != sample.support.bottom);
    let top_motion = has_top.then(|| column(&|sample| sample.support.top));
    let supports = match top_motion {
        Some(_) => "Acceleration of the supports: bottom (grey), top (amber)",
        None if wall.body().hinge().is_some() => "Acceleration of both supports",
        None if scene.floors.is_some() => "Acceleration of the floor",
        None => "Acceleration of the support",
    };
    [
        plot(
            "history",
            "Displacement; dashed: static instability u_ins",
            &plots::history(&ratio, end),
            &marks(response, end),
            true,
        ),
        plot("motion", supports, &plots::motion(&motion, top_motion.as_deref(), end), &[], true),
        tie::figures(wall, response, end),
        plot("force", &caption, &force, &[], false),
    ]
    .concat()
}

/// Marks where the wall exceeds `u_ins`, where it falls after a return, and the later shocks of a sequence.
fn marks(response: &Response, end: f64) -> Vec<(f64, &'static str)> {
    let fate = match response.summary.fate {
        Fate::Stands => Vec::new(),
        Fate::Falls { exceeds, falls } if falls == exceeds => vec![(falls, "falls")],
        Fate::Falls { exceeds, falls } => vec![(exceeds, "exceeds u_ins"), (falls, "falls")],
        Fate::ComesBack { exceeds } => vec![(exceeds, "exceeds u_ins")],
    };
    let later = response.shocks.iter().skip(1).map(|shock| shock.start).filter(|start| *start < end);
    fate.into_iter().chain(later.map(|start| (start, "next shock"))).collect()
}

/// Compares a rigid wall with itself under the other kinematics; empty for walls that do not allow them.
fn rotations(scene: &Scene, response: &Response, end: f64) -> String {
    let Some(other) = Counterpart::of(scene, response) else { return String::new() };
    let Counterpart { linear, trigonometric, apart, start, period, ratios } = other;
    let histories = plots::both_rotations(&plots::cut(trigonometric), &plots::cut(linear), end, HEIGHT);
    let short = 100.0 * (1.0 - period.ratio());
    let caption = format!(
        "Full rotations (blue) and small ones (red, dashed): at most {apart:.3} u_ins apart while both stand"
    );
    if ratios.is_empty() {
        let caption = format!(
            "{caption}; with small ones the time from rest at {start:.2} u_ins to u = 0 is {short:.2} % short"
        );
        return plot("rotations", &caption, &histories, &[], true);
    }
    let ratios = plots::period_ratios(ratios, (period.slenderness, period.ratio()), HEIGHT);
    plot("rotations", &caption, &histories, &[], true)
        + &format!(
            "<figure><figcaption>Period with small rotations over that with full ones, from {start:.2} \
             u_ins; dot: this wall, {short:.2} % short</figcaption>{}</figure>",
            ratios.svg()
        )
}

mod bodies;
pub mod tie;

#[cfg(test)]
mod tests;
