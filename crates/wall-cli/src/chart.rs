//! Charts by kuva as inline SVG, with their legends as text beside them.

use std::fmt::Write;

use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, ScatterPlot};
use kuva::render::plots::Plot;
use study::chart::{Axis, Chart, Look, Series};

use crate::figure::{MARGINS, escaped, inline, layout};

/// How charts and their legends look on a page.
pub(crate) const STYLE: &str = include_str!("chart.css");

/// Colours and marks, told apart by people who see fewer colours too.
const COLORS: [(&str, MarkerShape, &str); 6] = [
    ("#1f5fa8", MarkerShape::Circle, "●"),
    ("#b3371e", MarkerShape::Square, "■"),
    ("#2e7d32", MarkerShape::Triangle, "▲"),
    ("#8e5bb5", MarkerShape::Diamond, "◆"),
    ("#c98a00", MarkerShape::Cross, "✕"),
    ("#4d4d4d", MarkerShape::Plus, "✚"),
];
/// Size \[px\].
const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 300.0;
/// A line may leave out points no further from it than this \[px\].
const TOLERANCE: f64 = 0.3;

/// A figure element: title, legend, drawing.
pub(crate) fn figure(chart: &Chart) -> String {
    let named = || chart.series.iter().filter(|series| !series.name.is_empty());
    let mut key = String::new();
    for series in named() {
        let (color, _, mark) = COLORS[series.color % COLORS.len()];
        let sample = match series.look {
            Look::Line => format!("<i style=\"border-top:2px solid {color}\"></i>"),
            Look::Dashed => format!("<i style=\"border-top:2px dashed {color}\"></i>"),
            Look::Marks => format!("<b style=\"color:{color}\">{mark}</b>"),
        };
        let _ = write!(key, "<span>{sample}{}</span>", escaped(&series.name));
    }
    format!(
        "<figure><figcaption>{}</figcaption>{}<p class=\"key\">{key}</p></figure>\n",
        escaped(&chart.title),
        svg(chart)
    )
}

fn svg(chart: &Chart) -> String {
    let of = |pick: fn(&(f64, f64)) -> f64| chart.series.iter().flat_map(move |s| s.points.iter().map(pick));
    let marks = chart.series.iter().any(|series| series.look == Look::Marks);
    let x_range = range(&chart.x, of(|point| point.0), marks);
    let y_range = range(&chart.y, of(|point| point.1), true);
    let [left, right, top, bottom] = MARGINS;
    let scale = [
        (WIDTH - left - right) / (x_range[1] - x_range[0]),
        (HEIGHT - top - bottom) / (y_range[1] - y_range[0]),
    ];
    let mut plots: Vec<Plot> = Vec::new();
    for Series { look, color, points, .. } in &chart.series {
        let (color, marker, _) = COLORS[color % COLORS.len()];
        if *look == Look::Marks {
            let marks = ScatterPlot::new().with_data(points.clone());
            plots.push(Plot::Scatter(marks.with_color(color).with_marker(marker).with_size(3.5)));
            continue;
        }
        for part in within(points, [x_range, y_range]) {
            let line = LinePlot::new().with_data(simplified(&part, scale)).with_color(color);
            let line = line.with_stroke_width(1.4);
            plots.push(Plot::Line(if *look == Look::Dashed { line.with_dashed() } else { line }));
        }
    }
    let labels = [chart.x.label.as_str(), chart.y.label.as_str()];
    let layout = layout(&plots, [WIDTH, HEIGHT], [x_range, y_range], labels);
    inline(plots, layout, [WIDTH, HEIGHT])
}

/// The range of an axis: its own, or that of the data with room around it.
fn range(axis: &Axis, values: impl Iterator<Item = f64>, room: bool) -> [f64; 2] {
    if let Some(range) = axis.range {
        return range;
    }
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let room = if room { 0.06 * (high - low).max(1e-9) } else { 0.0 };
    // an axis that starts near zero starts there
    let low = if low >= 0.0 && low < 0.3 * high { 0.0 } else { low - room };
    [low, (high + room).max(low + 1e-9)]
}

/// The pieces of a broken line inside the axes, cut at their edges in y.
fn within(points: &[(f64, f64)], [x, y]: [[f64; 2]; 2]) -> Vec<Vec<(f64, f64)>> {
    let inside = |point: &(f64, f64)| (x[0]..=x[1]).contains(&point.0) && (y[0]..=y[1]).contains(&point.1);
    let mut pieces = Vec::new();
    let mut piece: Vec<(f64, f64)> = Vec::new();
    for pair in points.windows(2) {
        match (inside(&pair[0]), inside(&pair[1])) {
            (true, true) => {
                if piece.is_empty() {
                    piece.push(pair[0]);
                }
                piece.push(pair[1]);
            }
            (true, false) => {
                if piece.is_empty() {
                    piece.push(pair[0]);
                }
                piece.push(edge(pair[0], pair[1], [x, y]));
                pieces.push(std::mem::take(&mut piece));
            }
            (false, true) => piece = vec![edge(pair[1], pair[0], [x, y]), pair[1]],
            (false, false) => {}
        }
    }
    pieces.push(piece);
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

/// Where the way from a point inside to one outside leaves the axes.
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

/// The line without points that nobody would miss (Douglas and Peucker, 1973); `scale` turns data into pixels.
fn simplified(points: &[(f64, f64)], scale: [f64; 2]) -> Vec<(f64, f64)> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut kept = vec![false; points.len()];
    kept[0] = true;
    kept[points.len() - 1] = true;
    let mut open = vec![(0, points.len() - 1)];
    while let Some((first, last)) = open.pop() {
        let distance = |index: usize| distance(points[index], points[first], points[last], scale);
        let furthest = (first + 1..last).max_by(|&a, &b| distance(a).total_cmp(&distance(b)));
        if let Some(middle) = furthest.filter(|&index| distance(index) > TOLERANCE) {
            kept[middle] = true;
            open.extend([(first, middle), (middle, last)]);
        }
    }
    points.iter().zip(&kept).filter(|(_, kept)| **kept).map(|(point, _)| *point).collect()
}

/// Distance of a point from a chord \[px\].
fn distance(point: (f64, f64), from: (f64, f64), to: (f64, f64), scale: [f64; 2]) -> f64 {
    let vector = |a: (f64, f64), b: (f64, f64)| [(b.0 - a.0) * scale[0], (b.1 - a.1) * scale[1]];
    let (chord, way) = (vector(from, to), vector(from, point));
    let length = chord[0] * chord[0] + chord[1] * chord[1];
    let along = if length > 0.0 { (chord[0] * way[0] + chord[1] * way[1]) / length } else { 0.0 };
    let along = along.clamp(0.0, 1.0);
    (way[0] - along * chord[0]).hypot(way[1] - along * chord[1])
}
