//! Broken lines: cut to the axes, and without points that nobody would see.

/// Points in the plane.
pub type Points = Vec<(f64, f64)>;

/// Columns of pixels of a plot area: a history needs no more than its extremes in each.
const COLUMNS: usize = 532;
/// A line may leave out points no further from it than this \[px\].
const TOLERANCE: f64 = 0.3;

/// Keeps the extremes of each pixel column, in order of time. The line looks as one of all points would.
pub fn decimated(points: &[(f64, f64)], end: f64) -> Points {
    if points.len() <= 2 * COLUMNS {
        return points.to_vec();
    }
    let column = |time: f64| (time / end * COLUMNS as f64).floor();
    let mut kept = Vec::with_capacity(2 * COLUMNS + 2);
    for part in points.chunk_by(|a, b| column(a.0) == column(b.0)) {
        let by = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let (Some(low), Some(high)) = (part.iter().min_by(by), part.iter().max_by(by)) else { continue };
        kept.extend(if low.0 <= high.0 { [*low, *high] } else { [*high, *low] });
    }
    kept
}

/// Cuts a line to a range of x.
pub fn clipped(line: &[(f64, f64)], [low, high]: [f64; 2]) -> Points {
    let mut points = Vec::new();
    for pair in line.windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        if x1 < low || x0 > high {
            continue;
        }
        let at = |x: f64| if x1 > x0 { y0 + (y1 - y0) * (x - x0) / (x1 - x0) } else { y0 };
        for (x, y) in [(x0, y0), (x1, y1)] {
            let inside = x.clamp(low, high);
            points.push((inside, if inside == x { y } else { at(inside) }));
        }
    }
    points
}

/// Returns the pieces of a line inside the axes, cut at their edges.
pub fn within(points: &[(f64, f64)], [x, y]: [[f64; 2]; 2]) -> Vec<Points> {
    let inside = |point: &(f64, f64)| (x[0]..=x[1]).contains(&point.0) && (y[0]..=y[1]).contains(&point.1);
    let mut pieces = Vec::new();
    let mut piece: Points = Vec::new();
    for pair in points.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let starts = inside(&from);
        if starts && piece.is_empty() {
            piece.push(from);
        }
        match (starts, inside(&to)) {
            (true, true) => piece.push(to),
            (true, false) => {
                piece.push(edge(from, to, [x, y]));
                pieces.push(std::mem::take(&mut piece));
            }
            (false, true) => piece = vec![edge(to, from, [x, y]), to],
            (false, false) => {}
        }
    }
    pieces.push(piece);
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

/// The point where the way from a point inside to one outside leaves the axes.
fn edge(from: (f64, f64), to: (f64, f64), [x, y]: [[f64; 2]; 2]) -> (f64, f64) {
    let part = |from: f64, to: f64, [low, high]: [f64; 2]| {
        if to > high {
            (high - from) / (to - from)
        } else if to < low {
            (low - from) / (to - from)
        } else {
            1.0
        }
    };
    let t = part(from.0, to.0, x).min(part(from.1, to.1, y));
    (from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1))
}

/// Leaves out points that make no visible difference (Douglas and Peucker, 1973). `scale` turns data into
/// pixels.
pub fn simplified(points: &[(f64, f64)], scale: [f64; 2]) -> Points {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut kept = vec![false; points.len()];
    kept[0] = true;
    kept[points.len() - 1] = true;
    let mut open = vec![(0, points.len() - 1)];
    while let Some((first, last)) = open.pop() {
        let distance = |index: usize| distance(points[index], [points[first], points[last]], scale);
        let furthest = (first + 1..last).max_by(|&a, &b| distance(a).total_cmp(&distance(b)));
        if let Some(middle) = furthest.filter(|&index| distance(index) > TOLERANCE) {
            kept[middle] = true;
            open.extend([(first, middle), (middle, last)]);
        }
    }
    points.iter().zip(&kept).filter(|(_, kept)| **kept).map(|(point, _)| *point).collect()
}

/// Distance of a point from a chord \[px\].
fn distance(point: (f64, f64), [from, to]: [(f64, f64); 2], scale: [f64; 2]) -> f64 {
    let vector = |a: (f64, f64), b: (f64, f64)| [(b.0 - a.0) * scale[0], (b.1 - a.1) * scale[1]];
    let (chord, way) = (vector(from, to), vector(from, point));
    let length = chord[0] * chord[0] + chord[1] * chord[1];
    let along = if length > 0.0 { (chord[0] * way[0] + chord[1] * way[1]) / length } else { 0.0 };
    let along = along.clamp(0.0, 1.0);
    (way[0] - along * chord[0]).hypot(way[1] - along * chord[1])
}
