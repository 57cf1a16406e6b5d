//! What a check by Circolare 7/2019 refuses, and what it warns of.

use std::error::Error;

use check::{CheckFile, read};
use scene::Scene;

use crate::circolare::{PARAPET, checked, refuses};
use crate::circolare_bodies::facade;

const SITE: &str = "{ ag = 0.15, F0 = 2.45, TC = 0.32 }";

/// A table `[check]` on soil B of a rigid wall, with more keys.
fn table(more: &str) -> String {
    format!("[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\nbefore_activation = \"rigid\"\n{more}\n")
}

/// A table that states the activation itself.
fn open(more: &str) -> String {
    format!("[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\nSLV = {SITE}\n{more}\n")
}

#[test]
fn what_cannot_be_used_is_refused_with_the_remedy() {
    let slv = |site: &str| table(&format!("SLV = {{ {site} }}"));
    let with = |more: &str| table(&format!("SLV = {SITE}\n{more}"));
    let building = "building = { storeys = 3, period = 0.3, height_ratio = 1 }";
    let at_height = |more: &str, building: &str| {
        table(&format!("SLV = {{ ag = 0.15, F0 = 2.45, TC = 0.32{more} }}\nbuilding = {building}"))
    };
    let cases: &[(String, &str)] = &[
        (slv("ag = 0, F0 = 2.45, TC = 0.3"), "ag = 0 must be above 0 and at most 1: a_g on rigid ground [g]"),
        (slv("ag = 1.5, F0 = 2.45, TC = 0.3"), "ag = 1.5 must be above 0 and at most 1"),
        (slv("ag = 0.15, F0 = 2.1, TC = 0.3"), "F0 = 2.1 must be at least 2.2"),
        (slv("ag = 0.15, F0 = 2.45, TC = 0"), "TC = 0 must be above 0: T_C* [s]"),
        (slv("ag = 0.15, F0 = 2.45"), "SLV: needs its site: [check.SLV] with ag, F0 and TC"),
        (slv("ag = 0.15"), "needs its site: [check.SLV] with ag, F0 and TC"),
        (table(""), "SLV needs its site: [check.SLV] with ag, F0 and TC"),
        (
            slv("ag = 0.15, F0 = 2.45, TC = 0.3, damping = 8"),
            "damping = 8 must be above 0 and at most 0.5: Damping ratio",
        ),
        (slv("ag = 0.15, F0 = 2.45, TC = 0.3, displacement = 0.1"), "belongs to SLC (C8.7.1.2.1.6)"),
        (with("topography = 1.5"), "topography = 1.5 must be at least 1 and at most 1.4"),
        (with("topography = \"T5\""), "topography = \"T5\": expected \"T1\" to \"T4\", or S_T from 1 to 1.4"),
        (with("behaviour_factor = 0.5"), "behaviour_factor = 0.5 must be at least 1"),
        (with("confidence_factor = 0.9"), "confidence_factor = 0.9 must be at least 1"),
        (with("confidence_factor = 1.2"), "FC of LC1, 1.35, applies where compression is neglected"),
        (with("knowledge_level = \"LC3\""), "state compression_considered = true"),
        (with("confidence_factor = 1.35\nknowledge_level = \"LC1\""), "state the same; leave one out"),
        (with("overburden_mass = -1"), "overburden_mass = -1 must be at least 0"),
        (with("method = \"linear\"\n").replace("SLV", "SLC"), "SLV needs its site"),
        (with("method = \"dynamic\""), "needs records; add [check.records] with files"),
        (at_height("", "{ storeys = 0, period = 0.3, height_ratio = 1 }"), "storeys = 0 must be at least 1"),
        (
            at_height("", "{ storeys = 3, period = 0, height_ratio = 1 }"),
            "period = 0 must be above 0: First period",
        ),
        (
            at_height("", "{ storeys = 3, period = 0.3, height_ratio = 2 }"),
            "height_ratio = 2 must be at least 0 and at most 1: z/H",
        ),
        (at_height("", "{ storeys = 3 }"), "give storeys, period and height_ratio, or modes"),
        (at_height("", "{ modes = [] }"), "building.modes needs at least 1 value, found 0"),
        (with(building), "state building_damping, the damping of the building"),
        (
            with(building).replace("0.32", "0.32, building_damping = 0.5, damping = 0.5"),
            "xi_k = 0.5 leaves no amplification: [C7.2.6] does not hold",
        ),
        (open("").replace("soil = \"B\"\n", "before_activation = \"rigid\"\n"), "soil is missing"),
        (open("").replace("\"B\"", "\"F\""), "soil = \"F\" is not one of \"A\", \"B\""),
        (open(""), "before_activation is missing, or does not go with the law of the wall: state \"rigid\""),
        (
            open("before_activation = \"beam\""),
            "before_activation = \"beam\" and young_modulus, E in Pa, go together",
        ),
        (with("young_modulus = 1e9"), "young_modulus, E in Pa, go together; give both or none"),
        (with("record_scale = \"g\""), "record_scale = \"g\" is not one of \"ag\", \"none\""),
        (with("soll = 1"), "did you mean \"soil\"?"),
        (with("records = { synthetic = { count = 2 } }"), "found 2; at least 3 records (NTC 7.3.5)"),
    ];
    for (text, message) in cases {
        let error = refuses(&format!("{PARAPET}{text}"), message);
        assert!(error.starts_with("scene.toml, line"), "{error}");
    }
}

