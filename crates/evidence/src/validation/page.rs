//! A published test beside the model, in words and as a chart.

use std::fmt::Write;

use report::plot::{Axis, Plot, Series};
use report::table::{Cell, Column, Digits, Table};
use run::model::color;

use super::{DecayComparison, PublishedTest, Push, PushComparison, PushedLaw, Test};
use crate::EvidenceError;

/// Number of the colour and the mark of the measured points; no model here has the same one.
const MEASURED: usize = 3;

impl PublishedTest {
    /// Compares the test with the model, in words for a terminal and as a chart.
    ///
    /// # Errors
    /// [`EvidenceError`] if the model cannot do what was tested.
    ///
    /// # Panics
    /// If it has too few points, which [`PublishedTest::read`] refuses.
    pub fn shown(&self) -> Result<(String, Plot), EvidenceError> {
        let (text, chart) = match &self.test {
            Test::Push(push) => {
                let comparison = push.compare(&self.parameters)?;
                (about_push(push, &comparison), push_chart(&self.title, push, &comparison))
            }
            Test::Decay(decay) => {
                let comparison = decay.compare(&self.parameters)?;
                (about_decay(&comparison), decay_chart(&self.title, &comparison))
            }
        };
        Ok((format!("{}\nsource: {}\n{text}", self.title, self.source.trim()), chart))
    }
}

/// A table of named rows, with a column for each heading.
fn named_rows(
    name: &'static str,
    headings: impl IntoIterator<Item = String>,
    digits: Digits,
    rows: impl IntoIterator<Item = (String, Vec<Cell<'static>>)>,
) -> String {
    let columns = headings.into_iter().map(|heading| Column::number("", heading, digits));
    let mut table = Table::new(std::iter::once(Column::text("", name)).chain(columns));
    for (name, mut cells) in rows {
        cells.insert(0, name.into());
        cells.resize(table.columns.len(), Cell::Empty);
        table.row(cells);
    }
    table.text()
}

fn about_push(push: &Push, PushComparison { strength, instability, laws }: &PushComparison) -> String {
    let largest = push.points.iter().max_by(|a, b| a[1].total_cmp(&b[1])).copied().unwrap_or_default();
    let percent = |part: f64| Cell::Number(100.0 * part);
    let names = || laws.iter().map(|law| law.name.to_owned());
    let a3 = |(k, law): (usize, &PushedLaw)| {
        if k > 0 { Cell::Rounded(law.a3, 3) } else { "1 given".into() }
    };
    let fits = [
        ("a3".to_owned(), laws.iter().enumerate().map(a3).collect()),
        ("rms, % of F0".to_owned(), laws.iter().map(|law| percent(law.difference.rms)).collect()),
        ("max, % of F0".to_owned(), laws.iter().map(|law| percent(law.difference.largest)).collect()),
    ];
    let points = push.points.iter().enumerate().map(|(k, [x, measured])| {
        let over = laws.iter().map(|law| percent((law.forces[k] - measured) / strength));
        (format!("{x:.5}"), std::iter::once(Cell::Rounded(*measured, 5)).chain(over).collect())
    });
    format!(
        "model     F0 = {strength:.6} W, u_ins = {instability:.3} t\n\
         measured  at most {:.5} W = {:.3} F0, at d/t = {:.3}\n\
         trilinear laws with a1 = {}, d1 = {}; a3 fitted from d/t = {} on\n\n\
         {}\nless the measured P/W, % of F0\n{}",
        largest[1],
        largest[1] / strength,
        largest[0],
        push.a1,
        push.d1,
        push.fit_from,
        named_rows("law", names(), Digits::Decimals(1), fits),
        named_rows("d/t", std::iter::once("P/W".to_owned()).chain(names()), Digits::Decimals(1), points)
    )
}

fn about_decay(comparison: &DecayComparison) -> String {
    let DecayComparison { peaks, half_cycles, implied, rigid_half_cycles, is_fitted, models } = comparison;
    let how = if *is_fitted { "fitted to the peaks after the first" } else { "given" };
    let mut text = format!("e = {:.3}, {how}\n\n", models[0].restitution);
    let headings = ["e", "xi", "rms d/t", "max d/t"].map(str::to_owned);
    let fits = models.iter().map(|model| {
        let e = Cell::Rounded(model.restitution, 3);
        let sizes = [model.difference.rms, model.difference.largest].map(Cell::from);
        (model.name.clone(), [e, model.damping.into()].into_iter().chain(sizes).collect())
    });
    text += &named_rows("model", headings, Digits::Decimals(4), fits);
    let mut by_peak = |name, rows: Vec<(String, Vec<Cell<'static>>)>| {
        let numbers = (0..rows[0].1.len()).map(|peak| peak.to_string());
        let _ = write!(text, "\n{}", named_rows(name, numbers, Digits::Decimals(3), rows));
    };
    let cells = |values: &[f64]| -> Vec<_> { values.iter().map(|value| Cell::from(*value)).collect() };
    let of = |name: &str, values: &[f64]| (name.to_owned(), cells(values));
    let found = models.iter().map(|model| of(&model.name, &model.peaks));
    by_peak("peaks |d|/t", std::iter::once(of("measured", peaks)).chain(found).collect());
    by_peak("restitution from each peak to the next", vec![of("rigid law", implied)]);
    let measured = half_cycles.iter().map(|time| Cell::from(*time)).collect();
    let ratios =
        half_cycles.iter().zip(rigid_half_cycles).map(|(time, rigid)| (*time).map(|time| time / rigid));
    let mut times = vec![
        ("measured".to_owned(), measured),
        of("rigid law*", rigid_half_cycles),
        ("ratio".to_owned(), ratios.map(Cell::from).collect()),
    ];
    times.extend(models[..4].iter().map(|model| {
        // a model starts at the first peak
        (model.name.clone(), std::iter::once(Cell::Empty).chain(cells(&model.half_cycles)).collect())
    }));
    by_peak("time between passages, s", times);
    text + "* at the measured peaks, whatever e is\n"
}

fn push_chart(title: &str, push: &Push, comparison: &PushComparison) -> Plot {
    let line = |(k, law): (usize, &PushedLaw)| {
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
