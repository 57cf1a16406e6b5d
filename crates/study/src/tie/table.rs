//! The outcomes of ties as a table, over what is varied.

use report::table::{Column, Digits, Table};
use rocking_wall::wall::Parameters;
use scene::response::Fate;

use super::{Outcome, Row, TieStudy};

/// Returns a row for each value: median, 84 % fractile and largest force and u/`u_ins` over the motions, the
/// latter two forces also per metre of wall, and how many of the motions make the wall fall, fall away from
/// the tie, come back from beyond `u_ins`, and reach the strength. Where a tie may yield, also its plastic
/// elongation, and how many motions break it.
pub fn table(study: &TieStudy, rows: &[Row]) -> Table {
    let four = Digits::Significant(4);
    let Parameters { width, .. } = study.scene().parameters;
    let force = |part| move |row: &&Row| row.of(|outcome| outcome.force)[part];
    let of_metre = |part| move |row: &&Row| row.of(|outcome| outcome.force)[part] / width;
    let ratio = |part| move |row: &&Row| row.of(|outcome| outcome.u_ratio)[part];
    let count = |is: fn(&Outcome) -> bool| {
        move |row: &&Row| row.outcomes.iter().filter(|outcome| is(outcome)).count()
    };
    let in_kilo = |name, heading| Column::number(name, heading, four).shown(1e-3);
    let comes_back = |outcome: &Outcome| matches!(outcome.fate, Fate::ComesBack { .. });
    let varied = study.varied;
    let value = Column::number(varied.column, varied.heading, Digits::AtMost(6)).shown(varied.factor);
    let table = Table::over(rows)
        .column(value, |row| row.value)
        .column(in_kilo("force_median_n", "N median\n[kN]"), force(0))
        .column(in_kilo("force_84_n", "N 84 %\n[kN]"), force(1))
        .column(in_kilo("force_max_n", "N max\n[kN]"), force(2))
        .column(in_kilo("force_84_n_m", "N 84 %\n[kN/m]"), of_metre(1))
        .column(in_kilo("force_max_n_m", "N max\n[kN/m]"), of_metre(2))
        .number("u_ratio_median", "u/u_ins\nmedian", four, ratio(0))
        .number("u_ratio_84", "u/u_ins\n84 %", four, ratio(1))
        .number("u_ratio_max", "u/u_ins\nmax", four, ratio(2))
        .number("falls", "falls", four, count(|outcome| outcome.fate.falls()))
        .number("falls_away_from_tie", "away\nfrom tie", four, count(|outcome| outcome.away))
        .number("beyond_u_ins_and_back", "beyond u_ins\nand back", four, count(comes_back))
        .number("strength_reached", "strength\nreached", four, count(|outcome| outcome.reached));
    if !study.yields() {
        return table.done();
    }
    let millimetres = |name, heading| Column::number(name, heading, four).shown(1e3);
    let elongation = |part| move |row: &&Row| row.of(|outcome| outcome.elongation)[part];
    table
        .column(millimetres("elongation_median_m", "p median\n[mm]"), elongation(0))
        .column(millimetres("elongation_84_m", "p 84 %\n[mm]"), elongation(1))
        .column(millimetres("elongation_max_m", "p max\n[mm]"), elongation(2))
        .number("broken", "tie\nbroken", four, count(|outcome| outcome.broken))
        .done()
}
