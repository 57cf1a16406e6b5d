//! Checks by codes and their reports.

use super::*;

/// A run with the check of a site; `more` adds to its fields, or takes them away.
fn checked(parameters: &Value, more: &Value) -> Value {
    ask(&mut Session::default(), &run_and_check(parameters, more))["answer"].clone()
}

pub(super) fn run_and_check(parameters: &Value, more: &Value) -> Value {
    let mut check = json!({
        "code": "circolare-2019", "before_activation": "law", "soil": "B", "confidence_factor": "1.35",
        "SLV.ag": "0.15", "SLV.F0": "2.45", "SLV.TC": "0.32",
    });
    let fields = check.as_object_mut().unwrap();
    fields.extend(more.as_object().unwrap().clone());
    fields.retain(|_, text| !text.is_null());
    let motion = json!({ "kind": "none" });
    json!({ "run": { "parameters": parameters, "motion": motion, "check": check, "width": 600 } })
}

fn tied_on_the_roof() -> (Value, Value) {
    let tie = json!({
        "tie_stiffness": "2e5", "tie_height": "3", "tie_slack": "0.03", "tie_strength": "5000",
        "tie_side": "positive",
    });
    let roof = json!({
        "building.storeys": "3", "building.period": "0.3", "building.height_ratio": "1",
        "SLV.building_damping": "0.1",
    });
    (tie, roof)
}

/// The parapet and the tied parapet of the rule's worked examples, and the same from the scene file.
#[test]
fn the_check_has_the_numbers_of_the_code() {
    let (tie, roof) = tied_on_the_roof();
    for (parameters, more, zeta) in
        [(json!({}), json!({}), 0.855_812), (json!({}), roof.clone(), 0.790_84), (tie, roof, 0.727_534)]
    {
        let answer = checked(&parameters, &more);
        let check = &answer["check"];
        // six digits
        assert!((check["zeta"].as_f64().unwrap() - zeta).abs() < 5e-7, "{check}");
        assert_eq!(check["passed"], false);
        assert!(check["svg"].as_str().unwrap().starts_with("<svg"));
        let toml = answer["toml"].as_str().unwrap();
        let scene = Scene::parse("scene.toml", toml, "".as_ref()).unwrap();
        let code = check::read(&check::CheckFile::parse("scene.toml", toml).unwrap()).unwrap();
        let again = code.check((&scene).into()).unwrap().zeta;
        assert_eq!(check["zeta"], again);
    }
}

/// A façade with floors and a thrust is checked as its scene file is, against a target.
#[test]
fn a_facade_is_checked() {
    let parts = "[[geometry.part]]\nheight = 9.6\nthickness = 0.6\ndensity = 1800\n\
                 [[geometry.load]]\nforce = 12e3\nheight = 6.4\ninside = 0.5\nmoving_mass = 1.0\n\
                 [[geometry.load]]\nforce = 8e3\nheight = 9.6\ninside = 0.4\nmoving_mass = 1.0\n\
                 thrust = 1000\n";
    let mut inputs = run_and_check(&json!({}), &json!({ "target": "0.6", "SLV.ag": "0.2" }));
    inputs["run"]["parts"] = parts.into();
    let answer = ask(&mut Session::default(), &inputs)["answer"].clone();
    let toml = answer["toml"].as_str().unwrap_or_else(|| panic!("{answer}"));
    let scene = Scene::parse("scene.toml", toml, "".as_ref()).unwrap();
    let code = check::read(&check::CheckFile::parse("scene.toml", toml).unwrap()).unwrap();
    let again = code.check((&scene).into()).unwrap();
    assert_eq!(answer["check"]["zeta"], again.zeta);
    assert_eq!(answer["check"]["passed"], again.zeta >= 0.6);
    assert!(again.zeta > 0.6 && again.zeta < 1.0, "{}", again.zeta);
}

/// The report of the last run's check is that of its scene file, but for the fingerprint of the language.
#[test]
fn the_report_of_a_check_opens() {
    let mut session = Session::default();
    assert_eq!(ask(&mut session, &json!({ "report": "en" }))["faults"]["wall"], "nothing has run yet");
    let run = ask(&mut session, &run_and_check(&json!({}), &json!({})));
    let toml = run["answer"]["toml"].as_str().unwrap();
    for language in ["en", "it"] {
        let answer = ask(&mut session, &json!({ "report": language }));
        let text = format!("{toml}\n[report]\nlanguage = \"{language}\"\n");
        let file = check::CheckFile::parse("scene.toml", &text).unwrap();
        let (code, report) = (check::read(&file).unwrap(), &file.report().unwrap());
        let scene = Scene::parse("scene", &text, "".as_ref()).unwrap();
        let (title, records) = (&*scene.title, code.records());
        let origin = check::Origin::new(title, &file, records, report, crate::check::PROGRAM);
        let page = check::page(&code.check((&scene).into()).unwrap(), &origin).unwrap();
        let without = |page: &str| page.split(">Document").next().unwrap().to_owned();
        assert_eq!(without(answer["answer"].as_str().unwrap()), without(&page));
        assert!(page.contains(&format!("lang=\"{language}\"")));
    }
}

