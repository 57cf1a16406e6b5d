//! Calibrations as tables: the fits, their coefficients, and the laws of these.

use std::fmt::Write;

use report::table::{Column, Digits, Table};
use run::model::{Label, label};

use super::figure::printed;
use super::{Calibration, REGRESSIONS};

/// A number as it was given.
const AS_GIVEN: Digits = Digits::AtMost(15);

/// Returns every fit.
pub fn fits(found: &[Calibration]) -> Table {
    let mut table = Table::new([
        Column::text("damping_model", ""),
        Column::number("a1", "", AS_GIVEN),
        Column::number("u0_over_u_ins", "", AS_GIVEN),
        Column::number("restitution", "", AS_GIVEN),
        Column::number("damping", "", AS_GIVEN),
        Column::number("error", "", AS_GIVEN),
        Column::count("samples", ""),
    ]);
    for Calibration { model, fits, .. } in found {
        for fit in fits {
            table.row([
                model.name().into(),
                fit.a1.into(),
                fit.start.into(),
                fit.restitution.into(),
                fit.damping.into(),
                fit.error.into(),
                fit.samples.into(),
            ]);
        }
    }
    table
}

/// Returns x of ξ = −x ln e, Eq. (19), beside what the paper prints.
pub fn coefficients(found: &[Calibration]) -> Table {
    let four = Digits::Decimals(4);
    let mut table = Table::new([
        Column::text("damping_model", ""),
        Column::number("a1", "a1", AS_GIVEN),
        Column::number("u0_over_u_ins", "u0/u_ins", AS_GIVEN),
        Column::number("x", "x", four),
        Column::number("x_paper", "paper", four),
        Column::number("", "deviation", AS_GIVEN),
    ]);
    for Calibration { model, coefficients, .. } in found {
        for coefficient in coefficients {
            let paper = printed(*model, coefficient.a1);
            let deviation = paper.map(|paper| format!("{:.1}%", 100.0 * (coefficient.x / paper - 1.0)));
            table.row([
                model.name().into(),
                coefficient.a1.into(),
                coefficient.start.into(),
                coefficient.x.into(),
                paper.into(),
                deviation.into(),
            ]);
        }
    }
    table
}

/// Returns q and r of x = q a₁^r, Eqs. (20) to (22).
pub fn laws(found: &[Calibration]) -> Table {
    let mut table = Table::new([
        Column::text("damping_model", ""),
        Column::number("u0_over_u_ins", "", AS_GIVEN),
        Column::number("q", "", AS_GIVEN),
        Column::number("r", "", AS_GIVEN),
    ]);
    for Calibration { model, laws, .. } in found {
        for (start, law) in laws {
            table.row([model.name().into(), (*start).into(), law.q.into(), law.r.into()]);
        }
    }
    table
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
