//! Numbers that no scene shows: spectra, capacity against demand, fragilities.

use std::f64::consts::TAU;

use check::fractions::{Demand, Fractions, check};
use fragility::hazard::HazardCurve;
use fragility::{FragilityFunction, Lognormal, Sample, fit};
use ground_motion::{GroundMotion, Spectrum, Storey, Storeys, spectrum::AVERAGE_PERIODS};
use rocking_wall::variables::{ForceLaw, Mechanism};
use rocking_wall::wall::{Parameters, Wall, equivalence};
use scene::Scene;
use scene::response::Response;
use study::ida::Exceedance;

use super::given::{Comparisons, SIX_DIGITS, within};
use super::overturning::rigid;
use super::{circolare, overturning, paper};
use crate::Comparison;

/// A name in `formulas.toml`, and what computes the numbers of a formula that no scene shows.
type Study = (&'static str, fn() -> Comparisons);

const STUDIES: [Study; 13] = [
    ("equivalences", || Ok(equivalences())),
    ("capacity_curve", capacity_curve),
    ("capacity_against_demand", capacity_against_demand),
    ("circolare", circolare::examples),
    ("demands", demands),
    ("response_spectrum", response_spectrum),
    ("storeys", storeys),
    ("straight_pulses", overturning::straight_pulses),
    ("sines", overturning::sines),
    ("steady_rocking", overturning::steady_rocking),
    ("fragility", fragility),
    ("annual_rates", annual_rates),
    ("paper", paper::tables),
];

/// Computes the numbers of a study.
pub(super) fn compare(name: &str) -> Comparisons {
    let study = STUDIES.iter().find(|(own, _)| *own == name);
    let (_, compute) = study.unwrap_or_else(|| panic!("formulas.toml: {name} is not one of STUDIES"));
    compute()
}

/// 45 units of rounding.
const ROUNDING: f64 = 1e-14;
/// Eqs. (13), (14), (17) and (5) at e = 0.9 and θ₀/α = 0.9 in decimal arithmetic of 40 digits.
fn equivalences() -> Vec<Comparison> {
    let [eq_13, eq_14] = [equivalence::priestley(0.9, 0.9, 2), equivalence::makris_konstantinidis(0.9)];
    let [eq_17, eq_5] = [equivalence::giannini_masiani(0.9), equivalence::housner_period(1.0, 0.9)];
    let rows = [
        ("Eq. (13), 2 impacts from 0.9", eq_13, 0.125_910_878_001_287_4),
        ("Eq. (14)", eq_14, 0.071_645_150_647_321_87),
        ("Eq. (17)", eq_17, 0.033_506_303_808_820_06),
        ("Eq. (5) times p, from 0.9", eq_5, 11.972_891_384_505_525),
    ];
    within(ROUNDING, rows.map(|(name, found, given)| ("e = 0.9", name, "-", found, given)))
}

fn capacity_curve() -> Comparisons {
    let wall = Wall::new(&Parameters::default())?;
    let trilinear =
        Wall::new(&Parameters { force_law: ForceLaw::Trilinear, d1: 0.6, ..Parameters::default() })?;
    // p² = 3g/(2h) of an unloaded parapet, and g tan α its onset
    let (rate, onset) = ((1.5 * 9.81_f64 / 4.0).sqrt(), 9.81 * 0.1);
    let secant = |fraction: f64| {
        let found = wall.capacity_at(1.0, fraction).secant_period.unwrap_or(f64::NAN);
        let given = TAU / rate * (fraction / (1.0 - fraction)).sqrt();
        ("bilinear", format!("secant period at {fraction} u_ins"), "s", found, given)
    };
    let onset = |case, wall: &Wall, part: f64| {
        (case, "rocking_onset".to_owned(), "m/s2", wall.rocking_onset(), part * onset)
    };
    let rows = [0.1, 0.4, 0.95].map(secant).into_iter();
    Ok(within(ROUNDING, rows.chain([onset("bilinear", &wall, 0.97), onset("trilinear", &trilinear, 0.6)])))
}

/// The spectrum and the walls of docs/model.md, worked by hand there to six digits.
fn capacity_against_demand() -> Comparisons {
    let points = vec![(0.0, 2.0), (0.1, 5.0), (0.5, 5.0), (1.0, 2.5), (2.0, 1.25), (4.0, 0.3)];
    let demand = Demand::of_points(points, |index| format!("point {}", index + 1))?;
    let parapet = Parameters::default();
    let strip = Parameters {
        mechanism: Mechanism::VerticalSpanning,
        height: 3.0,
        thickness: 0.25,
        overburden: 10_000.0,
        ..Parameters::default()
    };
    let tied = Parameters {
        tie_height: 3.0,
        tie_stiffness: 2e5,
        tie_slack: 0.03,
        tie_strength: 5000.0,
        ..Parameters::default()
    };
    let mut comparisons = Vec::new();
    for (name, parameters, given) in [
        ("parapet", parapet, [0.951_570, 0.106_667, 1.42972, 0.475_785, 1.04954]),
        ("strip wall", strip, [6.76449, 0.056_639_6, 0.390_750, 3.38225, 2.92896]),
        ("tied parapet", tied, [3.40532, 0.048_888_9, 0.921_550, 1.70266, 0.785_772]),
    ] {
        let sides = check(&Wall::new(&parameters)?, Fractions::default(), |period| demand.at(period))?;
        // the side u > 0, that of the tie
        let [side, ..] = &sides[..] else { continue };
        let [onset, capacity, secant, strength, displacement] = given;
        let rows = [
            (name, "onset a0*", "m/s2", side.onset_acceleration, onset),
            (name, "capacity d_u*", "m", side.displacement_capacity, capacity),
            (name, "secant period T_s", "s", side.secant_period, secant),
            (name, "a0*/Sa(0)", "-", side.acceleration_ratio, strength),
            (name, "d_u*/Sd(T_s)", "-", side.displacement_ratio, displacement),
        ];
        comparisons.extend(within(SIX_DIGITS, rows));
    }
    Ok(comparisons)
}

/// A rigid parapet released at 0.9 `u_ins` keeps its energy to the first passage, and then e of its velocity.
fn demands() -> Comparisons {
    let parameters = Parameters {
        impact: rocking_wall::variables::Impact::Restitution,
        restitution: 0.9,
        u_start: 0.18,
        ..rigid()
    };
    let scene = Scene { parameters, stop_time: 3.0, ..Scene::default() };
    let response = Response::of(&scene)?;
    // u_ins = b/2, p² = 3g/(2h); 1 − (1 − 0.9)² of the energy at u_ins
    let rate = (1.5 * 9.81_f64 / 4.0).sqrt();
    let fastest = 0.2 * rate * 0.99_f64.sqrt();
    let turn = -0.2 * (1.0 - (1.0 - 0.81 * 0.99_f64).sqrt());
    // at u = 0 the force is F₀, and ü = −λ g b/h there
    let hardest = -0.75 * 9.81 * 0.1;
    let demands = &response.demands;
    let case = "released, e = 0.9";
    let mut comparisons = within(
        1e-12,
        [
            (case, "lowest u_dot", "m/s", demands.velocity.lowest.value, -fastest),
            (case, "lowest u", "m", demands.displacement.lowest.value, turn),
            (case, "lowest u_ddot", "m/s2", demands.acceleration.lowest.value, hardest),
        ],
    );
    comparisons[1].scale = 0.2;
    Ok(comparisons)
}

fn response_spectrum() -> Comparisons {
    // 1 m/s² for 5 s
    let step = GroundMotion::new(0.01, vec![1.0; 501])?;
    let spectrum = Spectrum::default();
    let ratio = 0.05_f64;
    let overshoot = 1.0 + libm::exp(-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt());
    let found = [
        ("Sa(0.2 s)", spectrum.acceleration(&step, 0.2)?),
        ("Sa(1 s)", spectrum.acceleration(&step, 1.0)?),
        ("AvgSA", spectrum.average(&step, &AVERAGE_PERIODS)?),
    ];
    Ok(within(1e-11, found.map(|(name, found)| ("1 m/s2 for 5 s", name, "m/s2", found, overshoot))))
}

fn storeys() -> Comparisons {
    let storey = Storey { mass: 1e4, stiffness: 4e6, damping_ratio: 0.0 };
    let frequency = (storey.stiffness / storey.mass).sqrt();
    let periods = Storeys::new(&[storey, storey])?.periods();
    let golden = 0.5 * (5.0_f64.sqrt() + 1.0);
    let ground = GroundMotion::new(0.01, vec![1.0; 101])?;
    let floor = Storeys::new(&[storey])?.floor(&ground, 0.9, 1)?;
    let node = floor.displacement.len() / 2;
    let step = floor.acceleration.step();
    // a node is x − (Δt²/12) ẍ, and ẍ = −a cos ωt
    let cosine = libm::cos(frequency * step * node as f64);
    let expected = -(1.0 - cosine) / (frequency * frequency) + step * step / 12.0 * cosine;
    let case = "two equal storeys";
    let mut comparisons = within(
        1e-13,
        [
            (case, "T1", "s", periods[0], TAU / frequency * golden),
            (case, "T2", "s", periods[1], TAU / frequency / golden),
        ],
    );
    let found = floor.displacement[node];
    let shaken = [("one storey, 1 m/s2", "x in the middle of 0.9 s", "m", found, expected)];
    comparisons.extend(within(1e-11, shaken));
    comparisons[2].scale = 2.0 / (frequency * frequency);
    Ok(comparisons)
}

/// A power law, and four points of a site: θ = 0.4 and β = 0.45, in decimal arithmetic of 40 digits and by
/// quadrature.
fn annual_rates() -> Comparisons {
    let curve = |points: &[[f64; 2]]| HazardCurve::new(points.to_vec()).map(|curve| curve.rate(0.4, 0.45));
    let power = curve(&[1e-4, 1e4].map(|x: f64| [x, 1e-4 * x.powf(-2.5)]))?;
    let site = curve(&[[0.05, 1.0 / 30.0], [0.1, 1.0 / 101.0], [0.2, 1.0 / 475.0], [0.4, 1.0 / 2475.0]])?;
    let given = [2.795_769_941_38e-6, 8.594_124_532_53e-5, 3.142_512_950_23e-4];
    let segment = |(k, given): (usize, f64)| {
        ("four points", format!("rate of segment {}", k + 1), "1/year", site.segments[k], given)
    };
    let rows = given.into_iter().enumerate().map(segment).chain([
        (
            "four points",
            "rate beyond, continued".to_owned(),
            "1/year",
            site.beyond_continued,
            3.038_573_345_53e-4,
        ),
        ("power law", "rate".to_owned(), "1/year", power.within(), 1.860_702_745_8e-3),
    ]);
    Ok(within(1e-10, rows))
}

fn fragility() -> Comparisons {
    let fitted = fit(&Sample::of_records([1.0, 2.0, 4.0].map(Exceedance::At).to_vec()))?;
    let wall = |median| FragilityFunction::new(&[Lognormal { median, dispersion: 0.3 }], 0.4);
    let class = FragilityFunction::of_class(&[0.5, 0.5], &[wall(1.0), wall(4.0)]);
    let two = std::f64::consts::LN_2;
    let (triple, pair) = ("1, 2, 4", "class of two walls");
    Ok(within(
        1e-12,
        [
            (triple, "θ", "-", fitted.median, 2.0),
            (triple, "β", "-", fitted.dispersion, two * (2.0_f64 / 3.0).sqrt()),
            (pair, "θ", "-", class.states[0].median, 2.0),
            (pair, "β", "-", class.dispersion(0), (0.09 + two * two + 0.16).sqrt()),
        ],
    ))
}
