//! Ties in the check by Circolare 7/2019: worked examples, which an independent program computed. Their
//! numbers have six digits.
#![allow(clippy::unreadable_literal, reason = "numbers as the examples print them")]

use check::circolare::SideVerdict;
use check::{CheckFile, Found, Language, Sought, find, read};
use scene::Scene;

use crate::circolare::{PARAPET, checked, near, refuses, warns};
use crate::circolare_hinges::{displaced, facade, near_all, negative, parapet, positive, strip};

/// Examples 9 and 10: ties at the activation, and their required strength.
#[test]
fn ties_at_the_activation() {
    let tie = "tie_stiffness = 5e6\ntie_strength = 10e3";
    let yields = "tie.at_activation = \"yield\"";
    for (more, alpha0, sld, slv_q, required) in [
        ("", 0.0579812, 0.308676, 0.285390, [5964.40, 6668.36]),
        (yields, 0.275701, 1.46776, 1.35703, [5964.40, 6668.36]),
    ] {
        let outcome = checked(&facade(tie, more)).unwrap();
        let side = positive(&outcome);
        let checks = [side.checks.sld.unwrap(), side.checks.slv_q.unwrap()];
        near_all(&checks.map(|check| check.ratio), &[sld, slv_q], "activation");
        near_all(&checks.map(|check| check.required.unwrap()), &required, "required strength");
        near(side.activation.alpha0, alpha0, "alpha0");
        near(checks[1].demand, 2.95266, "a_g S");
        let other = negative(&outcome);
        near_all(
            &[other.checks.sld.unwrap().ratio, other.checks.slv_q.unwrap().ratio],
            &[0.349585, 0.323213],
            "untied",
        );
        assert!(other.checks.sld.unwrap().required.is_none() && other.tie.is_none());
    }
    let printed = checked(&facade(tie, "height_demand = \"printed\"")).unwrap();
    let slv_q = positive(&printed).checks.slv_q.unwrap();
    near_all(&[slv_q.demand, slv_q.required.unwrap()], &[2.76489, 6074.95], "a_Z as printed");

    let outcome = checked(&parapet("tie_stiffness = 2.4e6\ntie_strength = 2e3", yields)).unwrap();
    let side = positive(&outcome);
    let (at, sld, slv_q) = (side.activation, side.checks.sld.unwrap(), side.checks.slv_q.unwrap());
    near_all(
        &[at.alpha0, at.acceleration, at.t0, side.curve.t0],
        &[0.774366, 7.47391, 0.0610314, 0.356487],
        "P",
    );
    near_all(&[sld.capacity, sld.demand, sld.ratio], &[5.53623, 3.18752, 1.73685], "SLD of P");
    near_all(
        &[slv_q.ratio, sld.required.unwrap(), slv_q.required.unwrap()],
        &[1.78896, 767.209, 718.471],
        "P",
    );
}

