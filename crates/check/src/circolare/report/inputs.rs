//! The statements of the engineer, with where they come from.

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::TieNumbers;

use crate::circolare::outcome::Checked;
use crate::circolare::report::loads::of_tie;
use crate::circolare::statement::Statement;
use crate::circolare::statement::states::Source;
use crate::circolare::statement::table::{
    Activation, AtActivation, Hinge, LARGEST_CONFIDENCE_FACTOR, RecordScale, Rocks, STRESS_BLOCK,
};
use crate::sections::inputs::code;
use crate::sections::origin::Origin;
use crate::words::markup::{heads, table};
use crate::words::names::LimitState;
use crate::words::{Sentence, at_most, say};

/// What is stated, by which key, and where it comes from.
struct Stated {
    said: Sentence,
    /// Its key in a file; empty for what no key states.
    key: String,
    from: Sentence,
}

/// Describes the statements of the engineer, and where each comes from.
pub(super) fn statements(case: &Checked<'_>, origin: &Origin<'_>) -> String {
    let language = origin.report.language;
    let rows = all(case, origin).into_iter();
    let rows: Vec<_> = rows.map(|one| [one.said.markup(language), one.from.markup(language)]).collect();
    let parts = [say!("statement", "dichiarazione"), say!("from", "provenienza")];
    format!("<div class=\"from\">{}</div>", table(&heads(parts, language), &rows))
}

/// The keys by which a file makes the statements: what each says, its key, and where it comes from.
pub(super) fn keys(case: &Checked<'_>, origin: &Origin<'_>) -> Vec<[String; 3]> {
    let language = origin.report.language;
    let stated = all(case, origin).into_iter().filter(|one| !one.key.is_empty());
    stated.map(|one| [one.said.markup(language), code(&one.key), one.from.markup(language)]).collect()
}

fn all(case: &Checked<'_>, origin: &Origin<'_>) -> Vec<Stated> {
    let statement = case.statement;
    let mut rows: Vec<Stated> = Vec::new();
    let stated = |said: Sentence, keys: &[&str]| {
        let found = keys.iter().find(|key| origin.file.states(&["check", key]));
        let (key, from) = match found {
            Some(key) => (*key, say!("stated", "dichiarato")),
            None => (keys[0], say!("default", "valore predefinito")),
        };
        Stated { said, key: format!("check.{key}"), from }
    };
    let mut state = |said: Sentence, keys: &[&str]| rows.push(stated(said, keys));
    state(activation(statement), &["before_activation"]);
    if case.parameters.overburden > 0.0 {
        state(overburden(case), &["overburden_mass"]);
    }
    let is_dynamic = case.outcome.dynamic.is_some();
    if let Some(rocks) = statement.table.rocking {
        state(rocking(rocks, is_dynamic), &["rocking"]);
    }
    for said in of_ties(case) {
        state(said, &["tie"]);
    }
    state(confidence(statement), &["confidence_factor", "knowledge_level"]);
    state(compression(statement), &["compression_considered", "masonry_strength"]);
    if let Some(rule) = case.rule {
        state(hinge(rule, statement.hinge_range), &["hinge"]);
    }
    if let Some(range) = statement.table.crack_angles {
        state(crack(range), &["crack_angles"]);
    }
    let q = at_most(statement.behaviour_factor, 6);
    state(
        say!("Behaviour factor `q` = {q}.", "Fattore di comportamento `q` = {q}.", q),
        &["behaviour_factor"],
    );
    if let Some(class) = statement.table.use_class {
        let class = format!("{class:?}");
        state(say!("Use class {class}.", "Classe d'uso {class}.", class), &["use_class"]);
    }
    let (decides, clause) = statement.by_method();
    state(say!("{decides} ({clause}).", "{decides} ({clause}).", decides, clause), &["method"]);
    if is_dynamic {
        state(scale(statement.table.record_scale), &["record_scale"]);
    }
    if statement.building().is_some() {
        let said = say! {
            "T_1 of the building is stated by the engineer.",
            "T_1 dell'edificio è dichiarato dal progettista."
        };
        state(said, &["building"]);
    }
    for given in statement.states.iter().flatten() {
        let Some(xi) = given.building_damping else { continue };
        let said = say! {
            "The building has the damping ξ_k = {xi} in {name}.",
            "L'edificio ha lo smorzamento ξ_k = {xi} allo {name}.",
            xi = at_most(xi, 6), name = given.state
        };
        state(said, &[given.state.key(), "building_damping"]);
    }
    rows.extend(of_states(statement));
    rows
}

