//! The outcomes of ties as a table, over the stiffness.

use report::table::{Column, Digits, Table};
use rocking_wall::response::Fate;

use super::{Outcome, Row};

/// Returns a row for each stiffness: median and largest force and u/`u_ins` over the motions, and how many of
/// them make the wall fall, fall away from the tie, come back from beyond `u_ins`, and reach the strength.
pub fn table(rows: &[Row]) -> Table {
    let six = Digits::Significant(6);
    let mut table = Table::new([
        Column::number("stiffness_n_m", "K [N/m]", six),
        Column::number("force_median_n", "N median\n[kN]", six).shown(1e-3),
        Column::number("force_max_n", "N max\n[kN]", six).shown(1e-3),
        Column::number("u_ratio_median", "u/u_ins\nmedian", six),
        Column::number("u_ratio_max", "u/u_ins\nmax", six),
        Column::count("falls", "falls"),
        Column::count("falls_away_from_tie", "away\nfrom tie"),
        Column::count("beyond_u_ins_and_back", "beyond u_ins\nand back"),
        Column::count("strength_reached", "strength\nreached"),
    ]);
    for row in rows {
        let ([force, most], [ratio, largest]) = (row.of(|o| o.force), row.of(|o| o.u_ratio));
        let count = |is: fn(&Outcome) -> bool| row.outcomes.iter().filter(|outcome| is(outcome)).count();
        table.row([
            row.stiffness.into(),
            force.into(),
            most.into(),
            ratio.into(),
            largest.into(),
            count(|outcome| outcome.fate.falls()).into(),
            count(|outcome| outcome.away).into(),
            count(|outcome| matches!(outcome.fate, Fate::ComesBack { .. })).into(),
            count(|outcome| outcome.reached).into(),
        ]);
    }
    table
}
