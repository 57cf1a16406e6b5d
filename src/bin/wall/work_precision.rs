//! The page of `wall accuracy`: for each problem error against run time, on logarithmic axes.

use std::fmt::Write;
use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, ScatterPlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;
use rocking_wall::accuracy::{Measurement, Study};

use crate::figure;

/// Colours and marks of the solvers.
const SOLVERS: [(&str, &str, MarkerShape); 3] = [
    ("exact", "#1f5fa8", MarkerShape::Circle),
    ("adaptive", "#2e7d32", MarkerShape::Square),
    ("newmark", "#b3371e", MarkerShape::Triangle),
];
const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 290.0;
/// Below this no error is told from rounding; also keeps logarithms finite.
const FLOOR: f64 = 1e-17;
/// Errors are drawn by their exponents: kuva's own logarithmic axis ends at 1e-10.
fn exponent(error: f64) -> f64 {
    error.max(FLOOR).log10()
}

pub(crate) fn page(studies: &[Study]) -> String {
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
    include_str!("work_precision.html").replace("{{figures}}", &figures)
}

fn plot(study: &Study) -> String {
    let mut plots: Vec<Plot> = Vec::new();
    for (name, color, marker) in SOLVERS {
        let rows: Vec<&Measurement> =
            study.measurements.iter().filter(|row| row.setting.solver() == name).collect();
        let points: Vec<(f64, f64)> =
            rows.iter().map(|row| (row.seconds * 1e3, exponent(row.error_max))).collect();
        let words = rows.iter().map(|row| hover(study, row));
        plots.push(Plot::Line(
            LinePlot::new().with_data(points.clone()).with_color(color).with_stroke_width(1.2),
        ));
        plots.push(Plot::Scatter(
            ScatterPlot::new()
                .with_data(points)
                .with_color(color)
                .with_marker(marker)
                .with_size(4.5)
                .with_tooltips()
                .with_tooltip_labels(words),
        ));
    }
    let seconds = study.measurements.iter().map(|row| row.seconds * 1e3);
    let (low, high) = seconds.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    let layout = Layout::auto_from_plots(&plots)
        .with_width(WIDTH)
        .with_height(HEIGHT)
        .with_log_x()
        .with_x_axis_min(decade(low, f64::floor))
        .with_x_axis_max(decade(high, f64::ceil))
        .with_y_axis_min(exponent(FLOOR))
        .with_y_axis_max(1.0)
        .with_y_tick_step(3.0)
        .with_y_tick_format(TickFormat::Custom(Arc::new(|exponent| format!("1e{exponent:.0}"))))
        .with_force_margins(70.0, 18.0)
        .with_force_margins_y(14.0, 48.0)
        .with_x_label("run time (ms)")
        .with_y_label("max error / u_ins")
        .with_label_size(14)
        .with_tick_size(13)
        .with_font_family("system-ui, sans-serif")
        .with_reference_line(ReferenceLine::horizontal(exponent(study.rounding())).with_color("#777"));
    let svg = SvgBackend::new().render_scene(&render_multiple(plots, layout));
    figure::fluid(&svg, WIDTH, HEIGHT)
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
