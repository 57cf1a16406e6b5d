//! The front of a wall: widths over the height. Parts are centred and openings spread evenly, since no file
//! says where along the wall they are.

use report::number;
use rocking_wall::wall::Opening;

use super::canvas::{Anchor, Canvas, LINE, OPENING};
use super::shape::Shape;
use super::{WIDTH, bar, masonry, metres};

/// Room for the wall: width and height \[px\].
const ROOM: [f64; 2] = [280.0, 170.0];

/// Draws the front below y \[px\], and returns where it ends.
pub(super) fn draw(canvas: &mut Canvas, shape: &Shape, top: f64) -> f64 {
    let widest = shape.parts.iter().flat_map(|part| part.width).fold(1e-3, f64::max);
    let scale = (ROOM[0] / widest).min(ROOM[1] / shape.height);
    let foot = top + 26.0 + scale * shape.height;
    let axis = 0.5 * WIDTH;
    let at = |x: f64, z: f64| [axis + scale * x, foot - scale * z];
    canvas.line([12.0, top - 2.0], [WIDTH - 12.0, top - 2.0], "stroke=\"#ddd\"");
    canvas.text([12.0, top + 18.0], Anchor::Start, canvas.words.from_the_front);
    for part in &shape.parts {
        let ([bottom, upper], [from, to]) = (part.width.map(|width| 0.5 * width), [part.base, part.top()]);
        let corners = [at(-bottom, from), at(bottom, from), at(upper, to), at(-upper, to)];
        canvas.polygon(&corners, &masonry(part.density).replace("\"part\"", "\"front\""));
    }
    for (index, opening) in shape.openings.iter().enumerate() {
        let middle = place(shape, index);
        let half = 0.5 * opening.width;
        let [from, to] = [at(middle - half, opening.base), at(middle + half, opening.top())];
        // what can be seen through is white, a hollow is not
        let look =
            if opening.hollow.is_some() { OPENING.to_owned() } else { OPENING.replace("none", "#fff") };
        canvas.rect([from[0], to[0]], [from[1], to[1]], &look);
        let [width, height] = [format!("{} ×", number(opening.width, 4)), metres(opening.height)];
        if (to[0] - from[0]).min(from[1] - to[1]) > 2.3 * LINE {
            let [x, y] = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
            canvas.text([x, y - 3.0], Anchor::Middle, &width);
            canvas.text([x, y + LINE - 3.0], Anchor::Middle, &height);
        }
    }
    let width = shape.parts.first().map_or(widest, |part| part.width[0]);
    let ends = [at(-0.5 * width, 0.0)[0], at(0.5 * width, 0.0)[0]];
    canvas.across(ends, foot + 14.0, &metres(width));
    let upper = shape.parts.last().map_or(0.0, |part| part.width[1]);
    if upper > 0.0 && upper != width {
        canvas.text([axis, foot - scale * shape.height - 6.0], Anchor::Middle, &metres(upper));
    }
    bar(canvas, [12.0, foot + 44.0], scale);
    foot + 50.0
}

/// Returns the middle of an opening along the wall \[m\]. Those at one height share its width evenly.
fn place(shape: &Shape, index: usize) -> f64 {
    let own = shape.openings[index];
    let [from, to] = [own.base, own.top()];
    let beside = |other: &&Opening| other.base < to && from < other.top();
    let width = |openings: &[Opening]| openings.iter().filter(beside).map(|other| other.width).sum::<f64>();
    let all = shape.openings.iter().filter(beside).count();
    let before = shape.openings[..index].iter().filter(beside).count();
    let sections = shape.parts.iter().filter(|part| part.base < to && from < part.top());
    let widths =
        sections.flat_map(|part| [from.max(part.base), to.min(part.top())].map(|z| part.section(z).width));
    let whole = widths.fold(f64::INFINITY, f64::min);
    let gap = (whole - width(&shape.openings)) / (all + 1) as f64;
    gap * (before + 1) as f64 + width(&shape.openings[..index]) + 0.5 * (own.width - whole)
}
