//! The page of `wall building --record`: storeys that sway, walls that rock and fall, and their histories.

use crate::document::Support;
use crate::{Building, Coupled, Parts, table};
use report::escaped;
use report::palette::{DARK_GREY, RED, SERIES};
use run::figure::{cut, histories};
use scene::response::Fate;
use serde_json::json;

use report::moving::{Moving, factors, frames, page, plot, rounded, verdict};

/// Height of a storey without a wall that spans it \[m\].
const STOREY: f64 = 3.0;
/// Width for each wall on a floor, and least width of a floor \[m\].
const FOR_A_WALL: f64 = 3.0;
const LEAST_WIDTH: f64 = 7.0;
/// Sway of the roof that is drawn, over the height; factors that it may be drawn with.
const SWAY: f64 = 0.06;
const FACTORS: [f64; 7] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
/// Factors that the rocking of walls may be drawn with.
const ROCKING: [f64; 3] = [1.0, 2.0, 5.0];
/// Seconds drawn after the last fall and the last peak.
const AFTER_ALL: f64 = 5.0;
/// u/`u_ins` at which a falling wall clearly differs from one that stands or lies.
const FALLING: f64 = 3.0;

/// Makes the page of a run; `note` says what shakes the ground.
pub fn render(building: &Building, parts: &Parts, run: &Coupled, note: &str) -> String {
    // slider and histories end together
    let end = end(run);
    let frames = frames(run.times.partition_point(|&time| time <= end));
    let of = |values: &[f64]| rounded(frames.iter().map(|&frame| values[frame]));
    let open = telling(run, &frames);
    let mut peaks = table::floors(building, run).html();
    if !building.walls.is_empty() {
        peaks += &table::walls(building, parts, run).html();
    }
    let data = json!({
        "t": rounded(frames.iter().map(|&frame| run.times[frame])),
        "ground": of(&run.ground.values),
        "floors": floors(building, parts, run, &frames),
        "walls": walls(building, parts, run, &frames),
        "open": open,
        "sway": sway(building, run),
    });
    page(&Moving {
        title: &building.title,
        subtitle: &format!("{note}, {:.2} m/s²", run.ground.peak.value.abs()),
        verdict: &verdict(&said(building, run), !overturned(building, run).is_empty()),
        name: "the building",
        style: include_str!("building.css"),
        picture: "<svg id=\"scene\" role=\"img\" aria-label=\"the building in motion\"></svg>",
        choices: &(factors("sway", &FACTORS, sway(building, run)) + &factors("rocking", &ROCKING, 1.0)),
        facts: "",
        figures: &(figures(building, run, end) + &peaks),
        data: &data,
        script: include_str!("building.js"),
        frames: frames.len(),
    })
}

/// Storeys: what they stand on, height, width, and displacement relative to the ground.
fn floors(building: &Building, parts: &Parts, run: &Coupled, frames: &[usize]) -> Vec<serde_json::Value> {
    let mut absolute: Vec<Vec<f64>> = Vec::new();
    for (floor, history) in building.floors.iter().zip(&run.floors) {
        let own = &history.drift.values;
        absolute.push(match floor.base {
            Support::Ground => own.clone(),
            Support::Floor(below) => own.iter().zip(&absolute[below]).map(|(a, b)| a + b).collect(),
        });
    }
    let heights = heights(building, parts);
    let on = |index: usize| building.walls.iter().filter(|w| w.bottom == Support::Floor(index)).count();
    let most = (0..building.floors.len()).map(on).max().unwrap_or(0);
    let width = LEAST_WIDTH.max(FOR_A_WALL * most as f64);
    let shown = building.floors.iter().zip(&absolute).enumerate().map(|(index, (floor, x))| {
        json!({
            "name": shown(&floor.name),
            "below": floor.base.floor(),
            "height": heights[index],
            "width": width,
            "x": rounded(frames.iter().map(|&frame| x[frame])),
            "a": rounded(frames.iter().map(|&frame| run.floors[index].acceleration.values[frame])),
        })
    });
    shown.collect()
}

