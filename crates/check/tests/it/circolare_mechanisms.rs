//! Mechanisms whose shape is searched in the check by Circolare 7/2019: the hinge of strips of parts, and the
//! crack of a transverse wall. Beside them brute-force scans by the sums of the text.

use crate::circolare::{refuses, sides_in_json, warns};
use crate::circolare_bodies::{check, json, load, near, number, part};
use crate::formulas::assert_gives;
use crate::report::{plain, report_of_one};

const G: f64 = 9.81;
const DENSITY: f64 = 1800.0;

/// A strip of two parts, flush outside, with loads (force, height, place) whose masses move, and ties that
/// count at the activation.
struct Strip {
    /// Thickness and height.
    parts: [[f64; 2]; 2],
    loads: Vec<[f64; 3]>,
    /// Height and strength.
    ties: Vec<[f64; 2]>,
}

impl Strip {
    /// One of many strips, by its number: numbers from 0 to 1 of a linear congruence.
    fn numbered(seed: u64) -> Self {
        let mut state = 1 + 7919 * seed;
        let mut next = |from: f64, to: f64| {
            state = (state * 48_271) % 2_147_483_647;
            let share = u32::try_from(state).unwrap();
            from + (to - from) * f64::from(share) / 2_147_483_647.0
        };
        let parts = [[next(0.25, 0.6), next(2.5, 4.0)], [next(0.25, 0.6), next(2.5, 4.0)]];
        let (step, top) = (parts[0][1], parts[0][1] + parts[1][1]);
        let thin = parts[0][0].min(parts[1][0]);
        let at_step = [next(5e3, 40e3), step, next(0.0, 1.2 * thin)];
        let within = [next(0.0, 20e3), next(0.2, 0.8) * top, next(0.0, 1.2 * thin)];
        let loads = vec![at_step, within, [next(5e3, 20e3), top, 0.5 * parts[1][0]]];
        Self { parts, loads, ties: Vec::new() }
    }

    fn height(&self) -> f64 {
        self.parts[0][1] + self.parts[1][1]
    }

    /// The displacement of a height for one of 1 at the hinge.
    fn phi(&self, z: f64, h1: f64) -> f64 {
        if z <= h1 { z / h1 } else { (self.height() - z) / (self.height() - h1) }
    }

    fn alpha0(&self, h1: f64, sign: f64) -> f64 {
        let [held, pushed] = self.work(h1, sign);
        held / pushed
    }

    /// What holds and what pushes with the hinge at a height, by the virtual work of both bodies about their
    /// toes.
    fn work(&self, h1: f64, sign: f64) -> [f64; 2] {
        let [[lower, step], [upper, _]] = self.parts;
        let (h, h2) = (self.height(), self.height() - h1);
        let [below, above] = [if h1 <= step { lower } else { upper }, if h1 < step { lower } else { upper }];
        // the base bears at the outer toe of the side, the hinge at the other edge of the thinner section
        let [base, hinge] = if sign > 0.0 { [0.0, below.min(above)] } else { [lower, 0.0] };
        let (mut held, mut pushed) = (0.0, 0.0);
        let mut add = |force: f64, x: f64, z: f64, is_lower: bool| {
            if is_lower {
                held += force * sign * (x - base) / h1;
                pushed += force * z / h1;
            } else {
                held += force * sign * ((hinge - base) / h1 + (hinge - x) / h2);
                pushed += force * (h - z) / h2;
            }
        };
        for (thickness, from, to) in [(lower, 0.0, step), (upper, step, h)] {
            for (from, to, is_lower) in [(from, to.min(h1), true), (from.max(h1), to, false)] {
                if from < to {
                    let weight = DENSITY * G * thickness * (to - from);
                    add(weight, 0.5 * thickness, 0.5 * (from + to), is_lower);
                }
            }
        }
        self.loads.iter().for_each(|[force, z, x]| add(*force, *x, *z, *z <= h1));
        held += self.ties.iter().map(|[z, strength]| strength * self.phi(*z, h1)).sum::<f64>();
        [held, pushed]
    }

    /// The least α0 of a scan, and its height: equal heights, and both sides of the step and of each load.
    fn scanned(&self, sign: f64) -> [f64; 2] {
        let (h, step) = (self.height(), self.parts[0][1]);
        let equal = (0..=20_000).map(|index| h * (0.1 + 0.8 * f64::from(index) / 20_000.0));
        let jumps = self.loads.iter().map(|load| load[1]).chain([step]).filter(|z| *z < 0.9 * h);
        let sides = jumps.flat_map(|z| [z - 1e-8, z, z + 1e-8]);
        let all = equal.chain(sides).map(|z| [self.alpha0(z, sign), z]);
        all.min_by(|a, b| a[0].total_cmp(&b[0])).unwrap()
    }

