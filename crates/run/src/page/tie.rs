//! The ties on the page of a run: slack, pulling, yielding, broken; their forces and elongations.

use report::moving::{plot, rounded};
use report::number;
use report::palette::{AMBER, BLUE, SERIES};
use report::plot::Plot;
use rocking_wall::solver::{TieDemands, Yielding};
use rocking_wall::wall::{Parameters, Tie, TiePart, Wall};
use scene::response::{Response, Sample, TieSample};
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

fn broke(demands: &TieDemands, sign: f64) -> Option<f64> {
    let [positive, negative] = demands.yielding?.breaks;
    if sign > 0.0 { positive } else { negative }
}

/// Returns whether a tie of the run may yield.
fn may_yield(response: &Response) -> bool {
    response.demands.ties.iter().any(|tie| tie.yielding.is_some())
}

fn state(tie: &Tie, u: f64, of: &TieSample, sign: f64, is_broken: bool) -> TieShown {
    let yields = |strength: f64| of.force >= (1.0 - ROUNDING) * strength;
    if is_broken {
        TieShown::Broken
    } else if u * sign <= 0.0 || of.force <= 0.0 {
        TieShown::Slack
    } else if tie.ultimate.and(tie.strength).is_some_and(yields) {
        TieShown::Yields
    } else {
        TieShown::Pulls
    }
}

/// Returns what the script draws of each tie at the samples of these numbers: for each side that is held its
/// state and its free length, for each frame the force \[kN\] and the elongations \[mm\].
pub fn data(wall: &Wall, response: &Response, frames: &[usize]) -> Value {
    let ties = wall.ties().iter().zip(&response.ties).zip(&response.demands.ties);
    ties.map(|((tie, samples), demands)| {
        let side = |sign: f64| {
            let broke = broke(demands, sign);
            let state = |&frame: &usize| {
                let Sample { time, outputs, .. } = &response.samples[frame];
                let is_broken = broke.is_some_and(|broke| broke <= *time);
                state(tie, outputs.displacement, &samples[frame], sign, is_broken) as u8
            };
            let stretched = |&frame: &usize| samples[frame].elongation.of(sign);
            let free = |frame: &usize| {
                let u = response.samples[*frame].outputs.displacement;
                (tie.slack + stretched(frame) - tie.lever * sign * u).max(0.0)
            };
            json!({
                "sign": sign,
                "state": frames.iter().map(state).collect::<Vec<_>>(),
                "free": rounded(frames.iter().map(free)),
                "p": rounded(frames.iter().map(|frame| 1000.0 * stretched(frame))),
            })
        };
        json!({
            "y": tie.height,
            "force": rounded(frames.iter().map(|frame| samples[*frame].force / 1000.0)),
            "yields": demands.yielding.is_some(),
            "sides": sides(tie).map(side).collect::<Vec<_>>(),
        })
    })
    .collect()
}

/// Ties, on the side that they pull to; the script draws them from the edge of the view box, at `edge`.
pub(super) fn lines(wall: &Wall, edge: f64, stroke: f64) -> String {
    let line = |sign: f64| {
        format!(
            "<path class=\"tie\" data-edge=\"{:.4}\" fill=\"none\" stroke-width=\"{stroke:.4}\"/>",
            -sign * edge
        )
    };
    wall.ties().iter().flat_map(sides).map(line).collect()
}

/// Describes the ties of a wall in the table of the page.
pub(super) fn facts(wall: &Wall, parameters: &Parameters) -> Vec<String> {
    let given = parameters.ties().filter(|tie| tie.stiffness > 0.0);
    wall.ties().iter().zip(given).map(|(tie, of)| fact(tie, of.weaker_part(parameters.width))).collect()
}

fn fact(tie: &Tie, weaker: Option<TiePart>) -> String {
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
    format!("{stiffness} kN/mm at {} m{yields}", number(tie.height, 6))
}

/// Says what becomes of ties that yield; empty for others.
pub fn said(response: &Response) -> String {
    let yielding = || response.demands.ties.iter().filter_map(|tie| tie.yielding);
    if !may_yield(response) {
        return String::new();
    }
    let longest = yielding().map(|Yielding { elongation, .. }| elongation.most()).fold(0.0, f64::max);
    let longest_mm = number(1000.0 * longest, 2);
    let first = yielding().flat_map(|of| of.breaks).flatten().reduce(f64::min);
    if response.ties.len() > 1 {
        let of_all = |count: usize| format!("{count} of {} ties", response.ties.len());
        let broken = yielding().filter(|of| of.breaks.iter().any(Option::is_some)).count();
        let yielded = yielding().filter(|of| of.elongation.most() > 0.0).count();
        return match first {
            Some(time) => format!(" {} break, from {time:.1} s on.", of_all(broken)),
            None if longest > 0.0 => format!(" {} yield, by up to {longest_mm} mm.", of_all(yielded)),
            None => " None of its ties yields.".to_owned(),
        };
    }
    match first {
        Some(time) => format!(" A tie breaks at {time:.1} s."),
        None if longest > 0.0 => format!(" Its tie yields and gets {longest_mm} mm longer."),
        None => " Its tie does not yield.".to_owned(),
    }
}

