//! Plots by kuva: inline SVG whose plot area is known to the pixel, for pages, and files.

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::{LinePlot, LineStyle};
use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};

/// Size of a plot and of the margins around its plot area \[px\]: left, right, top, bottom.
pub(crate) const WIDTH: f64 = 620.0;
pub(crate) const MARGINS: [f64; 4] = [70.0, 18.0, 14.0, 48.0];

/// Colours: the response, the backbone and limits, the motion.
const RESPONSE: &str = "#1f5fa8";
const LIMIT: &str = "#b3371e";
const MOTION: &str = "#4d4d4d";

/// Columns of pixels of a plot area: a history needs no more than its extremes in each.
const COLUMNS: usize = 532;

/// A plot: its SVG and how data become parts of its width and height.
pub(crate) struct Figure {
    pub(crate) svg: String,
    /// Height \[px\].
    height: f64,
    x_range: [f64; 2],
    y_range: [f64; 2],
}

impl Figure {
    /// A history over time with dashed limits.
    pub(crate) fn history(
        points: &[(f64, f64)],
        end: f64,
        label: &str,
        limits: &[f64],
        color: Color,
    ) -> Self {
        let extremes = points.iter().map(|point| point.1).chain(limits.iter().copied());
        let y_range = padded(extremes);
        let line =
            LinePlot::new().with_data(decimated(points, end)).with_color(color.name()).with_stroke_width(1.2);
        let references =
            limits.iter().map(|&limit| ReferenceLine::horizontal(limit).with_color(LIMIT)).collect();
        let height = if limits.is_empty() { 190.0 } else { 250.0 };
        Self::new(vec![line], references, [[0.0, end], y_range], ["time (s)", label], height)
    }

    /// The part of the backbone that a run went through, on the whole of it; displacements in `u/u_ins`, forces in kN.
    pub(crate) fn path_on_backbone(backbone: &[(f64, f64)], [lowest, highest]: [f64; 2]) -> Self {
        let reach = highest.max(-lowest).clamp(1.0, 1.1);
        let x_range = [-1.05 * reach, 1.05 * reach];
        let within = clipped(backbone, x_range);
        let path = clipped(backbone, [lowest.max(x_range[0]), highest.min(x_range[1])]);
        let y_range = padded(within.iter().map(|point| point.1));
        let law = LinePlot::new().with_data(within).with_color(LIMIT).with_stroke_width(1.0).with_dashed();
        let run = LinePlot::new().with_data(path).with_color(RESPONSE).with_stroke_width(1.6);
        let labels = ["u / u_ins", "restoring force F (kN)"];
        Self::new(vec![law, run], vec![], [x_range, y_range], labels, 320.0)
    }

    /// Curves over one axis; `y_range` is that of the points if none is given.
    pub(crate) fn curves(
        curves: &[Curve<'_>],
        x_range: [f64; 2],
        y_range: Option<[f64; 2]>,
        labels: [&str; 2],
        height: f64,
    ) -> Self {
        let points = || curves.iter().flat_map(|curve| curve.points);
        let y_range = y_range.unwrap_or_else(|| padded(points().map(|point| point.1)));
        let line = |curve: &Curve<'_>| {
            LinePlot::new()
                .with_data(decimated(curve.points, x_range[1]))
                .with_color(curve.color)
                .with_stroke_width(1.4)
                .with_line_style(curve.style.clone())
        };
        Self::new(curves.iter().map(line).collect(), vec![], [x_range, y_range], labels, height)
    }

    fn new(
        lines: Vec<LinePlot>,
        references: Vec<ReferenceLine>,
        [x_range, y_range]: [[f64; 2]; 2],
        [x_label, y_label]: [&str; 2],
        height: f64,
    ) -> Self {
        let plots: Vec<Plot> = lines.into_iter().map(Plot::Line).collect();
        let size = [WIDTH, height];
        let mut layout = layout(&plots, size, [x_range, y_range], [x_label, y_label]);
        for reference in references {
            layout = layout.with_reference_line(reference);
        }
        Self { svg: inline(plots, layout, size), height, x_range, y_range }
    }

    /// Where the plot area lies, as parts of the width and height: left, right, top, bottom.
    pub(crate) fn area(&self) -> [f64; 4] {
        let [left, right, top, bottom] = MARGINS;
        [left / WIDTH, 1.0 - right / WIDTH, top / self.height, 1.0 - bottom / self.height]
    }

    /// The ranges of the axes: x from, to, y from, to.
    pub(crate) fn ranges(&self) -> [f64; 4] {
        [self.x_range[0], self.x_range[1], self.y_range[0], self.y_range[1]]
    }
}

/// One of several curves of a figure.
pub(crate) struct Curve<'a> {
    pub(crate) points: &'a [(f64, f64)],
    pub(crate) color: &'static str,
    pub(crate) style: LineStyle,
}

/// What a history shows.
#[derive(Clone, Copy)]
pub(crate) enum Color {
    Response,
    Motion,
}

impl Color {
    fn name(self) -> &'static str {
        match self {
            Self::Response => RESPONSE,
            Self::Motion => MOTION,
        }
    }
}

/// The range of some values with room around it.
fn padded(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (low, high) = values.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    // nothing but zeros: an axis of ones
    let room = if high > low { 0.06 * (high - low) } else { 1.0 };
    [low - room, high + room]
}

/// The extremes of each pixel column, in order of time: what a line of all points would look like.
pub(crate) fn decimated(points: &[(f64, f64)], end: f64) -> Vec<(f64, f64)> {
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

/// A broken line cut to a range of x.
fn clipped(line: &[(f64, f64)], [low, high]: [f64; 2]) -> Vec<(f64, f64)> {
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

/// Axes over ranges of x and y, on a plot of a size \[px\]: what all plots of pages have in common.
pub(crate) fn layout(
    plots: &[Plot],
    [width, height]: [f64; 2],
    [x_range, y_range]: [[f64; 2]; 2],
    [x_label, y_label]: [&str; 2],
) -> Layout {
    let [left, right, top, bottom] = MARGINS;
    Layout::auto_from_plots(plots)
        .with_width(width)
        .with_height(height)
        .with_force_margins(left, right)
        .with_force_margins_y(top, bottom)
        .with_x_axis_min(x_range[0])
        .with_x_axis_max(x_range[1])
        .with_y_axis_min(y_range[0])
        .with_y_axis_max(y_range[1])
        .with_x_label(x_label)
        .with_y_label(y_label)
        .with_label_size(14)
        .with_tick_size(13)
        .with_font_family("system-ui, sans-serif")
}

/// An SVG that takes the width of its place: instead of a size it has a view box.
pub(crate) fn inline(plots: Vec<Plot>, layout: Layout, [width, height]: [f64; 2]) -> String {
    let svg = SvgBackend::new().render_scene(&render_multiple(plots, layout));
    let sized = format!("width=\"{width}\" height=\"{height}\"");
    let view = format!("viewBox=\"0 0 {width} {height}\"");
    assert!(svg.contains(&sized), "kuva writes the size as {sized}");
    svg.replacen(&sized, &view, 1)
}

/// A picture as a file of its own, in the format of its path's ending.
pub(crate) fn file(path: &Path, draw: impl FnOnce() -> Result<Scene>) -> Result<Vec<u8>> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match ending.as_str() {
        "svg" => Ok(SvgBackend::new().render_scene(&draw()?).into_bytes()),
        "png" => {
            PngBackend::new().render_scene(&draw()?).map_err(|reason| anyhow!("{}: {reason}", path.display()))
        }
        _ => bail!("{}: a plot ends in .svg or .png", path.display()),
    }
}

/// Text for markup.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
