//! The tie on the page of a run: slack, pulling, yielding, broken; its force and its elongation.

use report::moving::{plot, rounded};
use report::number;
use report::palette::{AMBER, BLUE};
use report::plot::Plot;
use rocking_wall::response::{Response, Sample};
use rocking_wall::solver::Yielding;
use rocking_wall::wall::{Tie, TiePart, Wall};
use serde_json::{Value, json};

use crate::figure::histories;

/// Share of `N_y` by which rounding may keep the force of a yielding tie below it.
const ROUNDING: f64 = 1e-9;

/// What a drawn tie does, by the names of its classes in `moving.js`.
#[derive(Clone, Copy)]
enum TieShown {
    Slack,
    Pulls,
    Yields,
    Broken,
}

/// The signs of u on which the tie holds the wall.
fn sides(tie: &Tie) -> impl Iterator<Item = f64> + use<'_> {
    [1.0, -1.0].into_iter().filter(|sign| tie.holds(*sign))
}

/// What ties have undergone, if they yield at all.
fn yielding(response: &Response) -> Option<Yielding> {
    response.demands.tie?.yielding
}

fn broke(response: &Response, sign: f64) -> Option<f64> {
    let [positive, negative] = yielding(response)?.breaks;
    if sign > 0.0 { positive } else { negative }
}

fn state(tie: &Tie, sample: &Sample, sign: f64, broke: Option<f64>) -> TieShown {
    let outputs = &sample.outputs;
    let yields = |strength: f64| outputs.tie_force >= (1.0 - ROUNDING) * strength;
    if broke.is_some_and(|time| time <= sample.time) {
        TieShown::Broken
    } else if outputs.displacement * sign <= 0.0 || outputs.tie_force <= 0.0 {
        TieShown::Slack
    } else if tie.ultimate.and(tie.strength).is_some_and(yields) {
        TieShown::Yields
    } else {
        TieShown::Pulls
    }
}

/// Returns what the script draws: for each side that is held its state and its free length, for each frame
/// the force \[kN\] and the elongations \[mm\]. Null without a tie.
pub fn data(wall: &Wall, response: &Response, frames: &[&Sample]) -> Value {
    let Some(tie) = wall.tie() else { return Value::Null };
    let side = |sign: f64| {
        let free = |sample: &&Sample| {
            let stretched = sample.outputs.tie_elongation.of(sign);
            (tie.slack + stretched - tie.lever * sign * sample.outputs.displacement).max(0.0)
        };
        let broke = broke(response, sign);
        json!({
            "sign": sign,
            "state": frames.iter().map(|sample| state(tie, sample, sign, broke) as u8).collect::<Vec<_>>(),
            "free": rounded(frames.iter().map(free)),
            "p": rounded(frames.iter().map(|sample| 1000.0 * sample.outputs.tie_elongation.of(sign))),
        })
    };
    json!({
        "y": height(wall, tie),
        "force": rounded(frames.iter().map(|sample| sample.outputs.tie_force / 1000.0)),
        "yields": yielding(response).is_some(),
        "sides": sides(tie).map(side).collect::<Vec<_>>(),
    })
}

fn height(wall: &Wall, tie: &Tie) -> f64 {
    tie.lever * wall.body().centroid_height
}

/// Ties, on the side that they pull to; the script draws them from the edge of the view box, at `edge`.
pub(super) fn lines(wall: &Wall, edge: f64, stroke: f64) -> String {
    let line = |sign: f64| {
        format!(
            "<path class=\"tie\" data-edge=\"{:.4}\" fill=\"none\" stroke-width=\"{stroke:.4}\"/>",
            -sign * edge
        )
    };
    wall.tie().map_or_else(String::new, |tie| sides(tie).map(line).collect())
}

