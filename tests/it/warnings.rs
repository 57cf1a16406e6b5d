//! Tests what walls and the FMU warn of: parameters without effect, improbable numbers, expensive steps, and
//! starts that overturn.

use std::path::Path;
use std::sync::{Arc, Mutex};

use fmu_export::{Category, Experiment, Filter, Interface, Log, Model, Status, Step};
use rocking_wall::unit::Unit;
use rocking_wall::variables::{
    DampingModel, Impact, IntegerVariable, Mechanism, RealVariable, Rocking, Solver, TieSide,
};
use rocking_wall::wall::{Kinematics, Parameters, TieNumbers, Wall, usage};
use scene::Scene;

use crate::instantiated;

/// What a multilinear law replaces is warned of too.
#[test]
fn a_law_of_points_replaces_the_named_one() {
    let text = "[force_law]\nforce_law = \"multilinear\"\npoints = [[0.03, 0.9], [1, 0]]\na1 = 0.05\n";
    let scene = Scene::parse("s.toml", text, Path::new(".")).unwrap();
    let warnings: Vec<_> =
        Wall::new(&scene.parameters).unwrap().warnings().iter().map(ToString::to_string).collect();
    assert_eq!(warnings, ["a1 is set and has no effect: it counts where force_law is not multilinear"]);
}

/// Points that are no pairs of numbers are named, and not taken for absent.
#[test]
fn points_of_a_law_that_are_no_pairs_are_refused() {
    let law = "force_law = \"multilinear\"\n";
    for (lines, message) in [
        (
            format!("{law}points = [[0.03, \"a\"], [1, 0]]"),
            "points = […]: expected a list of pairs [u/u_ins, F/F0]",
        ),
        (format!("{law}points = 0.03"), "points = 0.03: expected a list of pairs"),
        (law.to_owned(), "give both"),
        ("points = [[0.03, 0.9], [1, 0]]".to_owned(), "give both"),
    ] {
        let error = Scene::parse("s.toml", &format!("[force_law]\n{lines}\n"), Path::new(".")).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
    }
}

/// Damping and restitution are warned of beyond the range they stand for, and not inside it.
#[test]
fn damping_beyond_its_meaning_is_warned_of() {
    type Change = fn(&mut Parameters);
    let block: Change = |wall| wall.damping_model = DampingModel::FreeStandingBlock;
    let cases: [(Change, Change, &str); 6] = [
        (block, |wall| wall.overburden = 1e4, "computed c_bar (Eq. 23) is valid only for a parapet"),
        (|_| {}, |wall| wall.impact = Impact::Restitution, "computed damping already represents the impacts"),
        (|wall| wall.a1 = 0.1, |wall| wall.a1 = 0.101, "a1 = 0.101 is outside the range 0.005 to 0.1"),
        (|wall| wall.a1 = 0.005, |wall| wall.a1 = 0.0049, "a1 = 0.0049 is outside the range"),
        (|wall| wall.a1 = 0.005, |wall| wall.a1 = 1e-300, "a1 = 1e-300 is outside the range"),
        (
            |wall| (wall.damping_model, wall.impact) = (DampingModel::None, Impact::Restitution),
            |wall| wall.restitution = 1.0,
            "restitution = 1 without damping",
        ),
    ];
    for (within, beyond, words) in cases {
        let mut parameters = Parameters::default();
        within(&mut parameters);
        let has = |parameters: &Parameters| {
            let wall = Wall::new(parameters).unwrap();
            wall.warnings().iter().any(|warning| warning.to_string().starts_with(words))
        };
        assert!(!has(&parameters), "{words}");
        beyond(&mut parameters);
        assert!(has(&parameters), "{words}");
    }
}

