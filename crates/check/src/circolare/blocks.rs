//! Why no value of a search brings a check to pass.

use report::apart;
use rocking_wall::wall::TiePart;

use super::checks::sides::SideVerdict;
use super::statement::Statement;
use super::statement::table::AtActivation;
use crate::code::Subject;
use crate::code::sought::Sought;
use crate::words::names::Deciding;

/// Says what blocks a check of a wall that has the last value of a search.
pub(super) fn reason(
    statement: &Statement,
    subject: Subject<'_>,
    check: &str,
    sought: Sought,
) -> Option<String> {
    let which = Deciding::ALL.into_iter().find(|deciding| deciding.name() == check)?;
    let checked = match statement.checked(subject) {
        Ok(checked) => checked,
        Err(error) => return Some(format!("at the end of the range it is refused: {error}")),
    };
    let zeta = |side: &SideVerdict| side.checks.zetas()[which as usize];
    let sides = &checked.outcome.sides;
    let (side, verdict) = sides.iter().min_by(|a, b| zeta(a.1).total_cmp(&zeta(b.1)))?;
    let reached = format!("{:.3} at the end of the range", zeta(verdict));
    if !sought.is_of_tie() {
        return Some(reached);
    }
    let by_acceleration = matches!(which, Deciding::Sld | Deciding::SlvWithQ);
    let broken = verdict.curve.tie_break().filter(|_| !by_acceleration);
    let share = statement.rules(which.state()).fraction;
    let limit = share * verdict.curve.d0 / verdict.curve.d_per_u;
    let why = match (verdict.tie, broken) {
        (None, _) => format!("{}: the side without a tie governs", side.name()),
        _ if by_acceleration && statement.at_activation() == AtActivation::None => {
            "at_activation = \"none\": the tie does not count at the activation".into()
        }
        (_, Some(broken)) if broken.u < limit => {
            let [breaks, limit] = apart([broken.u, limit].map(|u| 1e3 * u), 4);
            format!(
                "the tie breaks at u_r = {breaks} mm, before {share} u_0 = {limit} mm: untied whatever its \
                 strength"
            )
        }
        _ if checked.parameters.weaker_part() == Some(TiePart::Anchor) => {
            "the anchor gives way before the bar".into()
        }
        _ => "the wall needs more than the range has".into(),
    };
    Some(format!("{reached}: {why}"))
}