/// Improbable numbers may be the cause of a refusal.
#[test]
fn a_refusal_begins_with_the_numbers_that_may_be_its_cause() {
    let beam = open("before_activation = \"beam\"\nyoung_modulus = 1500");
    let error = refuses(
        &format!("{PARAPET}{beam}"),
        "young_modulus = 1500 Pa is unusual: 100000000 to 5e10 Pa is usual; if it is in MPa, give 1.5e9 Pa; \
         no masonry has E below 1e7 Pa",
    );
    assert!(error.contains("[check] young_modulus"), "{error}");
    // a limit that a key of the table sets keeps its line
    let local = table(&format!("SLV = {SITE}\nSLC = {SITE}")).replace("SLC = {", "SLC = { displacement = 9,");
    let error = refuses(&format!("{PARAPET}{}", local.replace("2.45", "24")), "F0 = 24 is unusual");
    assert!(error.contains("line ") && error.contains("as given, SLC.displacement = 9 m"), "{error}");
}

/// Walls that the check cannot take: what their scenes add to the parapet, and their tables.
#[test]
fn walls_that_do_not_go_with_the_statements_are_refused() {
    let with = |more: &str| table(&format!("SLV = {SITE}\nSLC = {SITE}\n{more}"));
    let local = |d: f64| with("").replace("SLC = { ", &format!("SLC = {{ displacement = {d}, "));
    let law = || open("before_activation = \"law\"\n");
    let strip = "mechanism = \"vertical_spanning\"\noverburden = 1e4\n";
    let rigid = "[force_law]\nforce_law = \"rigid_linear\"\n[damping]\ndamping_model = \"none\"\n";
    let trilinear = "[force_law]\nforce_law = \"trilinear\"\na1 = 0.03\na3 = 1\nd1 = 0.7\n";
    let full = format!("kinematics = \"trigonometric\"\n{rigid}[impact]\nimpact = \"restitution\"\n");
    let first = "SLC comes before SLV: d_SLC = 50 mm is below d_SLV = 80 mm";
    let slow = "SLV: the elastic branch ends at d_y = 100 mm";
    for (wall, table, message) in [
        ("overburden = 5e3\n", with(""), "state whether the overburden's mass moves along"),
        (strip, with("overburden_mass = 1"), "the top of a strip wall is held"),
        (rigid, law(), "\"law\" of a law with an elastic branch, not rigid_linear"),
        (trilinear, with(""), "and of a trilinear or multilinear one"),
        (&full, with(""), "small rotations"),
        ("", local(0.3), "SLC.displacement = 0.3 m must be above 0 and below u_0 = 0.2"),
        ("", local(0.05), first),
        ("[force_law]\na1 = 0.5\n", law(), slow),
    ] {
        refuses(&format!("{PARAPET}{wall}{table}"), message);
    }
}

/// Spectra and records that do not go with the limit state.
#[test]
fn demands_that_do_not_serve_are_refused() {
    let with = |more: &str| table(&format!("SLV = {SITE}\nSLC = {SITE}\n{more}"));
    let spectrum = |points: &str, damping: f64| {
        let given = format!("SLC = {{ ag = 0.2, spectrum = {points}, spectrum_damping = {damping} }}");
        table(&format!("SLV = {SITE}\n{given}"))
    };
    let [to_nine, to_two] = ["[[0, 0.2], [9, 0.01]]", "[[0, 0.2], [2, 0.01]]"];
    let damped = "{ ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }";
    let in_building = spectrum(to_nine, 0.1).replace(SITE, damped)
        + "building = { modes = [{ period = 0.3, participation = 1 }] }";
    let records =
        with("method = \"dynamic\"\nrecords = { synthetic = { count = 3, duration = 10, step = 0.02 } }");
    let as_they_are = "or ag, with records and record_scale = \"none\"";
    for (table, message) in [
        (spectrum(to_nine, 0.05), "SLC needs the spectrum at 10 % damping; the given one is at 5 %"),
        (spectrum(to_two, 0.1), "SLC: the spectrum goes from 0 to 2 s and has no T = 3.1"),
        (spectrum("[[1, 0.2], [2, 0.01]]", 0.1), "T from 0 on that rises"),
        (spectrum("[[0, -0.1], [2, 0.01]]", 0.1), "found T = 0 s and Sa = -0.1 g at point 1 of the spectrum"),
        (in_building, "leave [check.building] out"),
        (records.replace(SITE, "{ ag = 0.15 }"), as_they_are),
    ] {
        refuses(&format!("{PARAPET}{table}"), message);
    }
}

