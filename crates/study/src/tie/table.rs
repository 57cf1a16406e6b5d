//! The outcomes of ties as a table, over the stiffness.

use report::table::{Column, Digits, Table};
use rocking_wall::response::Fate;

use super::{Outcome, Row};

/// Returns a row for each stiffness: median and largest force and u/`u_ins` over the motions, and how many of
/// them make the wall fall, fall away from the tie, come back from beyond `u_ins`, and reach the strength.
pub fn table(rows: &[Row]) -> Table {
    let six = Digits::Significant(6);
    let kilonewtons = |name, heading| Column::number(name, heading, six).shown(1e-3);
    let force = |part| move |row: &&Row| row.of(|outcome| outcome.force)[part];
    let ratio = |part| move |row: &&Row| row.of(|outcome| outcome.u_ratio)[part];
    let count = |is: fn(&Outcome) -> bool| {
        move |row: &&Row| row.outcomes.iter().filter(|outcome| is(outcome)).count()
    };
    let comes_back = |outcome: &Outcome| matches!(outcome.fate, Fate::ComesBack { .. });
    Table::over(rows)
        .number("stiffness_n_m", "K [N/m]", six, |row| row.stiffness)
        .column(kilonewtons("force_median_n", "N median\n[kN]"), force(0))
        .column(kilonewtons("force_max_n", "N max\n[kN]"), force(1))
        .number("u_ratio_median", "u/u_ins\nmedian", six, ratio(0))
        .number("u_ratio_max", "u/u_ins\nmax", six, ratio(1))
        .number("falls", "falls", six, count(|outcome| outcome.fate.falls()))
        .number("falls_away_from_tie", "away\nfrom tie", six, count(|outcome| outcome.away))
        .number("beyond_u_ins_and_back", "beyond u_ins\nand back", six, count(comes_back))
        .number("strength_reached", "strength\nreached", six, count(|outcome| outcome.reached))
        .done()
}
