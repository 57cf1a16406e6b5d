//! What a run demanded of a wall, as text for the summary and the page.

use std::fmt::Write;

use report::counted;

use rocking_wall::solver::{Crossing, Extremes, Instant, TieDemands, Work, Yielding};
use rocking_wall::variables::Mechanism;
use scene::Scene;
use scene::response::{Fate, Response, Shock, Summary};

/// The summary of a run, a name and a value in each line.
pub fn summary(scene: &Scene, response: &Response) -> String {
    let summary = &response.summary;
    let mut text = format!("{}\n", scene.title);
    let mut line = |name: &str, value: String| {
        // writing to a String cannot fail
        let _ = writeln!(text, "{name:<15}{value}");
    };
    if !scene.motion_notes.is_empty() {
        line("motion", scene.motion_notes.join(", "));
    }
    if let Some(curve) = &scene.curve {
        line("curve", curve.note());
    }
    line("largest |u|", largest(summary, "m", 6));
    line("overturned", overturned(summary.fate, 4));
    line("run", format!("{} s", report::number(summary.end_time, 6)));
    let Work { pieces, corners, impacts } = summary.work;
    let [pieces, corners, impacts] = [(pieces, "piece"), (corners, "corner"), (impacts, "impact")]
        .map(|(count, noun)| counted(count, noun));
    line("work", format!("{pieces} of motion, {corners}, {impacts}"));
    if let Some(until) = until(response) {
        line("demands", until.to_owned());
    }
    for (name, value) in lines(response, scene.parameters.mechanism == Mechanism::VerticalSpanning) {
        line(&name, value);
    }
    text
}

/// The largest |u| of a run in m or mm.
pub fn largest(summary: &Summary, unit: &str, digits: usize) -> String {
    let scale = if unit == "mm" { 1000.0 } else { 1.0 };
    let falls = if summary.fate.falls() { ", where the wall falls" } else { "" };
    format!("{:.digits$} {unit}, {:.4} u_ins{falls}", scale * summary.u_max, summary.u_ratio_max)
}

/// The time of overturning, and whether the wall fell.
pub fn overturned(fate: Fate, digits: usize) -> String {
    match fate {
        Fate::Stands => "no".to_owned(),
        Fate::ComesBack { exceeds } => format!("at {exceeds:.digits$} s, and came back"),
        Fate::Falls { exceeds, falls } if falls > exceeds => {
            format!("at {exceeds:.digits$} s, came back and fell at {falls:.2} s")
        }
        Fate::Falls { exceeds, .. } => format!("at {exceeds:.digits$} s"),
    }
}

/// Describes where demands end; `None` for a wall that did not overturn.
pub fn until(response: &Response) -> Option<&'static str> {
    let is_tied = !response.demands.ties.is_empty();
    let until =
        if is_tied { "up to overturning; those of ties over the whole run" } else { "up to overturning" };
    response.summary.overturned.then_some(until)
}

/// Names and values; a parapet has no top support.
pub fn lines(response: &Response, has_top: bool) -> Vec<(String, String)> {
    let demands = &response.demands;
    let mut lines = Vec::new();
    let mut peak = |name: &str, extremes: &Extremes, scale: f64, unit: &str| {
        let Extremes { highest, lowest } = extremes;
        let part = |at: &Instant| format!("{} at {:.3} s", figure(scale * at.value), at.time);
        lines.push((name.to_owned(), format!("{}, {} [{unit}]", part(highest), part(lowest))));
    };
    peak("u", &demands.displacement, 1000.0, "mm");
    peak("u_dot", &demands.velocity, 1.0, "m/s");
    peak("u_ddot", &demands.acceleration, 1.0, "m/s²");
    peak(if has_top { "bottom force" } else { "base force" }, &demands.reaction_bottom, 1e-3, "kN");
    if has_top {
        peak("top force", &demands.reaction_top, 1e-3, "kN");
    }
    for (number, tie) in demands.ties.iter().enumerate() {
        let numbered = |what: &str| format!("tie {} {what}", number + 1);
        let names = if demands.ties.len() > 1 {
            ["force", "longer"].map(numbered)
        } else {
            ["tie force", "tie stretched"].map(str::to_owned)
        };
        lines.extend(names.into_iter().zip(of_tie(tie)));
    }
    let crossing = |Crossing { fraction, first }: &Crossing| match first {
        Some(Instant { time, .. }) => format!("{fraction} u_ins at {time:.4} s"),
        None => format!("{fraction} u_ins never"),
    };
    if !demands.crossings.is_empty() {
        let crossings: Vec<_> = demands.crossings.iter().map(crossing).collect();
        lines.push(("first reached".to_owned(), crossings.join(", ")));
    }
    lines.push(("half cycles".to_owned(), demands.half_cycles.to_string()));
    let fallen = if response.summary.fate.falls() { ", fallen" } else { "" };
    lines.push(("residual u".to_owned(), format!("{} mm{fallen}", figure(1000.0 * response.residual))));
    let shocks = response.shocks.iter().zip(1..);
    lines.extend(shocks.map(|(shock, number)| (format!("shock {number}"), of_shock(shock))));
    lines
}

