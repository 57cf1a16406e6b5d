//! Why no value of a search brings a check to pass.

use rocking_wall::wall::TiePart;

use super::checks::sides::SideVerdict;
use super::statement::Statement;
use super::statement::table::AtActivation;
use crate::code::Subject;
use crate::code::sought::Sought;
use crate::words::names::Deciding;
use crate::words::{Sentence, apart, fixed, say};

/// Says what blocks a check of a wall that has the last value of a search.
pub(super) fn reason(
    statement: &Statement,
    subject: Subject<'_>,
    check: &str,
    sought: Sought,
) -> Option<Sentence> {
    let which = Deciding::ALL.into_iter().find(|deciding| deciding.name() == check)?;
    let checked = match statement.checked(subject) {
        Ok(checked) => checked,
        Err(error) => {
            let error = error.to_string();
            return Some(say! {
                "at the end of the range it is refused: {error}",
                "all'estremo dell'intervallo la verifica non è possibile: {error}", error
            });
        }
    };
    let zeta = |side: &SideVerdict| side.checks.zetas()[which as usize];
    let sides = &checked.outcome.sides;
    let (side, verdict) = sides.iter().min_by(|a, b| zeta(a.1).total_cmp(&zeta(b.1)))?;
    let reached = fixed(zeta(verdict), 3);
    let reached = say! {
        "{reached} at the end of the range", "{reached} all'estremo dell'intervallo", reached
    };
    if !sought.is_of_tie() {
        return Some(reached);
    }
    let by_acceleration = matches!(which, Deciding::Sld | Deciding::SlvWithQ);
    let broken = verdict.curve.tie_break().filter(|_| !by_acceleration);
    let share = statement.rules(which.state()).fraction;
    let limit = share * verdict.curve.d0 / verdict.curve.d_per_u;
    let why = match (verdict.tie, broken) {
        (None, _) => say! {
            "{side}: the side without a tie governs",
            "{side}: è determinante il verso senza catena", side = side.name()
        },
        _ if by_acceleration && statement.at_activation() == AtActivation::None => say! {
            "at_activation = \"none\": the tie does not count at the activation",
            "at_activation = \"none\": all'attivazione la catena non è considerata"
        },
        (_, Some(broken)) if broken.u < limit => {
            let [breaks, limit] = apart([broken.u, limit].map(|u| 1e3 * u), 4);
            say! {
                "the tie breaks at u_r = {breaks} mm, before {share} u_0 = {limit} mm: untied whatever its \
                 strength",
                "la catena si rompe a u_r = {breaks} mm, prima di {share} u_0 = {limit} mm: come senza \
                 catena, qualunque sia la resistenza", breaks, share, limit
            }
        }
        _ if checked.parameters.weaker_part() == Some(TiePart::Anchor) => {
            say!("the anchor gives way before the bar", "l'ancoraggio cede prima della barra")
        }
        _ => say!("the wall needs more than the range has", "la parete richiede più di quanto cercato"),
    };
    Some(say!("{reached}: {why}", "{reached}: {why}", reached, why))
}
