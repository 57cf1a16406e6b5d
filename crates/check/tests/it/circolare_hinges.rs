//! Hinges that are searched or set back in the check by Circolare 7/2019: worked examples, which an
//! independent program computed. Their numbers have six digits.
#![allow(clippy::unreadable_literal, reason = "numbers as the examples print them")]

use check::circolare::{DisplacementCheck, Outcome, SideVerdict};

use crate::circolare::{PARAPET, checked, near};

/// Where ζ is flat, a searched hinge is known less well than ζ.
const HINGE: f64 = 1e-4;

/// The site and the building of the examples, with the place of the wall; SLD raises SLC, too.
pub(crate) fn palazzo(height_ratio: f64, more: &str) -> String {
    format!(
        "[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\nraise_slc = true\n{more}\n\
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
pub(crate) fn parapet(tie: &str, more: &str) -> String {
    let scene = include_str!("../../../../scenes/checked_parapet.toml");
    let tie = format!("[tie]\ntie_height = 1.0\n{tie}\n[force_law]");
    let (wall, check) = scene.split_once("[check]\n").unwrap();
    format!("{}[check]\n{more}\n{check}", wall.replace("[force_law]", &tie))
}

pub(crate) fn positive(outcome: &Outcome) -> &SideVerdict {
    outcome.sides.positive.as_ref().unwrap()
}

pub(crate) fn negative(outcome: &Outcome) -> &SideVerdict {
    outcome.sides.negative.as_ref().unwrap()
}

pub(crate) fn near_all(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len());
    for (index, (found, expected)) in found.iter().zip(expected).enumerate() {
        near(*found, *expected, &format!("{what}, number {index}"));
    }
}

/// `ζ_E` of SLD, SLV with q, SLV and SLC, and their hinges.
fn zetas(side: &SideVerdict) -> ([f64; 4], [f64; 4]) {
    let none = f64::NAN;
    let activation = [side.checks.sld, side.checks.slv_q]
        .map(|check| check.map_or([none; 2], |c| [c.ratio, c.hinge.unwrap_or(none)]));
    let displaced = [side.checks.slv, side.checks.slc]
        .map(|check| check.map_or([none; 2], |c| [c.zeta, c.hinge.unwrap_or(none)]));
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
            near(side.checks.slv.unwrap().ratio, ratio, "SLV by displacement");
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
        near(negative(&outcome).checks.slv.unwrap().zeta, slv, "a given hinge");
    }
    // the least α0 is the default of a strip without hinge_ratio
    let outcome = checked(&strip(0.03, "", law)).unwrap();
    let side = negative(&outcome);
    near_all(&zetas(side).0, &[2.45573, 2.60430, 0.978529, 1.02206], "least alpha0");
    near(side.checks.slv.unwrap().ratio, 0.774090, "SLV by displacement");
    for hinge in zetas(side).1 {
        assert!((hinge - 0.660745).abs() < HINGE, "{hinge}");
    }
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

pub(crate) fn displaced(check: Option<DisplacementCheck>) -> DisplacementCheck {
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
        let t = side.curve.set_back;
        near_all(&[t.base, t.middle, t.top], &[0.0401643, 0.0341998, 0.0282353], "set-backs");
        near_all(&[side.curve.alpha0, side.curve.d0, side.curve.t0], &[alpha0, d0, t0], "the curve");
        let found = displaced(side.checks.slv);
        assert!(found.raised);
        near_all(&[found.period, found.zeta, found.ratio], &[0.410335, slv, ratio], "SLV");
        near(displaced(side.checks.slc).zeta, slc, "SLC");
    }
    let site = "{ ag = 0.15, F0 = 2.45, TC = 0.32 }";
    let outcome = checked(&format!(
        "{PARAPET}overburden = 20e3\noverburden_eccentricity = 0.05\neccentricity_mode = \"fixed_to_wall\"\n\
         [check]\ncode = \"circolare-2019\"\nsoil = \"B\"\nbefore_activation = \"rigid\"\noverburden_mass = \
         0\n masonry_strength = 1.2e6\nconfidence_factor = 1.2\nSLD = {site}\nSLV = {site}\n"
    ))
    .unwrap();
    for (side, edges, expected) in [
        (positive(&outcome), 0.153092, [0.841674, 0.128854, 0.106676, 0.596545, 1.37137, 0.732291]),
        (negative(&outcome), 0.188487, [0.871405, 0.164248, 0.135979, 0.760409, 1.37137, 0.933444]),
    ] {
        near(side.curve.alpha0 / side.curve.a3, edges, "alpha0 with the hinges at the edges");
        let slv = displaced(side.checks.slv);
        let found = [
            side.curve.a3,
            side.curve.alpha0,
            side.curve.d0,
            side.checks.sld.unwrap().ratio,
            slv.period,
            slv.zeta,
        ];
        near_all(&found, &expected, "parapet");
        near(side.curve.set_back.base, 0.0283840, "t");
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
    let a3 = positive(&set_back).curve.a3;
    let law = format!("a3 = {a3}\nsoftening = \"parallel\"\n");
    let given = checked(&text(&law, "compression_considered = true")).unwrap();
    let [one, other] = [&set_back, &given].map(positive);
    // some roundings
    for (found, expected) in [
        (one.curve.alpha0, other.curve.alpha0),
        (one.curve.d0, other.curve.d0),
        (one.curve.t0, other.curve.t0),
        (one.checks.sld.unwrap().ratio, other.checks.sld.unwrap().ratio),
        (one.checks.slv.unwrap().zeta, other.checks.slv.unwrap().zeta),
    ] {
        assert!(a3 < 1.0 && (found - expected).abs() <= 1e-14 * expected, "{found} for {expected}");
    }
}
