//! The rest of what a check by Circolare 7/2019 refuses and warns of: statements without effect, records,
//! searches that find nothing.

use check::{CheckFile, Found, Language, Sought, find, read};
use scene::Scene;

use crate::circolare::{PARAPET, checked, refuses, warns};
use crate::circolare_hinges::{facade, strip};

const SITE: &str = "{ ag = 0.15, F0 = 2.45, TC = 0.32 }";
const STIFF: &str = "tie_stiffness = 5e6\ntie_strength = 10e3";
const YIELD: &str = "tie.at_activation = \"yield\"";

/// A rigid parapet on soil B, with more of its scene and of its table.
fn parapet(scene: &str, more: &str) -> String {
    format!(
        "{PARAPET}{scene}\n[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\nbefore_activation = \"rigid\"\n\
         {more}\n"
    )
}

#[test]
fn statements_without_effect_are_warned_of() {
    let slv = |more: &str| parapet("", &format!("SLV = {SITE}\n{more}"));
    let storeys = |of: &str| format!("[[storeys]]\n{of}\n");
    let damped = "SLV = { ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }\n";
    let building = format!("{damped}building = {{ storeys = 3, period = 0.3, height_ratio = 1 }}");
    for (text, message) in [
        (
            slv("").replace("TC = 0.32 }", "TC = 0.32, building_damping = 0.1 }"),
            "SLV: building_damping and building_period have no effect without [check.building]",
        ),
        (slv("overburden_mass = 1"), "overburden_mass has no effect: it is for a parapet with overburden"),
        (
            slv("compression_considered = true"),
            "compression_considered with a3 = 1 puts the hinges at the edges: give the reduced thickness",
        ),
        (slv("confidence_factor = 1.5"), "FC = 1.5 is above that of LC1, 1.35 (C8.5.4)"),
        (
            parapet(&storeys("period = 0.3"), &building),
            "the static checks use [check.building]; runs under records use [[storeys]]",
        ),
        // the wall has 2880 kg, 0.29 of this floor
        (
            parapet(&storeys("mass = 10e3\nperiod = 0.3"), damped),
            "above 0.05 use `wall building`, whose walls act on the floors; the check is then on the safe \
             side (C8.7.1.2.1.4)",
        ),
    ] {
        warns(&text, message);
    }
}

#[test]
fn spectra_and_sites_that_contradict_themselves_are_refused() {
    let slv = |given: &str| parapet("", &format!("SLV = {{ {given} }}"));
    let spectrum = "ag = 0.15, spectrum = [[0, 0.2], [4, 0.01]]";
    let height = "SLV = { ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }\n\
                  building = { modes = [{ period = 0.3, participation = 0 }] }";
    let records = format!(
        "SLV = {SITE}\nrecord_range = [2.0, 0.15]\nrecord_scale = \"spectrum\"\n\
         records = {{ synthetic = {{ count = 3, duration = 10, step = 0.02 }} }}"
    );
    let scaled = "SLV = { ag = 0.15, spectrum = [[0, 0.2], [4, 0.01]], spectrum_damping = 0.08 }\n\
                  method = \"dynamic\"\nrecord_scale = \"spectrum\"\nrecords = { synthetic = { count = 3, \
                  duration = 10, step = 0.02 } }";
    for (text, message) in [
        (slv(spectrum), "or ag with a spectrum and spectrum_damping"),
        (slv(&format!("{spectrum}, spectrum_damping = 0.08, F0 = 2.45, TC = 0.3")), "SLV: needs its site"),
        (slv("ag = 0.15, F0 = 2.45, TC = 0.3, spectrum_damping = 0.08"), "SLV: needs its site"),
        (parapet("", height), "SLV: a_Z = 0: the wall stands on the ground; leave [check.building] out"),
        (parapet("", &records), "record_range = [2, 0.15] s must rise from above 0"),
        (
            parapet("", scaled),
            "record_scale = \"spectrum\" needs S of F0 and TC; give them, or record_scale = \"none\"",
        ),
        (
            slv(&format!("{}, building_period = 0", &SITE[2..SITE.len() - 2])),
            "SLV.building_period = 0 must be",
        ),
    ] {
        refuses(&text, message);
    }
}

/// What ends a limit state by displacement, or keeps the masonry of another law from being set back.
#[test]
fn walls_without_a_curve_for_the_limit_state_are_refused() {
    let no_slv = |text: String| {
        text.lines()
            .filter(|line| !line.starts_with("SLV"))
            .fold(String::new(), |all, line| all + line + "\n")
    };
    let strong = |law: &str| {
        let text = strip(0.03, "hinge_ratio = 0.5", "before_activation = \"law\"\nmasonry_strength = 1.5e6");
        text.replace("[force_law]\na1 = 0.03", &format!("[force_law]\n{law}"))
    };
    for (text, message) in [
        // u_1 = a1 u_0 is beyond 0.6 u_0
        (
            no_slv(strip(0.7, "hinge_ratio = 0.5", "before_activation = \"law\"")),
            "SLC: the elastic branch ends",
        ),
        (strong("a1 = 0.03\nsoftening = \"rotated\""), "leave out a3 and softening of [force_law]"),
        (
            strong("force_law = \"multilinear\"\npoints = [[0.05, 0.9], [1.0, 0.0]]"),
            "a trilinear or multilinear law has its own",
        ),
    ] {
        let error = Scene::parse("scene.toml", &text, ".".as_ref()).map(|_| checked(&text));
        let error = error.map_or_else(|error| error.to_string(), |checked| checked.expect_err(message));
        assert!(error.contains(message), "{error}\nexpected {message}\nfor {text}");
    }
}