/// Whoever pulls a wall to its start pulls its tie with it: from where it yields or breaks on that is told.
#[test]
fn a_start_that_has_stretched_a_tie_is_warned_of() {
    // it yields at 0.015 + 0.01 = 0.025 m of the tie and breaks at 0.045 m, twice as far as u
    let tied = Parameters {
        tie_height: 4.0,
        tie_stiffness: 2e5,
        tie_slack: 0.01,
        tie_strength: 3e3,
        tie_ultimate: 0.02,
        ..Parameters::default()
    };
    let wall = Wall::new(&tied).unwrap();
    let told = |u_start: f64| wall.start_warning(u_start).map(|warning| warning.to_string());
    for silent in [0.0, 0.0124, -0.1] {
        assert_eq!(told(silent), None);
    }
    assert_eq!(
        told(0.0175).unwrap(),
        "u_start = 0.0175 m is beyond 0.0125 m, where the tie yields: it starts stretched by 0.01 m"
    );
    assert_eq!(
        told(0.1).unwrap(),
        "u_start = 0.1 m is beyond 0.0225 m, where the tie breaks: it starts broken, stretched by 0.02 m"
    );
    let elastic = Wall::new(&Parameters { tie_ultimate: -1.0, ..tied.clone() }).unwrap();
    assert_eq!(elastic.start_warning(0.1), None);
    // of several ties the one that is meant
    let low = tied.ties().map(|tie| TieNumbers { height: 2.0, ..tie }).next().unwrap();
    let several = Parameters { further_ties: vec![low].into(), ..tied.clone() };
    let message = Wall::new(&several).unwrap().start_warning(0.1).unwrap().to_string();
    assert!(message.contains("where the tie at 4 m breaks"), "{message}");
    // a side that transverse walls keep from moving away
    let held = Parameters {
        rocking: Rocking::OneSidedNegative,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        restitution: 0.5,
        tie_side: TieSide::Positive,
        ..several
    };
    let warnings: Vec<_> = Wall::new(&held).unwrap().warnings().iter().map(ToString::to_string).collect();
    for height in [4, 2] {
        let told = format!("the tie at {height} m has no effect: it holds u above 0");
        assert!(warnings.iter().any(|warning| warning.starts_with(&told)), "{warnings:?}");
    }
    let ties = [
        (RealVariable::TieHeight, 4.0),
        (RealVariable::TieStiffness, 2e5),
        (RealVariable::TieSlack, 0.01),
        (RealVariable::TieStrength, 3e3),
        (RealVariable::TieUltimate, 0.02),
        (RealVariable::UStart, 0.1),
    ];
    let (started, text) = logged(&ties, &[]);
    assert!(started && text.contains("where the tie breaks"), "{text}");
}

/// How a unit starts is information.
#[test]
fn a_start_is_logged() {
    for (u_start, is_logged) in [(0.05, true), (-0.01, true), (0.0, false)] {
        let change = |unit: &mut Unit| unit.set_real(RealVariable::UStart, u_start);
        let (started, text) = logged_by(Interface::CoSimulation, Category::All, change, &[]);
        assert!(started && text.contains("solver: adaptive"), "{text}");
        assert_eq!(text.contains(&format!("released from u_start = {u_start} m")), is_logged, "{text}");
    }
}

/// A tolerance of the importer below the least one, that of rounding, counts as the least.
#[test]
fn a_tolerance_has_a_least_value() {
    for (given, used) in [(1e-9, "1e-9"), (1e-13, "1e-13"), (1e-30, "1e-15")] {
        let change = |unit: &mut Unit| {
            unit.setup_experiment(Experiment { tolerance: Some(given), ..Experiment::default() });
        };
        let (_, text) = logged_by(Interface::CoSimulation, Category::All, change, &[]);
        assert!(text.contains(&format!("solver: adaptive, tolerance {used}")), "{text}");
    }
}

/// A parapet warns once of a motion of the top support, which it does not have; a strip has one.
#[test]
fn a_parapet_warns_once_of_a_top_support() {
    for (mechanism, times) in [(Mechanism::Parapet, 1), (Mechanism::VerticalSpanning, 0)] {
        let change = |unit: &mut Unit| {
            unit.set_integer(IntegerVariable::Mechanism, mechanism.value());
            unit.set_real(RealVariable::UStart, 0.0);
        };
        let (started, text) =
            logged_by(Interface::CoSimulation, Category::Warning, change, &[(RealVariable::ATop, 0.1)]);
        assert!(started);
        assert_eq!(text.matches("a_top is ignored: a parapet has no top support").count(), times, "{text}");
    }
}

type Change = fn(&mut Parameters);

/// What is said where no other unit brings the number into its range.
const UNCLEAR: &str = "check value and unit";

