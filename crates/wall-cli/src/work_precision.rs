//! The page of `wall accuracy`: for each problem error against run time, on logarithmic axes.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::sync::Arc;

use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, ScatterPlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::TickFormat;
use kuva::render::plots::Plot;
use study::accuracy::{Measurement, Study};

use crate::figure;
use crate::template::filled;

/// Colours and marks of the solvers.
const SOLVERS: [(&str, &str, MarkerShape); 3] = [
    ("exact", "#1f5fa8", MarkerShape::Circle),
    ("adaptive", "#2e7d32", MarkerShape::Square),
    ("newmark", "#b3371e", MarkerShape::Triangle),
];
/// Colours and marks of the tools a comparison may name.
const TOOLS: [(&str, &str, MarkerShape); 6] = [
    ("rocking-wall", "#1f5fa8", MarkerShape::Circle),
    ("ode_solvers", "#2e7d32", MarkerShape::Square),
    ("diffsol", "#7b1fa2", MarkerShape::Diamond),
    ("numba", "#e08a00", MarkerShape::Cross),
    ("OpenSeesPy", "#b3371e", MarkerShape::Triangle),
    ("SciPy", "#616161", MarkerShape::Plus),
];
const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 290.0;
/// Below this no error is told from rounding; also keeps logarithms finite.
const FLOOR: f64 = 1e-17;
/// Errors are drawn by their exponents: kuva's own logarithmic axis ends at 1e-10.
fn exponent(error: f64) -> f64 {
    error.max(FLOOR).log10()
}

/// The page; `rotations` is its section on small rotations, `peers_csv` what `cargo xtask bench --peers` wrote.
pub(crate) fn page(studies: &[Study], rotations: &str, peers_csv: Option<&str>) -> String {
    let mut figures = String::new();
    for study in studies {
        let fate = match study.overturning {
            Some(time) => format!("overturns at {time:.3} s"),
            None => format!("u<sub>max</sub>/u<sub>ins</sub> = {:.3}", study.peak),
        };
        let reference = if study.exact { "exact" } else { "adaptive at 10<sup>−13</sup>" };
        let _ = writeln!(
            figures,
            "<figure><figcaption><b>{}</b><br>{fate}; reference: {reference}</figcaption>{}</figure>",
            figure::escaped(&study.name),
            plot(study)
        );
    }
    filled(
        include_str!("work_precision.html"),
        &[
            ("figures", &figures),
            ("rotations", rotations),
            ("peers", &peers_csv.map_or_else(String::new, peers)),
        ],
    )
}

/// Points of one solver or tool: run time \[ms\], error, and words for each.
struct Series {
    color: &'static str,
    marker: MarkerShape,
    points: Vec<(f64, f64)>,
    words: Vec<String>,
    /// Points that follow from one another, joined by a line.
    joined: bool,
}

fn plot(study: &Study) -> String {
    let series = SOLVERS.map(|(name, color, marker)| {
        let rows: Vec<&Measurement> =
            study.measurements.iter().filter(|row| row.setting.solver() == name).collect();
        let points = rows.iter().map(|row| (row.seconds * 1e3, row.error_max)).collect();
        let words = rows.iter().map(|row| hover(study, row)).collect();
        Series { color, marker, points, words, joined: true }
    });
    drawing(&series, Some(study.rounding()))
}

/// The plot of a scene of the peers.
fn peer_plot(rows: &[&PeerRow<'_>]) -> String {
    let series = TOOLS.map(|(name, color, marker)| {
        let rows = rows.iter().filter(|row| row.tool == name);
        let points = rows.clone().map(|row| (row.seconds * 1e3, row.error)).collect();
        let words = rows
            .map(|row| {
                format!("{name}, {}: max error {:.1e}; {:.3} ms", row.setting, row.error, row.seconds * 1e3)
            })
            .collect();
        Series { color, marker, points, words, joined: false }
    });
    drawing(&series, None)
}

/// A line of the CSV that `cargo xtask bench --peers` writes.
struct PeerRow<'a> {
    scene: &'a str,
    tool: &'a str,
    setting: &'a str,
    seconds: f64,
    error: f64,
}

