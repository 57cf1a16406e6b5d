//! Broken lines: cut to the axes, and without points that nobody would see.

/// A point in the plane: x and y.
pub type Point = (f64, f64);

/// Points in the plane.
pub type Points = Vec<Point>;

/// Columns of pixels of a plot area: a history needs no more than its extremes in each.
const COLUMNS: usize = 532;
/// A line may leave out points no further from it than this \[px\].
const TOLERANCE: f64 = 0.3;

/// Keeps the extremes of each pixel column, in order of time. The line looks as one of all points would.
pub fn decimated(points: &[Point], end: f64) -> Points {
    if points.len() <= 2 * COLUMNS {
        return points.to_vec();
    }
    let column = |time: f64| (time / end * COLUMNS as f64).floor();
    let mut kept = Vec::with_capacity(2 * COLUMNS + 2);
    for part in points.chunk_by(|a, b| column(a.0) == column(b.0)) {
        let by = |a: &&Point, b: &&Point| a.1.total_cmp(&b.1);
        let (Some(low), Some(high)) = (part.iter().min_by(by), part.iter().max_by(by)) else { continue };
        kept.extend(if low.0 <= high.0 { [*low, *high] } else { [*high, *low] });
    }
    kept
}

/// Returns the pieces of a line inside ranges of x and y, cut at their edges.
pub fn within(points: &[Point], ranges: [[f64; 2]; 2]) -> Vec<Points> {
    let mut pieces: Vec<Points> = Vec::new();
    for pair in points.windows(2) {
        let Some([from, to]) = inside(pair[0], pair[1], ranges) else { continue };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
    }
    pieces
}

/// The part of a segment inside ranges (Liang and Barsky, 1984); none of one without a value.
fn inside(a: Point, b: Point, [x, y]: [[f64; 2]; 2]) -> Option<[Point; 2]> {
    let way = (b.0 - a.0, b.1 - a.1);
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (from, way, range) in [(a.0, way.0, x), (a.1, way.1, y)] {
        if way == 0.0 && (range[0]..=range[1]).contains(&from) {
            continue;
        }
        let [low, high] = range.map(|edge| (edge - from) / way);
        if way == 0.0 || low.is_nan() || high.is_nan() {
            return None;
        }
        (first, last) = (first.max(low.min(high)), last.min(low.max(high)));
    }
    let at = |part: f64| if part == 1.0 { b } else { (a.0 + part * way.0, a.1 + part * way.1) };
    (first < last).then(|| [at(first), at(last)])
}

/// Leaves out points that make no visible difference (Douglas and Peucker, 1973). `scale` turns data into
/// pixels.
pub fn simplified(points: &[Point], scale: [f64; 2]) -> Points {
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
fn distance(point: Point, [from, to]: [Point; 2], scale: [f64; 2]) -> f64 {
    let vector = |a: Point, b: Point| [(b.0 - a.0) * scale[0], (b.1 - a.1) * scale[1]];
    let (chord, way) = (vector(from, to), vector(from, point));
    let length = chord[0] * chord[0] + chord[1] * chord[1];
    let along = if length > 0.0 { (chord[0] * way[0] + chord[1] * way[1]) / length } else { 0.0 };
    let along = along.clamp(0.0, 1.0);
    (way[0] - along * chord[0]).hypot(way[1] - along * chord[1])
}

#[cfg(test)]
mod tests {
    use super::within;

    #[test]
    fn lines_are_cut_at_the_edges() {
        let mountain = [(0.0, 1.0), (1.0, 5.0), (2.0, 6.0), (3.0, 0.0)];
        let pieces = within(&mountain, [[0.0, 3.0], [0.0, 3.0]]);
        assert_eq!(pieces, [[(0.0, 1.0), (0.5, 3.0)], [(2.5, 3.0), (3.0, 0.0)]]);
        // a segment may begin and end outside, at any height
        let across = within(&[(-1.0, 2.0), (1.0, 4.0)], [[-0.5, 0.5], [f64::NEG_INFINITY, f64::INFINITY]]);
        assert_eq!(across, [[(-0.5, 2.5), (0.5, 3.5)]]);
        // one without a value is a gap, and points inside belong together
        let gap = [(0.0, 1.0), (0.0, 2.0), (1.0, 2.0), (2.0, f64::NAN), (3.0, 1.0), (4.0, 1.0)];
        let pieces = within(&gap, [[0.0, 9.0], [0.0, 9.0]]);
        assert_eq!(pieces, [vec![(0.0, 1.0), (0.0, 2.0), (1.0, 2.0)], vec![(3.0, 1.0), (4.0, 1.0)]]);
    }
}
