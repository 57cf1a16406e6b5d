//! The reference cases of `tests/data/cases`, made by two independent programs (see the README there).
//!
//! A case passes if |error|/`u_ins` stays within max(1e-9, 100 ε sensitivity, 100 `error_in_double`) up to
//! its horizon. These are the project's own tolerance and two bounds on the effect of rounding.

use std::path::PathBuf;

use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Work;
use rocking_wall::variables::{DampingModel, Solver};
use rocking_wall::wall::{Parameters, Support};
use scene::Scene;
use serde::Deserialize;

/// The result of a reference program; times in s, displacements in m.
#[derive(Deserialize)]
struct Reference {
    u_ins: f64,
    u_max: f64,
    /// None for a wall that does not overturn.
    overturn_time: Option<f64>,
    /// Time up to which the sensitivity stays below 1e5.
    horizon: f64,
    /// What plain double precision reached, as a fraction of `u_ins`.
    error_in_double: f64,
    /// Of ties that yield.
    tie: Option<TieReference>,
}

/// What ties have undergone; the side u > 0 first.
#[derive(Deserialize)]
struct TieReference {
    /// Plastic elongations at the end.
    elongation: [f64; 2],
    /// When a tie broke.
    breaks: [Option<f64>; 2],
}

fn folder() -> PathBuf {
    crate::root().join("tests/data/cases")
}

pub(crate) fn text(file: &str) -> String {
    let path = folder().join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// One line of a reference history.
pub(crate) struct Row {
    pub(crate) time: f64,
    pub(crate) displacement: f64,
    velocity: f64,
    sensitivity: f64,
    /// Force of the tie and plastic elongations, of ties that yield.
    pub(crate) tie: Option<[f64; 3]>,
}

pub(crate) fn rows(name: &str) -> Vec<Row> {
    let parse = |line: &str| {
        let mut numbers = line.split(',').map(|field| field.parse::<f64>().unwrap());
        let mut next = || numbers.next();
        let [time, displacement, velocity, sensitivity] = std::array::from_fn(|_| next().unwrap());
        let tie = next().map(|force| [force, next().unwrap(), next().unwrap()]);
        Row { time, displacement, velocity, sensitivity, tie }
    };
    text(&format!("{name}.csv")).lines().skip(1).map(parse).collect()
}

/// Returns the largest ratio of error to bound, and the work done.
fn check(name: &str, change: impl Fn(&mut Parameters)) -> (f64, Work) {
    let mut scene = Scene::read(&folder().join(format!("{name}.toml"))).unwrap();
    change(&mut scene.parameters);
    let reference: Reference = serde_json::from_str(&text(&format!("{name}.json"))).unwrap();
    let Reference { u_ins, horizon, .. } = reference;
    let excitation = scene.excitation.as_ref();
    let at_start = excitation.map_or(0.0, |e| e.bottom().samples()[0]);
    let mut simulation = Simulation::new(&scene.parameters, None, 0.0, Support::rigid(at_start)).unwrap();
    let rate = simulation.wall().rocking_rate();
    let (mut worst, mut compared) = (0.0_f64, 0);
    for row in rows(name).iter().filter(|row| row.time <= horizon && row.displacement.is_finite()) {
        simulation.advance_to(row.time, excitation, None).unwrap();
        let state = simulation.progress().state;
        let bound = 1e-9_f64.max(100.0 * 2.2e-16 * row.sensitivity).max(100.0 * reference.error_in_double);
        let error = (state.displacement - row.displacement).abs() / u_ins;
        // the velocity is as sensitive on the fastest time scale, the elastic one
        let fast = rate.max(simulation.wall().omega1());
        let velocity_error = (state.velocity - row.velocity).abs() / (u_ins * fast);
        worst = worst.max(error / bound);
        if scene.parameters.damping_model != DampingModel::None {
            // at an impact on a row, the reference may have either velocity
            worst = worst.max(velocity_error / (10.0 * bound));
        }
        if let (Some([force, positive, negative]), Some(tie)) = (row.tie, simulation.wall().ties().first()) {
            let outputs = simulation.outputs(Support::default());
            let elongation = outputs.tie_elongation;
            let length = tie.lever * u_ins;
            let errors = [
                (outputs.tie_force - force) / (tie.stiffness * length),
                (elongation.positive - positive) / length,
                (elongation.negative - negative) / length,
            ];
            worst = errors.into_iter().fold(worst, |worst, error| worst.max(error.abs() / bound));
        }
        compared += 1;
    }
    assert!(compared > 10, "{name}: compared {compared} rows");
    simulation.advance_to(scene.stop_time, excitation, None).unwrap();
    let progress = simulation.progress();
    assert_eq!(progress.state.overturned, reference.overturn_time.is_some(), "{name}: overturned");
    if let Some(time) = reference.overturn_time {
        let found = progress.overturn_time.expect("an overturn time");
        assert!((found - time).abs() < 1e-6, "{name}: overturned at {found} s, reference {time} s");
    } else {
        let (found, peak) = (progress.state.peaks.largest(), reference.u_max);
        assert!((found - peak).abs() / u_ins < 1e-7, "{name}: peak {found} for {peak}");
    }
    if let Some(TieReference { elongation, breaks }) = &reference.tie {
        let found = simulation.outputs(Support::default()).tie_elongation;
        let differences = [found.positive - elongation[0], found.negative - elongation[1]];
        assert!(differences.iter().all(|difference| difference.abs() < 1e-7 * u_ins), "{name}: {found:?}");
        for (found, wanted) in progress.tie_breaks.iter().zip(breaks) {
            let near = |(found, wanted): (f64, f64)| (found - wanted).abs() < 1e-9;
            assert!(found.is_some() == wanted.is_some(), "{name}: {found:?} for {wanted:?}");
            assert!(found.zip(*wanted).is_none_or(near), "{name}: {found:?} for {wanted:?}");
        }
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
            let mut found = 0;
            for entry in std::fs::read_dir(folder()).unwrap() {
                let name = entry.unwrap().file_name().into_string().unwrap();
                if let Some(name) = name.strip_suffix(".json") {
                    assert!(tested.contains(&name), "{name} has no test");
                    found += 1;
                }
            }
            assert_eq!(found, tested.len());
        }
    };
}

/// Whether the coefficient of a damping model is right, only a case of an independent program tells.
#[test]
fn every_damping_model_has_a_case() {
    let files = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let scenes = files.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
    let models: Vec<_> = scenes.map(|path| Scene::read(&path).unwrap().parameters.damping_model).collect();
    for model in DampingModel::ALL {
        let name = model.name();
        assert!(models.contains(model), "tests/data/cases: add one with {name}, by tests/data/restraints.py");
    }
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
    y01_free_cdc,
    y03_pulse_brittle_sdr,
    y07_one_sided_pulse,
    y09_harmonic_ratchet_cdr,
    y11_beyond_uins_back,
    y13_start_beyond_yield,
);

/// The adaptive solver is an independent way to solve the cases with constant damping.
#[test]
fn the_adaptive_solver_agrees_where_the_exact_one_holds() {
    for name in ["c02_free_cdc", "c05_free_cdcfs", "c06_fig5_cdc", "c11_cr_rigid_free", "c18_rec_cdc"] {
        check(name, |parameters| parameters.solver = Solver::Adaptive);
    }
}
