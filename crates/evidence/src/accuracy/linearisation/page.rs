//! What small rotations leave out: Figures 2 and 3 of the paper, as tables and on the page of
//! `wall verify accuracy`.

use std::fmt::Write;

use report::palette::{BLUE, GREY, RED};
use report::plot::Plot;
use report::table::{Digits, Table};
use run::figure::{both_rotations, period_ratios};
use run::rotations::SLENDERNESS;

use super::{BothRotations, Period, STARTS};
use crate::accuracy::page::{figure, figures};

/// Size of the plots \[px\].
const SIZE: [f64; 2] = [440.0, 290.0];

/// Returns the periods, one a row.
pub fn table(both: &[BothRotations]) -> Table {
    let rows = both
        .iter()
        .flat_map(|measured| measured.periods.iter().flatten().map(|period| (measured.name, period)));
    Table::over(rows)
        .value("mechanism", |(name, _)| *name)
        .value("alpha_rad", |(_, period)| period.slenderness)
        .value("start_over_u_ins", |(_, period)| period.start)
        .value("period_linear_s", |(_, period)| period.linear)
        .value("period_trigonometric_s", |(_, period)| period.trigonometric)
        .value("period_eq5_s", |(_, period)| period.housner)
        .value("ratio", |(_, period)| period.ratio())
        .value("ratio_eq5", |(_, period)| period.over_housner())
        .done()
}

/// Returns the ratios of periods by slenderness and start, and Figure 2 in numbers.
pub fn text(both: &[BothRotations]) -> String {
    let ratio = Digits::Decimals(5);
    let mut table = Table::over(SLENDERNESS.into_iter().enumerate())
        .number("", "alpha", Digits::Decimals(2), |(_, alpha)| *alpha)
        .number("", "Eq. (5)", ratio, |(index, _)| both[0].periods[0][*index].over_housner());
    for measured in both {
        for (start, periods) in STARTS.iter().zip(&measured.periods) {
            let heading = format!("{} {start}", measured.name);
            table = table.number("", heading, ratio, |(index, _)| periods[*index].ratio());
        }
    }
    let mut text =
        String::from("small rotations: their period over that of full rotations, by start over u_ins\n");
    text += &table.done().text();
    let first = |times: &[f64]| times.first().copied().unwrap_or(f64::NAN);
    for BothRotations { name, duration, restitution, history, .. } in both {
        let (linear, full) = (first(&history.linear.impacts), first(&history.trigonometric.impacts));
        let _ = writeln!(
            text,
            "Figure 2, {name}, e = {restitution}: first impact at {linear:.5} s instead of {full:.5} s \
             ({:.2} % short);\n  over {duration} s at most {:.3} u_ins apart, amplitudes within {:.1e} u_ins",
            100.0 * (1.0 - linear / full),
            history.largest_difference(),
            history.largest_amplitude_difference()
        );
    }
    text
}

/// The section of the page.
pub(crate) fn section(both: &[BothRotations]) -> String {
    let key = [("full rotations", BLUE), ("small rotations", RED), ("Eq. (1) over Eq. (5), √cos α", GREY)];
    let chip = |(name, color): (&str, &str)| {
        (format!("<i class=\"chip\" style=\"background:{color}\"></i>"), name.to_owned())
    };
    let moved = both.iter().map(|BothRotations { name, duration, restitution, history, .. }| {
        let caption = format!(
            "<b>{name}, e = {restitution}</b><br>at most {:.3} u<sub>ins</sub> apart, amplitudes within \
             {:.0e} u<sub>ins</sub>",
            history.largest_difference(),
            history.largest_amplitude_difference()
        );
        let [small, full] = history.points();
        figure(&caption, &Plot { size: SIZE, ..both_rotations(&full, &small, *duration, SIZE[1]) })
    });
    let periods = both.iter().map(|BothRotations { name, periods, .. }| {
        let starts = "started at 0.1 (dotted), 0.5 (dashed) and 0.9 (solid) of u<sub>ins</sub>";
        figure(&format!("<b>{name}</b><br>{starts}"), &ratios(periods))
    });
    let words = "<p>The wall of Figure 2 of the paper (b = 0.4 m, h = 4 m, released from 0.9 \
                 u<sub>ins</sub>) with small and with full rotations, and the ratio of the two periods \
                 against slenderness, hinge of the strip at mid-height.</p>\n";
    words.to_owned() + &figures(key.map(chip), moved.chain(periods))
}

/// Ratios of periods of one mechanism.
fn ratios(periods: &[Vec<Period>]) -> Plot {
    let points = |of: &dyn Fn(&Period) -> Option<f64>, periods: &[Period]| -> Vec<(f64, f64)> {
        let upright = std::iter::once((0.0, 1.0));
        upright.chain(periods.iter().filter_map(|period| Some((period.slenderness, of(period)?)))).collect()
    };
    let curves = periods.iter().map(|periods| points(&|period| Some(period.ratio()), periods)).collect();
    let housner = points(&Period::over_housner, &periods[0]);
    Plot { size: SIZE, ..period_ratios(curves, housner, None, SIZE[1]) }
}
