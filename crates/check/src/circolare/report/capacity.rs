//! The capacity curve: its numbers, and the curve over the demand.

use super::figure::over_demand;
use super::{SideLedger, by_side};
use crate::circolare::checks::sides::SideVerdict;
use crate::circolare::outcome::Checked;
use crate::error::CheckError;
use crate::sections::origin::Figure;
use crate::words::formulas::formula;
use crate::words::ledger::Ledger;
use crate::words::markup::{aligned, table};
use crate::words::names::{Deciding, Sides};
use crate::words::{Language, Sentence, Written, above, joined, say, shown, side as told_side};

pub(super) fn section(
    case: &Checked<'_>,
    sides: &[SideLedger<'_>],
    language: Language,
) -> Result<String, CheckError> {
    let mut text = by_side(case, sides, language, |one| {
        one.ledger.markup("curve", language) + &at_hinges(one, language)
    });
    for SideLedger { level: case, of, verdict, .. } in sides {
        if verdict.checks.slv.is_some() || verdict.checks.slc.is_some() {
            text += &figure(case, *of, verdict, language)?.html(language);
            if let Some(d) = cut(verdict) {
                text += &detail(case, *of, verdict, d, language)?.html(language);
            }
        }
    }
    Ok(text)
}

/// The curve of a side over the demands of SLV and SLC.
pub(in crate::circolare) fn figure(
    case: &Checked<'_>,
    of: Sides,
    side: &SideVerdict,
    language: Language,
) -> Result<Figure, CheckError> {
    let mut said = vec![say! {
        "Capacity curve over the demand, {side}. A wall passes by displacement where its circle lies right \
         of the triangle of the same colour.",
        "Curva di capacità e domanda, {side}. La verifica in spostamento è soddisfatta se il cerchio è a \
         destra del triangolo dello stesso colore.", side = above(told_side(of), case.stated_level())
    }];
    for (state, check) in side.by_displacement() {
        // the curve is that of the hinge that governs
        let own = check.hinge.filter(|hinge| Some(*hinge) != side.curve.hinge);
        said.extend(own.map(|hinge| {
            say! {
                "d_{state} is of the hinge `h_1/h` = {hinge}.",
                "d_{state} è riferito alla cerniera `h_1/h` = {hinge}.", state, hinge = Written(shown(hinge))
            }
        }));
    }
    let caption = joined(&said, " ").markup(language);
    Ok(Figure { caption, plot: over_demand(side, case.statement, &case.demands, None, language)? })
}

/// The share of the axis below which what a tie does cannot be read \[-\].
const HIDDEN: f64 = 0.3;

/// Where to cut the axis of d so that the tie can be read: at twice `u_r`, or `u_y` of a tie that lasts;
/// `None` where the whole curve shows it \[m\].
fn cut(side: &SideVerdict) -> Option<f64> {
    let tie = side.tie?;
    let d = 2.0
        * side.curve.d_per_u
        * tie.breaks.filter(|breaks| side.curve.d_per_u * breaks < side.curve.d0).or(tie.yields)?;
    (d > 0.0 && d < HIDDEN * side.curve.d0).then_some(d)
}

/// The beginning of the curve, up to d = `cut`.
fn detail(
    case: &Checked<'_>,
    of: Sides,
    side: &SideVerdict,
    cut: f64,
    language: Language,
) -> Result<Figure, CheckError> {
    let caption = say! {
        "The beginning of the curve, {side}, up to `d` = {d} mm: where the tie pulls and gives way.",
        "L'inizio della curva, {side}, fino a `d` = {d} mm: dove la catena tira e cede.",
        side = above(told_side(of), case.stated_level()), d = Written(shown(1e3 * cut))
    };
    let plot = over_demand(side, case.statement, &case.demands, Some(cut), language)?;
    Ok(Figure { caption: caption.markup(language), plot })
}

/// The numbers of a side at the hinges of all checks, by the formulas of the one that governs.
fn at_hinges(one: &SideLedger<'_>, language: Language) -> String {
    let side = one.verdict;
    if side.others.is_empty() {
        return String::new();
    }
    let hinges = Deciding::ALL.into_iter().filter_map(|check| Some((check, side.checks.hinge(check)?)));
    let at = |(check, hinge)| {
        let (of, curve) = (one.level.of(one.side), side.at(Some(hinge)));
        let mut ledger = of.ledger(curve);
        curve.add_to(of, &mut ledger);
        (check, ledger)
    };
    let (checks, ledgers): (Vec<Deciding>, Vec<Ledger>) = hinges.map(at).unzip();
    let all = [
        ("h_1/h", ""),
        ("F0", " [kN]"),
        ("t_b", " [mm]"),
        ("t_m", " [mm]"),
        ("F_act", " [kN]"),
        ("α0", ""),
        ("a_0", " [m/s²]"),
        ("k_0", " [kN/m]"),
        ("u_0", " [mm]"),
        ("d_0", " [mm]"),
        ("d_y", " [mm]"),
        ("a_y", " [m/s²]"),
        ("T0", " [s]"),
    ];
    let row = |(symbol, unit): (&str, &str)| {
        let cells: Vec<_> = ledgers.iter().map(|ledger| language.or_dash(ledger.number(symbol))).collect();
        let is_said = cells.iter().any(|cell| !matches!(&**cell, "0" | "–"));
        is_said.then(|| [formula(symbol) + unit, aligned(cells).join("</td><td>")])
    };
    let rows: Vec<_> = all.into_iter().filter_map(row).collect();
    let first = say!("at the hinge of each check", "alla cerniera di ogni verifica");
    let heads = [first].into_iter().chain(checks.iter().map(|check| say!("{check}", "{check}", check)));
    let heads: Vec<_> = heads.map(|head: Sentence| head.markup(language)).collect();
    format!("<div class=\"together\">{}</div>", table(&heads, &rows))
}