/// The colours of the first series, in words.
const COLORS: [&str; 5] = ["blue", "red", "green", "purple", "amber"];

/// A plot over the time, with its name and its caption.
pub type Named = (&'static str, String, Plot);

/// Forces and, of ties that may yield, plastic elongations over the time up to `end` \[s\].
pub fn plots(wall: &Wall, response: &Response, end: f64) -> Vec<Named> {
    if response.ties.is_empty() {
        return Vec::new();
    }
    let shown = response.samples.partition_point(|sample| sample.time <= end);
    let column = |samples: &[TieSample], pick: &dyn Fn(&TieSample) -> f64| -> Vec<(f64, f64)> {
        let both = response.samples.iter().zip(samples).take(shown);
        both.map(|(sample, of)| (sample.time, pick(of))).collect()
    };
    let color = |index: usize| SERIES[index % SERIES.len()].0;
    let drawn = |columns: &[Vec<(f64, f64)>], color: &dyn Fn(usize) -> &'static str, label: &str| {
        let lines: Vec<_> = columns.iter().enumerate().map(|(at, points)| (&points[..], color(at))).collect();
        histories(&lines, [0.0, end], label, &[])
    };
    let forces: Vec<_> =
        response.ties.iter().map(|samples| column(samples, &|of| of.force / 1000.0)).collect();
    let named = |(tie, at): (&Tie, usize)| {
        let color = COLORS.get(at).map_or(String::new(), |color| format!(" ({color})"));
        format!("{} m{color}", number(tie.height, 6))
    };
    let heights: Vec<_> = wall.ties().iter().zip(0..).map(named).collect();
    let are_several = response.ties.len() > 1;
    let of = if are_several {
        format!("Forces of the ties at {}", heights.join(", "))
    } else {
        "Force of the tie".to_owned()
    };
    let mut plots = vec![("tie_force", of, drawn(&forces, &color, "N (kN)"))];
    if !may_yield(response) {
        return plots;
    }
    if are_several {
        let longest: Vec<_> = response
            .ties
            .iter()
            .map(|samples| column(samples, &|of| 1000.0 * of.elongation.most()))
            .collect();
        let caption = "Plastic elongation of each tie, on the side where it is larger".to_owned();
        plots.push(("tie_elongation", caption, drawn(&longest, &color, "p (mm)")));
    } else {
        let signs: Vec<_> = wall.ties().iter().flat_map(sides).collect();
        let of_sides: Vec<_> = signs
            .iter()
            .map(|sign| column(&response.ties[0], &|of| 1000.0 * of.elongation.of(*sign)))
            .collect();
        let which = if signs.len() > 1 { ": u > 0 (blue), u < 0 (amber)" } else { "" };
        let color = |index: usize| if signs[index] > 0.0 { BLUE } else { AMBER };
        let caption = format!("Plastic elongation of the tie{which}");
        plots.push(("tie_elongation", caption, drawn(&of_sides, &color, "p (mm)")));
    }
    plots
}

/// Forces and elongations over the time, with marks where ties first yield and where they break.
pub(super) fn figures(wall: &Wall, response: &Response, end: f64) -> String {
    let ties = wall.ties().iter().zip(&response.demands.ties);
    // marks of several would cover each other
    let marks: Vec<_> = ties
        .filter(|_| response.ties.len() == 1)
        .flat_map(|(tie, demands)| {
            let breaks = sides(tie).filter_map(|sign| broke(demands, sign)).map(|time| (time, "breaks"));
            // a brittle tie breaks where it would yield
            let yields = tie.ultimate.is_some_and(|ultimate| ultimate > 0.0);
            let first = demands.strength.filter(|_| yields).map(|first| (first.time, "yields"));
            first.into_iter().chain(breaks)
        })
        .filter(|(time, _)| *time <= end)
        .collect();
    let of = |id| if id == "tie_force" { &marks[..] } else { &[] };
    plots(wall, response, end)
        .iter()
        .map(|(id, caption, drawn)| plot(id, caption, drawn, of(*id), true))
        .collect()
}
