//! A wall in the table of walls of a report.

use crate::circolare::{Activation, Checked};
use crate::report::markup::{formula, kilonewtons, millimetres, or_dash, shown as n, stated};
use crate::report::overview;

/// Headings and cells: the wall, its place, what holds it, and the numbers of the side that governs.
pub(in crate::circolare) fn of(case: &Checked<'_>) -> Vec<(String, String)> {
    let table = &case.statement.table;
    let some = |value: Option<f64>| or_dash(value, n);
    let mut cells = overview(&case.wall, &case.parameters);
    let mut cell = |head: String, text: String| cells.push((head, text));
    cell(formula("r"), or_dash(table.overburden_mass, stated));
    let ratio = table.building.as_ref().and_then(|building| building.height_ratio);
    cell(formula("z/H"), or_dash(ratio, stated));
    let is_held = matches!(table.before_activation, None | Some(Activation::Rigid));
    cell("before rocking".into(), if is_held { "held" } else { "free" }.into());
    let tie = case.wall.tie().map(|tie| tie.strength.map_or_else(|| "elastic".to_owned(), kilonewtons));
    cell("tie, N_y [kN]".into(), tie.unwrap_or_else(|| "–".to_owned()));
    let Some(side) = case.governing() else { return cells };
    cell(formula("h_1/h"), some(side.curve.hinge));
    cell("α0".into(), n(side.curve.alpha0));
    cell("a_0 [m/s²]".into(), n(side.curve.a0));
    cell("d_0 [mm]".into(), millimetres(side.curve.d0));
    cell("T_SLV [s]".into(), some(side.checks.slv.map(|check| check.period)));
    cell("S_d SLV [mm]".into(), or_dash(side.checks.slv.map(|check| check.demand), millimetres));
    let raised = side.by_displacement().filter(|(_, check)| check.raised);
    let raised: Vec<_> = raised.map(|(state, _)| state.key()).collect();
    cell("raised".into(), if raised.is_empty() { "–".to_owned() } else { raised.join(", ") });
    cells
}