/// Describes a tie in the table of the page; `None` without one.
pub(super) fn fact(wall: &Wall, weaker: Option<TiePart>) -> Option<String> {
    let tie = wall.tie()?;
    let part = match weaker {
        Some(TiePart::Bar) => "its bar ",
        Some(TiePart::Anchor) => "its anchor ",
        None => "",
    };
    let yields = |(strength, ultimate): (f64, f64)| {
        let force = number(strength / 1000.0, 4);
        match ultimate {
            0.0 => format!(", {part}breaks at {force} kN"),
            _ => format!(", {part}yields at {force} kN, breaks {} mm later", number(1000.0 * ultimate, 4)),
        }
    };
    let yields = tie.strength.zip(tie.ultimate).map_or(String::new(), yields);
    let stiffness = number(1e-6 * tie.stiffness, 4);
    Some(format!("{stiffness} kN/mm at {} m{yields}", number(height(wall, tie), 6)))
}

/// Says what becomes of ties that yield; empty for others.
pub fn said(response: &Response) -> String {
    let Some(Yielding { elongation, breaks }) = yielding(response) else { return String::new() };
    let largest = 1000.0 * elongation.positive.max(elongation.negative);
    match breaks.into_iter().flatten().reduce(f64::min) {
        Some(time) => format!(" A tie breaks at {time:.1} s."),
        None if largest > 0.0 => format!(" Its tie yields and gets {} mm longer.", number(largest, 2)),
        None => " Its tie does not yield.".to_owned(),
    }
}

/// A plot over the time, with its name and its caption.
pub type Named = (&'static str, String, Plot);

/// Force and, of ties that may yield, plastic elongation over the time up to `end` \[s\].
pub fn plots(wall: &Wall, response: &Response, end: f64) -> Vec<Named> {
    let Some(tie) = wall.tie() else { return Vec::new() };
    let column = |pick: &dyn Fn(&Sample) -> f64| -> Vec<(f64, f64)> {
        let shown = response.samples.iter().take_while(|sample| sample.time <= end);
        shown.map(|sample| (sample.time, pick(sample))).collect()
    };
    let force = column(&|sample| sample.outputs.tie_force / 1000.0);
    let force = histories(&[(&force, BLUE)], [0.0, end], "N (kN)", &[]);
    let mut plots = vec![("tie_force", "Force of the tie".to_owned(), force)];
    if yielding(response).is_some() {
        let elongations: Vec<_> = sides(tie)
            .map(|sign| (column(&|sample| 1000.0 * sample.outputs.tie_elongation.of(sign)), sign))
            .collect();
        let color = |sign: f64| if sign > 0.0 { BLUE } else { AMBER };
        let lines: Vec<_> = elongations.iter().map(|(points, sign)| (&points[..], color(*sign))).collect();
        let which = if lines.len() > 1 { ": u > 0 (blue), u < 0 (amber)" } else { "" };
        let plot = histories(&lines, [0.0, end], "p (mm)", &[]);
        plots.push(("tie_elongation", format!("Plastic elongation of the tie{which}"), plot));
    }
    plots
}

/// Force and elongation over the time, with marks where a tie first yields and where it breaks.
pub(super) fn figures(wall: &Wall, response: &Response, end: f64) -> String {
    let Some(tie) = wall.tie() else { return String::new() };
    let yields = yielding(response).is_some();
    let first = response.demands.tie.and_then(|tie| tie.strength).map(|first| first.time);
    let breaks = sides(tie).filter_map(|sign| broke(response, sign)).map(|time| (time, "breaks"));
    // a brittle tie breaks where it would yield
    let first = first.filter(|_| yields && tie.ultimate != Some(0.0)).map(|time| (time, "yields"));
    let marks: Vec<_> = first.into_iter().chain(breaks).filter(|(time, _)| *time <= end).collect();
    let of = |id| if id == "tie_force" { &marks[..] } else { &[] };
    plots(wall, response, end)
        .iter()
        .map(|(id, caption, drawn)| plot(id, caption, drawn, of(*id), true))
        .collect()
}