/// Heights of the storeys: that of a wall that spans one, or the usual \[m\].
fn heights(building: &Building, parts: &Parts) -> Vec<f64> {
    let height = |index: usize| {
        let mut spanning = building.walls.iter().zip(&parts.walls);
        let (base, top) = (building.floors[index].base, Some(Support::Floor(index)));
        let found = spanning.find(|(wall, _)| wall.top == top && wall.bottom == base);
        found.map_or(STOREY, |(_, wall)| wall.body().height)
    };
    (0..building.floors.len()).map(height).collect()
}

fn walls(building: &Building, parts: &Parts, run: &Coupled, frames: &[usize]) -> Vec<serde_json::Value> {
    let (own, times) = (parts.walls.iter().zip(&parts.scenes), &run.times);
    let shown = building.walls.iter().zip(&run.walls).zip(own).map(|((wall, history), (own, scene))| {
        let body = own.body();
        let beside = building.walls.iter().filter(|other| other.bottom == wall.bottom);
        let place = beside.clone().position(|other| other.name == wall.name).unwrap_or(0);
        json!({
            "name": shown(&wall.name),
            "bottom": wall.bottom.floor(),
            "top": wall.top.and_then(Support::floor),
            "place": (place as f64 + 0.5) / beside.count() as f64,
            "height": body.height,
            "thickness": scene.parameters.thickness,
            "hinge": body.hinge(),
            "shape": run::page::shape(own, &scene.parameters),
            "u": rounded(frames.iter().map(|&frame| history.displacement.values[frame])),
            "falls": history.fate(times).falling(),
        })
    });
    shown.collect()
}

/// Largest sway of any floor over its height above the ground, without a factor.
fn sway(building: &Building, run: &Coupled) -> f64 {
    let drifts = run.floors.iter().map(|floor| floor.drift.peak.value.abs()).sum::<f64>();
    let largest = drifts / (STOREY * building.floors.len() as f64);
    let fits = FACTORS.iter().rev().find(|factor| **factor * largest <= SWAY);
    fits.copied().unwrap_or(1.0)
}

/// Lists the walls that overturn, in order of time: the time, the name, and whether the wall falls.
fn overturned<'a>(building: &'a Building, run: &Coupled) -> Vec<(f64, &'a str, Fate)> {
    let walls = building.walls.iter().zip(&run.walls);
    let mut overturned: Vec<_> = walls
        .filter_map(|(wall, history)| {
            Some((history.overturn_time?, wall.name.as_str(), history.fate(&run.times)))
        })
        .collect();
    overturned.sort_by(|a, b| a.0.total_cmp(&b.0));
    overturned
}

/// Finds the frame shown first: just after the first fall, or that of the largest u/`u_ins`.
fn telling(run: &Coupled, frames: &[usize]) -> usize {
    let largest = |frame: &usize| {
        let ratios = run.walls.iter().map(|wall| wall.ratio.values[*frame].abs());
        let floors = run.floors.iter().map(|floor| floor.acceleration.values[*frame].abs());
        if run.walls.is_empty() { floors.fold(0.0, f64::max) } else { ratios.fold(0.0, f64::max) }
    };
    let falling = frames.iter().position(|frame| largest(frame) > FALLING && !run.walls.is_empty());
    let peak = frames.iter().enumerate().max_by(|a, b| largest(a.1).total_cmp(&largest(b.1)));
    falling.or(peak.map(|(index, _)| index)).unwrap_or(0)
}