    fn scene(&self) -> String {
        let parts = self.parts.map(|[thickness, height]| part(thickness, height)).concat();
        let loads: String = self.loads.iter().map(|[force, z, x]| load(*force, *z, *x, 1.0, "")).collect();
        let tie = |[z, strength]: &[f64; 2]| {
            format!(
                "[[tie]]\ntie_height = {z}\ntie_stiffness = {STIFFNESS}\ntie_strength = {strength}\n\
                 tie_ultimate = 0.5\ntie_side = \"both\"\n"
            )
        };
        let ties: String = self.ties.iter().map(tie).collect();
        let counts = if ties.is_empty() { "" } else { "tie = { at_activation = \"yield\" }" };
        format!("[geometry]\nmechanism = \"vertical_spanning\"\n{parts}{loads}{ties}{}", check(counts))
    }
}

/// Stiffness of ties \[N/m\].
const STIFFNESS: f64 = 2e7;

/// The hinge of a strip of parts is where a scan of all heights has the least α0, at the step of the
/// thickness and at loads on the side that has it.
#[test]
fn the_hinge_of_a_strip_of_parts_has_the_least_multiplier_of_all_heights() {
    let (mut at_jumps, mut beside) = (0, 0);
    for seed in 0..30 {
        let strip = Strip::numbered(seed);
        let sides = sides_in_json(&strip.scene());
        for (side, sign) in [("positive", 1.0), ("negative", -1.0)] {
            let [scanned, z] = strip.scanned(sign);
            let found = number(&sides, &[side, "least_alpha0", "alpha0"]);
            // the scan has steps of 0.8/20000 h; the sides of a jump are 4e-9 h away
            assert!(
                (found / scanned - 1.0).abs() < 2e-7,
                "{seed} {side}: {found}, a scan {scanned} at {z} m"
            );
            let is_at = |jump: f64| (z - jump).abs() < 1e-6;
            if is_at(strip.parts[0][1]) || strip.loads.iter().any(|load| is_at(load[1])) {
                at_jumps += 1;
            } else {
                beside += 1;
            }
        }
    }
    assert!(at_jumps > 5 && beside > 5, "{at_jumps} at a jump, {beside} beside");
}

/// Ties of a strip do virtual work by φ, and are stretched by φ u: at the hinge of the least α0 of all
/// heights, and with the hinge of the scene at the activation and at the limit state.
#[test]
fn ties_of_a_strip_hold_it_by_their_displacement() {
    for seed in 0..8 {
        let mut strip = Strip::numbered(seed);
        let by_rule = |strip: &Strip, rule: &str| {
            sides_in_json(&strip.scene().replace("[check]\n", &format!("[check]\nhinge = \"{rule}\"\n")))
        };
        let rules = ["least_alpha0", "worst"];
        let without = rules.map(|rule| by_rule(&strip, rule));
        let (h, untied) = (strip.height(), sides_in_json(&strip.scene()));
        strip.ties = vec![[0.4 * h, 2e3], [0.55 * h, 3e3]];
        strip.ties.truncate(1 + usize::from(seed % 2 == 1));
        for (rule, without) in rules.iter().zip(without) {
            let with = by_rule(&strip, rule);
            for (side, sign) in [("positive", 1.0), ("negative", -1.0)] {
                let found = &with[side];
                let h1 = number(found, &["hinge_ratio"]) * h;
                near(number(found, &["activation", "alpha0"]), strip.alpha0(h1, sign), "alpha0 of a rule");
                let zeta = number(found, &["untied", "SLV"]);
                near(zeta, number(&without, &[side, "SLV", "zeta_E"]), "zeta_E without ties");
            }
        }
        let sides = sides_in_json(&strip.scene());
        assert!(assert_gives(&report_of_one(&strip.scene())) > 40, "{seed}");
        for (side, sign) in [("positive", 1.0), ("negative", -1.0)] {
            let (found, own) = (&sides[side], &untied[side]);
            let [scanned, z] = strip.scanned(sign);
            let least = number(found, &["least_alpha0", "alpha0"]);
            // as for strips without ties
            assert!((least / scanned - 1.0).abs() < 2e-7, "{seed}: {least}, a scan {scanned} at {z} m");
            let h1 = number(found, &["hinge_ratio"]) * h;
            near(number(found, &["activation", "alpha0"]), strip.alpha0(h1, sign), "alpha0");
            let [_, pushed] = strip.work(h1, sign);
            let d = number(found, &["SLV", "d"]);
            let (u, mut work) = (d / number(found, &["d_per_u"]), 0.0);
            for (index, [z, strength]) in strip.ties.iter().enumerate() {
                let phi = strip.phi(*z, h1);
                work += phi * strength.min(STIFFNESS * phi * u);
                let tie = if strip.ties.len() == 1 { &found["tie"] } else { &found["ties"][index] };
                near(number(tie, &["u_yield"]), strength / STIFFNESS / phi, "u_yield");
                near(number(tie, &["u_break"]), (strength / STIFFNESS + 0.5) / phi, "u_break");
            }
            // a = g α/(e* FC), the curve of the wall alone as it is without ties
            let alpha = number(own, &["alpha0"]) * (1.0 - d / number(own, &["d0"])) + work / pushed;
            near(number(found, &["SLV", "a"]), G * alpha / number(own, &["e_star"]) / 1.35, "a(d_SLV)");
        }
    }
}