/// Changes to the default wall, what is said of the number, and of what it may mean.
const IMPROBABLE: [(Change, &str, &str); 21] = [
    (|wall| wall.density = 1.8, "density = 1.8 kg/m3 is unusual: 400 to 3000 kg/m3", "t/m3, give 1800 kg/m3"),
    (
        |wall| wall.density = 18.0,
        "density = 18 kg/m3 is unusual: 400 to 3000 kg/m3",
        "kN/m3, give 1835.49 kg/m3",
    ),
    (|wall| wall.overburden = 10.0, "overburden = 10 N is unusual: 100 to 1000000 N", "kN, give 10000 N"),
    (
        |wall| (wall.overburden, wall.overburden_eccentricity) = (3e3, 0.25),
        "overburden_eccentricity = 0.25 m is unusual: -0.2 to 0.2 m",
        "cm, give 0.0025 m",
    ),
    // 100 N/m times 0.07 m is 7.000000000000001 N
    (
        |wall| (wall.width, wall.overburden) = (0.07, 1.0),
        "overburden = 1 N is unusual: 7 to 70000 N",
        "kN, give 1000 N",
    ),
    (
        |wall| (wall.width, wall.overburden) = (0.07, 1e11),
        "overburden = 1e11 N is unusual: 7 to 70000 N",
        UNCLEAR,
    ),
    (|wall| wall.height = 300.0, "height = 300 m is unusual: 0.2 to 30 m", "cm, give 3 m"),
    (|wall| wall.height = 3e3, "height = 3000 m is unusual: 0.2 to 30 m", "mm, give 3 m"),
    // a wall in cm: no word on its ratio
    (
        |wall| (wall.height, wall.thickness) = (200.0, 30.0),
        "thickness = 30 m is unusual: 0.03 to 3 m",
        "cm, give 0.3 m",
    ),
    // small numbers are in powers of ten
    (|wall| wall.density = 1e-5, "density = 1e-5 kg/m3 is unusual: 400 to 3000 kg/m3", UNCLEAR),
    (|wall| wall.thickness = 5.0, "thickness = 5 m is unusual: 0.03 to 3 m", "cm, give 0.05 m"),
    (
        |wall| (wall.height, wall.thickness) = (2.0, 2.5),
        "height/thickness = 0.8 is unusual: 1 to 100",
        UNCLEAR,
    ),
    (|wall| wall.xi = 5.0, "xi = 5 is unusual: 0 to 0.5", "per cent, give 0.05"),
    (|wall| wall.gravity = 1.62, "gravity = 1.62 m/s2 is unusual: 9.7 to 9.9 m/s2", UNCLEAR),
    (|wall| wall.gravity = 981.0, "gravity = 981 m/s2 is unusual: 9.7 to 9.9 m/s2", "cm/s2, give 9.81 m/s2"),
    (
        |wall| (wall.tie_height, wall.tie_stiffness) = (3.0, 13e3),
        "tie_stiffness = 13000 N/m is unusual: 100000 to 1e9 N/m",
        "kN/m, give 13000000 N/m",
    ),
    (
        |wall| (wall.tie_height, wall.tie_stiffness) = (3.0, 13.0),
        "tie_stiffness = 13 N/m is unusual: 100000 to 1e9 N/m",
        "kN/mm, give 13000000 N/m",
    ),
    (
        |wall| (wall.tie_height, wall.tie_stiffness) = (3.0, 2e9),
        "tie_stiffness = 2e9 N/m is unusual: 100000 to 1e9 N/m",
        UNCLEAR,
    ),
    (
        |wall| (wall.tie_height, wall.tie_stiffness, wall.tie_strength) = (3.0, 13e6, 75.0),
        "tie_strength = 75 N is unusual: 1000 to 2000000 N",
        "kN, give 75000 N",
    ),
    (
        |wall| (wall.tie_height, wall.tie_stiffness, wall.tie_strength) = (3.0, 13e6, 3e6),
        "tie_strength = 3000000 N is unusual: 1000 to 2000000 N",
        UNCLEAR,
    ),
    (|wall| wall.height = 0.05, "height = 0.05 m is unusual: 0.2 to 30 m", UNCLEAR),
];

/// Numbers that walls rarely have are warned of, with their usual range and what to do.
#[test]
fn improbable_numbers_are_warned_of() {
    for (change, words, meant) in IMPROBABLE {
        let mut parameters = Parameters { restitution: 0.5, ..Parameters::default() };
        change(&mut parameters);
        let warnings: Vec<_> =
            Wall::new(&parameters).unwrap().warnings().iter().map(ToString::to_string).collect();
        let meant = if meant == UNCLEAR { UNCLEAR.to_owned() } else { format!("if it is in {meant}") };
        let message = format!("{words} is usual; {meant}");
        assert!(warnings.contains(&message), "{message}: {warnings:?}");
        let of_ratio = warnings.iter().filter(|warning| warning.starts_with("height/thickness")).count();
        assert_eq!(of_ratio, usize::from(words.starts_with("height/thickness")), "{warnings:?}");
    }
    assert_eq!(Wall::new(&Parameters::default()).unwrap().warnings(), []);
}

/// What a unit logs with these parameters and inputs, in co-simulation, and whether it could start.
fn logged(parameters: &[(RealVariable, f64)], inputs: &[(RealVariable, f64)]) -> (bool, String) {
    let change =
        |unit: &mut Unit| parameters.iter().for_each(|&(variable, value)| unit.set_real(variable, value));
    logged_by(Interface::CoSimulation, Category::Warning, change, inputs)
}

