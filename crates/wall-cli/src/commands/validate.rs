//! `wall validate`: the model beside a published test.

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use evidence::validation::{Case, DecayComparison, Push, PushComparison, Test};
use report::plot::{Axis, Plot, Series};
use run::model::color;

use crate::output::Console;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// A test (TOML), such as those of `tests/data/validation`
    test: PathBuf,
    /// Write the points and the model as SVG
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

/// Number of the colour and the mark of the measured points; no model here has the same one.
const MEASURED: usize = 3;

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let case = Case::read(&arguments.test)?;
    console.check_distinct(&case.inputs, &arguments.plot)?;
    let mut text = format!("{}\nsource: {}\n", case.title, case.source.trim());
    let chart = match &case.test {
        Test::Push(push) => {
            let comparison = push.compare(&case.parameters)?;
            about_push(&mut text, push, &comparison);
            push_chart(&case.title, push, &comparison)
        }
        Test::Decay(decay) => {
            let comparison = decay.compare(&case.parameters)?;
            about_decay(&mut text, &comparison);
            decay_chart(&case.title, &comparison)
        }
    };
    console.print(&text)?;
    console.picture(arguments.plot.as_ref(), || Ok(chart.figure_file()))
}

fn about_push(text: &mut String, push: &Push, comparison: &PushComparison) {
    let PushComparison { strength, instability, laws } = comparison;
    let largest = push.points.iter().max_by(|a, b| a[1].total_cmp(&b[1])).copied().unwrap_or_default();
    let _ = writeln!(
        text,
        "model     F0 = {strength:.6} W, u_ins = {instability:.3} t\n\
         measured  at most {:.5} W = {:.3} F0, at d/t = {:.3}\n\
         trilinear laws with a1 = {}, d1 = {}; a3 fitted from d/t = {} on\n",
        largest[1],
        largest[1] / strength,
        largest[0],
        push.a1,
        push.d1,
        push.fit_from
    );
    let _ = writeln!(text, "{:<16}{}", "law", columns(laws.iter().map(|law| law.name.to_owned())));
    let percent = |part: f64| format!("{:.1}", 100.0 * part);
    let a3 = |a3: f64, is_fitted: bool| if is_fitted { format!("{a3:.3}") } else { "1 given".to_owned() };
    let fitted = laws.iter().enumerate().map(|(k, law)| a3(law.a3, k > 0));
    let _ = writeln!(text, "{:<16}{}", "a3", columns(fitted));
    let differences = laws.iter().map(|law| law.difference);
    let _ = writeln!(text, "{:<16}{}", "rms, % of F0", columns(differences.clone().map(|d| percent(d.rms))));
    let _ = writeln!(text, "{:<16}{}", "max, % of F0", columns(differences.map(|d| percent(d.largest))));
    let _ = writeln!(text, "\nd/t     P/W     less the measured P/W, % of F0");
    for (k, [x, measured]) in push.points.iter().enumerate() {
        let over = laws.iter().map(|law| percent((law.forces[k] - measured) / strength));
        let _ = writeln!(text, "{x:.5} {measured:.5} {}", columns(over));
    }
}

/// Puts texts in columns.
fn columns(texts: impl Iterator<Item = String>) -> String {
    texts.fold(String::new(), |row, text| format!("{row}{text:>10}"))
}

fn push_chart(title: &str, push: &Push, comparison: &PushComparison) -> Plot {
    let line = |(k, law): (usize, &evidence::validation::PushedLaw)| {
        let name = if k == 0 { law.name.to_owned() } else { format!("{}, a3 = {:.3}", law.name, law.a3) };
        let series = if k == 0 { Series::dashed } else { Series::line };
        series(&name, if k == 0 { color("none") } else { k - 1 }, law.corners.clone())
    };
    let mut series: Vec<_> = comparison.laws.iter().enumerate().map(line).collect();
    let points = push.points.iter().map(|[x, y]| (*x, *y)).collect();
    series.push(Series::marks("measured", MEASURED, points));
    let top = push.points.iter().map(|[_, force]| *force).fold(comparison.strength, f64::max);
    let (x, y) = (Axis::over("displacement d/t", [-0.02, 1.02]), Axis::over("force P/W", [0.0, 1.1 * top]));
    Plot::titled(title, x, y, series)
}

