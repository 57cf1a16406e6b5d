//! The reference cases of `tests/data/cases`, made by two independent programs (see the README there).
//!
//! A case passes if |error|/`u_ins` stays within max(1e-9, 100 ε sensitivity, 100 `double_vs_quad`) up to its
//! horizon. These are the project's own tolerance and two bounds on the effect of rounding.

use std::path::PathBuf;

use ground_motion::{GroundMotion, Pulse, Shape};
use rocking_wall::simulation::{Excitation, Simulation};
use rocking_wall::solver::{Segment, Work};
use rocking_wall::variables::{
    DampingModel, EccentricityMode, ForceLaw, Impact, Mechanism, Rocking, Softening, Solver, TieSide,
};
use rocking_wall::wall::{Parameters, Support};
use serde_json::Value;

/// Wall width in every case [m]; the cases give the weight of the whole wall.
const WIDTH: f64 = 1.0;

fn folder() -> PathBuf {
    crate::root().join("tests/data/cases")
}

struct Case {
    json: Value,
}

impl Case {
    fn read(name: &str) -> Self {
        let path = folder().join(format!("{name}.json"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        Self { json: serde_json::from_str(&text).unwrap() }
    }

    fn number(&self, pointer: &str) -> Option<f64> {
        self.json.pointer(pointer).and_then(Value::as_f64)
    }

    fn text(&self, pointer: &str) -> &str {
        self.json.pointer(pointer).and_then(Value::as_str).unwrap_or_else(|| panic!("no {pointer}"))
    }

    fn required(&self, pointer: &str) -> f64 {
        self.number(pointer).unwrap_or_else(|| panic!("no number {pointer}"))
    }

    fn item<T>(&self, pointer: &str, default: T, read: fn(&str) -> Option<T>) -> T {
        match self.json.pointer(pointer) {
            Some(name) => read(name.as_str().unwrap()).unwrap_or_else(|| panic!("{pointer} {name}")),
            None => default,
        }
    }

    fn parameters(&self) -> Parameters {
        let (h, b, g) = (self.required("/wall/h"), self.required("/wall/b"), self.required("/g"));
        let vertical = self.text("/wall/kind") == "VSSW";
        let rigid = self.text("/law/typ") == "rigid";
        let restitution = self.number("/damping/e");
        Parameters {
            mechanism: if vertical { Mechanism::VerticalSpanning } else { Mechanism::Parapet },
            height: h,
            thickness: b,
            width: WIDTH,
            density: self.required("/wall/W") / (g * h * b * WIDTH),
            gravity: g,
            hinge_ratio: self.number("/wall/h1").map_or(0.5, |h1| h1 / h),
            overburden: self.number("/wall/O").unwrap_or(0.0),
            overburden_eccentricity: self.number("/wall/c").unwrap_or(0.0),
            eccentricity_mode: match self.text("/c_mode") {
                "mirrored" => EccentricityMode::FixedToWall,
                "same" => EccentricityMode::FollowsPivot,
                other => panic!("c_mode {other}"),
            },
            force_law: match self.text("/law/typ") {
                "rigid" => ForceLaw::RigidLinear,
                "bilinear" => ForceLaw::Bilinear,
                "trilinear" => ForceLaw::Trilinear,
                other => panic!("law {other}"),
            },
            a1: self.number("/law/a1").unwrap_or(0.03),
            a3: self.number("/law/a3").unwrap_or(1.0),
            d1: self.number("/law/d1").unwrap_or(0.85),
            softening: if rigid {
                Softening::Parallel
            } else {
                Softening::from_name(self.text("/law/soften")).unwrap()
            },
            damping_model: match self.text("/damping/kind") {
                "none" => DampingModel::None,
                "CDC" => DampingModel::ConstantCoefficient,
                "CDCFS" => DampingModel::FreeStandingBlock,
                "CDR" => DampingModel::ConstantRatio,
                "SDR" => DampingModel::StiffnessProportional,
                other => panic!("damping {other}"),
            },
            xi: self.number("/damping/xi").unwrap_or(0.0),
            c_bar: self.number("/damping/cbar").unwrap_or(0.0),
            impact: if restitution.is_some() { Impact::Restitution } else { Impact::None },
            restitution: restitution.unwrap_or(1.0),
            rocking: self.item("/rocking", Rocking::TwoSided, Rocking::from_name),
            tie_height: self.number("/tie/y").unwrap_or(0.0),
            tie_stiffness: self.number("/tie/K").unwrap_or(0.0),
            tie_slack: self.number("/tie/g0").unwrap_or(0.0),
            tie_side: self.item("/tie/side", TieSide::Positive, TieSide::from_name),
            u_start: self.required("/u0"),
            u_dot_start: self.required("/v0"),
            tolerance: 1e-12,
            ..Parameters::default()
        }
    }

    fn excitation(&self) -> Option<Excitation> {
        let amplitude = self.number("/excitation/A").unwrap_or(0.0);
        let pulse = |shape, frequency, step| {
            let pulse = Pulse { shape, amplitude, frequency };
            pulse.sampled(Some(self.required("/t_end")), step).unwrap()
        };
        // 0.5 ms: c16, the most sensitive pulse, changes by less than 3e-11 at half the step
        let motion = match self.text("/excitation/kind") {
            "none" => return None,
            "record" => {
                let text = std::fs::read_to_string(folder().join(self.text("/excitation/file"))).unwrap();
                let samples =
                    text.lines().filter(|line| !line.starts_with('#')).map(|line| line.parse().unwrap());
                GroundMotion::new(self.required("/excitation/dt"), samples.collect())
                    .unwrap()
                    .scaled(self.required("/excitation/scale"))
            }
            "harmonic" => {
                let phase = self.number("/excitation/phi").unwrap_or(0.0);
                let end = self.number("/excitation/t_end");
                pulse(Shape::Harmonic { phase, end }, self.required("/excitation/f"), 5e-4)
            }
            "ricker" => pulse(
                Shape::Ricker { centre: self.required("/excitation/t0") },
                self.required("/excitation/f"),
                5e-4,
            ),
            other => panic!("excitation {other}"),
        };
        Some(Excitation::new(motion, None))
    }
}

/// One line of a reference history.
struct Row {
    time: f64,
    displacement: f64,
    velocity: f64,
    sensitivity: f64,
}

fn rows(name: &str) -> Vec<Row> {
    let text = std::fs::read_to_string(folder().join(format!("{name}.csv"))).unwrap();
    let parse = |line: &str| {
        let mut numbers = line.split(',').map(|field| field.parse::<f64>().unwrap());
        let mut next = || numbers.next().unwrap();
        Row { time: next(), displacement: next(), velocity: next(), sensitivity: next() }
    };
    text.lines().skip(1).map(parse).collect()
}

/// Advances a simulation to a time, through every sample of the excitation.
pub(crate) fn advance_to(simulation: &mut Simulation, excitation: Option<&Excitation>, time: f64) {
    while simulation.progress().time < time {
        let now = simulation.progress().time;
        let remaining = time - now;
        let segment = match excitation {
            Some(excitation) => excitation.segment(now, remaining),
            None => Segment { duration: remaining, from: Support::default(), to: Support::default() },
        };
        let last = segment.duration >= remaining;
        simulation.advance(&segment).unwrap();
        if last {
            simulation.set_time(time);
        }
    }
}

/// Returns the largest ratio of error to bound, and the work done.
fn check(name: &str, change: impl Fn(&mut Parameters)) -> (f64, Work) {
    let case = Case::read(name);
    let mut parameters = case.parameters();
    change(&mut parameters);
    let excitation = case.excitation();
    let at_start = excitation.as_ref().map_or(0.0, |e| e.bottom().samples()[0]);
    let mut simulation = Simulation::new(&parameters, None, 0.0, Support::rigid(at_start)).unwrap();
    let u_ins = case.required("/derived/uinsp");
    let horizon = case.required("/accuracy/horizon_S_below_1e5");
    let plain_double = case.required("/accuracy/double_vs_quad_over_uins");
    let rate = simulation.wall().rocking_rate();
    let (mut worst, mut compared) = (0.0_f64, 0);
    for row in rows(name).iter().filter(|row| row.time <= horizon && row.displacement.is_finite()) {
        advance_to(&mut simulation, excitation.as_ref(), row.time);
        let state = simulation.progress().state;
        let bound = 1e-9_f64.max(100.0 * 2.2e-16 * row.sensitivity).max(100.0 * plain_double);
        let error = (state.displacement - row.displacement).abs() / u_ins;
        // the velocity is as sensitive on the fastest time scale, the elastic one
        let fast = rate.max(simulation.wall().omega1());
        let velocity_error = (state.velocity - row.velocity).abs() / (u_ins * fast);
        worst = worst.max(error / bound);
        if case.text("/damping/kind") != "none" {
            // at an impact on a row, the reference may have either velocity
            worst = worst.max(velocity_error / (10.0 * bound));
        }
        compared += 1;
    }
    assert!(compared > 10, "{name}: compared {compared} rows");
    let end = case.required("/t_end");
    advance_to(&mut simulation, excitation.as_ref(), end);
    let progress = simulation.progress();
    let overturned = case.json.pointer("/result/overturned").and_then(Value::as_bool).unwrap();
    assert_eq!(progress.state.overturned, overturned, "{name}: overturned");
    if let Some(time) = case.number("/result/t_overturn") {
        let found = progress.overturn_time.expect("an overturn time");
        assert!((found - time).abs() < 1e-6, "{name}: overturned at {found} s, reference {time} s");
    } else {
        let peak = case.required("/result/umax");
        assert!(
            (progress.state.peaks.largest() - peak).abs() / u_ins < 1e-7,
            "{name}: peak {} for {peak}",
            progress.state.peaks.largest()
        );
    }
    assert!(worst <= 1.0, "{name}: the error takes {worst} of its bound");
    (worst, progress.work)
}

macro_rules! cases {
    ($($name:ident),* $(,)?) => {$(
        #[test]
        fn $name() {
            let (worst, work) = check(stringify!($name), |_| {});
            println!("{}: {worst:.2e} of the bound, {work:?}", stringify!($name));
        }
    )*

        /// Checks that every case in the folder has a test above.
        #[test]
        fn every_case_is_tested() {
            let tested = [$(stringify!($name)),*];
            for entry in std::fs::read_dir(folder()).unwrap() {
                let name = entry.unwrap().file_name().into_string().unwrap();
                if let Some(name) = name.strip_suffix(".json") {
                    assert!(tested.contains(&name), "{name} has no test");
                }
            }
        }
    };
}

cases!(
    c01_elastic_free,
    c02_free_cdc,
    c04_free_sdr,
    c05_free_cdcfs,
    c06_fig5_cdc,
    c09_separatrix,
    c11_cr_rigid_free,
    c13_cr_bilinear,
    c14_harmonic_cdr,
    c16_ricker_survive,
    c17_ricker_overturn,
    c18_rec_cdc,
    c23_pw_overburden_asym,
    c24_stiff1e3_cdr,
    c26_stiff1e4_free,
    c29_rec_overturn_short,
    c30_cr_rigid_rec,
    c31_a3_rotated,
    c35_hf_cdc_dt005,
    c36_asym_tril_a3,
    t01_tie_stiff_free,
    t02_tie_sdr_record,
    t03_tie_rigid_record,
    t04_tie_cdr_free,
    o01_one_sided_free,
    o02_one_sided_pulse,
    o03_one_sided_record,
    o04_one_sided_elastic_record,
    o05_one_sided_tie_record,
);

/// The adaptive solver is an independent way to solve the cases with constant damping.
#[test]
fn the_adaptive_solver_agrees_where_the_exact_one_holds() {
    for name in ["c02_free_cdc", "c05_free_cdcfs", "c06_fig5_cdc", "c11_cr_rigid_free", "c18_rec_cdc"] {
        check(name, |parameters| parameters.solver = Solver::Adaptive);
    }
}
