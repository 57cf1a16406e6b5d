//! Formulas that a study computes: spectra, capacity against demand, fragilities, the paper's tables.

use std::f64::consts::TAU;

use ground_motion::{GroundMotion, Spectrum, Storey, Storeys, spectrum::AVERAGE_PERIODS};
use rocking_wall::response::Response;
use rocking_wall::scene::Scene;
use rocking_wall::variables::{DampingModel, ForceLaw, Mechanism};
use rocking_wall::wall::{Parameters, Wall, equivalence};

use super::error::VerificationError;
use super::formula::{Check, Formula};
use check::points::{Demand, Fractions, check};
use run::bisection::first_true;
use study::fragility::{FragilityFunction, Lognormal, Observation, fit};
use study::spectrum::{PulseForm, over_pulses};

type Group = fn() -> Result<Formula, VerificationError>;

/// Formulas in the order of the manual. Another one is a function here.
pub(super) const FORMULAS: [Group; 10] = [
    equivalences,
    capacity_curve,
    capacity_against_demand,
    super::circolare::examples,
    demands,
    response_spectrum,
    storeys,
    half_sine,
    fragility,
    super::paper::tables,
];

/// 45 units of rounding.
const ROUNDING: f64 = 1e-14;

fn rigid() -> Parameters {
    Parameters {
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        ..Parameters::default()
    }
}

/// Eqs. (13), (14), (17) and (5) at e = 0.9 and θ₀/α = 0.9 in decimal arithmetic of 40 digits.
const EQ_13: f64 = 0.125_910_878_001_287_4;
const EQ_14: f64 = 0.071_645_150_647_321_87;
const EQ_17: f64 = 0.033_506_303_808_820_06;
const EQ_5: f64 = 11.972_891_384_505_525;

#[allow(clippy::unnecessary_wraps, reason = "as the other formulas")]
fn equivalences() -> Result<Formula, VerificationError> {
    let of = |quantity, computed, reference| {
        Check::of(("e = 0.9", quantity, "-"), [computed, reference], ROUNDING)
    };
    Ok(Formula::new(
        [
            "Equivalent damping ratios of other authors",
            "damping",
            "ξ = ln(θ₀/θₙ)/(nπ) after n impacts (Eq. 13), −0.68 ln e (Eq. 14), 2 (1 − e)/(π (1 + e)) \
             (Eq. 17); Housner's period 4/p acosh(1/(1 − θ₀/α)) (Eq. 5)",
            "the formula in decimal arithmetic of 40 digits",
            "45 units of rounding",
        ],
        vec![
            of("Eq. (13), 2 impacts from 0.9", equivalence::priestley(0.9, 0.9, 2), EQ_13),
            of("Eq. (14)", equivalence::makris_konstantinidis(0.9), EQ_14),
            of("Eq. (17)", equivalence::giannini_masiani(0.9), EQ_17),
            of("Eq. (5) times p, from 0.9", equivalence::housner_period(1.0, 0.9), EQ_5),
        ],
    ))
}

fn capacity_curve() -> Result<Formula, VerificationError> {
    let wall = Wall::new(&Parameters::default())?;
    let trilinear =
        Wall::new(&Parameters { force_law: ForceLaw::Trilinear, d1: 0.6, ..Parameters::default() })?;
    // p² = 3g/(2h) of an unloaded parapet, and g tan α its onset
    let (rate, onset) = ((1.5 * 9.81_f64 / 4.0).sqrt(), 9.81 * 0.1);
    let mut checks = Vec::new();
    for fraction in [0.1, 0.4, 0.95] {
        let computed = wall.capacity_at(1.0, fraction).secant_period.unwrap_or(f64::NAN);
        let expected = TAU / rate * (fraction / (1.0 - fraction)).sqrt();
        let name = format!("secant period at {fraction} u_ins");
        checks.push(Check::of(("bilinear", &name, "s"), [computed, expected], ROUNDING));
    }
    let name = "rocking_onset";
    checks.push(Check::of(("bilinear", name, "m/s2"), [wall.rocking_onset(), 0.97 * onset], ROUNDING));
    checks.push(Check::of(("trilinear", name, "m/s2"), [trilinear.rocking_onset(), 0.6 * onset], ROUNDING));
    Ok(Formula::new(
        [
            "Capacity curve",
            "capacity-curve",
            "T = 2π √(m_eff u/F); on the softening line of a₃ = 1, F/u = k₀ (1 − f)/f at u = f u_ins. \
             Rocking begins at the largest F/(λ m_eff): (1 − a₁) g tan α, or d₁ g tan α",
            "the formula with p² = 3g/(2h) and tan α = b/h of an unloaded parapet",
            "45 units of rounding",
        ],
        checks,
    ))
}