#[test]
fn what_the_engineer_should_know_is_warned_of() {
    let state = |name: &str, more: &str| format!("{name} = {{ ag = 0.15, F0 = 2.45, TC = 0.32{more} }}\n");
    let slv = |more: &str| table(&(state("SLV", "") + more));
    let damped = |more: &str| table(&(state("SLV", ", building_damping = 0.1") + more));
    let records = |count: u32| slv(&format!("records = {{ synthetic = {{ count = {count} }} }}"));
    let roof = "building = { storeys = 3, period = 0.3, height_ratio = 1.0 }";
    let low = "building = { modes = [{ period = 0.3, participation = 0.1 }] }";
    let tie = "[tie]\ntie_height = 3\ntie_stiffness = 2e4\n";
    let beam = open("before_activation = \"beam\"\nyoung_modulus = 3e11")
        .replace("TC = 0.32 }", "TC = 0.32, building_damping = 0.1 }");
    for (text, message) in [
        (slv(&state("SLC", "")), "a_g does not rise from SLV to SLC: 0.15 and 0.15 g"),
        (slv("").replace("0.32", "1.2"), "TC = 1.2 s is unusual: 0.1 to 1 s is usual; check value and unit"),
        (slv("use_class = \"IV\""), "use class IV is checked for SLD too"),
        (damped(low) + "height_demand = \"printed\"", "SLV: a_Z = "),
        (
            slv("").replace("0.32", "320"),
            "TC = 320 s is unusual: 0.1 to 1 s is usual; if it is in ms, give 0.32 s",
        ),
        (
            slv("").replace("2.45", "24"),
            "F0 = 24 is unusual: 2.2 to 4 is usual; if it is without its decimal point, give 2.4",
        ),
        (
            damped(&roof.replace("0.3,", "320,")),
            "period of the building = 320 s is unusual: 0.02 to 5 s is usual; if it is in ms, give 0.32 s",
        ),
        (
            damped(roof).replace("= 0.1 }", "= 0.1, building_period = 400 }"),
            "building_period = 400 s is unusual: 0.02 to 5 s is usual; if it is in ms, give 0.4 s",
        ),
        (
            format!("{}[[storeys]]\nperiod = 250\n", damped("")),
            "period of a storey = 250 s is unusual: 0.02 to 5 s is usual; if it is in ms, give 0.25 s",
        ),
        (
            format!("{}{}", tie.replace("2e4", "20e3\ntie_strength = 75"), slv("")),
            "tie_strength = 75 N is unusual: 1000 to 2000000 N is usual; if it is in kN, give 75000 N",
        ),
        (
            format!("overburden = 5\n{}", slv("overburden_mass = 1")),
            "overburden = 5 N is unusual: 100 to 1000000 N is usual; if it is in kN, give 5000 N",
        ),
        (records(3), "3 records: the least favourable one counts"),
        (records(7), "7 records: the mean counts"),
        (format!("{tie}{}", damped(roof)), "the tie has no tie_strength: it never breaks"),
        (beam + low, "S_eZ(T0) = "),
    ] {
        let warnings = checked(&format!("{PARAPET}{text}")).unwrap().warnings;
        assert!(warnings.iter().any(|warning| warning.contains(message)), "{warnings:?} for {text}");
    }
    let tall = "[geometry]\nheight = 8\nthickness = 0.4\ndensity = 1800\n";
    let warnings = checked(&format!("{tall}{}", table(&state("SLC", "")))).unwrap().warnings;
    let long = "NTC 3.2.3.2 admits the spectra of accelerations up to 4 s";
    assert!(warnings.iter().any(|warning| warning.contains(long)), "{warnings:?}");
    let weak = state("SLD", "").replace("0.15", "0.05");
    let quiet = checked(&format!("{PARAPET}{}", slv(&weak))).unwrap().warnings;
    assert!(quiet.is_empty(), "{quiet:?}");
}

/// A wall that falls by its own loads is told of once, with what the check adds.
#[test]
fn a_wall_that_falls_at_rest_is_told_of_once() {
    let text = facade("thrust = 50e3", "");
    let told = refuses(&text, "the body falls at rest: without a tie its α0 and d_0 are below 0");
    assert_eq!(told.matches("falls at rest").count(), 1, "{told}");
    let scene = Scene::parse("scene.toml", &text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", &text).unwrap()).unwrap();
    let error = code.check((&scene).into()).err().unwrap();
    assert!(error.source().is_none() && told.contains(&error.to_string()), "{error}");
}