/// What a shock did to the wall, and to its ties up to then.
fn of_shock(shock: &Shock) -> String {
    let Shock { start, u_max, u_ratio_max, residual, .. } = shock;
    if shock.fallen_before {
        return format!("from {start:.3} s: had fallen before");
    }
    let end =
        if shock.falls { "fallen".to_owned() } else { format!("u {} mm at its end", figure(1e3 * residual)) };
    let yielding = shock.demands.ties.iter().filter_map(|tie| tie.yielding);
    let ties: Vec<_> = yielding.map(|one| format!(", tie stretched {}", stretched(&one))).collect();
    format!("from {start:.3} s: |u| {:.2} mm, {u_ratio_max:.4} u_ins, {end}{}", 1e3 * u_max, ties.concat())
}

/// The largest force of a tie with the time at which it reached its strength, and how far it has yielded.
fn of_tie(tie: &TieDemands) -> impl Iterator<Item = String> {
    let TieDemands { force, strength, yielding, .. } = tie;
    let has_yielded = |Yielding { elongation, .. }: &Yielding| elongation.most() > 0.0;
    let reaches = if yielding.as_ref().is_some_and(has_yielded) { "yields" } else { "strength reached" };
    let reached = strength.map_or(String::new(), |at| format!(", {reaches} at {:.4} s", at.time));
    let peak = figure(1e-3 * force.value);
    let force = format!("{peak} at {:.3} s [kN]{reached}", force.time);
    std::iter::once(force).chain(yielding.as_ref().map(stretched))
}

/// The plastic elongations of a tie and when it broke, of the sides where it yielded.
fn stretched(&Yielding { elongation, breaks }: &Yielding) -> String {
    let sides = [("u > 0", elongation.positive, breaks[0]), ("u < 0", elongation.negative, breaks[1])];
    let side = |(name, elongation, broke): (&str, f64, Option<f64>)| {
        let length = (elongation > 0.0).then(|| format!("{} mm", figure(1000.0 * elongation)));
        let broke = broke.map(|time| format!("broken at {time:.4} s"));
        let words: Vec<_> = length.into_iter().chain(broke).collect();
        (!words.is_empty()).then(|| format!("{} on {name}", words.join(", ")))
    };
    let yielded: Vec<_> = sides.into_iter().filter_map(side).collect();
    if yielded.is_empty() { "no".to_owned() } else { yielded.join("; ") }
}

/// Four significant figures with a sign.
fn figure(value: f64) -> String {
    let value = value + 0.0; // no negative zero
    let digits = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    if !(-3.0..6.0).contains(&digits) {
        return format!("{value:+.3e}");
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 6 decimals")]
    let decimals = (3.0 - digits).clamp(0.0, 6.0) as usize;
    format!("{value:+.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::stretched;
    use rocking_wall::solver::Yielding;
    use rocking_wall::wall::Sides;

    #[test]
    fn ties_that_yielded_are_told_by_their_sides() {
        let of = |positive: f64, negative: f64, breaks: [Option<f64>; 2]| {
            stretched(&Yielding { elongation: Sides { positive, negative }, breaks })
        };
        assert_eq!(of(0.0, 0.0, [None; 2]), "no");
        assert_eq!(of(0.02, 0.0, [None; 2]), "+20.00 mm on u > 0");
        // a brittle tie breaks without stretching
        let both = of(0.0, 0.03, [Some(1.5), Some(2.25)]);
        assert_eq!(both, "broken at 1.5000 s on u > 0; +30.00 mm, broken at 2.2500 s on u < 0");
    }
}
