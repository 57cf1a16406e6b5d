//! A wall in the table of walls of a report.

use rocking_wall::wall::Tie;

use crate::circolare::outcome::Checked;
use crate::circolare::statement::table::Activation;
use crate::sections::inputs::overview;
use crate::words::formulas::formula;
use crate::words::{Language, say};

/// Headings and cells: the wall, its place, what holds it, and the numbers of the side that governs.
pub(in crate::circolare) fn of(case: &Checked<'_>, language: Language) -> Vec<(String, String)> {
    let table = &case.statement.table;
    let stated = |value: Option<f64>| value.map_or("–".to_owned(), |value| language.stated(value));
    let some = |value: Option<f64>| language.or_dash(value);
    let mut cells = overview(&case.wall, &case.parameters, language);
    let mut cell = |head: String, text: String| cells.push((head, text));
    cell(formula("r"), stated(table.overburden_mass));
    cell(formula("z/H"), stated(case.height_ratio()));
    let is_held = matches!(table.before_activation, None | Some(Activation::Rigid));
    let held = if is_held { say!("held", "vincolata") } else { say!("free", "libera") };
    cell(say!("before rocking", "prima dell'attivazione").markup(language), held.markup(language));
    let elastic = || say!("elastic", "elastica").markup(language);
    let strength = |tie: &Tie| tie.strength.map_or_else(elastic, |strength| language.shown(1e-3 * strength));
    let ties: Vec<_> = case.wall.ties().iter().map(strength).collect();
    let ties = if ties.is_empty() { "–".to_owned() } else { ties.join(" + ") };
    cell(say!("tie, N_y [kN]", "catena, N_y [kN]").markup(language), ties);
    let Some(side) = case.governing() else { return cells };
    cell(formula("h_1/h"), some(side.curve.hinge));
    cell(formula("α0"), language.shown(side.curve.alpha0));
    cell(formula("a_0") + " [m/s²]", language.shown(side.curve.a0));
    cell(formula("d_0") + " [mm]", language.shown(1e3 * side.curve.d0));
    cell(formula("T_SLV") + " [s]", some(side.checks.slv.map(|check| check.period)));
    cell(formula("S_d") + " SLV [mm]", some(side.checks.slv.map(|check| 1e3 * check.demand)));
    let raised = side.by_displacement().filter(|(_, check)| check.raised);
    let raised: Vec<_> = raised.map(|(state, _)| state.key()).collect();
    let heading = say!("raised", "innalzati dallo SLD").markup(language);
    cell(heading, if raised.is_empty() { "–".to_owned() } else { raised.join(", ") });
    cells
}