/// Describes what becomes of the building.
fn said(building: &Building, run: &Coupled) -> String {
    let overturned = overturned(building, run);
    let worst = building.walls.iter().zip(&run.walls).max_by(|a, b| {
        let ratio = |wall: &crate::histories::WallHistory| wall.ratio.peak.value.abs();
        ratio(a.1).total_cmp(&ratio(b.1))
    });
    match (&overturned[..], worst) {
        ([], None) => "No wall stands on this building.".to_owned(),
        ([], Some((wall, history))) => {
            let ratio = 100.0 * history.ratio.peak.value.abs();
            format!("All walls stand; the {} reaches {ratio:.0} % of u_ins.", shown(&wall.name))
        }
        (overturned, _) => {
            let part =
                |(_, wall, fate): &(f64, &str, Fate)| Some(format!("the {} {}", shown(wall), fate.words(1)?));
            let text = overturned.iter().filter_map(part).collect::<Vec<_>>().join("; ");
            format!("{}{}.", text[..1].to_uppercase(), &text[1..])
        }
    }
}

/// Returns the end of the time axes: soon after the last fall or peak, whichever is later.
fn end(run: &Coupled) -> f64 {
    let floors = run.floors.iter().flat_map(|floor| [floor.acceleration.peak.time, floor.drift.peak.time]);
    let walls = run.walls.iter().map(|wall| wall.fate(&run.times).falling().unwrap_or(wall.ratio.peak.time));
    let last = floors.chain(walls).fold(0.0, f64::max);
    (last + AFTER_ALL).min(run.times.last().copied().unwrap_or(AFTER_ALL))
}

/// A name, a history and its colour.
type Trace = (String, Vec<(f64, f64)>, &'static str);

/// Histories: floor accelerations, u/`u_ins` of each wall, the forces that support them.
fn figures(building: &Building, run: &Coupled, end: f64) -> String {
    let points = |values: &[f64], scale: f64| -> Vec<(f64, f64)> {
        let pairs = run.times.iter().copied().zip(values.iter().map(|value| scale * value));
        pairs.take_while(|(time, _)| *time <= end).collect()
    };
    let drawn = |id, caption: &str, label, lines: Vec<Trace>, limits: &[f64], marks: &[(f64, String)]| {
        let keys = lines.iter().map(|(name, _, color)| {
            let name = escaped(&shown(name));
            format!(" <span class=\"key\"><i class=\"chip\" style=\"background:{color}\"></i>{name}</span>")
        });
        let caption = format!("{caption}:{}", keys.collect::<String>());
        let lines: Vec<_> = lines.iter().map(|(_, points, color)| (&points[..], *color)).collect();
        let mut figure = histories(&lines, [0.0, end], label, limits);
        figure.limits = limits.iter().map(|limit| (*limit, RED)).collect();
        let marks: Vec<_> = marks.iter().map(|(time, name)| (*time, name.as_str())).collect();
        plot(id, &caption, &figure, &marks, true)
    };
    let color = |index: usize| SERIES[index % SERIES.len()].0;
    let mut floors = vec![("ground".to_owned(), points(&run.ground.values, 1.0), DARK_GREY)];
    for (index, (floor, history)) in building.floors.iter().zip(&run.floors).enumerate() {
        floors.push((floor.name.clone(), points(&history.acceleration.values, 1.0), color(index)));
    }
    let text = drawn("floors", "Floor accelerations", "acceleration (m/s²)", floors, &[], &[]);
    if building.walls.is_empty() {
        return text;
    }
    let (mut ratios, mut forces) = (Vec::new(), Vec::new());
    for (index, (wall, history)) in building.walls.iter().zip(&run.walls).enumerate() {
        ratios.push((wall.name.clone(), cut(points(&history.ratio.values, 1.0)), color(index)));
        forces.push((wall.name.clone(), points(&history.reaction_bottom.values, 1e-3), color(index)));
    }
    let mark = |(time, name, fate): (f64, &str, Fate)| (fate.falling().unwrap_or(time), shown(name));
    let marks: Vec<_> = overturned(building, run).into_iter().map(mark).collect();
    let caption = "Walls; dashed: static instability";
    text + &drawn("ratios", caption, "u / u_ins", ratios, &[-1.0, 1.0], &marks)
        + &drawn("forces", "Forces of the floors on the feet of the walls", "force (kN)", forces, &[], &[])
}

/// The name of a storey or a wall in words.
fn shown(name: &str) -> String {
    name.replace('_', " ")
}
