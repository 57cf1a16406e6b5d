//! Worked examples of the second edition of the check by Circolare 7/2019, which an independent program
//! computed. Their numbers have six digits.
#![allow(clippy::unreadable_literal, reason = "numbers as the examples print them")]

use check::circolare::{DisplacementCheck, Outcome, SideVerdict};
use check::{CheckFile, Found, Sought, find, read};
use rocking_wall::scene::Scene;

use crate::circolare::{PARAPET, checked, near};

/// Where ζ is flat, a searched hinge is known less well than ζ.
const HINGE: f64 = 1e-4;

/// The site and the building of the examples, with the place of the wall.
pub(crate) fn palazzo(height_ratio: f64, more: &str) -> String {
    format!(
        "[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\n{more}\n\
         building = {{ storeys = 3, period = 0.32, height_ratio = {height_ratio} }}\n\
         SLD = {{ ag = 0.104, F0 = 2.332, TC = 0.281, building_damping = 0.05 }}\n\
         SLV = {{ ag = 0.261, F0 = 2.364, TC = 0.347, building_damping = 0.10 }}\n\
         SLC = {{ ag = 0.334, F0 = 2.400, TC = 0.364, building_damping = 0.15 }}\n"
    )
}

/// D, a loaded strip; `geometry` adds to its shape.
pub(crate) fn strip(a1: f64, geometry: &str, more: &str) -> String {
    format!(
        "[geometry]\nmechanism = \"vertical_spanning\"\nheight = 3.4\nthickness = 0.40\ndensity = 1900\n\
         overburden = 60e3\noverburden_eccentricity = 0.05\neccentricity_mode = \
         \"fixed_to_wall\"\n{geometry}\n [force_law]\na1 = {a1}\n{}",
        palazzo(0.83, more)
    )
}

/// C, a façade with a tie on u > 0.
pub(crate) fn facade(tie: &str, more: &str) -> String {
    format!(
        "[geometry]\nheight = 7\nthickness = 0.5\ndensity = 1900\noverburden = 12e3\n\
         overburden_eccentricity = 0.1\neccentricity_mode = \"fixed_to_wall\"\n\
         [tie]\ntie_height = 6.8\ntie_side = \"positive\"\n{tie}\n{}",
        palazzo(0.37, &format!("before_activation = \"rigid\"\noverburden_mass = 1\n{more}"))
    )
}

/// P, the parapet of scenes/checked_parapet.toml, with a tie at 1 m on both sides.
fn parapet(tie: &str, more: &str) -> String {
    let scene = include_str!("../../../../scenes/checked_parapet.toml");
    let tie = format!("[tie]\ntie_height = 1.0\n{tie}\n[force_law]");
    let (wall, check) = scene.split_once("[check]\n").unwrap();
    format!("{}[check]\n{more}\n{check}", wall.replace("[force_law]", &tie))
}

fn positive(outcome: &Outcome) -> &SideVerdict {
    outcome.sides.positive.as_ref().unwrap()
}

fn negative(outcome: &Outcome) -> &SideVerdict {
    outcome.sides.negative.as_ref().unwrap()
}

fn near_all(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len());
    for (index, (found, expected)) in found.iter().zip(expected).enumerate() {
        near(*found, *expected, &format!("{what}, number {index}"));
    }
}

/// `ζ_E` of SLD, SLV with q, SLV and SLC, and their hinges.
fn zetas(side: &SideVerdict) -> ([f64; 4], [f64; 4]) {
    let none = f64::NAN;
    let activation =
        [side.sld, side.slv_q].map(|check| check.map_or([none; 2], |c| [c.ratio, c.hinge.unwrap_or(none)]));
    let displaced =
        [side.slv, side.slc].map(|check| check.map_or([none; 2], |c| [c.zeta, c.hinge.unwrap_or(none)]));
    let [a, b] = activation;
    let [c, d] = displaced;
    ([a[0], b[0], c[0], d[0]], [a[1], b[1], c[1], d[1]])
}

