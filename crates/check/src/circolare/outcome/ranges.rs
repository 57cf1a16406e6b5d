//! What is outside the ranges of the code: damping, the use coefficient, the force of a tie.

use crate::circolare::curve::Curve;
use crate::circolare::curve::case::Case;
use crate::circolare::statement::Statement;
use crate::circolare::statement::states::StateStatement;
use crate::circolare::statement::table::UseClass;
use crate::code::sought::{LARGE, load};
use crate::words::names::LimitState;
use crate::words::{Sentence, at_most, say};

/// Damping of masonry buildings, C8.7.1.2.1.4: from that of small motions to that of ultimate limit states
/// \[-\].
const OF_BUILDINGS: [f64; 2] = [0.05, 0.20];

/// What is stated outside the ranges of the code.
pub(super) fn of_statement(statement: &Statement) -> Vec<Sentence> {
    let states = || statement.states.iter().flatten();
    let has_building = statement.building().is_some();
    let of_mechanism = states().filter_map(damping);
    let of_building = states().filter(|_| has_building).filter_map(building_damping);
    of_mechanism.chain(of_building).chain(use_coefficient(statement)).collect()
}

/// Where the least α0 is at an end of the angles in which a crack is searched.
pub(super) fn of_crack(case: &Case<'_>) -> Option<Sentence> {
    let ([from, to], angle) = (case.statement.table.crack_angles?, case.crack?);
    let is_at = |end: f64| (angle - end).abs() < 1e-6;
    let end = at_most(if is_at(from) { from } else { to }, 4);
    if is_at(from) {
        Some(say! {
            "the least alpha0 is at the smallest angle of the crack, {end}°: it falls with the wedge; \
             without one it is simple overturning, to be checked unless the walls are well connected",
            "il minimo α0 è alla minima inclinazione della lesione, {end}°: α0 diminuisce con il cuneo; in \
             sua assenza è il ribaltamento semplice, da verificare se l'ammorsamento non è efficace", end
        })
    } else {
        is_at(to).then(|| {
            say! {
                "the least alpha0 is at the largest angle of the crack, {end}°: beyond it may be lower",
                "il minimo α0 è alla massima inclinazione della lesione, {end}°: oltre può essere minore", end
            }
        })
    }
}

fn damping(given: &StateStatement) -> Option<Sentence> {
    let (state, of_code) = (given.state, given.state.damping());
    (state != LimitState::Sld && given.damping != of_code).then(|| {
        let [stated, printed] = [given.damping, of_code].map(|xi| at_most(100.0 * xi, 4));
        say! {
            "{state}: the mechanism has ξ = {stated} %; C8.7.1.2.1.8 has {printed} %",
            "{state}: il meccanismo ha ξ = {stated} %; C8.7.1.2.1.8 prevede {printed} %",
            state, stated, printed
        }
    })
}

fn building_damping(given: &StateStatement) -> Option<Sentence> {
    let [least, most] = OF_BUILDINGS;
    let xi = given.building_damping.filter(|xi| !(least..=most).contains(xi))?;
    let [xi, least, most] = [xi, least, most].map(|xi| at_most(100.0 * xi, 4));
    Some(say! {
        "{state}: ξ_k = {xi} % of the building is outside {least} to {most} % (C8.7.1.2.1.4)",
        "{state}: ξ_k = {xi} % dell'edificio è fuori da {least} - {most} % (C8.7.1.2.1.4)",
        state = given.state, xi, least, most
    })
}

/// `C_U` of the site beside that of the class, NTC Tab. 2.4.II.
fn use_coefficient(statement: &Statement) -> Option<Sentence> {
    let (class, site) = (statement.table.use_class?, statement.table.site.as_ref()?);
    let of_class = match class {
        UseClass::I => 0.7,
        UseClass::II => 1.0,
        UseClass::III => 1.5,
        UseClass::IV => 2.0,
    };
    (site.use_coefficient != of_class).then(|| {
        let class = format!("{class:?}");
        say! {
            "C_U = {stated} is not that of class {class}, {of_class} (NTC Tab. 2.4.II)",
            "C_U = {stated} non è quello della classe {class}, {of_class} (NTC Tab. 2.4.II)",
            stated = site.use_coefficient, class, of_class
        }
    })
}

/// A tie whose force masonry hardly anchors.
pub(super) fn of_tie(case: &Case<'_>, curve: &Curve) -> Option<Sentence> {
    let largest = curve.ties().filter_map(|tie| tie.strength).reduce(f64::max)?;
    let ratio = largest / load(&case.parameters);
    (ratio > LARGE).then(|| {
        say! {
            "the tie has {ratio} of W + O: a large force for an anchor in masonry",
            "la catena ha {ratio} di W + O: un tiro elevato per un ancoraggio nella muratura",
            ratio = at_most(ratio, 3)
        }
    })
}
