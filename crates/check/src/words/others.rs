//! The Italian of what the crates below say in English: parameters, their choices, and warnings of a wall.

use ::report::number;
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Parameters, Warning};
use scene::{Floors, HeavyWall, LIGHT};

use super::{Language, Sentence, say};

/// A warning of a number that is improbable.
pub(crate) fn improbable(warning: &Warning) -> Sentence {
    let english = warning.to_string();
    let Warning::Unusual { name, value, unit, usual: [least, most], meant } = warning else {
        return Sentence::same(english);
    };
    let [value, least, most] = [value, least, most].map(|value| Language::It.decimal(&number(*value, 6)));
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let remedy = match meant {
        Some((other, own)) => {
            let other = match *other {
                "in per cent" => "in percento",
                "in g/10 or m/s2" => "in g/10 o m/s2",
                "in g and not in g/10" => "in g e non in g/10",
                "without its decimal point" => "senza il punto decimale",
                other => other,
            };
            format!("se è {other}, dare {}{unit}", Language::It.decimal(&number(*own, 6)))
        }
        None => "controllare valore e unità".to_owned(),
    };
    let key = *name;
    let name = match key {
        "period of the building" => "il periodo dell'edificio",
        "period of a storey" => "il periodo di un piano",
        "a_g of the grid at T_R = 475 years" => "a_g del reticolo a T_R = 475 anni",
        "a_g of the grid at T_R = 30 years" => "a_g del reticolo a T_R = 30 anni",
        name => name,
    };
    let usual = format!(" = {value}{unit} è insolito: è usuale da {least} a {most}{unit}; {remedy}");
    let told = Sentence::new(&*english, format!("{name}{usual}"));
    // a page has no names of parameters
    let Some(variable) = scene::variable(key) else { return told };
    let described = described(variable.description, key);
    let page =
        Sentence::new(english.replacen(key, &described, 1), format!("{}{usual}", described.of(Language::It)));
    told.on_page(page)
}

/// A wall that is heavy beside its floor.
pub(crate) fn heavy(wall: HeavyWall) -> Sentence {
    let ratio = Language::It.decimal(&format!("{:.2}", wall.ratio));
    let italian = format!(
        "la parete ha {ratio} della massa del suo piano, che si muove come se la parete non ci fosse; \
         oltre {} usare `wall building`, le cui pareti agiscono sui piani",
        Language::It.decimal(&LIGHT.to_string())
    );
    Sentence::new(wall.to_string(), italian)
}

/// The storeys below a wall in a few words.
pub(crate) fn storeys(floors: &Floors) -> Sentence {
    let english = floors.note();
    let periods = english.split_once("T = ").map_or("", |(_, periods)| periods);
    let count = floors.storeys().storeys().len();
    let name = if count == 1 { "un piano".to_owned() } else { format!("{count} piani") };
    let periods = Language::It.decimal(&periods.replace(", ", "; "));
    Sentence::new(english.clone(), format!("trasmesso da {name}, T = {periods}"))
}

/// The mechanism, as codes name it: compound where the wall takes wedges of others along.
pub(crate) fn mechanism(parameters: &Parameters) -> Sentence {
    let has_wedge = parameters.profile.as_ref().is_some_and(|profile| !profile.hanging().is_empty());
    match parameters.mechanism {
        _ if has_wedge => say!("compound overturning", "ribaltamento composto"),
        Mechanism::Parapet | Mechanism::RigidBody => say!("simple overturning", "ribaltamento semplice"),
        Mechanism::VerticalSpanning => say!("vertical bending (strip)", "flessione verticale"),
    }
}

/// What a parameter is. Its description says that first; behind a semicolon, for who states it, what follows
/// from some values.
pub(crate) fn described(description: &str, name: &str) -> Sentence {
    let english = description.split("; ").next().unwrap_or_default();
    Sentence::new(english, italian(name).unwrap_or(english))
}

