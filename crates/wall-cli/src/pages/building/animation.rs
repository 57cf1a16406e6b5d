//! `wall building --svg`: the building as one animated SVG without a script.

use std::fmt::Write;

use building::document::Support;
use building::{Building, Coupled, Parts};
use figures::palette::{BLUE, RED, SERIES};
use rocking_wall::variables::Mechanism;

use super::{end, heights, overturned, said, sway};
use crate::pages::animation::{GROUND, MOST_FRAMES, Shape, animated, history, picture};

/// Room of the building, and thickness of a slab \[px\].
const ROOM: [f64; 2] = [190.0, 190.0];
const SLAB: f64 = 5.0;

/// What is drawn, and how.
struct Stage<'a> {
    building: &'a Building,
    parts: &'a Parts,
    run: &'a Coupled,
    frames: Vec<usize>,
    heights: Vec<f64>,
    /// Pixels per metre.
    px: f64,
    factor: f64,
    period: String,
}

/// Draws a run.
pub(crate) fn render(building: &Building, parts: &Parts, run: &Coupled) -> String {
    let end = end(run);
    let count = run.times.iter().take_while(|time| **time <= end).count();
    let frames: Vec<_> = (0..count).step_by(count.div_ceil(MOST_FRAMES).max(1)).collect();
    let heights = heights(building, parts);
    let mut levels: Vec<f64> = Vec::new();
    for (floor, height) in building.floors.iter().zip(&heights) {
        let below = if let Support::Floor(below) = floor.base { levels[below] } else { 0.0 };
        levels.push(below + height);
    }
    let parapets = parts.walls.iter().filter(|wall| wall.body().mechanism == Mechanism::Parapet);
    let room = parapets.map(|wall| wall.body().height).fold(0.0, f64::max);
    let high = levels.iter().copied().fold(0.0, f64::max) + room;
    let period = format!("{end:.2}s");
    let (px, factor) = (ROOM[1] / high, sway(building, run));
    let stage = Stage { building, parts, run, frames, heights, px, factor, period };
    let mut text = format!(
        "<path d=\"M8 {GROUND}H222\" stroke=\"#555\" stroke-width=\"2\"/>\n\
         <g transform=\"translate(115 {GROUND})\" fill=\"#c9a183\" stroke=\"#6b4a33\">{}</g>\n",
        stage.standing_on(Support::Ground)
    );
    let name = |index: usize| building.walls[index].name.replace('_', " ");
    let lines = run.walls.iter().enumerate().map(|(index, wall)| {
        let points = stage.frames.iter().map(|&frame| (run.times[frame], wall.ratio.values[frame]));
        (points.collect(), SERIES[index % SERIES.len()].0, name(index))
    });
    let lines: Vec<_> = lines.collect();
    text += &history(&lines, [0.0, end], &stage.period);
    let colour = if overturned(building, run).is_empty() { BLUE } else { RED };
    let said = format!("{} Sway × {factor}.", said(building, run));
    picture(&building.title, (&said, colour), &text)
}

impl Stage<'_> {
    /// Draws what stands on a support, whose level is the origin: storeys, and walls.
    fn standing_on(&self, support: Support) -> String {
        let Self { building, px, .. } = *self;
        let mut text = String::new();
        for (index, _) in building.floors.iter().enumerate().filter(|(_, floor)| floor.base == support) {
            text += &self.storey(index);
        }
        let here: Vec<_> =
            building.walls.iter().enumerate().filter(|(_, wall)| wall.bottom == support).collect();
        for (place, (index, wall)) in here.iter().enumerate() {
            let (own, scene) = (&self.parts.walls[*index], &self.parts.scenes[*index]);
            let body = own.body();
            let part = (place as f64 + 0.5) / here.len() as f64 - 0.5;
            let shape = Shape {
                foot: [0.85 * ROOM[0] * part, 0.0],
                px,
                height: body.height,
                thickness: scene.parameters.thickness,
                hinge: wall.top.map(|_| body.hinge_height),
            };
            let drifts = wall.drift.map(|floor| &self.run.floors[floor].drift.values);
            let motion: Vec<_> = self
                .frames
                .iter()
                .map(|&frame| {
                    let drift = drifts.map_or(0.0, |drifts| self.factor * drifts[frame]);
                    [self.run.walls[*index].displacement.values[frame], drift]
                })
                .collect();
            text += &shape.rocking(&motion, &self.period);
        }
        text
    }

    /// Draws a storey: columns that lean by its drift, and the floor that moves with it.
    fn storey(&self, index: usize) -> String {
        let height = self.heights[index];
        let drifts = &self.run.floors[index].drift.values;
        let drift = |frame: &usize| self.factor * drifts[*frame];
        let leaning =
            self.frames.iter().map(|frame| format!("{:.2}", -(drift(frame) / height).atan().to_degrees()));
        let moved = self.frames.iter().map(|frame| format!("{:.2} 0", self.px * drift(frame)));
        let (top, side) = (self.px * height, 0.5 * ROOM[0] - 6.0);
        let mut text = format!(
            "<path d=\"M{side:.1} 0V-{top:.1}M-{side:.1} 0V-{top:.1}\" stroke=\"#555\" \
             stroke-width=\"3\">{}</path>",
            animated("skewX", leaning, &self.period)
        );
        let slab = 0.5 * ROOM[0];
        // writing to a String cannot fail
        let _ = writeln!(
            text,
            "<g>{}<g transform=\"translate(0 -{top:.1})\"><rect x=\"-{slab}\" width=\"{}\" height=\"{SLAB}\" \
             fill=\"#e4e1dc\" stroke=\"#555\"/>{}</g></g>",
            animated("translate", moved, &self.period),
            2.0 * slab,
            self.standing_on(Support::Floor(index))
        );
        text
    }
}