/// The spectrum and the walls of docs/model.md, worked by hand there to six digits.
fn capacity_against_demand() -> Result<Formula, VerificationError> {
    let points = vec![(0.0, 2.0), (0.1, 5.0), (0.5, 5.0), (1.0, 2.5), (2.0, 1.25), (4.0, 0.3)];
    let demand = Demand::of_points(points)?;
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
    let mut checks = Vec::new();
    for (name, parameters, references) in [
        ("parapet", parapet, [0.951_570, 0.106_667, 1.42972, 0.475_785, 1.04954]),
        ("strip wall", strip, [6.76449, 0.056_639_6, 0.390_750, 3.38225, 2.92896]),
        ("tied parapet", tied, [3.40532, 0.048_888_9, 0.921_550, 1.70266, 0.785_772]),
    ] {
        let sides = check(&Wall::new(&parameters)?, Fractions::default(), |period| demand.at(period))?;
        // the side u > 0, that of the tie
        let [side, ..] = &sides[..] else { continue };
        let computed = [
            ("onset a0*", "m/s2", side.onset_acceleration),
            ("capacity d_u*", "m", side.displacement_capacity),
            ("secant period T_s", "s", side.secant_period),
            ("a0*/Sa(0)", "-", side.acceleration_ratio),
            ("d_u*/Sd(T_s)", "-", side.displacement_ratio),
        ];
        for ((quantity, unit, computed), reference) in computed.into_iter().zip(references) {
            checks.push(Check::of((name, quantity, unit), [computed, reference], 5e-6));
        }
    }
    Ok(Formula::new(
        [
            "Capacity against demand",
            "capacity-against-demand",
            "d* = u/λ, a* = F/(λ m_eff), T_s = 2π √(d_s*/a_s*); d_u* against S_a(T_s) T_s²/(4π²), a₀* \
             against S_a(0)",
            "worked by hand in model.md, to six digits",
            "half a unit of the sixth digit: 5e-6",
        ],
        checks,
    ))
}

/// A rigid parapet released at 0.9 `u_ins` keeps its energy to the first passage, and then e of its velocity.
fn demands() -> Result<Formula, VerificationError> {
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
    let of = |quantity, unit, computed, reference| {
        Check::of(("released, e = 0.9", quantity, unit), [computed, reference], 1e-12)
    };
    Ok(Formula::new(
        [
            "Demands between samples",
            "demands",
            "largest |u̇| = p u_ins √(1 − (1 − u₀/u_ins)²); after an impact the energy is e² of that before; \
             the largest |ü| is at u = 0",
            "conservation of energy",
            "1e-12 of the size of its terms, which model.md states for extremes; of u, that of u_ins",
        ],
        vec![
            of("lowest u_dot", "m/s", demands.velocity.lowest.value, -fastest),
            Check { scale: 0.2, ..of("lowest u", "m", demands.displacement.lowest.value, turn) },
            of("lowest u_ddot", "m/s2", demands.acceleration.lowest.value, hardest),
        ],
    ))
}

fn response_spectrum() -> Result<Formula, VerificationError> {
    // 1 m/s² for 5 s
    let step = GroundMotion::new(0.01, vec![1.0; 501])?;
    let spectrum = Spectrum::default();
    let ratio = 0.05_f64;
    let overshoot = 1.0 + libm::exp(-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt());
    let mut checks = Vec::new();
    for period in [0.2, 1.0] {
        let name = format!("Sa({period} s)");
        let computed = spectrum.acceleration(&step, period)?;
        checks.push(Check::of(("1 m/s2 for 5 s", &name, "m/s2"), [computed, overshoot], 1e-11));
    }
    let computed = spectrum.average(&step, &AVERAGE_PERIODS)?;
    checks.push(Check::of(("1 m/s2 for 5 s", "AvgSA", "m/s2"), [computed, overshoot], 1e-11));
    Ok(Formula::new(
        [
            "Response spectrum",
            "records-and-their-intensity",
            "Sa(T) = ω² max |u| for ü + 2 ξ ω u̇ + ω² u = −a_g; AvgSA is the geometric mean at 0.2 … 1.4 s",
            "a suddenly applied acceleration a: Sa = a (1 + exp(−πξ/√(1 − ξ²)))",
            "rounding over 500 samples of 20 pieces each, 2.2e-16 a piece: 2e-12, with room 1e-11",
        ],
        checks,
    ))
}

