//! From which ratio on a check passes, and which limit states SLD raises.

use check::{CheckFile, Language, Sought, Subject, find, read};
use scene::Scene;

use crate::circolare::checked;
use crate::circolare_hinges::{displaced, facade, negative, positive, strip};

/// The headline in both languages, and the notes.
fn told(text: &str) -> (String, String, String) {
    let scene = Scene::parse("scene.toml", text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", text).unwrap()).unwrap();
    let verdict = code.check(Subject::from(&scene)).unwrap();
    let (headline, notes) = (verdict.headline(), verdict.notes.iter().map(ToString::to_string));
    (headline.to_string(), headline.of(Language::It).to_owned(), notes.collect::<Vec<_>>().join("\n"))
}

/// C8.7.1.2.1.8 prints the raise for SLV alone.
#[test]
fn only_slv_is_raised_unless_stated() {
    let stated = strip(0.03, "hinge_ratio = 0.82", "before_activation = \"rigid\"");
    let printed = stated.replace("raise_slc = true", "");
    let [with, without] = [&stated, &printed].map(|text| checked(text).unwrap());
    let of = |outcome| [displaced(negative(outcome).checks.slv), displaced(negative(outcome).checks.slc)];
    let ([slv, slc], [own_slv, own_slc]) = (of(&with), of(&without));
    assert!(slv.raised && slc.raised && slc.zeta > slc.ratio);
    assert_eq!(own_slv, slv);
    assert!(!own_slc.raised && own_slc.zeta.to_bits() == slc.ratio.to_bits() && own_slc.d == slc.d);
    assert!(with.passed && !without.passed);
}

/// A raise by a rounding is no reason of a verdict. The longer the elastic branch, the less SLD raises.
#[test]
fn a_raise_by_a_rounding_is_not_told() {
    let text = |a1: f64| {
        format!(
            "[geometry]\nmechanism = \"vertical_spanning\"\nheight = 3\nthickness = 0.25\nhinge_ratio = 0.5\n\
             density = 1800\noverburden = 10e3\n[force_law]\na1 = {a1:?}\n[check]\n\
             code = \"circolare-2019\"\nbefore_activation = \"law\"\nsoil = \"B\"\noverburden_mass = 0\n\
             building = {{ storeys = 2, period = 0.3, height_ratio = 0.83 }}\n\
             SLD = {{ ag = 0.06, F0 = 2.45, TC = 0.28, building_damping = 0.05 }}\n\
             SLV = {{ ag = 0.50, F0 = 2.45, TC = 0.32, building_damping = 0.05 }}\n"
        )
    };
    let slv = |a1: f64| displaced(positive(&checked(&text(a1)).unwrap()).checks.slv);
    let [mut raised, mut own] = [0.001, 0.003];
    assert!(told(&text(raised)).0.contains("raised by SLD"));
    for _ in 0..50 {
        let middle = f64::midpoint(raised, own);
        *(if slv(middle).raised { &mut raised } else { &mut own }) = middle;
    }
    let found = slv(raised);
    assert!(found.raised && found.zeta - found.ratio < 1e-12, "{found:?}");
    let (headline, ..) = told(&text(raised));
    assert!(!headline.contains("raised"), "{headline}");
}

#[test]
fn the_verdict_names_its_target() {
    let text =
        |more: &str| strip(0.03, "hinge_ratio = 0.82", &format!("before_activation = \"law\"\n{more}"));
    let (fails, ..) = told(&text(""));
    assert!(fails.starts_with("NOT PASSED: SLC governs with zeta_E = 0.9"), "{fails}");
    let (holds, italian, notes) = told(&text("target = 0.6"));
    assert!(holds.starts_with("PASSED for zeta_E ≥ 0.60: SLC governs with zeta_E = 0.9"), "{holds}");
    assert!(italian.starts_with("VERIFICA SODDISFATTA per ζ_E ≥ 0,60: SLC è"), "{italian}");
    assert!(notes.contains("for zeta_E ≥ 0.60, the target of an improvement (NTC 8.4.2)."), "{notes}");
    let (fails, ..) = told(&text("target = 0.99"));
    assert!(fails.starts_with("NOT PASSED for zeta_E ≥ 0.99: "), "{fails}");
}

/// With the strength that a check requires, its ratio is the target.
#[test]
fn a_tie_is_required_for_the_target() {
    let with = |strength: f64| {
        let tie = format!("tie_stiffness = 5e6\ntie_strength = {strength}\ntie_ultimate = 0.3");
        let text = facade(&tie, "tie.at_activation = \"yield\"\ntarget = 0.7");
        let sld = positive(&checked(&text).unwrap()).checks.sld.unwrap();
        (sld.ratio, sld.required.unwrap())
    };
    let (_, required) = with(10e3);
    // rigid: the demand hangs on no strength; some roundings of a force of some kN
    assert!((with(required).0 - 0.7).abs() < 1e-12, "{required}");
}

/// A search looks for the target, too.
#[test]
fn a_search_looks_for_the_target() {
    let thickness = |more: &str| {
        let text = strip(0.03, "hinge_ratio = 0.5", &format!("before_activation = \"rigid\"\n{more}"));
        let scene = Scene::parse("scene.toml", &text, ".".as_ref()).unwrap();
        let code = read(&CheckFile::parse("scene.toml", &text).unwrap()).unwrap();
        find(&*code, (&scene).into(), Sought::Thickness).unwrap().value.unwrap()
    };
    let [least, target] = [thickness(""), thickness("target = 0.6")];
    assert!(target < 0.9 * least, "{target} {least}");
}

#[test]
fn targets_are_ratios() {
    let text = strip(0.03, "hinge_ratio = 0.5", "before_activation = \"rigid\"\ntarget = 60");
    assert!(checked(&text).unwrap_err().contains("target"));
}