impl<'a> PeerRow<'a> {
    /// `None` for the header and for what a tool does not offer.
    fn parse(line: &'a str) -> Option<Self> {
        let mut fields = line.split(',');
        let (scene, tool, setting) = (fields.next()?, fields.next()?, fields.next()?);
        let (seconds, error) = (fields.next()?.parse().ok()?, fields.next()?.parse().ok()?);
        Some(Self { scene, tool, setting, seconds, error })
    }
}

/// The section on other tools.
fn peers(csv: &str) -> String {
    let rows: Vec<PeerRow<'_>> = csv.lines().filter_map(PeerRow::parse).collect();
    let mut section = String::from("<h2>Beside other tools</h2>\n<p class=\"key\">");
    for (name, color, _) in TOOLS {
        let _ = write!(section, "<span><i style=\"background:{color}\"></i>{name}</span>");
    }
    section.push_str("</p>\n<main>\n");
    for scene in rows.chunk_by(|a, b| a.scene == b.scene).map(|rows| rows[0].scene).collect::<BTreeSet<_>>() {
        let rows: Vec<_> = rows.iter().filter(|row| row.scene == scene && row.error.is_finite()).collect();
        let _ = writeln!(
            section,
            "<figure><figcaption><b>Table 5, {}</b></figcaption>{}</figure>",
            figure::escaped(scene),
            peer_plot(&rows)
        );
    }
    section + "</main>\n"
}

fn drawing(series: &[Series], limit: Option<f64>) -> String {
    let mut plots: Vec<Plot> = Vec::new();
    for Series { color, marker, points, words, joined } in
        series.iter().filter(|series| !series.points.is_empty())
    {
        let drawn: Vec<(f64, f64)> = points.iter().map(|&(time, error)| (time, exponent(error))).collect();
        if *joined {
            plots.push(Plot::Line(
                LinePlot::new().with_data(drawn.clone()).with_color(*color).with_stroke_width(1.2),
            ));
        }
        plots.push(Plot::Scatter(
            ScatterPlot::new()
                .with_data(drawn)
                .with_color(*color)
                .with_marker(*marker)
                .with_size(4.5)
                .with_tooltips()
                .with_tooltip_labels(words.clone()),
        ));
    }
    let times = series.iter().flat_map(|series| series.points.iter().map(|point| point.0));
    let (low, high) = times.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    let size = [WIDTH, HEIGHT];
    let ranges = [[decade(low, f64::floor), decade(high, f64::ceil)], [exponent(FLOOR), 1.0]];
    let mut layout = figure::layout(&plots, size, ranges, ["run time (ms)", "max error / u_ins"])
        .with_log_x()
        .with_y_tick_step(3.0)
        .with_y_tick_format(TickFormat::Custom(Arc::new(|exponent| format!("1e{exponent:.0}"))));
    if let Some(limit) = limit {
        layout = layout.with_reference_line(ReferenceLine::horizontal(exponent(limit)).with_color("#777"));
    }
    figure::inline(plots, layout, size)
}

fn hover(study: &Study, row: &Measurement) -> String {
    let Measurement { seconds, error_max, error_rms, error_peak, work, .. } = row;
    format!(
        "{}, {}: max error {error_max:.1e}, rms {error_rms:.1e}{}; {:.3} ms, {} pieces, {} \
         corners, {} impacts",
        row.setting.solver(),
        row.setting.words(study.step),
        error_peak.map_or_else(String::new, |error| format!(", peak {error:.1e}")),
        seconds * 1e3,
        work.pieces,
        work.corners,
        work.impacts
    )
}

/// The power of ten below or above a value.
fn decade(value: f64, round: fn(f64) -> f64) -> f64 {
    10.0_f64.powf(round(value.log10()))
}