/// The Italian of what a parameter is.
fn italian(name: &str) -> Option<&'static str> {
    Some(match name {
        "mechanism" => "Meccanismo",
        "height" => "Altezza della parete",
        "thickness" => "Spessore della parete",
        "width" => "Larghezza considerata",
        "density" => "Massa volumica della muratura",
        "gravity" => "Accelerazione di gravità",
        "hinge_ratio" => "Quota della cerniera intermedia, frazione dell'altezza",
        "overburden" => "Forza verticale in sommità, senza massa, per tutta la larghezza",
        "overburden_eccentricity" => {
            "Distanza del carico in sommità dal centro della sezione, positiva verso l'esterno (u > 0)"
        }
        "eccentricity_mode" => "Se l'eccentricità cambia lato con la parete",
        "force_law" => "Forma della forza di richiamo",
        "a1" => "Fine del ramo elastico, frazione di u_ins",
        "a3" => "Fine del ramo decrescente, frazione di u_ins",
        "d1" => "Forza del tratto costante, frazione di F0",
        "softening" => "Grandezza che il ramo decrescente conserva per terminare ad a3",
        "damping_model" => "Smorzamento continuo",
        "xi" => "Smorzamento sul ramo elastico",
        "c_bar" => "Costante di smorzamento di un blocco libero",
        "impact" => "Che cosa accade quando la parete passa per lo spostamento nullo",
        "restitution_source" => "Come il coefficiente di restituzione è calcolato dalla geometria",
        "restitution" => "Coefficiente di restituzione agli urti e dello smorzamento",
        "u_start" => "Spostamento iniziale",
        "u_dot_start" => "Velocità iniziale",
        "solver" => "Metodo di integrazione",
        "tolerance" => "Tolleranza relativa del solutore adattivo",
        "newmark_step" => "Passo di integrazione del solutore newmark",
        "tie_height" => "Quota della catena sopra la base",
        "tie_stiffness" => "Rigidezza assiale della catena",
        "tie_slack" => "Spostamento della parete alla catena prima che questa tiri",
        "tie_strength" => "Resistenza della catena (snervamento, o stato limite se elastica)",
        "tie_side" => "Verso trattenuto dalla catena",
        "rocking" => "Versi in cui la parete può oscillare",
        "tie_ultimate" => "Allungamento plastico a rottura della catena",
        "body_mass" => "Massa del corpo rigido, senza i carichi",
        "centroid_height" => "Quota del baricentro sopra la base",
        "inertia" => "Momento d'inerzia rispetto alla base",
        "arm" => "Distanza del baricentro dalla cerniera esterna",
        "arm_inner" => "Distanza del baricentro dalla cerniera interna",
        "load_force" => "Somma dei carichi verticali",
        "load_height" => "Quota dei carichi",
        "load_arm" => "Distanza dei carichi dalla cerniera esterna",
        "load_mass" => "Massa dei carichi che si muove con il corpo",
        "load_mass_height" => "Quota della massa dei carichi",
        "load_inertia" => "Momento d'inerzia della massa dei carichi",
        "thrust" => "Somma delle spinte verso l'esterno",
        "thrust_height" => "Quota delle spinte",
        "bar_diameter" => "Diametro della barra",
        "bar_length" => "Lunghezza libera tra gli ancoraggi",
        "bar_young_modulus" => "Modulo di elasticità della barra",
        "bar_yield_stress" => "Tensione di snervamento di progetto",
        "bar_ultimate_strain" => "Deformazione a rottura della barra",
        "bar_anchor_capacity" => "Forza di rottura fragile di un ancoraggio",
        "bar_spacing" => "Interasse delle barre lungo la parete",
        _ => return None,
    })
}

/// A choice of a parameter by its name in scenes.
pub(crate) fn choice(name: &str) -> Sentence {
    let english = name.replace('_', " ");
    let italian = match name {
        "vertical_spanning" => "flessione verticale",
        "parapet" => "parapetto",
        "rigid_body" => "corpo rigido",
        "fixed_to_wall" => "fissa alla parete",
        "follows_pivot" => "segue la cerniera",
        "rigid_linear" => "rigida lineare",
        "bilinear" => "bilineare",
        "trilinear" => "trilineare",
        "multilinear" => "multilineare",
        "parallel" => "parallela",
        "rotated" => "ruotata",
        "chord" => "corda",
        "none" => "nessuno",
        "constant_coefficient" => "coefficiente costante",
        "free_standing_block" => "blocco isolato",
        "constant_ratio" => "rapporto costante",
        "stiffness_proportional" => "proporzionale alla rigidezza",
        "restitution" => "restituzione",
        "two_sided" => "entrambi i versi",
        "one_sided_positive" => "solo verso positivo",
        "one_sided_negative" => "solo verso negativo",
        "analytic" => "analitico",
        "calibrated" => "calibrato",
        "momentum" => "quantità di moto",
        "impulses" => "impulsi",
        "positive" => "positivo",
        "negative" => "negativo",
        "both" => "entrambi",
        "automatic" => "automatico",
        "exact" => "esatto",
        "adaptive" => "adattivo",
        _ => &english,
    };
    Sentence::new(english.clone(), italian)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking_wall::variables::DampingModel;
    use rocking_wall::wall::Bar;
    use scene::{GROUPS, variable};

    #[test]
    fn each_parameter_has_its_italian() {
        let names = GROUPS.into_iter().flat_map(|(_, names)| names.iter().copied());
        let of_bar = Bar::NUMBERS.map(|number| number.usual.name);
        let of_wall = names.filter(|name| variable(name).is_some());
        let missing: Vec<_> = of_wall.chain(of_bar).filter(|name| italian(name).is_none()).collect();
        assert!(missing.is_empty(), "add the Italian of {missing:?}");
    }

    #[test]
    fn each_damping_model_has_its_italian() {
        for model in DampingModel::ALL {
            let said = choice(model.name());
            assert_ne!(said.of(Language::It), &*said, "add the Italian of {}", model.name());
        }
    }
}
