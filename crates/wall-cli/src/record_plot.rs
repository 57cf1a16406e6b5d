//! The plot of records: their histories and their response spectra.

use anyhow::Result;
use ground_motion::{GroundMotion, STANDARD_GRAVITY, Spectrum};
use kuva::plot::{LegendPosition, LinePlot};
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::Scene;

use crate::figure::decimated;

/// So many records have a history and a colour each; more are drawn as grey spectra with their median.
const COLORS: [&str; 8] =
    ["#1f5fa8", "#b3371e", "#2e7d32", "#8e5bb5", "#c98a00", "#00838f", "#6d4c41", "#4d4d4d"];
const GREY: &str = "#b5b5b5";
const MEDIAN: &str = "#000000";

/// Size \[px\].
const WIDTH: f64 = 820.0;
const HISTORY: f64 = 180.0;
const SPECTRA: f64 = 420.0;

/// Periods of the spectra: up to 4 s, denser where they are short.
const PERIODS: u32 = 200;
const LONGEST: f64 = 4.0;

/// Histories over spectra.
///
/// # Errors
/// If a spectrum cannot be computed.
pub(crate) fn drawing(
    records: &[(String, &GroundMotion)],
    spectrum: Spectrum,
    damping: f64,
) -> Result<Scene> {
    let spectra: Vec<Vec<(f64, f64)>> =
        records.iter().map(|(_, motion)| points(motion, spectrum)).collect::<Result<_>>()?;
    let longest = records.iter().map(|(_, motion)| motion.duration()).fold(0.0, f64::max);
    let mut panels = Vec::new();
    let mut layouts = Vec::new();
    if records.len() <= COLORS.len() {
        for ((name, motion), color) in records.iter().zip(COLORS) {
            let panel = vec![Plot::Line(history(motion).with_color(color).with_stroke_width(0.9))];
            let layout = layout(&panel, ["time (s)", "a (g)"], longest);
            layouts.push(layout.with_title(name.as_str()).with_title_size(14));
            panels.push(panel);
        }
    }
    let panel = spectrum_lines(records, spectra);
    let label = format!("Sa (g) at {} % damping", 100.0 * damping);
    let layout = layout(&panel, ["period T (s)", &label], LONGEST);
    layouts.push(layout.with_legend_position(LegendPosition::InsideTopRight));
    panels.push(panel);
    let rows = panels.len();
    let figure = Figure::new(rows, 1)
        .with_plots(panels)
        .with_layouts(layouts)
        .with_cell_size(WIDTH, HISTORY)
        .with_row_height(rows - 1, SPECTRA)
        .with_spacing(4.0);
    Ok(figure.render())
}

/// Sa (g) over the period (s), from the peak ground acceleration at 0.
fn points(motion: &GroundMotion, spectrum: Spectrum) -> Result<Vec<(f64, f64)>> {
    let shortest = 0.01;
    let mut points = vec![(0.0, motion.peak() / STANDARD_GRAVITY)];
    for index in 0..=PERIODS {
        let part = f64::from(index) / f64::from(PERIODS);
        let period = shortest + (LONGEST - shortest) * part * part;
        points.push((period, spectrum.acceleration(motion, period)? / STANDARD_GRAVITY));
    }
    Ok(points)
}

fn history(motion: &GroundMotion) -> LinePlot {
    #[allow(clippy::cast_precision_loss, reason = "far fewer than 2⁵³ samples")]
    let samples = motion.samples().iter().enumerate();
    let points: Vec<_> =
        samples.map(|(index, a)| (index as f64 * motion.step(), a / STANDARD_GRAVITY)).collect();
    LinePlot::new().with_data(decimated(&points, motion.duration()))
}

fn spectrum_lines(records: &[(String, &GroundMotion)], spectra: Vec<Vec<(f64, f64)>>) -> Vec<Plot> {
    let few = records.len() <= COLORS.len();
    let median = if few { Vec::new() } else { median(&spectra) };
    let mut lines: Vec<Plot> = Vec::new();
    for (index, spectrum) in spectra.into_iter().enumerate() {
        let line = LinePlot::new().with_data(spectrum);
        lines.push(Plot::Line(if few {
            line.with_color(COLORS[index]).with_stroke_width(1.6).with_legend(records[index].0.as_str())
        } else {
            line.with_color(GREY).with_stroke_width(0.8)
        }));
    }
    if !few {
        let legend = format!("median of {} records", records.len());
        let line = LinePlot::new().with_data(median).with_color(MEDIAN).with_stroke_width(2.2);
        lines.push(Plot::Line(line.with_legend(legend)));
    }
    lines
}

/// The median of spectra at the same periods.
fn median(spectra: &[Vec<(f64, f64)>]) -> Vec<(f64, f64)> {
    let Some(first) = spectra.first() else { return Vec::new() };
    let at = |index: usize| {
        let mut values: Vec<f64> = spectra.iter().map(|spectrum| spectrum[index].1).collect();
        values.sort_by(f64::total_cmp);
        f64::midpoint(values[(values.len() - 1) / 2], values[values.len() / 2])
    };
    first.iter().enumerate().map(|(index, &(period, _))| (period, at(index))).collect()
}

fn layout(panel: &[Plot], [x_label, y_label]: [&str; 2], end: f64) -> Layout {
    Layout::auto_from_plots(panel)
        .with_x_label(x_label)
        .with_y_label(y_label)
        .with_x_axis_min(0.0)
        .with_x_axis_max(end)
        .with_label_size(14)
        .with_tick_size(12)
        .with_font_family("system-ui, sans-serif")
}