/// A check says what a statement leaves out, and which side governs where one has no tie.
#[test]
fn what_turns_a_verdict_is_said() {
    let beam = strip(0.03, "hinge_ratio = 0.5", "before_activation = \"beam\"\nyoung_modulus = 1e9");
    let beam: String =
        beam.lines().filter(|line| !line.starts_with("SLC")).map(|line| line.to_owned() + "\n").collect();
    warns(&beam, "young_modulus turns the verdict: with E = ");
    // SLC has 0.948 by displacement at this hinge, and a_g,SLD above its own
    let raised = strip(0.03, "hinge_ratio = 0.82", "before_activation = \"rigid\"");
    warns(&raised, "; the text has the raise for SLV only");
    let tied = facade(&format!("{STIFF}\ntie_ultimate = 0.3"), YIELD);
    warns(&tied, "u < 0: no tie holds this side; the side without a tie governs");
    let strong = facade("", "rocking = \"two_sided\"");
    assert!(!checked(&strong).unwrap().warnings.iter().any(|warning| warning.contains("no tie")));
    // with a high hinge so eccentric an overburden turns the wall over, with a low one it does not
    let low = strip(0.03, "hinge_ratio = 0.3", "before_activation = \"rigid\"");
    let eccentric = low.replace("eccentricity = 0.05", "eccentricity = 0.5");
    warns(&eccentric, "other hinges could not be searched: with the hinge at hinge_ratio = ");
}

/// What the runs of a dynamic check leave out, and records that are far from the spectrum.
#[test]
fn runs_under_records_say_what_they_leave_out() {
    let records = "method = \"dynamic\"\nrecords = { synthetic = { count = 3, duration = 10, step = 0.02 } }";
    let dynamic =
        |scene: &str, site: &str, more: &str| parapet(scene, &format!("SLV = {site}\n{records}\n{more}"));
    let tie = format!("[tie]\ntie_height = 3\n{STIFF}");
    let storey = "[[storeys]]\nperiod = 0.3\ndamping_ratio = 0.02\n";
    let damped = "{ ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }";
    let weak = "{ ag = 0.01, F0 = 2.45, TC = 0.32 }";
    for (text, message) in [
        (
            dynamic("overburden = 2e3", SITE, "overburden_mass = 1"),
            "the dynamic model has no mass on top: the overburden loads the wall without inertia",
        ),
        (
            dynamic(&tie, SITE, ""),
            "the tie of the dynamic model does not break: a run that reaches its strength fails",
        ),
        (
            dynamic(storey, damped, ""),
            "SLV: the runs have building_damping = 0.1 for every mode, not damping_ratio = 0.02 of",
        ),
        // the synthetic records have peaks of some m/s²
        (dynamic("", weak, ""), "0.25 to 4 is usual (C3.2.3.6)"),
        (dynamic("", SITE, ""), "SLV: a single record reaches "),
    ] {
        warns(&text, message);
    }
}

fn searched(text: &str, sought: Sought) -> Found {
    let scene = Scene::parse("scene.toml", text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", text).unwrap()).unwrap();
    find(&*code, (&scene).into(), sought).unwrap()
}

/// Why nothing is found, in the order of the specification; a large force is warned of.
#[test]
fn a_search_says_what_blocks_and_what_is_large() {
    let one = "rocking = \"one_sided_positive\"";
    let bar = |anchor: &str| {
        format!(
            "{one}\ntie = {{ at_activation = \"yield\", bar = {{ diameter = 0.016, length = 6, \
             yield_stress = 235e6, ultimate_strain = 0.3, spacing = 3{anchor} }} }}"
        )
    };
    let reason = |found: &Found, check: &str| {
        let one = found.checks.iter().find(|one| one.check == check).unwrap();
        one.reason.clone().unwrap_or_default()
    };
    // an anchor of 0.3 kN, 0.1 kN on a metre, whatever the bar
    let text = facade("", &bar(", anchor_capacity = 300"));
    let found = searched(&text, Sought::BarDiameter);
    let said = reason(&found, "SLD");
    assert!(said.contains("the anchor gives way before the bar"), "{said}");
    // a rupture before 0.4 u_0 or 0.6 u_0, u_0 = 0.203 m
    for (check, limit) in [("SLV", "before 0.4 u_0 = 81.17 mm"), ("SLC", "before 0.6 u_0 = 121.8 mm")] {
        assert!(reason(&found, check).contains(limit), "{}", reason(&found, check));
    }
    // a tie so soft does not act at the activation: u_y grows with its strength
    let soft = facade("tie_stiffness = 1.5e6\ntie_strength = 10e3", &format!("{one}\n{YIELD}"));
    let found = searched(&soft, Sought::TieStrength);
    let said = reason(&found, "SLV");
    assert!(said.contains("at the end of the range it is refused: ") && said.contains("u_y = "), "{said}");
    // neither the tie nor its sides are to blame where the site is too strong
    let strong = facade(&format!("{STIFF}\ntie_ultimate = 0.3"), &format!("{one}\n{YIELD}"))
        .replace("ag = 0.261", "ag = 1.0")
        .replace("TC = 0.347", "TC = 0.9")
        .replace("ag = 0.334", "ag = 1.0");
    let found = searched(&strong, Sought::TieStiffness);
    let said = reason(&found, "SLV with q");
    assert!(said.contains("needs more than the range has") && !said.contains("tie_side"), "{said}");
    let linear = format!("{one}\n{YIELD}\nmethod = \"linear\"\ntopography = \"T4\"");
    let large = facade(&format!("{STIFF}\ntie_ultimate = 0.3"), &linear).replace("ag = 0.261", "ag = 1.0");
    let text = searched(&large, Sought::TieStrength).text(Language::En);
    assert!(text.contains("of W + O: a large force for an anchor in masonry"), "{text}");
}
