//! `wall simulate --svg`: the rocking wall as one small animated SVG without a script.

use anyhow::{Result, bail};
use figures::palette::{BLUE, RED};
use rocking_wall::response::{Response, Sample};
use rocking_wall::scene::Scene;
use rocking_wall::wall::Wall;

use crate::pages::animation::{GROUND, MOST_FRAMES, Shape, history, picture};

/// Room of the wall: width, and height above the ground \[px\].
const ROOM: [f64; 2] = [220.0, 196.0];
/// Seconds before the first motion and after the last that are shown.
const BEFORE: f64 = 0.5;
const AFTER: f64 = 2.0;
/// Part of `u_ins` from which a wall counts as moving.
const MOVING: f64 = 0.02;
/// Largest rotation drawn \[rad\], and the factors that may bring a small one near it.
const LARGEST: f64 = 0.25;
const FACTORS: [f64; 4] = [5.0, 3.0, 2.0, 1.0];

/// Draws the run of a scene.
pub(crate) fn render(scene: &Scene, wall: &Wall, response: &Response) -> Result<String> {
    let moving = |sample: &&Sample| sample.outputs.ratio.abs() > MOVING;
    let mut samples = response.samples.iter();
    let (Some(first), Some(last)) = (samples.clone().find(moving), samples.rfind(moving)) else {
        bail!("--svg: the wall hardly moves, by less than {MOVING} u_ins: there is nothing to draw");
    };
    let end = response.summary.fate.falling().unwrap_or(last.time).min(last.time) + AFTER;
    let span = [(first.time - BEFORE).max(0.0), end.min(response.summary.end_time)];
    let shown = response.samples.iter().filter(|sample| (span[0]..=span[1]).contains(&sample.time));
    let every = shown.clone().count().div_ceil(MOST_FRAMES).max(1);
    let frames: Vec<_> = shown.step_by(every).collect();
    let period = format!("{:.2}s", span[1] - span[0]);
    let factor = factor(wall, response);
    let motion: Vec<_> = frames.iter().map(|sample| [factor * sample.outputs.displacement, 0.0]).collect();
    let line = frames.iter().map(|sample| (sample.time, sample.outputs.ratio)).collect();
    let shape = shape(scene, wall, motion.last().map_or(0.0, |last| last[0]));
    let parts = format!(
        "<path d=\"M8 {GROUND}H{}\" stroke=\"#555\" stroke-width=\"2\"/>\n\
         {}<g fill=\"#c9a183\" stroke=\"#6b4a33\">{}</g>\n{}",
        ROOM[0] + 2.0,
        wall.free_side().map_or_else(String::new, |side| transverse(&shape, side)),
        shape.rocking(&motion, &period),
        history(&[(line, BLUE, String::new())], span, &period)
    );
    let scale = if factor == 1.0 { String::new() } else { format!(", rotation × {factor}") };
    let (said, colour) = match response.summary.fate.words(1) {
        Some(words) => (words, RED),
        None => (format!("stands: {:.0} % of u_ins{scale}", 100.0 * response.summary.u_ratio_max), BLUE),
    };
    Ok(picture(&scene.title, (&said, colour), &parts))
}

/// The wall in its room; one that falls, to end at a displacement \[m\], has room beside it.
fn shape(scene: &Scene, wall: &Wall, end: f64) -> Shape {
    let (height, thickness) = (wall.body().height, scene.parameters.thickness);
    let [width, room] = ROOM;
    let (px, axis) = if (end / arm(wall)).abs() > 0.7 {
        ((width - 40.0) / (height + thickness), if end > 0.0 { 32.0 } else { width - 32.0 })
    } else {
        (room / height, width / 2.0)
    };
    Shape { foot: [axis, GROUND], px, height, thickness, hinge: wall.body().hinge() }
}

/// Transverse walls, on the side to which the wall cannot rock.
fn transverse(shape: &Shape, side: f64) -> String {
    let Shape { foot: [axis, ground], px, height, thickness, .. } = *shape;
    let face = axis - side * px * thickness / 2.0;
    let (left, right) = if side > 0.0 { (8.0, face) } else { (face, ROOM[0] + 2.0) };
    format!(
        "<rect x=\"{left:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"#e4e1dc\" \
         stroke=\"#555\"/>\n",
        ground - px * height,
        right - left,
        px * height
    )
}

/// Returns the largest factor that keeps the rotation within its limit. A fall is drawn to scale.
fn factor(wall: &Wall, response: &Response) -> f64 {
    let largest = response.summary.u_max / arm(wall);
    let fits = |factor: &&f64| **factor * largest <= LARGEST && !response.summary.overturned;
    FACTORS.iter().find(fits).copied().unwrap_or(1.0)
}

/// Height over which u turns the lower body \[m\].
fn arm(wall: &Wall) -> f64 {
    wall.body().hinge().unwrap_or(wall.body().height / 2.0)
}
