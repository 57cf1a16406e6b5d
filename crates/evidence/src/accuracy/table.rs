//! The measurements as a table, and in words.

use report::table::{Cell, Column, Digits, Table};

use super::WorkPrecision;

/// Returns the measurements, one a row. An error without a unit is relative to `u_ins`, except that of the
/// peak, which is relative to the peak.
pub fn table(studies: &[WorkPrecision]) -> Table {
    let (error, count) =
        (Digits::Exponent(1), |count| Cell::Count(usize::try_from(count).unwrap_or(usize::MAX)));
    let rows = studies.iter().flat_map(|study| study.measurements.iter().map(move |row| (study, row)));
    Table::over(rows)
        .text("scene", "", |(study, _)| study.name.clone())
        .text("solver", "solver", |(_, row)| row.setting.solver())
        .text("setting", "setting", |(study, row)| row.setting.describe(study.step))
        .value("run_time_s", |(_, row)| row.seconds)
        .number("error_max", "max error", error, |(_, row)| row.error_max)
        .number("error_rms", "rms error", error, |(_, row)| row.error_rms)
        .number("error_peak", "peak", error, |(_, row)| row.error_peak)
        .number("error_overturn_time_s", "t overt. s", error, |(_, row)| row.error_overturning)
        .column(Column::number("", "time ms", Digits::Decimals(3)).shown(1e3), |(_, row)| row.seconds)
        .column(Column::count("pieces", "pieces"), |(_, row)| count(row.work.pieces))
        .column(Column::count("corners", "corners"), |(_, row)| count(row.work.corners))
        .column(Column::count("impacts", "impacts"), |(_, row)| count(row.work.impacts))
        .value("amplification", |(study, _)| study.amplification)
        .done()
}

/// Returns a problem and its measurements for a terminal.
pub fn text(study: &WorkPrecision) -> String {
    let fate = match study.overturning {
        Some(time) => format!("overturns at {time:.6} s"),
        None => format!("u_max/u_ins {:.4}", study.peak),
    };
    let reference = if study.exact { "exact" } else { "adaptive at 1e-13" };
    let WorkPrecision { name, amplification, .. } = study;
    format!(
        "{name}\n{fate}; reference {reference}; a change of the motion is amplified {amplification:.1e} \
         times, rounding alone may cause {:.0e}\n{}\n",
        study.rounding(),
        table(std::slice::from_ref(study)).text()
    )
}
