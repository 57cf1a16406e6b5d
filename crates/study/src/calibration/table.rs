//! Calibrations as tables: the fits, their coefficients, and the laws of these.

use std::fmt::Write;

use report::table::{Digits, Table};
use run::model::{Label, label};

use super::figure::printed;
use super::{Calibration, Coefficient, DampingModel, REGRESSIONS};

/// Returns every fit.
pub fn fits(found: &[Calibration]) -> Table {
    Table::over(found.iter().flat_map(|one| one.fits.iter().map(|fit| (one.model, fit))))
        .text("damping_model", "", |(model, _)| model.name())
        .value("a1", |(_, fit)| fit.a1)
        .value("u0_over_u_ins", |(_, fit)| fit.start)
        .value("restitution", |(_, fit)| fit.restitution)
        .value("damping", |(_, fit)| fit.damping)
        .value("error", |(_, fit)| fit.error)
        .value("samples", |(_, fit)| fit.samples)
        .done()
}

/// Returns x of ξ = −x ln e, Eq. (19), beside what the paper prints.
pub fn coefficients(found: &[Calibration]) -> Table {
    let (given, four) = (Digits::AtMost(15), Digits::Decimals(4));
    let rows = found.iter().flat_map(|one| one.coefficients.iter().map(|row| (one.model, row)));
    let paper = |(model, row): &(DampingModel, &Coefficient)| printed(*model, row.a1);
    let deviation = |row: &(DampingModel, &Coefficient)| {
        paper(row).map(|paper| format!("{:.1}%", 100.0 * (row.1.x / paper - 1.0)))
    };
    Table::over(rows)
        .text("damping_model", "", |(model, _)| model.name())
        .number("a1", "a1", given, |(_, row)| row.a1)
        .number("u0_over_u_ins", "u0/u_ins", given, |(_, row)| row.start)
        .number("x", "x", four, |(_, row)| row.x)
        .number("x_paper", "paper", four, paper)
        .number("", "deviation", given, deviation)
        .done()
}

/// Returns q and r of x = q a₁^r, Eqs. (20) to (22).
pub fn laws(found: &[Calibration]) -> Table {
    Table::over(found.iter().flat_map(|one| one.laws.iter().map(|(start, law)| (one.model, start, law))))
        .text("damping_model", "", |(model, ..)| model.name())
        .value("u0_over_u_ins", |(_, start, _)| **start)
        .value("q", |(.., law)| law.q)
        .value("r", |(.., law)| law.r)
        .done()
}

/// Describes a calibration for a terminal: its coefficients and its laws, beside those of the paper.
pub fn text(found: &Calibration) -> String {
    let Label { name, symbol, .. } = label(found.model);
    let table = coefficients(std::slice::from_ref(found)).text();
    let mut text = format!("{} ({name}): {symbol} = -x ln e\n{table}", found.model.name());
    for (start, law) in &found.laws {
        let _ = write!(text, "u0 = {start} u_ins: x = {:.4} a1^{:.4}", law.q, law.r);
        if let Some((.., [q, r])) = REGRESSIONS.iter().find(|(of, ..)| *of == found.model) {
            let _ = write!(text, "   (paper: {q} a1^{r})");
        }
        text.push('\n');
    }
    text.push('\n');
    text
}