/// What holds for limit states, and what the method of the check takes.
fn of_states(statement: &Statement) -> Vec<Stated> {
    let mut rows = Vec::new();
    if let Some(u) = statement.state(LimitState::Slc).and_then(|given| given.displacement) {
        let u = at_most(u, 6);
        let said = say! {
            "Something else becomes unstable at `u` = {u} m and limits SLC.",
            "Un'altra instabilità locale a `u` = {u} m limita lo SLC.", u
        };
        let (key, from) = ("check.SLC.displacement".to_owned(), say!("stated", "dichiarato"));
        rows.push(Stated { said, key, from });
    }
    let by_method = |said: Sentence| {
        let (key, from) = (String::new(), say!("method of the check", "metodo della verifica"));
        Stated { said, key, from }
    };
    let said = say! {
        "There is one resultant of the forces on each body (C8.7.1.1), so that `e*` = 1.",
        "Su ogni corpo agisce una sola risultante delle forze (C8.7.1.1), per cui `e*` = 1."
    };
    rows.push(by_method(said));
    if statement.states.iter().flatten().any(|state| matches!(state.source, Source::Code(_))) {
        let said = say! {
            "The shape of each spectrum (`F0, T_C*, S, T_B, T_C, T_D, T_k, ξ_k`) is held at that of the site \
             while a_g varies.",
            "La forma di ogni spettro (`F0, T_C*, S, T_B, T_C, T_D, T_k, ξ_k`) resta quella del sito al \
             variare di a_g."
        };
        rows.push(by_method(said));
    }
    let missing = LimitState::ALL.into_iter().filter(|state| statement.state(*state).is_none());
    let missing: Vec<_> = missing.map(LimitState::key).collect();
    if !missing.is_empty() {
        let said = say! {
            "Not checked, no hazard is given: {missing} (NTC 8.3, 7.3.6).",
            "Non verificati: dati sismici non forniti per {missing} (NTC 8.3, 7.3.6).",
            missing = missing.join(", ")
        };
        rows.push(Stated { said, key: String::new(), from: say!("stated", "dichiarato") });
    }
    rows
}

fn rocking(rocks: Rocks, is_dynamic: bool) -> Sentence {
    let sides = match rocks {
        Rocks::TwoSided => say!("rocks to both sides.", "oscilla nei due versi."),
        Rocks::OneSidedPositive => {
            say!("rocks to the side u > 0 only: outwards.", "oscilla solo verso u > 0, verso l'esterno.")
        }
        Rocks::OneSidedNegative => {
            say!("rocks to the side u < 0 only: inwards.", "oscilla solo verso u < 0, verso l'interno.")
        }
    };
    // the runs rock as the scene does
    if is_dynamic {
        return say! {
            "In the static checks the wall {sides}", "Nelle verifiche statiche la parete {sides}", sides
        };
    }
    say!("The wall {sides}", "La parete {sides}", sides)
}

/// The strain at which the bar tears, and where that number comes from.
fn ultimate_strain(case: &Checked<'_>, tie: &TieNumbers) -> Option<Sentence> {
    let strain = at_most(tie.bar?.ultimate_strain?, 6);
    let which = of_tie(case, tie);
    let source = case.statement.table.tie.as_ref().and_then(|tie| tie.ultimate_strain_source.clone());
    let source =
        source.map_or_else(|| say!("its source is not stated", "fonte non dichiarata"), Sentence::same);
    Some(say! {
        "The bar{which} tears at `ε_u` = {strain}: {source}.",
        "Deformazione a rottura della barra{which} `ε_u` = {strain}: {source}.", which, strain, source
    })
}