/// The thickness moves the verdict, and the check says up to which `a_g` the wall holds.
#[test]
fn a_thicker_wall_passes_the_check() {
    let check = |thickness: &str| checked(&json!({ "thickness": thickness }), &json!({}))["check"].clone();
    let [thin, thick] = ["0.4", "0.6"].map(check);
    assert_eq!(thin["headline"], "NOT PASSED: SLV governs with zeta_E = 0.856 (both sides alike)");
    assert_eq!(thin["notes"][0], "It holds up to a_g = 0.128 g; the site has 0.15 g.");
    assert!(
        thick["headline"].as_str().unwrap().contains("PASSED: SLV governs with zeta_E = 1.28"),
        "{thick}"
    );
    assert_ne!(thin["svg"], thick["svg"]);
    let (tie, roof) = tied_on_the_roof();
    let notes = checked(&tie, &roof)["check"]["notes"].clone();
    assert!(notes.as_array().unwrap().contains(&"u > 0: the tie breaks at d_SLV.".into()), "{notes}");
}

/// A code that is not the first gives a verdict with rows and a picture, too.
#[test]
fn the_page_checks_by_another_code() {
    let given = json!({
        "code": "fractions", "before_activation": null, "soil": null, "confidence_factor": null,
        "SLV.ag": null, "SLV.F0": null, "SLV.TC": null,
        "spectrum": "[[0, 2], [0.5, 5], [4, 0.6]]", "check.unit": "m/s2",
    });
    let check = checked(&json!({}), &given)["check"].clone();
    assert!(check["svg"].as_str().unwrap().starts_with("<svg"), "{check}");
    assert!(check["rows"].as_str().unwrap().contains("displacement"));
}

/// What is wrong with a check stands beside its field, and the wall runs all the same.
#[test]
fn a_check_that_cannot_be_made_leaves_the_run() {
    let height = json!({ "building.storeys": "3", "building.period": "0.3", "building.height_ratio": "1" });
    let undamped = {
        let mut height = height.clone();
        height["SLV.building_damping"] = "".into();
        height
    };
    let loaded = json!({ "overburden": "5000", "u_start": "0" });
    let rigid = json!({ "force_law": "rigid_linear", "damping_model": "none", "impact": "restitution" });
    for (parameters, more, field, message) in [
        (json!({}), json!({ "SLV.ag": "15" }), "SLV.ag", "at most 1: a_g on rigid ground [g]"),
        (json!({}), json!({ "SLV.ag": "much" }), "SLV.ag", "expected a number"),
        (json!({}), json!({ "SLV.F0": "2" }), "SLV.F0", "must be at least 2.2"),
        (json!({ "a1": "0.6" }), json!({ "SLV.F0": "24" }), "check", "F0 = 24 is unusual"),
        (json!({}), undamped, "SLV.building_damping", "state building_damping"),
        (json!({}), json!({ "confidence_factor": "1.2" }), "confidence_factor", "FC of LC1"),
        (rigid, json!({}), "before_activation", "with an elastic branch, not rigid_linear"),
        (loaded, json!({ "overburden_mass": "" }), "overburden_mass", "is missing"),
        (json!({}), json!({ "SLV.ag": "", "SLV.F0": null, "SLV.TC": null }), "SLV.ag", "needs its site"),
        (json!({ "a1": "0.6" }), json!({}), "check", "the elastic branch ends at d_y"),
    ] {
        let answer = checked(&parameters, &more);
        let fault = answer["check"]["faults"][field].as_str();
        let fault = fault.unwrap_or_else(|| panic!("no fault of {field}: {}", answer["check"]));
        assert!(fault.contains(message), "{fault}");
        assert!(answer["verdict"]["headline"].is_string());
    }
    // no code, no check
    let answer = checked(&json!({}), &json!({ "code": "" }));
    assert_eq!(answer["check"], Value::Null);
    assert!(!answer["toml"].as_str().unwrap().contains("check"));
}
