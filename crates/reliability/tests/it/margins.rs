//! Margins of a rigid wall on the ground under pulses, in closed form.

use std::f64::consts::{PI, TAU};

use check::CheckFile;
use check::circolare::Statement;
use reliability::{Codes, FILES};
use rocking_wall::variables::ForceLaw;
use rocking_wall::wall::Parameters;
use run::records::NamedRecord;
use run::walls::NamedWall;
use study::loaded::LoadedStudy;
use study::spectrum::PulseForm;

use crate::asked::{CHECK, run};
use crate::folders::{number, rows};
use crate::uplift::{Uplift, root, straight};

/// Height and thickness of the wall [m]; g [m/s²]; e.
const HEIGHT: f64 = 2.0;
const THICKNESS: f64 = 0.2;
const G: f64 = 9.81;
const RESTITUTION: f64 = 0.9;
/// Periods of the intensity [s], on the plateau of the spectrum: S_e/a_g is F0.
const PERIODS: [f64; 2] = [0.2, 0.3];
const F0: f64 = 2.4;
const DAMPING: f64 = 0.05;

/// A pulse that lasts π/β of 1/p, a sine cycle 2π/β.
#[derive(Clone, Copy)]
struct Pulse {
    form: PulseForm,
    beta: f64,
}

impl Pulse {
    /// a_p/a₀ from which on the wall falls: under a sine cycle after one impact, else without any.
    fn falls(self) -> f64 {
        let Self { form, beta } = self;
        match form {
            PulseForm::HalfSine => root(1.0 + 1e-12, 1e3, |eta| Uplift::new(eta, beta).growing(PI / beta)),
            PulseForm::SineCycle => {
                let falls = |eta: &f64| beyond_an_impact(*eta, beta) > 0.0;
                let high = (1..1000).map(|k| 1.0 + 0.01 * f64::from(k)).find(falls).unwrap();
                root(high - 0.01, high, |eta| beyond_an_impact(eta, beta))
            }
            _ => straight(form, PI / beta),
        }
    }

    /// Sa at a period over the amplitude of the pulse.
    fn amplified(self, period: f64, rate: f64) -> f64 {
        let oscillator = Oscillator { frequency: TAU / period };
        let angular = self.beta * rate;
        let length = if self.form == PulseForm::SineCycle { TAU } else { PI } / angular;
        // the pulse is a sum of parts that begin at rest, with a factor and a start
        let step = |t: f64| oscillator.step(t);
        let ramp = |t: f64| oscillator.ramp(t) / length;
        let sine = |t: f64| oscillator.sine(t, angular);
        let after = |start: f64, t: f64| t - start * length;
        let response = |t: f64| match self.form {
            PulseForm::Rectangle => step(t) - step(after(1.0, t)),
            PulseForm::FallingTriangle => step(t) - ramp(t) + ramp(after(1.0, t)),
            PulseForm::Triangle => 2.0 * (ramp(t) - 2.0 * ramp(after(0.5, t)) + ramp(after(1.0, t))),
            PulseForm::HalfSine => sine(t) + sine(after(1.0, t)),
            PulseForm::SineCycle => sine(t) - sine(after(1.0, t)),
            PulseForm::CosineCycle | PulseForm::Ricker => panic!("no closed form"),
        };
        highest(|t| response(t).abs(), length + period)
    }
}

/// A linear oscillator with the damping of spectra: ω² x of x″ + 2ξω x′ + ω² x = a, from rest; 0 for t < 0.
struct Oscillator {
    frequency: f64,
}

impl Oscillator {
    /// e^−ξωt (c cos ω_d t + s sin ω_d t), which is free motion.
    fn free(&self, t: f64, [c, s]: [f64; 2]) -> f64 {
        let damped = self.frequency * (1.0 - DAMPING * DAMPING).sqrt();
        (-DAMPING * self.frequency * t).exp() * (c * (damped * t).cos() + s * (damped * t).sin())
    }

    /// Under a = 1.
    fn step(&self, t: f64) -> f64 {
        let root = (1.0 - DAMPING * DAMPING).sqrt();
        if t > 0.0 { 1.0 + self.free(t, [-1.0, -DAMPING / root]) } else { 0.0 }
    }

    /// Under a = t: t − 2ξ/ω, and what starts it from rest.
    fn ramp(&self, t: f64) -> f64 {
        let (lag, root) = (2.0 * DAMPING / self.frequency, (1.0 - DAMPING * DAMPING).sqrt());
        let sine = (2.0 * DAMPING * DAMPING - 1.0) / (root * self.frequency);
        if t > 0.0 { t - lag + self.free(t, [lag, sine]) } else { 0.0 }
    }

    /// Under a = sin Ωt: A sin Ωt + B cos Ωt with A + iB = 1/(1 − r² + 2iξr), r = Ω/ω, and what starts it
    /// from rest.
    fn sine(&self, t: f64, angular: f64) -> f64 {
        let r = angular / self.frequency;
        let size = (1.0 - r * r).powi(2) + (2.0 * DAMPING * r).powi(2);
        let [a, b] = [(1.0 - r * r) / size, -2.0 * DAMPING * r / size];
        let root = (1.0 - DAMPING * DAMPING).sqrt();
        let free = self.free(t, [-b, -(DAMPING * b + r * a) / root]);
        if t > 0.0 { a * (angular * t).sin() + b * (angular * t).cos() + free } else { 0.0 }
    }
}