/// Examples 1 to 6: each check at its least favourable hinge, and at the hinge of the least α0.
#[allow(clippy::too_many_lines, reason = "one list of cases")]
#[test]
fn hinges_that_are_searched() {
    let worst = |before: &str| format!("hinge = \"worst\"\n{before}");
    let law = worst("before_activation = \"law\"");
    let rigid = worst("before_activation = \"rigid\"");
    let beam = worst("before_activation = \"beam\"\nyoung_modulus = 1e9");
    let strong = worst("before_activation = \"law\"\nmasonry_strength = 1.5e6\nconfidence_factor = 1.2");
    let none = f64::NAN;
    let one = strip(0.03, "", &law);
    let without: Vec<_> = one.lines().filter(|line| !line.starts_with("SLD")).collect();
    for (text, sign, zeta, x, ratio, least) in [
        (
            &one,
            -1.0,
            [2.44482, 2.59596, 0.974182, 0.947685],
            [0.632576, 0.636400, 0.632576, 0.807403],
            0.793562,
            [1.81460, 0.660745],
        ),
        (
            &one,
            1.0,
            [2.92059, 3.10544, 1.16376, 1.24754],
            [0.587588, 0.589448, 0.587588, 0.710954],
            0.975940,
            [2.19056, 0.601377],
        ),
        (
            &strip(0.03, "", &rigid),
            -1.0,
            [4.30646, 4.25198, 1.71598, 1.34093],
            [0.660745; 4],
            0.774090,
            [1.81460, 0.660745],
        ),
        (
            &strip(0.03, "", &beam),
            -1.0,
            [2.56068, 2.69858, 1.02035, 0.946206],
            [0.663987, 0.663987, 0.663987, 0.824933],
            0.771885,
            [1.81460, 0.660745],
        ),
        (
            &without.join("\n"),
            -1.0,
            [none, 2.59596, 0.696758, 0.946206],
            [none, 0.636400, 0.809283, 0.824933],
            0.696758,
            [1.81460, 0.660745],
        ),
        (
            &strip(0.03, "", &strong),
            -1.0,
            [2.04753, 2.20236, 0.815874, 0.800338],
            [0.627425, 0.631843, 0.627425, 0.804416],
            none,
            [1.46493, 0.658992],
        ),
    ] {
        let outcome = checked(text).unwrap();
        let side = if sign > 0.0 { positive(&outcome) } else { negative(&outcome) };
        let (found, hinges) = zetas(side);
        for index in 0..4 {
            if zeta[index].is_nan() {
                assert!(found[index].is_nan());
                continue;
            }
            near(found[index], zeta[index], &format!("zeta {index}\n{text}"));
            assert!((hinges[index] - x[index]).abs() < HINGE, "{hinges:?} for {x:?}");
        }
        if !ratio.is_nan() {
            near(side.slv.unwrap().ratio, ratio, "SLV by displacement");
        }
        let found = side.least_alpha0.unwrap();
        near(found.alpha0, least[0], "least alpha0");
        assert!((found.hinge - least[1]).abs() < HINGE);
    }
}

/// Around example 1: the sensitivity to a₁, given hinges, and the hinge of the least α0 by default.
#[test]
fn what_the_hinge_and_a1_change() {
    let law = "before_activation = \"law\"";
    let outcome = checked(&strip(0.03, "", &format!("hinge = \"worst\"\n{law}"))).unwrap();
    let varied = &negative(&outcome).sensitivity;
    near_all(&[varied[0].value, varied[0].slv.unwrap()], &[0.015, 1.17913], "a1/2");
    near_all(&[varied[1].value, varied[1].slv.unwrap()], &[0.06, 0.744912], "2 a1");
    // SLC fails with each of them, so that the verdict stays
    assert_eq!([varied[0].passed, varied[1].passed], [Some(false); 2]);
    for (x, slv) in [(0.4, 1.26468), (0.5, 1.06278), (0.6, 0.979657), (0.65, 0.975823), (0.7, 1.00065)] {
        let outcome = checked(&strip(0.03, &format!("hinge_ratio = {x}"), law)).unwrap();
        near(negative(&outcome).slv.unwrap().zeta, slv, "a given hinge");
    }
    // the least α0 is the default of a strip without hinge_ratio
    let outcome = checked(&strip(0.03, "", law)).unwrap();
    let side = negative(&outcome);
    near_all(&zetas(side).0, &[2.45573, 2.60430, 0.978529, 1.02206], "least alpha0");
    near(side.slv.unwrap().ratio, 0.774090, "SLV by displacement");
    near(side.least_alpha0.unwrap().zeta.unwrap(), 0.978529, "what it gives");
    near(side.least_alpha0.unwrap().worst.unwrap(), 0.947685, "what the least favourable one gives");
    // without load the upper end
    let unloaded = strip(0.03, "", "hinge = \"worst\"\nbefore_activation = \"rigid\"")
        .replace("overburden = 60e3\noverburden_eccentricity = 0.05\n", "");
    let outcome = checked(&unloaded).unwrap();
    let (found, hinges) = zetas(positive(&outcome));
    near_all(&[found[0], found[2], found[3]], &[0.620452, 0.732446, 0.716204], "without load");
    assert_eq!(hinges, [0.9; 4]);
}