/// A wedge of a transverse wall, 0.5 m thick, behind a façade of 0.45 m.
fn wedge(height: f64, angles: &str) -> String {
    let wedge = format!(
        "[[geometry.part]]\nbase = 0\nheight = {height}\nthickness = [0, 1]\nwidth = 0.5\nouter = 0.45\n\
         density = 1800\n"
    );
    part(0.45, height) + &wedge + &check(&format!("rocking = \"one_sided_positive\"\n{angles}"))
}

/// α0 of that façade with the wedge of a slope tan β and a moment that holds it.
fn of_wedge(height: f64, slope: f64, moment: f64) -> f64 {
    let wall = 0.45 * height * DENSITY * G;
    let own = 0.5 * 0.5 * slope * height * height * DENSITY * G;
    (wall * 0.225 + own * (0.45 + slope * height / 3.0) + moment)
        / (wall * 0.5 * height + own * 2.0 / 3.0 * height)
}

/// Without a tie the smallest wedge is that of the least α0; what the tie holds makes a larger one worse.
#[test]
fn the_crack_of_a_wedge_is_at_the_least_multiplier() {
    let smallest = sides_in_json(&wedge(6.0, "crack_angles = [15, 40]"));
    assert_eq!(number(&smallest, &["positive", "crack_angle"]), 15.0);
    let slope = 15.0_f64.to_radians().tan();
    near(number(&smallest, &["positive", "alpha0"]), of_wedge(6.0, slope, 0.0), "alpha0");
    warns(
        &wedge(6.0, "crack_angles = [15, 40]"),
        "the least alpha0 is at the smallest angle of the crack, 15°",
    );
    let tie = "[tie]\ntie_height = 5.8\ntie_stiffness = 2e7\ntie_strength = 20e3\ntie_ultimate = 0.1\n";
    let yields = "crack_angles = [5, 60]\ntie = { at_activation = \"yield\" }";
    let sides = sides_in_json(&(tie.to_owned() + &wedge(6.0, yields)));
    let of = |angle: f64| of_wedge(6.0, angle.to_radians().tan(), 20e3 * 5.8);
    let scan = (0..=55_000).map(|index| 5.0 + f64::from(index) * 1e-3);
    let best = scan.min_by(|a, b| of(*a).total_cmp(&of(*b))).unwrap();
    assert!(best > 6.0 && best < 59.0, "{best}");
    let angle = number(&sides, &["positive", "crack_angle"]);
    assert!((angle - best).abs() < 1e-3, "{angle}, a scan {best}");
    near(number(&sides, &["positive", "activation", "alpha0"]), of(angle), "alpha0 with the tie");
    let narrow = tie.to_owned() + &wedge(6.0, &yields.replace("60", "6"));
    warns(&narrow, "the least alpha0 is at the largest angle of the crack, 6°: beyond it may be lower");
}

/// A wedge of several parts keeps one straight crack, and takes along what the façade leaves it.
#[test]
fn the_parts_of_a_wedge_have_one_crack() {
    let tall = |base: f64, height: f64, thickness: &str| {
        format!(
            "[[geometry.part]]\nbase = {base}\nheight = {height}\nthickness = {thickness}\nwidth = 0.5\n\
             outer = 0.45\ndensity = 1800\n"
        )
    };
    let angles = check("rocking = \"one_sided_positive\"\ncrack_angles = [20, 30]");
    let parts = part(0.45, 6.0) + &tall(0.0, 2.0, "[0, 0.5]") + &tall(2.0, 4.0, "[0.5, 2.5]");
    let (cut, whole) =
        (sides_in_json(&(parts + &angles)), sides_in_json(&wedge(6.0, "crack_angles = [20, 30]")));
    for key in ["alpha0", "d0", "crack_angle"] {
        near(number(&cut, &["positive", key]), number(&whole, &["positive", key]), key);
    }
}