/// The highest value of a function from 0 to `end`: on a grid, and by golden section around its highest
/// point.
fn highest(function: impl Fn(f64) -> f64, end: f64) -> f64 {
    let at = |index: u32| end * f64::from(index) / 2000.0;
    let best = (0..=2000).max_by(|a, b| function(at(*a)).total_cmp(&function(at(*b)))).unwrap();
    let [mut low, mut high] = [at(best.saturating_sub(1)), at(best + 1)];
    for _ in 0..60 {
        let [a, b] = [low + 0.382 * (high - low), high - 0.382 * (high - low)];
        if function(a) < function(b) { low = a } else { high = b }
    }
    function(low)
}

/// How far a wall is from falling after its first impact under a sine cycle, positive where it falls:
/// e |y′| − 1 − ∫ e^−s f(τ_i + s) ds at the impact τ_i, up to the end of the cycle.
fn beyond_an_impact(eta: f64, beta: f64) -> f64 {
    let uplift = Uplift::new(eta, beta);
    let end = TAU / beta;
    // the first time on a grid at which the wall is back
    let back = (1..4000)
        .map(|k| end * f64::from(k) / 4000.0)
        .find(|&t| t > (1.0 / eta).asin() / beta + 1e-3 && uplift.reach(t) < 0.0);
    // at a lower a_p it is back before, at a higher one it falls without an impact
    let Some(back) = back else { return 1.0 };
    let impact = root(back - end / 4000.0, back, |t| -uplift.reach(t));
    // c = y′ + y − 1, and y = 0
    let speed = -(uplift.growing(impact) + 1.0);
    let primitive = |t: f64| (beta * t).sin() + beta * (beta * t).cos();
    let rest = primitive(impact) - (impact - end).exp() * primitive(end);
    RESTITUTION * speed - 1.0 - eta / (1.0 + beta * beta) * rest
}

/// The margin of the fall is the geometric mean of the a_g at which the pulses overturn the wall, over a_g of
/// the check. The bracket of a fall is 1e-12 of it and spectra are found to 1e-12; samples of sines are off
/// by (ωΔt)³/80 = 4e-10 of a_p in the step of the uplift or of the impact.
#[test]
fn margins_under_pulses_are_those_of_closed_forms() {
    let rate = (1.5 * G / HEIGHT).sqrt();
    let wall = Parameters {
        height: HEIGHT,
        thickness: THICKNESS,
        force_law: ForceLaw::RigidLinear,
        restitution: RESTITUTION,
        gravity: G,
        ..Parameters::default()
    };
    let onset = G * THICKNESS / HEIGHT;
    let text = format!(
        "models = [\"CR\"]\nlevels = {{ method = \"hunt\", first = 0.002, increase = 0.0005, top = 3, \
         resolution = 1e-12, gap = 0.5 }}\nintensity = {{ measure = \"code\", periods = [0.2, 0.3] \
         }}\n{CHECK}"
    );
    for (form, betas) in [
        (PulseForm::Rectangle, [4.0, 2.5, 1.6, 1.0]),
        (PulseForm::FallingTriangle, [4.0, 2.5, 1.6, 1.0]),
        (PulseForm::Triangle, [4.0, 2.5, 1.6, 1.0]),
        (PulseForm::HalfSine, [5.0, 3.0, 2.0, 1.0]),
        (PulseForm::SineCycle, [4.0, 3.0, 2.0, 1.0]),
    ] {
        let pulses = betas.map(|beta| Pulse { form, beta });
        let record = |pulse: Pulse| {
            let motion = form.motion(pulse.beta * rate / TAU).unwrap().scaled(-1.0);
            NamedRecord::new(format!("beta {}", pulse.beta), motion)
        };
        let walls = vec![NamedWall::new("a", wall.clone())];
        let loaded = LoadedStudy::of_parts(text.clone(), walls, pulses.map(record).into(), &Codes).unwrap();
        let path = run(&format!("pulses_{form:?}"), &loaded);
        let mut rows = rows(&path.join(FILES[0])).into_iter();
        let fall = rows.find(|row| row["check"] == "SLV" && row["event"] == "fall");
        let found = number(&fall.unwrap(), "margin");
        let falls = pulses.map(|pulse| {
            let worth = PERIODS.map(|period| (pulse.amplified(period, rate) / F0).ln()).iter().sum::<f64>();
            (onset * pulse.falls()).ln() + worth / 2.0
        });
        let expected = (falls.iter().sum::<f64>() / 4.0).exp() / code(&loaded);
        assert!((found / expected - 1.0).abs() < 1e-9, "{form:?}: {found} {expected}");
    }
}

/// a_g with which the wall just passes SLV [m/s²]: d_SLV = 0.4 b/2 at mid-height, a = 0.6 a₀/FC, and S_De
/// between T_C and T_D on soil A at 8 % damping.
fn code(loaded: &LoadedStudy) -> f64 {
    let statement = Statement::read(&CheckFile::parse("a", &loaded.text).unwrap()).unwrap();
    let (d, a) = (0.2 * THICKNESS, 0.6 * G * THICKNESS / HEIGHT / statement.confidence_factor);
    let period = 1.68 * PI * (d / a).sqrt();
    assert!(period > 0.3 && period < 4.0 * 0.2 + 1.6, "{period}");
    let eta = (10.0_f64 / 13.0).sqrt();
    // of a_g = 1
    let demand = eta * F0 * 0.3 * period / TAU.powi(2);
    d / demand
}
