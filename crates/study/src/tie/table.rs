//! The outcomes of ties as a table, over what is varied.

use report::table::{Column, Digits, Table};
use rocking_wall::response::Fate;

use super::{Outcome, Row, TieStudy};

/// Returns a row for each value: median and largest force and u/`u_ins` over the motions, and how many of
/// them make the wall fall, fall away from the tie, come back from beyond `u_ins`, and reach the strength.
/// Where a tie may yield, also median and largest plastic elongation, and how many motions break it.
pub fn table(study: &TieStudy, rows: &[Row]) -> Table {
    let six = Digits::Significant(6);
    let kilonewtons = |name, heading| Column::number(name, heading, six).shown(1e-3);
    let force = |part| move |row: &&Row| row.of(|outcome| outcome.force)[part];
    let ratio = |part| move |row: &&Row| row.of(|outcome| outcome.u_ratio)[part];
    let count = |is: fn(&Outcome) -> bool| {
        move |row: &&Row| row.outcomes.iter().filter(|outcome| is(outcome)).count()
    };
    let comes_back = |outcome: &Outcome| matches!(outcome.fate, Fate::ComesBack { .. });
    let table = Table::over(rows)
        .number(study.varied.column, study.varied.heading, six, |row| row.value)
        .column(kilonewtons("force_median_n", "N median\n[kN]"), force(0))
        .column(kilonewtons("force_max_n", "N max\n[kN]"), force(1))
        .number("u_ratio_median", "u/u_ins\nmedian", six, ratio(0))
        .number("u_ratio_max", "u/u_ins\nmax", six, ratio(1))
        .number("falls", "falls", six, count(|outcome| outcome.fate.falls()))
        .number("falls_away_from_tie", "away\nfrom tie", six, count(|outcome| outcome.away))
        .number("beyond_u_ins_and_back", "beyond u_ins\nand back", six, count(comes_back))
        .number("strength_reached", "strength\nreached", six, count(|outcome| outcome.reached));
    if !study.yields() {
        return table.done();
    }
    let millimetres = |name, heading| Column::number(name, heading, six).shown(1e3);
    let elongation = |part| move |row: &&Row| row.of(|outcome| outcome.elongation)[part];
    table
        .column(millimetres("elongation_median_m", "p median\n[mm]"), elongation(0))
        .column(millimetres("elongation_max_m", "p max\n[mm]"), elongation(1))
        .number("broken", "tie\nbroken", six, count(|outcome| outcome.broken))
        .done()
}