fn logged_by(
    interface: Interface,
    category: Category,
    change: impl Fn(&mut Unit),
    inputs: &[(RealVariable, f64)],
) -> (bool, String) {
    let texts = Arc::new(Mutex::new(Vec::new()));
    let sink = texts.clone();
    let mut push = move |_: Status, _: Category, text: &str| sink.lock().unwrap().push(text.to_owned());
    let mut log = Log::new(&mut push, Filter::ERRORS.with(category));
    let mut unit = instantiated(interface, None, &mut log);
    change(&mut unit);
    let started = unit.initialize(&mut log);
    for step in 0..3_u32 {
        for &(variable, value) in inputs {
            unit.set_real(variable, value);
        }
        let step = Step { from: 0.01 * f64::from(step), duration: 0.01, may_end_early: false };
        if started.is_ok() && interface == Interface::CoSimulation {
            unit.do_step(step, &mut log).unwrap();
        }
    }
    let reason = started.as_ref().err().map(|failure| failure.0.clone()).unwrap_or_default();
    (started.is_ok(), reason + &texts.lock().unwrap().concat())
}

#[test]
fn the_unit_warns_once_of_a_start_that_was_forgotten() {
    use RealVariable::{ABottom, AG, D1, Thickness, UStart};
    let (started, reason) = logged(&[(Thickness, 0.25)], &[]);
    assert!(!started && reason.contains("set u_start = 0 for a wall that is at rest"), "{reason}");
    assert_eq!(logged(&[], &[]), (true, String::new()));
    assert_eq!(logged(&[], &[(AG, 0.0)]).1, "");
    for input in [AG, ABottom] {
        let text = logged(&[], &[(input, 0.1)]).1;
        assert_eq!(text.matches("released from u_start = 0.18 m, the start value").count(), 1, "{text}");
        assert_eq!(logged(&[(UStart, 0.0)], &[(input, 0.1)]).1, "");
        assert_eq!(logged(&[(UStart, 0.1)], &[(input, 0.1)]).1, "");
    }
    assert!(logged(&[(D1, 0.7)], &[]).1.starts_with("d1 is set and has no effect"));
}

/// In Model Exchange the importer's solver integrates: no parameter of the wall's own counts.
#[test]
fn model_exchange_warns_of_a_solver_that_is_set() {
    let change = |solver: Solver| {
        move |unit: &mut Unit| {
            unit.set_integer(IntegerVariable::Solver, solver.value());
            unit.set_real(RealVariable::Tolerance, 1e-10);
        }
    };
    let warning = |name: &str| {
        format!("{name} is set and has no effect: in Model Exchange the importer's solver integrates")
    };
    let told = |interface, solver| logged_by(interface, Category::Warning, change(solver), &[]).1;
    assert_eq!(told(Interface::ModelExchange, Solver::Automatic), warning("tolerance"));
    assert_eq!(told(Interface::ModelExchange, Solver::Adaptive), warning("solver") + &warning("tolerance"));
    assert_eq!(told(Interface::CoSimulation, Solver::Adaptive), "");
}

/// Of the warnings of a wall, those about work say that its runs take long.
#[test]
fn warnings_about_work_are_marked() {
    let fast = Parameters { a1: 1e-9, ..Parameters::default() };
    let improbable = Parameters { density: 10.0, ..Parameters::default() };
    for (parameters, about_work) in [(fast, 1), (improbable, 0)] {
        let wall = Wall::new(&parameters).unwrap();
        let warnings = wall.warnings();
        assert!(!warnings.is_empty());
        let marked = warnings.iter().filter(|warning| warning.is_about_work()).count();
        assert_eq!(marked, about_work, "{warnings:?}");
    }
}

/// The tolerance counts where motion has no closed form: with secant damping, and in full rotations.
#[test]
fn the_tolerance_counts_where_there_is_no_closed_form() {
    let matters = |kinematics: Kinematics, damping_model: DampingModel, solver: Solver| {
        let parameters = Parameters { kinematics, damping_model, solver, ..Parameters::default() };
        usage(&parameters).find(|usage| usage.name == "tolerance").unwrap().matters
    };
    for solver in [Solver::Automatic, Solver::Adaptive] {
        assert!(matters(Kinematics::Linear, DampingModel::ConstantRatio, solver));
        assert!(matters(Kinematics::Trigonometric, DampingModel::None, solver));
    }
    assert!(!matters(Kinematics::Linear, DampingModel::None, Solver::Automatic));
    assert!(!matters(Kinematics::Linear, DampingModel::None, Solver::Exact));
}