fn storeys() -> Result<Formula, VerificationError> {
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
    let relative = Check {
        scale: 2.0 / (frequency * frequency),
        ..Check::of(
            ("one storey, 1 m/s2", "x in the middle of 0.9 s", "m"),
            [floor.displacement[node], expected],
            1e-11,
        )
    };
    let of = |quantity, computed, reference| {
        Check::of(("two equal storeys", quantity, "s"), [computed, reference], 1e-13)
    };
    Ok(Formula::new(
        [
            "Storeys between ground and wall",
            "floors-between-ground-and-wall",
            "M ẍ + C ẋ + K x = −M 1 a_g; two equal storeys have ω = √(k/m) (√5 ∓ 1)/2, and one \
             undamped storey under a suddenly applied acceleration x = −a/ω² (1 − cos ωt), at the nodes \
             x − (Δt²/12) ẍ",
            "the formula",
            "the eigenvalues' rounding, 1e-13; rounding over some hundred steps, 1e-11",
        ],
        vec![
            of("T1", periods[0], TAU / frequency * golden),
            of("T2", periods[1], TAU / frequency / golden),
            relative,
        ],
    ))
}

/// Halvings of the bracket of a threshold.
const HALVINGS: u32 = 16;

fn half_sine() -> Result<Formula, VerificationError> {
    // the root of the condition for ω_p/p = 2
    let expected = 1.800_723_930_560_746;
    let bracket = [expected * (1.0 - 1e-6), expected * (1.0 + 1e-6)];
    let falls = first_true(bracket, HALVINGS, |amplitude| {
        let spectrum = over_pulses(&rigid(), PulseForm::HalfSine, &[2.0], &[amplitude], 1);
        spectrum.map(|spectrum| spectrum.points[0][0].overturning.is_some())
    })?;
    Ok(Formula::new(
        [
            "Overturning by a half sine",
            "rocking-spectra",
            "√(η² − 1) + η exp(−(π − asin(1/η))/β) > β with η = a_p/a₀, β = ω_p/p",
            "the root of the condition",
            "the pulse's samples, off by (ωΔt)³/80 = 4e-10 of a_p in the step of the uplift",
        ],
        vec![Check::of(("ω_p/p = 2", "a_p/a0 that overturns", "-"), [falls, expected], 4e-10)],
    ))
}

fn fragility() -> Result<Formula, VerificationError> {
    let fitted = fit(&[1.0, 2.0, 4.0].map(Observation::At))?;
    let wall = |median| FragilityFunction::new(&[Lognormal { median, dispersion: 0.3 }], 0.4);
    let class = FragilityFunction::of_class(&[0.5, 0.5], &[wall(1.0), wall(4.0)]);
    let two = std::f64::consts::LN_2;
    let of =
        |case, quantity, computed, reference| Check::of((case, quantity, "-"), [computed, reference], 1e-12);
    Ok(Formula::new(
        [
            "Fragilities",
            "incremental-dynamic-analysis",
            "P = Φ(ln(IM/θ)/β) by maximum likelihood: of exact intensities, ln θ is the mean and β the \
             standard deviation (of n) of ln IM. A class has ln θ = Σ w ln θᵢ and β² = β_r² + β_w² + β_m²",
            "the formula: 1, 2 and 4 have θ = 2 and β = ln 2 √(2/3); θ = 1 and 4 have θ = 2 and β_w = ln 2",
            "1e-12: some roundings of logarithms, and the step at which the fit ends",
        ],
        vec![
            of("1, 2, 4", "θ", fitted.median, 2.0),
            of("1, 2, 4", "β", fitted.dispersion, two * (2.0_f64 / 3.0).sqrt()),
            of("class of two walls", "θ", class.medians[0], 2.0),
            of("class of two walls", "β", class.dispersion(), (0.09 + two * two + 0.16).sqrt()),
        ],
    ))
}
