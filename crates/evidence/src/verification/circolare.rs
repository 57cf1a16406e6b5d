//! Worked examples of the check by Circolare 7/2019.

use std::path::Path;

use scene::Scene;

use super::given::{SIX_DIGITS, within};
use crate::{Comparison, EvidenceError};
use check::CheckFile;
use check::circolare::{
    Checks, GroundSpectrum, Hazard, Outcome, SideVerdict, Soil, Statement, damping_factor,
};

/// The site of the examples, and walls: a parapet, the same with a tie, a strip wall under the roof.
const SITE: &str = "ag = 0.15, F0 = 2.45, TC = 0.32";
const PARAPET: &str =
    "geometry = { height = 4, thickness = 0.4, density = 1800 }\nforce_law = { a1 = 0.03 }\n";
const TIE: &str = "tie = { tie_stiffness = 2e5, tie_height = 3, tie_slack = 0.03, tie_strength = 5e3 }\n";
const STRIP: &str = "geometry.mechanism = \"vertical_spanning\"\ngeometry.height = 3\n\
                     geometry.thickness = 0.25\ngeometry.density = 1800\ngeometry.overburden = 10e3\n\
                     force_law = { a1 = 0.03 }\n";

/// Checks a wall on the ground, or at z/H of a building of three storeys.
fn checked(wall: &str, height_ratio: Option<f64>) -> Result<Outcome, EvidenceError> {
    let (mut building, mut damping) = (String::new(), [""; 2]);
    if let Some(ratio) = height_ratio {
        building = format!("building = {{ storeys = 3, period = 0.3, height_ratio = {ratio:?} }}\n");
        damping = [", building_damping = 0.05", ", building_damping = 0.10"];
    }
    let [sld, ultimate] = damping;
    let text = format!(
        "{wall}[check]\ncode = \"circolare-2019\"\nbefore_activation = \"law\"\nsoil = \"B\"\n{building}\
         SLD = {{ {SITE}{sld} }}\nSLV = {{ {SITE}{ultimate} }}\nSLC = {{ {SITE}{ultimate} }}\n"
    );
    let scene = Scene::parse("example", &text, Path::new("."))?;
    let file = CheckFile::parse("example", &text)?;
    let outcome = || Ok(Statement::read(&file)?.checked((&scene).into())?.outcome);
    Ok(outcome().map_err(|error| file.located(error))?)
}

/// T0, the onset `a_y`, and ζ of SLD, SLV and SLC of the side u > 0.
fn results(side: Option<&SideVerdict>) -> [f64; 5] {
    side.map_or([f64::NAN; 5], |side| {
        let Checks { sld, slv, slc, .. } = side.checks;
        let ratios = [sld.map(|check| check.ratio), slv.map(|check| check.zeta), slc.map(|check| check.zeta)];
        let [sld, slv, slc] = ratios.map(|ratio| ratio.unwrap_or(f64::NAN));
        [side.curve.t0, side.curve.ay, sld, slv, slc]
    })
}

pub(super) fn examples() -> Result<Vec<Comparison>, EvidenceError> {
    let ground = GroundSpectrum::new(Hazard { ag: 0.15, f0: 2.45, tc: 0.32 }, Soil::B, 1.0);
    let case = "site, soil B";
    let mut comparisons = within(
        SIX_DIGITS,
        [
            (case, "S_S", "-", ground.soil_factor, 1.2),
            (case, "T_C", "s", ground.t_c, 0.442_092),
            (case, "S_e(0.3 s), 5 %", "m/s2", ground.acceleration(0.3, 0.05), 4.32621),
            (case, "eta of 8 %", "-", damping_factor(0.08), 0.877_058),
        ],
    );
    let tied = format!("{PARAPET}{TIE}");
    for (name, wall, ratio, given) in [
        ("parapet on the ground", PARAPET, None, [0.498_925, 0.951_57, 0.183_875, 0.855_812, 1.37893]),
        ("parapet on the roof", PARAPET, Some(1.0), [0.498_925, 0.951_57, 0.070_611_9, 0.790_84, 0.913_095]),
        ("tied parapet", &*tied, None, [f64::NAN, f64::NAN, f64::NAN, 1.35612, 1.37893]),
        ("tied parapet on the roof", &*tied, Some(1.0), [f64::NAN, f64::NAN, f64::NAN, 0.727_534, 0.913_095]),
        (
            "strip wall below the roof",
            STRIP,
            Some(7.5 / 9.0),
            [0.136_359, 6.76449, 0.442_265, 1.02249, 1.31793],
        ),
    ] {
        let found = results(checked(wall, ratio)?.sides.positive.as_ref());
        let names = [("T0", "s"), ("a_y", "m/s2"), ("zeta SLD", "-"), ("zeta SLV", "-"), ("zeta SLC", "-")];
        let rows = (0..names.len()).map(|k| (name, names[k].0, names[k].1, found[k], given[k]));
        // a tie has no number there in the examples
        comparisons.extend(within(SIX_DIGITS, rows.filter(|row| !row.4.is_nan())));
    }
    Ok(comparisons)
}
