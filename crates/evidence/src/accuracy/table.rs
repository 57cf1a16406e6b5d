//! The measurements as a table, and in words.

use report::table::{Cell, Column, Digits, Table};

use super::{Measurement, WorkPrecision};

/// Returns the measurements, one a row. An error without a unit is relative to `u_ins`, except that of the
/// peak, which is relative to the peak.
pub fn table(studies: &[WorkPrecision]) -> Table {
    let error = |name, heading| Column::number(name, heading, Digits::Exponent(1));
    let mut table = Table::new([
        Column::text("scene", ""),
        Column::text("solver", "solver"),
        Column::text("setting", "setting"),
        Column::number("run_time_s", "", Digits::AtMost(6)),
        error("error_max", "max error"),
        error("error_rms", "rms error"),
        error("error_peak", "peak"),
        error("error_overturn_time_s", "t overt. s"),
        Column::number("", "time ms", Digits::Decimals(3)).shown(1e3),
        Column::count("pieces", "pieces"),
        Column::count("corners", "corners"),
        Column::count("impacts", "impacts"),
        error("amplification", ""),
    ]);
    let count = |count: u64| Cell::Count(usize::try_from(count).unwrap_or(usize::MAX));
    for study in studies {
        for Measurement { setting, seconds, error_max, error_rms, error_peak, error_overturning, work } in
            &study.measurements
        {
            let names = [study.name.as_str(), setting.solver(), &setting.describe(study.step)]
                .map(|name| Cell::from(name.to_owned()));
            let errors =
                [Some(*error_max), Some(*error_rms), *error_peak, *error_overturning].map(Cell::from);
            let work = [work.pieces, work.corners, work.impacts].map(count);
            let seconds = || [Cell::from(*seconds)];
            let row = names.into_iter().chain(seconds()).chain(errors).chain(seconds()).chain(work);
            table.row(row.chain([study.amplification.into()]));
        }
    }
    table
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