/// A level above the wedge has none: what stands on the façade turns alone.
#[test]
fn a_level_above_the_wedge_has_no_crack() {
    let levels = "crack_angles = [15, 30]\nhinge_levels = [0, 6]";
    let gable = part(0.3, 2.0) + "base = 6\n";
    let found = json(&wedge(6.0, levels).replace("[check]", &(gable + "[check]")));
    let of = |level: usize, key: &str| found["levels"][level]["sides"]["positive"][key].as_f64();
    assert_eq!((of(0, "crack_angle"), of(1, "crack_angle")), (Some(15.0), None));
    near(of(1, "alpha0").unwrap(), 0.15, "alpha0 above");
}

/// Angles need a wedge, and limits that rise.
#[test]
fn angles_of_a_crack_are_refused_without_a_wedge() {
    let one_sided = "rocking = \"one_sided_positive\"\ncrack_angles = [15, 30]";
    refuses(
        &(part(0.4, 4.0) + &check(one_sided)),
        "crack_angles = [15, 30]: the wall has no wedge; give a part",
    );
    refuses(
        &wedge(6.0, "crack_angles = [30, 15]"),
        "crack_angles = [30, 15] must rise, within 1 to 80 degrees",
    );
    refuses(&wedge(6.0, "crack_angles = [0, 15]"), "crack_angles = [0, 15] must rise");
    let slack = "[tie]\ntie_height = 5.8\ntie_stiffness = 2e7\ntie_strength = 4e4\ntie_slack = 0.01\n";
    let yields = "crack_angles = [5, 60]\ntie = { at_activation = \"yield\" }";
    refuses(&(slack.to_owned() + &wedge(6.0, yields)), "with the crack at 5 degrees: at_activation");
}

/// A corner of two walls by its integrals: about an axis across the diagonal, with the thrust of the hip.
#[test]
fn a_corner_turns_about_its_diagonal() {
    // walls 0.5 m thick, 3.2 m high, cracks at 25 degrees from the pier of the corner on
    let (t, h, slope) = (0.5_f64, 3.2_f64, 25.0_f64.to_radians().tan());
    let [pier, wedges] = [t * t * h, t * slope * h * h].map(|volume| DENSITY * volume);
    let root = 2.0_f64.sqrt();
    let arm = (pier * t + wedges * (1.5 * t + slope * h / 3.0)) / root / (pier + wedges);
    let z = (pier * h / 2.0 + wedges * 2.0 * h / 3.0) / (pier + wedges);
    let inertia = pier * h * h / 3.0 + wedges * h * h / 2.0;
    let body = format!(
        "[geometry.body]\nmass = {:?}\ncentroid_height = {z:?}\ninertia = {inertia:?}\narm = {arm:?}\n\
         height = {h}\n",
        pier + wedges
    );
    let hip = load(8e3, h, 0.35, 1.0, "thrust = 1500");
    let sides = sides_in_json(&(body + &hip + &check("rocking = \"one_sided_positive\"")));
    let weight = G * (pier + wedges);
    let alpha0 = (weight * arm + 8e3 * 0.35 - 1500.0 * h) / (weight * z + 8e3 * h);
    near(number(&sides, &["positive", "alpha0"]), alpha0, "alpha0");
}

/// The mechanisms of the scenes have reports whose formulas give their numbers, and which draw what turns.
#[test]
fn the_mechanisms_of_the_scenes_are_reported() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/mechanisms");
    for (name, bodies, said) in [
        ("compound_overturning", 1, ["0 to 1.715 m, β = 15°", "compound overturning"]),
        ("corner", 1, ["5737.49 · 9.81 · 10⁻³", "26918.4 kg m²"]),
        ("gable", 3, ["Body above 6.4 m", "Part from 6.4 to 9 m"]),
        ("two_storeys", 1, ["h₁ = ", "Load at 3.3 m"]),
    ] {
        let text = std::fs::read_to_string(format!("{folder}/{name}.toml")).unwrap();
        let page = report_of_one(&text);
        assert!(assert_gives(&page) > 20, "{name}");
        assert_eq!(page.matches("aria-label=\"the wall to scale\"").count(), bodies, "{name}");
        let text = plain(&page);
        assert!(said.iter().all(|said| text.contains(said)), "{name} without {said:?}");
    }
}

/// An Italian report of a wedge names the mechanism and its crack, with commas along the dimensions, too.
#[test]
fn a_wedge_is_reported_in_italian() {
    let text = include_str!("../../../../scenes/mechanisms/compound_overturning.toml");
    let text = plain(&report_of_one(&format!("{text}[report]\nlanguage = \"it\"\n")));
    for said in [
        "ribaltamento composto",
        "Lesione rispetto alla verticale, di minimo α0 tra 15° e 30°",
        "La lesione del cuneo è cercata tra 15° e 30° dalla verticale",
        "0 a 1,715 m, β = 15°",
        "h = 6,4 m",
        "il minimo α0 è alla minima inclinazione della lesione, 15°",
    ] {
        assert!(text.contains(said), "{said}\n{text}");
    }
}