/// What is stated of the ties; nothing without one.
fn of_ties(case: &Checked<'_>) -> Vec<Sentence> {
    if case.wall.ties().is_empty() {
        return Vec::new();
    }
    let at_activation = match case.statement.at_activation() {
        AtActivation::None => say! {
            "The tie does not count at the activation (SLD, SLV with q).",
            "All'attivazione la catena non è considerata (SLD, SLV con q)."
        },
        AtActivation::Yield => say! {
            "The tie pulls with its strength at the activation.",
            "All'attivazione la catena è in tensione e agisce con la propria resistenza."
        },
    };
    let whole = case.lowest();
    let strains = whole.parameters.ties().filter_map(|tie| ultimate_strain(whole, &tie));
    [at_activation].into_iter().chain(strains).collect()
}

fn scale(scale: RecordScale) -> Sentence {
    match scale {
        RecordScale::Ag => say! {
            "The peak of each record is brought to `a_g S`.",
            "Il picco di ogni accelerogramma è portato a `a_g S`."
        },
        RecordScale::None => {
            say!("The records are taken as they are.", "Gli accelerogrammi sono usati senza scalarli.")
        }
        RecordScale::Spectrum => say! {
            "The records are scaled to the spectrum of the ground (NTC 3.2.3.6).",
            "Gli accelerogrammi sono scalati allo spettro del suolo (NTC 3.2.3.6)."
        },
    }
}

fn compression(statement: &Statement) -> Sentence {
    let table = &statement.table;
    if let Some(strength) = table.masonry_strength.filter(|_| statement.masonry.is_some()) {
        let (gamma, block) = (table.masonry_gamma.unwrap_or(1.0), table.stress_block.unwrap_or(STRESS_BLOCK));
        // C8.7.1 asks for 2 with design values
        let instead = if gamma == 2.0 {
            Sentence::default()
        } else {
            say!(" in place of 2 (C8.7.1)", " anziché 2 (C8.7.1)")
        };
        say! {
            "The hinges are set back for the compressive strength of the masonry: f_m = {strength} MPa, `γ` \
             = {gamma}{instead}, `κ` = {block}.",
            "Le cerniere sono arretrate per la resistenza a compressione della muratura: f_m = {strength} \
             MPa, `γ` = {gamma}{instead}, `κ` = {block}.",
            strength = at_most(1e-6 * strength, 6), gamma, instead, block
        }
    } else if table.compression_considered {
        say! {
            "The hinges are set back for the compressive strength of the masonry.",
            "Le cerniere sono arretrate per la resistenza a compressione della muratura."
        }
    } else {
        say! {
            "The limited compressive strength of the masonry is neglected: hinges are at the edges.",
            "La limitata resistenza a compressione della muratura è trascurata: le cerniere sono agli \
             spigoli."
        }
    }
}

/// The rule on the hinge of a strip.
fn crack(range: [f64; 2]) -> Sentence {
    let [from, to] = range.map(|angle| at_most(angle, 4));
    say! {
        "The crack of a wedge is searched from {from}° to {to}° from the vertical, at the least α0 \
         (C8.7.1.2.1.1).",
        "La lesione del cuneo è cercata tra {from}° e {to}° dalla verticale, al minimo α0 (C8.7.1.2.1.1).",
        from, to
    }
}

fn hinge(rule: Hinge, range: [f64; 2]) -> Sentence {
    let [from, to] = range.map(|end| at_most(end, 6));
    match rule {
        Hinge::Worst => say! {
            "Intermediate hinge: the least favourable from {from} h to {to} h, of each check.",
            "Cerniera intermedia: la più sfavorevole tra {from} h e {to} h, per ogni verifica.", from, to
        },
        Hinge::LeastAlpha0 => say! {
            "Intermediate hinge: that of the least multiplier (C8.7.1.2.1.1).",
            "Cerniera intermedia: quella del moltiplicatore minimo (C8.7.1.2.1.1)."
        },
        Hinge::Given => say!("Intermediate hinge: as given.", "Cerniera intermedia: come fornita."),
    }
}

