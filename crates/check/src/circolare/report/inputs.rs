//! The statements of the engineer, with where they come from.

use crate::circolare::{Activation, Checked, LARGEST_CONFIDENCE_FACTOR, Source, Statement};
use crate::names::LimitState;
use crate::report::Origin;
use ::report::escaped;
use rocking_wall::variables::Mechanism;

use crate::circolare::table::{Hinge, STRESS_BLOCK};

use crate::report::markup::{formula, stated, table};

/// Describes the statements of the engineer, and where each comes from.
pub(super) fn statements(case: &Checked<'_>, origin: &Origin<'_>) -> String {
    let statement = case.statement;
    let mut rows = Vec::new();
    let mut state = |said: String, keys: &[&str]| {
        let stated = keys.iter().find(|key| origin.file.states(&["check", key]));
        rows.push([said, stated.map_or_else(|| "default".to_owned(), |key| format!("[check] {key}"))]);
    };
    state(activation(case), &["before_activation"]);
    if case.parameters.overburden > 0.0 {
        state(overburden(case), &["overburden_mass"]);
    }
    let is_dynamic = case.outcome.dynamic.is_some();
    if let Some(rocks) = statement.table.rocking {
        let sides = ["both sides.", "the side u > 0 only: outwards.", "the side u < 0 only: inwards."];
        // the runs rock as the scene does
        let wall = if is_dynamic { "In the static checks the wall" } else { "The wall" };
        state(escaped(&format!("{wall} rocks to {}", sides[rocks as usize])), &["rocking"]);
    }
    if case.wall.tie().is_some() {
        let said = [
            "The tie does not count at the activation (SLD, SLV with q).",
            "The tie pulls with its strength at the activation.",
        ];
        state(said[statement.at_activation() as usize].to_owned(), &["tie"]);
    }
    state(confidence(case), &["confidence_factor", "knowledge_level"]);
    state(compression(statement), &["compression_considered", "masonry_strength"]);
    if let Some(rule) = case.rule {
        state(hinge(rule, statement.hinge_range), &["hinge"]);
    }
    state(
        format!("Behaviour factor {} = {}.", formula("q"), stated(statement.behaviour_factor)),
        &["behaviour_factor"],
    );
    if let Some(class) = statement.table.use_class {
        state(format!("Use class {class:?}."), &["use_class"]);
    }
    let [method, decides, clause] = statement.by_method();
    state(format!("{method} {decides} ({clause})."), &["method"]);
    if is_dynamic {
        let peak = format!("The peak of each record is brought to {}.", formula("a_g S"));
        let said = [
            &*peak,
            "The records are taken as they are.",
            "The records are scaled to the spectrum of the ground (NTC 3.2.3.6).",
        ];
        state(said[statement.table.record_scale as usize].to_owned(), &["record_scale"]);
    }
    of_building(statement, &mut state);
    if let Some(u) = statement.state(LimitState::Slc).and_then(|given| given.displacement) {
        let said =
            format!("Something else becomes unstable at {} = {} m and limits SLC.", formula("u"), stated(u));
        rows.push([said, "[check] SLC displacement".to_owned()]);
    }
    let missing = LimitState::ALL.into_iter().filter(|state| statement.state(*state).is_none());
    let taken = |said: String| [said, "method of the check".to_owned()];
    let missing: Vec<_> = missing.map(|state| state.to_string()).collect();
    let one_body = "There is one resultant of the forces on each body (C8.7.1.1), so that e* = 1.".to_owned();
    rows.push(taken(one_body.replace("e*", &formula("e*"))));
    if statement.states.iter().flatten().any(|state| matches!(state.source, Source::Code(_))) {
        rows.push(taken(format!(
            "The shape of each spectrum ({}) is held at that of the site while a_g varies.",
            formula("F0, T_C*, S, T_B, T_C, T_D, T_k, ξ_k")
        )));
    }
    if !missing.is_empty() {
        rows.push([
            format!("Not checked, no hazard is given: {} (NTC 8.3, 7.3.6).", missing.join(", ")),
            "[check]".to_owned(),
        ]);
    }
    format!("<div class=\"from\">{}</div>", table(&["statement", "from"], &rows))
}

