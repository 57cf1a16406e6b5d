//! The loads of the wall, and its materials with the level of knowledge.

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Load, Opening, Parameters, Part, Profile, TieNumbers};

use crate::circolare::curve::level;
use crate::circolare::outcome::Checked;
use crate::circolare::statement::table::KnowledgeLevel;
use crate::words::formulas::formula;
use crate::words::markup::{heads, table};
use crate::words::{Language, Sentence, Written, say, shown};

/// A row: what it is, how it follows, and its value.
type Row = [String; 3];

/// The loads: own weight, overburden, parts, openings, loads and thrusts; of several bodies those of the
/// lowest, which has all.
pub(super) fn loads(case: &Checked<'_>, language: Language) -> String {
    let parameters = &case.lowest().parameters;
    let Parameters { height, thickness, width, density, gravity, mechanism, .. } = *parameters;
    let mut rows = Vec::new();
    if let Some(profile) = &parameters.profile {
        rows.extend(profile.parts().iter().map(|part| of_part(part, gravity, language)));
        let openings = profile.openings().iter();
        rows.extend(openings.map(|opening| of_opening(opening, profile, gravity, language)));
        let words = say!("Own weight `W`", "Peso proprio `W`");
        let how = say!("parts without openings", "porzioni al netto delle aperture").markup(language);
        rows.push(row(&words, how, 1e-3 * gravity * mass(profile), "kN", language));
    } else if mechanism == Mechanism::RigidBody {
        let mass = parameters.body_mass;
        let how =
            format!("{} = {} · {} · 10⁻³", formula("m g"), language.stated(mass), language.stated(gravity));
        let words = say!("Own weight `W`", "Peso proprio `W`");
        rows.push(row(&words, how, 1e-3 * mass * gravity, "kN", language));
    } else {
        let [h, b, l, rho] = [height, thickness, width, density].map(|value| language.stated(value));
        let weight = 1e-3 * density * gravity * height * thickness * width;
        let how = format!(
            "{} = {rho} · {} · {h} · {b} · {l} · 10⁻³",
            formula("ρ g h b l"),
            language.stated(gravity)
        );
        rows.push(row(&say!("Own weight `W`", "Peso proprio `W`"), how, weight, "kN", language));
    }
    rows.extend(level::loads(parameters).iter().map(|load| of_load(load, language)));
    let overburden = case.wall.body().overburden;
    if overburden > 0.0 && parameters.profile.is_none() {
        let per_metre = 1e-3 * overburden / width;
        let words = say!("Overburden `O`, in all", "Carico in sommità `O`, totale");
        let how = say!("stated, without mass", "dichiarato, senza massa").markup(language);
        rows.push(row(&words, how, 1e-3 * overburden, "kN", language));
        let words = say!("Overburden, per metre", "Carico in sommità, al metro");
        rows.push(row(&words, formula("O/l"), per_metre, "kN/m", language));
        let words = say!("Its eccentricity `c`, outwards", "Sua eccentricità `c`, verso l'esterno");
        let how = say!("stated", "dichiarata").markup(language);
        rows.push(row(&words, how, parameters.overburden_eccentricity, "m", language));
    }
    let parts = [say!("load", "carico"), say!("how", "origine"), say!("value", "valore")];
    table(&heads(parts, language), &rows)
}

fn row(words: &Sentence, how: String, value: f64, unit: &str, language: Language) -> Row {
    let value = language.shown(value).replace('-', "−");
    [words.markup(language), how, format!("<span class=\"value\">{value} {unit}</span>")]
}

fn written(value: f64) -> Written {
    Written(shown(value))
}

fn of_part(part: &Part, gravity: f64, language: Language) -> Row {
    let [lower, upper] = part.thickness;
    let [from, to] = part.width;
    // the mean of a product of two straight lines
    let section = (2.0 * (lower * from + upper * to) + lower * to + upper * from) / 6.0;
    let words = say! {
        "Part from {from} to {to} m", "Porzione da {from} a {to} m",
        from = written(part.base), to = written(part.base + part.height)
    };
    let how = say! {
        "thickness {thickness} m, width {width} m, {density} kg/m³",
        "spessore {thickness} m, larghezza {width} m, {density} kg/m³",
        thickness = between(part.thickness), width = between(part.width), density = written(part.density)
    };
    let weight = 1e-3 * part.density * gravity * section * part.height;
    row(&words, how.markup(language), weight, "kN", language)
}

/// A size at the bottom and at the top, once where both are alike.
fn between([lower, upper]: [f64; 2]) -> Sentence {
    if lower == upper {
        return say!("{lower}", "{lower}", lower = written(lower));
    }
    say!("{lower} to {upper}", "da {lower} a {upper}", lower = written(lower), upper = written(upper))
}