fn activation(statement: &Statement) -> Sentence {
    match statement.table.before_activation {
        Some(Activation::Law) => say! {
            "The wall is a free element (C8.7.1.2.1.5); before it rocks it is elastic as its force law.",
            "La parete è un elemento libero di vibrare (C8.7.1.2.1.5), con il ramo elastico iniziale della \
             sua legge."
        },
        Some(Activation::Beam) => say! {
            "The wall is a free element (C8.7.1.2.1.5); before it rocks it is a uniform beam with `E` = \
             {modulus} MPa.",
            "La parete è un elemento libero di vibrare (C8.7.1.2.1.5); prima dell'oscillazione è una trave \
             uniforme con `E` = {modulus} MPa.",
            modulus = at_most(1e-6 * statement.table.young_modulus.unwrap_or(f64::NAN), 6)
        },
        Some(Activation::Rigid) => say! {
            "The wall is held by transverse walls before it rocks (C8.7.1.2.1.5): it is rigid.",
            "La parete è vincolata alle pareti trasversali (C8.7.1.2.1.5): è infinitamente rigida fino \
             all'attivazione."
        },
        None => say! {
            "The wall rocks to one side, against transverse walls that hold it before: it is rigid \
             (C8.7.1.2.1.5).",
            "La parete oscilla da un solo lato, contro pareti trasversali che prima la vincolano: è \
             infinitamente rigida (C8.7.1.2.1.5)."
        },
    }
}

fn overburden(case: &Checked<'_>) -> Sentence {
    if case.parameters.mechanism == Mechanism::VerticalSpanning {
        return say! {
            "The top is held: the mass of the overburden does not move with the wall.",
            "La sommità è trattenuta: la massa del carico non si muove con la parete."
        };
    }
    let r = case.statement.table.overburden_mass.unwrap_or(0.0);
    let meaning = if r == 0.0 {
        say!(": its inertia goes elsewhere", ": la sua inerzia va altrove")
    } else {
        Sentence::default()
    };
    say! {
        "The share `r` = {r} of the overburden's mass moves with the wall{meaning}.",
        "La frazione `r` = {r} della massa del carico in sommità si muove con la parete{meaning}.",
        r = at_most(r, 6), meaning
    }
}

fn confidence(statement: &Statement) -> Sentence {
    let factor = statement.confidence_factor;
    let level = statement.table.knowledge_level.map(|level| {
        let level = format!("{level:?}");
        say!(" (level of knowledge {level})", " (livello di conoscenza {level})", level)
    });
    let level = level.unwrap_or_default();
    let why = if statement.masonry.is_some() {
        if statement.table.masonry_over_fc == Some(false) {
            say!(", applied to a, not to f_m", ", applicato ad a e non a f_m")
        } else {
            say!(", applied to a and f_m", ", applicato ad a e a f_m")
        }
    } else if statement.table.compression_considered {
        say! {
            ": hinges are set back for compression, so that the level of knowledge reached counts (C8.5.4)",
            ": le cerniere sono arretrate per la compressione, per cui vale il livello di conoscenza \
             raggiunto (C8.5.4)"
        }
    } else if factor > LARGEST_CONFIDENCE_FACTOR {
        say!(": more than that of LC1", ": superiore a quello di LC1")
    } else {
        say! {
            ": that of LC1, which applies where the compressive strength is neglected (C8.7.1.2.1.3)",
            ": quello di LC1, che vale se la resistenza a compressione è trascurata (C8.7.1.2.1.3)"
        }
    };
    let factor = at_most(factor, 6);
    say!("FC = {factor}{level}{why}.", "FC = {factor}{level}{why}.", factor, level, why)
}