/// States what the building is.
fn of_building(statement: &Statement, state: &mut impl FnMut(String, &[&str])) {
    if statement.table.building.is_some() {
        state("T_1 of the building is stated by the engineer.".to_owned(), &["building"]);
    }
    for (given, xi) in
        statement.states.iter().flatten().filter_map(|given| Some((given, given.building_damping?)))
    {
        let said = format!("The building has the damping ξ_k = {} in {}.", stated(xi), given.state);
        state(said, &[given.state.key(), "building_damping"]);
    }
}

fn compression(statement: &Statement) -> String {
    let table = &statement.table;
    if let Some(strength) = table.masonry_strength.filter(|_| statement.masonry.is_some()) {
        let (gamma, block) = (table.masonry_gamma.unwrap_or(1.0), table.stress_block.unwrap_or(STRESS_BLOCK));
        // C8.7.1 asks for 2 with design values
        let instead = if gamma == 2.0 { "" } else { " in place of 2 (C8.7.1)" };
        let [f_m, g, k] = ["f_m", "γ", "κ"].map(formula);
        format!(
            "The hinges are set back for the compressive strength of the masonry: {f_m} = {} MPa, {g} = \
             {}{instead}, {k} = {}.",
            stated(1e-6 * strength),
            stated(gamma),
            stated(block)
        )
    } else if table.compression_considered {
        "The hinges are set back for the compressive strength of the masonry.".into()
    } else {
        "The limited compressive strength of the masonry is neglected: hinges are at the edges.".into()
    }
}

/// The rule on the hinge of a strip.
fn hinge(rule: Hinge, [from, to]: [f64; 2]) -> String {
    match rule {
        Hinge::Worst => format!(
            "Intermediate hinge: the least favourable from {} h to {} h, of each check.",
            stated(from),
            stated(to)
        ),
        Hinge::LeastAlpha0 => "Intermediate hinge: that of the least multiplier (C8.7.1.2.1.1).".into(),
        Hinge::Given => "Intermediate hinge: as given.".into(),
    }
}

fn activation(case: &Checked<'_>) -> String {
    let statement = case.statement;
    match statement.table.before_activation {
        Some(Activation::Law) => {
            "The wall is a free element (C8.7.1.2.1.5); before it rocks it is elastic as its force law."
                .into()
        }
        Some(Activation::Beam) => format!(
            "The wall is a free element (C8.7.1.2.1.5); before it rocks it is a uniform beam with {} = {} \
             MPa.",
            formula("E"),
            stated(1e-6 * statement.table.young_modulus.unwrap_or(f64::NAN))
        ),
        Some(Activation::Rigid) => {
            "The wall is held by transverse walls before it rocks (C8.7.1.2.1.5): it is rigid.".into()
        }
        None => "The wall rocks to one side, against transverse walls that hold it before: it is rigid \
                 (C8.7.1.2.1.5)."
            .into(),
    }
}

fn overburden(case: &Checked<'_>) -> String {
    if case.parameters.mechanism == Mechanism::VerticalSpanning {
        return "The top is held: the mass of the overburden does not move with the wall.".into();
    }
    let r = case.statement.table.overburden_mass.unwrap_or(0.0);
    let meaning = if r == 0.0 { ": its inertia goes elsewhere" } else { "" };
    format!(
        "The share {} = {} of the overburden's mass moves with the wall{meaning}.",
        formula("r"),
        stated(r)
    )
}

fn confidence(case: &Checked<'_>) -> String {
    let statement = case.statement;
    let factor = statement.confidence_factor;
    let level = statement.table.knowledge_level;
    let level = level.map_or_else(String::new, |level| format!(" (level of knowledge {level:?})"));
    let why = if statement.masonry.is_some() {
        let applied =
            if statement.table.masonry_over_fc == Some(false) { "a, not to f_m" } else { "a and f_m" };
        return format!("FC = {}{level}, applied to {applied}.", stated(factor));
    } else if statement.table.compression_considered {
        "hinges are set back for compression, so that the level of knowledge reached counts (C8.5.4)"
    } else if factor > LARGEST_CONFIDENCE_FACTOR {
        "more than that of LC1"
    } else {
        "that of LC1, which applies where the compressive strength is neglected (C8.7.1.2.1.3)"
    };
    format!("FC = {}{level}: {why}.", stated(factor))
}