fn about_decay(text: &mut String, comparison: &DecayComparison) {
    let DecayComparison { peaks, half_cycles, implied, rigid_half_cycles, is_fitted, models } = comparison;
    let how = if *is_fitted { "fitted to the peaks after the first" } else { "given" };
    let _ = writeln!(text, "e = {:.3}, {how}\n", models[0].restitution);
    let _ = writeln!(text, "{:<14}{:>8}{:>8}{:>10}{:>10}", "model", "e", "xi", "rms d/t", "max d/t");
    for model in models {
        let xi = model.damping.map_or_else(|| "-".to_owned(), |xi| format!("{xi:.4}"));
        let _ = writeln!(
            text,
            "{:<14}{:>8.3}{xi:>8}{:>10.4}{:>10.4}",
            model.name, model.restitution, model.difference.rms, model.difference.largest
        );
    }
    let row = |name: &str, values: &[f64]| some_row(name, values.iter().copied().map(Some));
    let _ = writeln!(text, "\npeaks |d|/t\n{}", row("measured", peaks));
    for model in models {
        let _ = writeln!(text, "{}", row(&model.name, &model.peaks));
    }
    let _ = writeln!(text, "\nrestitution from each peak to the next\n{}", row("rigid law", implied));
    let half_cycles = half_cycles.iter().copied();
    let _ = writeln!(text, "\ntime between passages, s\n{}", some_row("measured", half_cycles.clone()));
    let _ = writeln!(text, "{}", row("rigid law*", rigid_half_cycles));
    let ratios = half_cycles.zip(rigid_half_cycles).map(|(time, rigid)| Some(time? / rigid));
    let _ = writeln!(text, "{}", some_row("ratio", ratios));
    for model in &models[..4] {
        // a model starts at the first peak
        let half_cycles = model.half_cycles.iter().copied().map(Some);
        let _ = writeln!(text, "{}", some_row(&model.name, std::iter::once(None).chain(half_cycles)));
    }
    let _ = writeln!(text, "* at the measured peaks, whatever e is");
}

/// Puts a name and numbers in columns; a missing number leaves its column blank.
fn some_row(name: &str, values: impl Iterator<Item = Option<f64>>) -> String {
    let text = |value: Option<f64>| value.map_or_else(|| " ".repeat(8), |value| format!("{value:>8.3}"));
    let row = values.fold(format!("{name:<14}"), |row, value| row + &text(value));
    row.trim_end().to_owned()
}

fn decay_chart(title: &str, comparison: &DecayComparison) -> Plot {
    let numbered = |peaks: &[f64]| peaks.iter().enumerate().map(|(k, peak)| (k as f64, *peak)).collect();
    let mut series = Vec::new();
    for (k, model) in comparison.models.iter().enumerate() {
        let name = match k {
            0 => format!("e = {:.3}", model.restitution),
            1..4 => model.name.clone(),
            _ => format!("{} = {:.3}", model.name, model.restitution),
        };
        let line = if k < 4 { Series::line } else { Series::dashed };
        // models keep their colours; the calibrated e has that of the fitted one
        let color = match k {
            0 | 4 => color("CR rigid"),
            1..4 => color(&model.name),
            _ => color("none"),
        };
        series.push(line(&name, color, numbered(&model.peaks)));
    }
    series.push(Series::marks("measured", MEASURED, numbered(&comparison.peaks)));
    let last = comparison.peaks.len() as f64 - 1.0;
    let first = comparison.peaks.first().copied().unwrap_or_default();
    let (x, y) =
        (Axis::over("peak after the start", [-0.2, last + 0.2]), Axis::over("|d|/t", [0.0, 1.35 * first]));
    Plot::titled(title, x, y, series)
}