fn displaced(check: Option<DisplacementCheck>) -> DisplacementCheck {
    check.unwrap()
}

/// Examples 7 and 8: hinges set back for the compressive strength.
#[test]
fn hinges_that_are_set_back() {
    let law = "before_activation = \"law\"\nmasonry_strength = 1.5e6\nconfidence_factor = 1.2";
    let outcome = checked(&strip(0.03, "hinge_ratio = 0.5", law)).unwrap();
    for (side, alpha0, d0, t0, slv, ratio, slc) in [
        (positive(&outcome), 1.89081, 0.140148, 0.105823, 1.05210, 0.859428, 1.14595),
        (negative(&outcome), 1.61235, 0.119508, 0.107433, 0.886574, 0.732858, 0.977179),
    ] {
        let t = side.set_back;
        near_all(&[t.base, t.middle, t.top], &[0.0401643, 0.0341998, 0.0282353], "set-backs");
        near_all(&[side.alpha0, side.d0, side.t0], &[alpha0, d0, t0], "the curve");
        let found = displaced(side.slv);
        assert!(found.raised);
        near_all(&[found.period, found.zeta, found.ratio], &[0.410335, slv, ratio], "SLV");
        near(displaced(side.slc).zeta, slc, "SLC");
    }
    let site = "{ ag = 0.15, F0 = 2.45, TC = 0.32 }";
    let outcome = checked(&format!(
        "{PARAPET}overburden = 20e3\noverburden_eccentricity = 0.05\neccentricity_mode = \"fixed_to_wall\"\n\
         [check]\ncode = \"circolare-2019\"\nsoil = \"B\"\nbefore_activation = \"rigid\"\noverburden_mass = \
         0\n masonry_strength = 1.2e6\nconfidence_factor = 1.2\nSLD = {site}\nSLV = {site}\n"
    ))
    .unwrap();
    for (side, expected) in [
        (positive(&outcome), [0.841674, 0.128854, 0.106676, 0.596545, 1.37137, 0.732291]),
        (negative(&outcome), [0.871405, 0.164248, 0.135979, 0.760409, 1.37137, 0.933444]),
    ] {
        let slv = displaced(side.slv);
        let found = [side.a3, side.alpha0, side.d0, side.sld.unwrap().ratio, slv.period, slv.zeta];
        near_all(&found, &expected, "parapet");
        near(side.set_back.base, 0.0283840, "t");
    }
}