/// The mass of the masonry \[kg\].
fn mass(profile: &Profile) -> f64 {
    profile.centroid([0.0, profile.height()]).mass
}

fn of_opening(opening: &Opening, profile: &Profile, gravity: f64, language: Language) -> Row {
    let words = say! {
        "Opening from {from} to {to} m", "Apertura da {from} a {to} m",
        from = written(opening.base), to = written(opening.base + opening.height)
    };
    let how = say!("width {width} m", "larghezza {width} m", width = written(opening.width));
    let with = |openings| {
        let own = Profile::new(profile.parts().to_vec(), openings, Vec::new());
        mass(&own.expect("a profile is one with fewer openings"))
    };
    let taken = with(vec![*opening]) - with(Vec::new());
    row(&words, how.markup(language), 1e-3 * gravity * taken, "kN", language)
}

fn of_load(load: &Load, language: Language) -> Row {
    let words = say!("Load at {height} m", "Carico a {height} m", height = written(load.height));
    let how = say! {
        "at x = {inside} m, thrust {thrust} kN outwards, {share} of its mass moves along",
        "a x = {inside} m, spinta {thrust} kN verso l'esterno, quota {share} della massa in moto",
        inside = written(load.inside), thrust = written(1e-3 * load.thrust),
        share = written(load.moving_mass.unwrap_or(0.0))
    };
    row(&words, how.markup(language), 1e-3 * load.force, "kN", language)
}

/// Which of several ties is meant; nothing of one alone.
pub(super) fn of_tie(case: &Checked<'_>, tie: &TieNumbers) -> Sentence {
    if case.parameters.ties().count() < 2 {
        return Sentence::default();
    }
    let height = written(case.above_base(tie.height));
    say!(" of the tie at {height} m", " della catena a {height} m", height)
}

/// The materials, and the level of knowledge with its factor.
pub(super) fn materials(case: &Checked<'_>, language: Language) -> String {
    let (table_of_check, parameters) = (&case.statement.table, &case.parameters);
    let stated = || say!("stated", "dichiarato").markup(language);
    let mut rows = Vec::new();
    let mut weigh = |which: Sentence, density: f64| {
        let words =
            say!("Specific weight of the masonry{which}", "Peso specifico della muratura{which}", which);
        let [rho, g] = [density, parameters.gravity].map(|value| language.stated(value));
        let how = format!("{} = {rho} · {g} · 10⁻³", formula("ρ g"));
        rows.push(row(&words, how, 1e-3 * density * parameters.gravity, "kN/m³", language));
    };
    match case.lowest().parameters.profile.as_deref().map(Profile::parts) {
        Some([first, others @ ..]) if others.iter().all(|part| part.density == first.density) => {
            weigh(Sentence::default(), first.density);
        }
        Some(parts) => {
            for part in parts {
                let [from, to] = [part.base, part.top()].map(written);
                weigh(say!(" from {from} to {to} m", " da {from} a {to} m", from, to), part.density);
            }
        }
        None if parameters.mechanism == Mechanism::RigidBody => {}
        None => weigh(Sentence::default(), parameters.density),
    }
    if let Some(strength) = table_of_check.masonry_strength {
        let words = say!("Compressive strength f_m", "Resistenza a compressione f_m");
        rows.push(row(&words, stated(), 1e-6 * strength, "MPa", language));
    }
    if let Some(modulus) = table_of_check.young_modulus {
        let words = say!("Young's modulus `E`", "Modulo di elasticità `E`");
        rows.push(row(&words, stated(), 1e-6 * modulus, "MPa", language));
    }
    let whole = case.lowest();
    for tie in whole.parameters.ties() {
        let Some(bar) = tie.bar else { continue };
        let which = of_tie(whole, &tie);
        let words =
            say!("Yield stress of the bar{which}", "Tensione di snervamento della barra{which}", which);
        rows.push(row(&words, stated(), 1e-6 * bar.yield_stress, "MPa", language));
    }
    let level = match table_of_check.knowledge_level {
        Some(KnowledgeLevel::LC1) => Sentence::same("LC1"),
        Some(KnowledgeLevel::LC2) => Sentence::same("LC2"),
        Some(KnowledgeLevel::LC3) => Sentence::same("LC3"),
        None if table_of_check.confidence_factor.is_some() => say!("stated", "dichiarato"),
        None => say!("default", "valore predefinito"),
    };
    let words = say!("Confidence factor FC (C8.5.4)", "Fattore di confidenza FC (C8.5.4)");
    rows.push(row(&words, level.markup(language), case.statement.confidence_factor, "", language));
    let parts = [say!("material", "materiale"), say!("from", "origine"), say!("value", "valore")];
    table(&heads(parts, language), &rows)
}