/// Examples 11 to 13: ties that yield, and the bar that they are.
#[test]
fn ties_that_yield() {
    for (e_p, u_r, slv, slc, forces) in [
        (0.0, 0.00102941, [0.00118935, 2.00129, 0.128664, 0.00211691, 0.561834], [4.47761, 0.556940], 0.0),
        (0.03, 0.0164706, [0.0190296, 1.96923, 0.518830, 0.0379499, 0.501439], [4.47761, 0.556940], 0.0),
        (0.3, 0.155441, [0.0937853, 1.83490, 1.19322, 0.0872784, 1.07455], [1.38928, 1.17699], 10e3),
    ] {
        let tie = format!("tie_stiffness = 5e6\ntie_strength = 10e3\ntie_ultimate = {e_p}");
        let outcome = checked(&facade(&tie, "")).unwrap();
        let side = positive(&outcome);
        let (found, last) = (displaced(side.checks.slv), displaced(side.checks.slc));
        near(side.tie.unwrap().breaks.unwrap(), u_r, "u_r");
        near_all(&[found.d, found.a, found.period, found.demand, found.zeta], &slv, "SLV");
        near_all(&[last.period, last.zeta], &slc, "SLC");
        assert_eq!(found.tie.unwrap().force_at_demand, forces);
        assert_eq!(last.tie.unwrap().force, forces);
        let untied = side.untied.unwrap();
        near_all(&[untied.slv.unwrap(), untied.slc.unwrap()], &[0.484939, 0.556940], "untied");
        if e_p == 0.0 {
            near(side.tie.unwrap().loss.unwrap(), 0.790539, "loss");
        }
    }
    // the tied parapet of the first edition, under the roof
    let site = "ag = 0.15, F0 = 2.45, TC = 0.32, building_damping";
    for (e_p, slv, slc) in [(0.0, 0.727534, 0.913095), (0.02, 0.928449, 0.913095), (0.20, 1.31575, 1.77547)] {
        let outcome = checked(&format!(
            "{PARAPET}[force_law]\na1 = 0.03\n[tie]\ntie_stiffness = 200e3\ntie_height = 3\ntie_slack = \
             0.03\n tie_strength = 5e3\ntie_ultimate = {e_p}\n[check]\ncode = \"circolare-2019\"\nsoil = \
             \"B\"\n before_activation = \"law\"\n\
             building = {{ storeys = 3, period = 0.3, height_ratio = 1 }}\n\
             SLD = {{ {site} = 0.05 }}\nSLV = {{ {site} = 0.1 }}\nSLC = {{ {site} = 0.1 }}\n"
        ))
        .unwrap();
        let side = positive(&outcome);
        near_all(
            &[displaced(side.checks.slv).zeta, displaced(side.checks.slc).zeta],
            &[slv, slc],
            "first edition (c)",
        );
    }
    let bar = |anchor: &str| {
        let bar = format!(
            "tie = {{ at_activation = \"yield\", bar = {{ diameter = 0.016, length = 6, yield_stress = \
             235e6, ultimate_strain = 0.02, spacing = 3{anchor} }} }}"
        );
        checked(&facade("", &bar)).unwrap()
    };
    let outcome = bar("");
    let side = positive(&outcome);
    near_all(
        &[side.checks.sld.unwrap().ratio, side.checks.slv_q.unwrap().ratio],
        &[2.13421, 1.97321],
        "bar at activation",
    );
    let (slv, slc) = (displaced(side.checks.slv), displaced(side.checks.slc));
    // u_y = N_y/K h/(2 y), u_r − u_y = e_p h/(2 y)
    let (tie, lever) = (side.tie.unwrap(), 2.0 * 6.8 / 7.0);
    let [yields, breaks] = [tie.yields, tie.breaks].map(Option::unwrap);
    let strength = side.curve.tie().unwrap().strength.unwrap();
    let stiffness = strength / (lever * yields);
    let numbers = [stiffness, strength, lever * (breaks - yields)];
    near_all(&numbers, &[2.34572e6, 15749.9, 0.113286], "K, N_y and e_p of the bar");
    near_all(&[side.tie.unwrap().breaks.unwrap(), slv.d, slv.zeta], &[0.0617647, 0.0713609, 1.15475], "bar");
    // the tie, which SLD counts, is broken at d_SLC: SLD does not raise it
    near_all(&[slc.ratio, slc.zeta], &[0.556940, 0.556940], "bar, SLC");
    let outcome = bar(", anchor_capacity = 30e3");
    let side = positive(&outcome);
    let (slv, tie) = (displaced(side.checks.slv), side.tie.unwrap());
    let strength = side.curve.tie().unwrap().strength.unwrap();
    near_all(&[slv.ratio, slv.zeta, strength], &[0.418495, 0.584854, 10e3], "a weak anchor");
    assert_eq!(tie.yields, tie.breaks, "it does not stretch");
}

/// Example 14: ties that break while the wall is on its elastic branch, and limit states on that branch.
#[test]
fn ties_on_the_elastic_branch() {
    for (k, strength, expected) in [
        (2.4e6, 8e3, [0.890087, 0.0, 15.7018, 0.0595661, 0.000541047, 3.69653]),
        (1e5, 8e3, [0.0, 0.048, 0.0, 0.284867, 0.0, 1.68705]),
        (1e5, 500.0, [0.0, 0.0, 0.0, 0.0, 0.0, 0.882976]),
    ] {
        let tie = format!("tie_stiffness = {k}\ntie_strength = {strength}");
        let outcome = checked(&parapet(&tie, "")).unwrap();
        let side = positive(&outcome);
        let slv = displaced(side.checks.slv);
        let loss = side.tie.unwrap().loss.unwrap();
        let found = [loss, slv.d, slv.a, slv.period, slv.demand, slv.ratio];
        for (index, (found, expected)) in found.into_iter().zip(expected).enumerate() {
            // 0 stands for a number that the example does not print
            if expected != 0.0 {
                near(found, expected, &format!("K = {k}, {strength}, number {index}"));
            }
        }
        assert!(strength != 500.0 || loss == 0.0 && Some(slv.zeta) == side.untied.unwrap().slv);
    }
}

