//! What must hold of every check by Circolare 7/2019.

use proptest::prelude::*;

use crate::circolare::{checked, near};

/// A rigid parapet or strip wall, its site and its building, as text with gaps for what a property changes.
#[derive(Clone, Debug)]
struct Case {
    strip: bool,
    height: f64,
    slenderness: f64,
    eccentricity: f64,
    ag: f64,
    period: Option<f64>,
}

impl Case {
    fn text(&self, width: f64, sign: f64, factor: f64) -> String {
        let (mechanism, mass) =
            if self.strip { ("vertical_spanning", "") } else { ("parapet", "overburden_mass = 0.5\n") };
        let thickness = self.height / self.slenderness;
        let floor = self.period.map_or(String::new(), |period| {
            format!("building = {{ storeys = 3, period = {period}, height_ratio = 0.9 }}\n")
        });
        let damping = self.period.map_or("", |_| ", building_damping = 0.1");
        // on soil A the shape of the spectrum does not depend on a_g, except for T_D
        let site = format!("{{ ag = {}, F0 = 2.45, TC = 0.32{damping} }}", self.ag * factor);
        format!(
            "[geometry]\nmechanism = {mechanism:?}\nhinge_ratio = 0.5\nheight = {}\nthickness = \
             {thickness}\ndensity = 1800\nwidth = {width}\n overburden = {}\noverburden_eccentricity = {}\n\
             [check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"A\"\n{mass}{floor}\
             SLD = {site}\nSLV = {site}\nSLC = {site}\n",
            self.height,
            1e4 * width,
            sign * self.eccentricity * thickness,
        )
    }
}

fn case() -> impl Strategy<Value = Case> {
    let period = prop_oneof![Just(None), (0.05..1.5).prop_map(Some)];
    (any::<bool>(), 1.5..6.0, 5.0..20.0, -0.2..0.2, 0.02..0.3, period).prop_map(
        |(strip, height, slenderness, eccentricity, ag, period)| Case {
            strip,
            height,
            slenderness,
            eccentricity,
            ag,
            period,
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// ζ does not depend on the width; mirrored walls swap their sides.
    #[test]
    fn width_and_mirror(case in case(), width in 0.3..3.0) {
        let verdict = checked(&case.text(1.0, 1.0, 1.0)).unwrap();
        let wide = checked(&case.text(width, 1.0, 1.0)).unwrap();
        near(wide.governs.zeta, verdict.governs.zeta, "width");
        let mirrored = checked(&case.text(1.0, -1.0, 1.0)).unwrap();
        // the eccentricity of a strip wall is that of both sides alike, by mode
        let [one, other] = [&verdict.sides.positive, &mirrored.sides.negative].map(|s| s.as_ref().unwrap());
        near(one.curve.d0, other.curve.d0, "d_0 of the mirrored wall");
        near(one.checks.slv.unwrap().zeta, other.checks.slv.unwrap().zeta, "SLV of the mirrored wall");
        near(one.checks.sld.unwrap().ratio, other.checks.sld.unwrap().ratio, "SLD of the mirrored wall");
    }

    /// Capacity over demand falls as 1/a_g while T_D stays beyond the periods: rock, short periods.
    #[test]
    fn shaking(case in case(), factor in 0.5..3.0) {
        let [weak, strong] = [1.0, factor].map(|factor| checked(&case.text(1.0, 1.0, factor)).unwrap());
        let [weak, strong] = [&weak, &strong].map(|v| v.sides.positive.as_ref().unwrap());
        near(strong.checks.sld.unwrap().ratio * factor, weak.checks.sld.unwrap().ratio, "SLD");
        near(strong.checks.slv_q.unwrap().ratio * factor, weak.checks.slv_q.unwrap().ratio, "SLV with q");
        if weak.checks.slc.unwrap().period < 1.6 {
            near(strong.checks.slv.unwrap().ratio * factor, weak.checks.slv.unwrap().ratio, "SLV");
            near(strong.checks.slc.unwrap().ratio * factor, weak.checks.slc.unwrap().ratio, "SLC");
        }
    }

    /// A tie that never breaks does not lower ζ of SLV on the ground.
    #[test]
    fn a_lasting_tie_does_not_harm(stiffness in 1e2..1e7_f64, slack in 0.0..0.05, height in 0.5..4.0) {
        let wall = "[geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\n";
        let tie = format!("[tie]\ntie_height = {height}\ntie_stiffness = {stiffness}\ntie_slack = {slack}\n");
        let table = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n\
                     SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }\n";
        let [free, tied] = ["", &tie].map(|tie| checked(&format!("{wall}{tie}{table}")).unwrap());
        prop_assert!(tied.governs.zeta >= free.governs.zeta * (1.0 - 1e-12));
    }
}

/// A stiff building moves with the ground: a_Z and, beyond its period, the displacement demand are those of
/// the ground times γψ.
#[test]
fn a_stiff_building_is_the_ground() {
    let text = |building: &str, damping: &str| {
        format!(
            "[geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\n[check]\ncode = \"circolare-2019\"\n\
             before_activation = \"rigid\"\nsoil = \"B\"\n{building}\n\
             SLD = {{ ag = 0.15, F0 = 2.45, TC = 0.32{damping} }}\n\
             SLV = {{ ag = 0.15, F0 = 2.45, TC = 0.32{damping} }}\n"
        )
    };
    let ground = checked(&text("", "")).unwrap();
    // a participation of 1 over √(1 + 4 ξ_k²) leaves a_g S
    let participation = 1.0 / (1.0_f64 + 4.0 * 0.05 * 0.05).sqrt();
    let building = format!("building = {{ modes = [{{ period = 1e-6, participation = {participation} }}] }}");
    let stiff = checked(&text(&building, ", building_damping = 0.05")).unwrap();
    let [ground, stiff] = [&ground, &stiff].map(|verdict| verdict.sides.positive.as_ref().unwrap());
    near(stiff.checks.sld.unwrap().demand, ground.checks.sld.unwrap().demand, "a_Z");
    near(stiff.checks.slv.unwrap().demand, ground.checks.slv.unwrap().demand, "S_d");
}