/// A wall whose hinges are set back is the one with a₃ = F0'/F0 and parallel softening.
#[test]
fn set_back_hinges_are_a_law_with_a3() {
    let site = "{ ag = 0.15, F0 = 2.45, TC = 0.32 }";
    let text = |law: &str, more: &str| {
        format!(
            "{PARAPET}[force_law]\na1 = 0.03\n{law}[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\n\
             before_activation = \"law\"\nconfidence_factor = 1.2\n{more}\nSLD = {site}\nSLV = {site}\n"
        )
    };
    let set_back = checked(&text("", "masonry_strength = 2e6")).unwrap();
    let a3 = positive(&set_back).a3;
    let law = format!("a3 = {a3}\nsoftening = \"parallel\"\n");
    let given = checked(&text(&law, "compression_considered = true")).unwrap();
    let [one, other] = [&set_back, &given].map(positive);
    // some roundings
    for (found, expected) in [
        (one.alpha0, other.alpha0),
        (one.d0, other.d0),
        (one.t0, other.t0),
        (one.sld.unwrap().ratio, other.sld.unwrap().ratio),
        (one.slv.unwrap().zeta, other.slv.unwrap().zeta),
    ] {
        assert!(a3 < 1.0 && (found - expected).abs() <= 1e-14 * expected, "{found} for {expected}");
    }
}

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
        let checks = [side.sld.unwrap(), side.slv_q.unwrap()];
        near_all(&checks.map(|check| check.ratio), &[sld, slv_q], "activation");
        near_all(&checks.map(|check| check.required.unwrap()), &required, "required strength");
        near(side.activation.alpha0, alpha0, "alpha0");
        near(checks[1].demand, 2.95266, "a_g S");
        let other = negative(&outcome);
        near_all(&[other.sld.unwrap().ratio, other.slv_q.unwrap().ratio], &[0.349585, 0.323213], "untied");
        assert!(other.sld.unwrap().required.is_none() && other.tie.is_none());
    }
    let printed = checked(&facade(tie, "height_demand = \"printed\"")).unwrap();
    let slv_q = positive(&printed).slv_q.unwrap();
    near_all(&[slv_q.demand, slv_q.required.unwrap()], &[2.76489, 6074.95], "a_Z as printed");

    let outcome = checked(&parapet("tie_stiffness = 2.4e6\ntie_strength = 2e3", yields)).unwrap();
    let side = positive(&outcome);
    let (at, sld, slv_q) = (side.activation, side.sld.unwrap(), side.slv_q.unwrap());
    near_all(&[at.alpha0, at.acceleration, at.t0, side.t0], &[0.774366, 7.47391, 0.0610314, 0.356487], "P");
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
        let (found, last) = (displaced(side.slv), displaced(side.slc));
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
        near_all(&[displaced(side.slv).zeta, displaced(side.slc).zeta], &[slv, slc], "first edition (c)");
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
    near_all(&[side.sld.unwrap().ratio, side.slv_q.unwrap().ratio], &[2.13421, 1.97321], "bar at activation");
    let (slv, slc) = (displaced(side.slv), displaced(side.slc));
    near_all(&[side.tie.unwrap().breaks.unwrap(), slv.d, slv.zeta], &[0.0617647, 0.0713609, 1.15475], "bar");
    near_all(&[slc.ratio, slc.zeta], &[0.556940, 0.664546], "bar, SLC");
    let outcome = bar(", anchor_capacity = 30e3");
    let slv = displaced(positive(&outcome).slv);
    near_all(&[slv.ratio, slv.zeta], &[0.418495, 0.584854], "a weak anchor");
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
        let slv = displaced(side.slv);
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
    find(&*code, (&scene).into(), Sought::TieStrength, &mut |_, _| {}).unwrap()
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
    for (check, value) in [("SLD", 5964.40), ("SLV with q", 6668.36), ("SLV", 18988.6), ("SLC", 25044.5)] {
        near(of(&found, check).value.unwrap(), value, check);
    }
    assert!(found.text().contains("smallest tie_strength that passes: 25044"), "{}", found.text());
}

/// Both sides differ, and the tie is on one: the other blocks, and is named.
#[test]
fn a_side_without_a_tie_blocks() {
    let text = facade("tie_stiffness = 5e6\ntie_strength = 10e3\ntie_ultimate = 0.3", "");
    let scene = Scene::parse("scene.toml", &text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", &text).unwrap()).unwrap();
    let found = find(&*code, (&scene).into(), Sought::TieStrength, &mut |_, _| {}).unwrap();
    assert!(found.text().contains("u < 0: the side without a tie governs"), "{}", found.text());
    // a bar is sought by its diameter; a wall without one has none to seek
    let error = find(&*code, (&scene).into(), Sought::BarDiameter, &mut |_, _| {}).unwrap_err().to_string();
    assert!(error.contains("the tie has no bar"), "{error}");
    let bar = "rocking = \"one_sided_positive\"\ntie = { at_activation = \"yield\", bar = { diameter = \
               0.016, length = 6, yield_stress = 235e6, ultimate_strain = 0.06, spacing = 3 } }";
    let text = facade("", bar);
    let scene = Scene::parse("scene.toml", &text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", &text).unwrap()).unwrap();
    let found = find(&*code, (&scene).into(), Sought::BarDiameter, &mut |_, _| {}).unwrap();
    let diameter = found.value.unwrap();
    for (factor, passes) in [(1.0, true), (1.0 - 1e-6, false)] {
        let text = text.replace("diameter = 0.016", &format!("diameter = {}", diameter * factor));
        assert_eq!(checked(&text).unwrap().passed, passes, "{factor} of {diameter}");
    }
}