/// The façade of example 15: only the side of its tie rocks.
fn searched(tie: &str, more: &str) -> Found {
    let text = facade(tie, &format!("rocking = \"one_sided_positive\"\n{more}"));
    let scene = Scene::parse("scene.toml", &text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", &text).unwrap()).unwrap();
    find(&*code, (&scene).into(), Sought::TieStrength).unwrap()
}

/// Example 15: from which strength of the tie on each limit state passes, and what blocks.
#[test]
fn the_strength_that_a_tie_needs() {
    let of = |found: &Found, check: &str| found.checks.iter().find(|one| one.check == check).unwrap().clone();
    let stiff = "tie_stiffness = 5e6\ntie_strength = 10e3";
    let found = searched(stiff, "");
    near(of(&found, "SLV").value.unwrap(), 20767.2, "SLV");
    let slc = of(&found, "SLC");
    assert!(slc.value.is_none() && found.value.is_none());
    let reason = slc.reason.unwrap();
    assert!(reason.contains("0.557") && reason.contains("untied whatever its strength"), "{reason}");
    let sld = of(&found, "SLD").reason.unwrap();
    assert!(sld.contains("at_activation = \"none\""), "{sld}");

    let found = searched(&format!("{stiff}\ntie_ultimate = 0.3"), "");
    near(of(&found, "SLV").value.unwrap(), 8446.48, "SLV, ductile");
    near(of(&found, "SLC").value.unwrap(), 6922.28, "SLC, ductile");
    near(found.value.unwrap(), 8446.48, "the larger");
    // W + O: 7 · 0.5 · 1900 · 9.81 + 12000 N
    near(found.force_ratio.unwrap(), 8446.48 / 77236.5, "over W + O");

    let found = searched(stiff, "tie.at_activation = \"yield\"");
    for (check, value) in [("SLD", 5964.40), ("SLV with q", 6668.36), ("SLV", 18988.6)] {
        near(of(&found, check).value.unwrap(), value, check);
    }
    // the tie is broken at d_SLC: SLD, which counts it, does not raise SLC
    assert!(of(&found, "SLC").value.is_none() && found.value.is_none());
}

/// Both sides differ, and the tie is on one: the other blocks, and is named.
#[test]
fn a_side_without_a_tie_blocks() {
    let text = facade("tie_stiffness = 5e6\ntie_strength = 10e3\ntie_ultimate = 0.3", "");
    let scene = Scene::parse("scene.toml", &text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", &text).unwrap()).unwrap();
    let found = find(&*code, (&scene).into(), Sought::TieStrength).unwrap();
    assert!(
        found.text(Language::En).contains("u < 0: the side without a tie governs"),
        "{}",
        found.text(Language::En)
    );
    // a bar is sought by its diameter; a wall without one has none to seek
    let error = find(&*code, (&scene).into(), Sought::BarDiameter).unwrap_err().to_string();
    assert!(error.contains("bar_diameter is sought, but the wall has no such tie"), "{error}");
    let bar = "rocking = \"one_sided_positive\"\ntie = { at_activation = \"yield\", bar = { diameter = \
               0.016, length = 6, yield_stress = 235e6, ultimate_strain = 0.06, spacing = 3 } }";
    let text = facade("", bar);
    let scene = Scene::parse("scene.toml", &text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", &text).unwrap()).unwrap();
    let found = find(&*code, (&scene).into(), Sought::BarDiameter).unwrap();
    let diameter = found.value.unwrap();
    for (factor, passes) in [(1.0, true), (1.0 - 1e-6, false)] {
        let text = text.replace("diameter = 0.016", &format!("diameter = {}", diameter * factor));
        assert_eq!(checked(&text).unwrap().passed, passes, "{factor} of {diameter}");
    }
}

/// A beam with the T0 of a bilinear law has its elastic branch, also where a tie breaks on it.
#[test]
fn a_beam_is_the_law_of_its_period() {
    for tie in [
        "tie_stiffness = 2.4e6\ntie_strength = 8e3",
        "tie_stiffness = 1e5\ntie_strength = 500",
        "tie_stiffness = 1e5\ntie_strength = 8e3",
    ] {
        let text = parapet(tie, "");
        let of_law = checked(&text).unwrap();
        let law = positive(&of_law);
        // [C8.7.1.7]: E = ρ (κ h²/(b T0))²
        let modulus = 1800.0 * (6.2 * 1.2 * 1.2 / (0.3 * law.curve.t0)).powi(2);
        let beam = format!("before_activation = \"beam\"\nyoung_modulus = {modulus:e}");
        let of_beam = checked(&text.replace("before_activation = \"law\"", &beam)).unwrap();
        let beam = positive(&of_beam);
        let numbers = |side: &SideVerdict| {
            let slv = displaced(side.checks.slv);
            let loss = side.tie.unwrap().loss.unwrap();
            [
                side.curve.t0,
                side.curve.dy,
                side.curve.ay,
                loss,
                slv.d,
                slv.a,
                slv.demand,
                slv.zeta,
                displaced(side.checks.slc).zeta,
            ]
        };
        for (beam, law) in numbers(beam).into_iter().zip(numbers(law)) {
            // some roundings
            assert!((beam - law).abs() <= 1e-12 * law.abs(), "{beam} for {law}: {tie}");
        }
    }
}

/// Of given points the largest S_d from T0 on counts: that of wall and tie, or with slack that of the wall.
#[test]
fn a_slack_tie_does_not_shorten_the_period_of_the_demand() {
    let of = |slack: f64| {
        let tie = format!("tie_stiffness = 2.4e6\ntie_strength = 8e3\ntie_slack = {slack}");
        let text = parapet(&tie, "");
        let (wall, _) = text.split_once("[check]").unwrap();
        // a peak at 0.1 s and a plateau up to 0.3 s, between T0 with the tie, 0.061 s, and without, 0.356 s
        let table = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"law\"\n\
                     SLC = { ag = 0.2, spectrum = [[0, 0.2], [0.0999, 0.2], [0.1, 900], [0.1001, 0.2], \
                     [0.2, 0.2], [0.2001, 90], [0.3, 90], [0.3001, 0.2], [9, 0.1]], \
                     spectrum_damping = 0.1 }\n";
        let outcome = checked(&format!("{wall}{table}")).unwrap();
        let (t0, slc) = (positive(&outcome).curve.t0, displaced(positive(&outcome).checks.slc));
        (t0, slc.demand, slc.acceleration * (slc.period / std::f64::consts::TAU).powi(2))
    };
    let [(t0, tight, _), (same, slack, at_the_end)] = [0.0, 1e-6].map(of);
    near(t0, 0.356487, "T0 of the wall");
    assert_eq!(t0, same);
    // 900 g at 0.1 s
    near(tight, 900.0 * 9.81 * (0.1 / std::f64::consts::TAU).powi(2), "the peak");
    // beyond 0.3 s S_d rises
    near(slack, at_the_end, "S_d at T_SLC");
}

/// What only informs stops no check: without the tie that breaks early `d_SLC` is below `d_SLV`, and with SLC
/// alone the search for the least α0 meets hinges with which the tie cannot act.
#[test]
fn what_informs_stops_no_check() {
    let of = |tie: &str| {
        let text = facade(tie, "rocking = \"one_sided_positive\"");
        text.replace("SLC = { ag", "SLC = { displacement = 0.05, ag")
    };
    refuses(&of(""), "SLC comes before SLV");
    let outcome = checked(&of("tie_stiffness = 5e6\ntie_strength = 10e3")).unwrap();
    let side = positive(&outcome);
    near(displaced(side.checks.slv).zeta, 0.561834, "SLV, as of the example");
    assert!(side.untied.is_none());

    let text = held_strip("hinge = \"worst\"\nrocking = \"one_sided_positive\"");
    let is_kept = |line: &&str| !["SLD", "SLV"].iter().any(|state| line.starts_with(state));
    let text: Vec<_> = text.lines().filter(is_kept).collect();
    let outcome = checked(&text.join("\n")).unwrap();
    let side = positive(&outcome);
    assert!(side.least_alpha0.is_none() && displaced(side.checks.slc).hinge.is_some());
    warns(&text.join("\n"), "other hinges could not be searched: with the hinge at hinge_ratio = 0.1: ");
}

/// D with bars of 6 m near its top: with a hinge far below they have their strength late.
fn held_strip(more: &str) -> String {
    let bar = "tie = { at_activation = \"yield\", bar = { diameter = 0.016, length = 6, \
               yield_stress = 235e6, ultimate_strain = 0.02, spacing = 3 } }";
    let text = strip(0.03, "", &format!("before_activation = \"law\"\n{bar}\n{more}"));
    text.replace("[force_law]", "[tie]\ntie_height = 3.0\ntie_side = \"both\"\n[force_law]")
}

/// Where a tie cannot act with some hinges of the range, the message says how to leave these out.
#[test]
fn a_tie_that_cannot_act_with_some_hinges_asks_for_another_range() {
    let remedy = "or, where the hinge is searched, a hinge_range without this place";
    for rule in ["least_alpha0", "worst"] {
        let text = held_strip(&format!("hinge = \"{rule}\""));
        // u_y = f_y L/(E φ), φ = (1 − 3/3.4)/(1 − 0.1)
        let told = refuses(&text, "hinge_ratio = 0.1: at_activation = \"yield\" needs a stiff tie");
        assert!(told.contains("u_y = 51.36 mm") && told.ends_with(remedy), "{told}");
        let outcome = checked(&text.replace("[check]", "[check]\nhinge_range = [0.5, 0.9]")).unwrap();
        assert!(positive(&outcome).activation.force > 0.0);
    }
    // a façade has no hinge between its ends
    let soft = facade("tie_stiffness = 2e5\ntie_strength = 10e3", "tie.at_activation = \"yield\"");
    assert!(!refuses(&soft, "needs a stiff tie").contains("hinge_range"));
}
