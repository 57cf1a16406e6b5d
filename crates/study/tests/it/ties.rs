//! Ties that yield and break, in incremental dynamic analyses and in studies of ties.

use ground_motion::SyntheticMotion;
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::variables::{DampingModel, TieSide};
use rocking_wall::wall::{Parameters, Support};
use run::model::Model;
use run::records::NamedRecord;
use run::walls::NamedWall;
use scene::Scene;
use study::ida::{IntensityMeasure, Levels, Study, TieDemand};
use study::tie::{ALL, BAR_DIAMETER, HEIGHT, SLACK, STIFFNESS, STRENGTH, TieStudy, ULTIMATE, Varied, table};

/// A parapet whose ties yield at 0.03 u_ins and break at 0.2 u_ins on both sides.
fn tied() -> Parameters {
    Parameters {
        height: 3.0,
        thickness: 0.3,
        a1: 0.009,
        tie_height: 2.6,
        tie_stiffness: 2e5,
        tie_slack: 5e-3,
        tie_strength: 5e2,
        tie_ultimate: 0.05,
        tie_side: TieSide::Both,
        ..Parameters::default()
    }
}

fn motion() -> ground_motion::GroundMotion {
    SyntheticMotion { seed: 1, duration: 12.0, step: 0.01, peak: 3.0 }.motion().unwrap()
}

/// The demand of a run is that of the same run step by step: forces and elongations at the samples do not
/// exceed it, and the elongation at the end is the same.
#[test]
fn demands_on_ties_are_those_of_runs_one_by_one() {
    let elastic = Parameters { tie_ultimate: -1.0, ..tied() };
    let walls = [("yields", tied()), ("elastic", elastic)];
    let walls = walls.map(|(name, parameters)| NamedWall::new(name, parameters)).to_vec();
    let records = vec![NamedRecord::new("synthetic", motion())];
    let models = [DampingModel::ConstantCoefficient, DampingModel::ConstantRatio].map(Model::new).to_vec();
    let levels = Levels::Grid((1..=12).map(|n| 0.5 * f64::from(n)).collect());
    let study = Study::new(walls, records, models, IntensityMeasure::Pga, levels).unwrap();
    let study = study.with_tail(0.0).unwrap();
    let (mut whole, mut yielded, mut broken) = (0, 0, 0);
    for index in 0..study.count() {
        let (case, curve) = (study.case(index), study.curve(study.case(index)).unwrap());
        for run in curve.runs() {
            let wall = &study.walls()[case.wall];
            let Some(demand) = run.tie.filter(|_| run.overturning.is_none()) else {
                assert!(run.overturning.is_some() || wall.name == "elastic");
                continue;
            };
            let found = directly(&study, case.wall, case.model, run.intensity);
            // both motions keep the tolerance 1e-8 within a tenth, amplified by up to a thousand
            let allowed = 1e-6;
            let [ours, theirs] = [&demand, &found].map(|tie| tie.elongation / wall.parameters.tie_ultimate);
            assert!((ours - theirs).abs() < allowed, "{ours} {theirs} at {}", run.intensity);
            let [ours, theirs] = [&demand, &found].map(|tie| tie.force / wall.parameters.tie_strength);
            // between samples the force may be larger
            assert!(theirs < ours + allowed && ours < theirs + 0.02 && ours <= 1.0, "{ours} {theirs}");
            assert_eq!(demand.broken, found.broken);
            whole += usize::from(demand.elongation == 0.0);
            yielded += usize::from(demand.elongation > 0.0 && !demand.broken);
            broken += usize::from(demand.broken);
        }
    }
    assert!(whole > 1 && yielded > 1 && broken > 1, "{whole} whole, {yielded} yielded, {broken} broken");
}

/// Computes the demand of a run sample by sample.
fn directly(study: &Study, wall: usize, model: usize, level: f64) -> TieDemand {
    let parameters = study.models()[model].applied_to(&study.walls()[wall].parameters).unwrap();
    let samples: Vec<f64> =
        study.records()[0].motion.samples().iter().map(|a| a * level / study.intensity(0)).collect();
    let mut simulation = Simulation::new(&parameters, None, 0.0, Support::rigid(samples[0])).unwrap();
    let mut demand = TieDemand { force: 0.0, elongation: 0.0, broken: false };
    for ends in samples.windows(2) {
        let (from, to) = (Support::rigid(ends[0]), Support::rigid(ends[1]));
        simulation.advance(&Segment { duration: 0.01, from, to }).unwrap();
        let outputs = simulation.outputs(to);
        demand.force = demand.force.max(outputs.tie_force);
        demand.elongation = outputs.tie_elongation.positive.max(outputs.tie_elongation.negative);
    }
    let (wall, state) = (simulation.wall(), simulation.progress().state);
    demand.broken = [1.0, -1.0].iter().any(|sign| wall.ties().first().unwrap().is_broken(*sign, &state.tie));
    demand
}

fn scene() -> Scene {
    Scene { parameters: tied(), ..Scene::default() }
}

fn study_of(scene: &Scene, varied: &Varied, values: &[f64]) -> Result<TieStudy, study::tie::TieError> {
    let records = [1.0, 2.0].map(|scale| motion().checked_scaled(scale).unwrap()).to_vec();
    TieStudy::new(scene.clone(), varied, values, records, false)
}

/// A tie that is brittle breaks with no elongation, and one that stays elastic takes more than its strength.
/// Of those between the force is at most that.
#[test]
fn ties_of_several_ultimate_elongations() {
    let study = study_of(&scene(), &ULTIMATE, &[0.05, -1.0, 0.0, 1e3]).unwrap();
    assert_eq!((study.values(), study.yields()), (&[-1.0, 0.0, 0.05, 1e3][..], true));
    let rows = study.rows(2).unwrap();
    let outcomes = |row: usize| rows[row].outcomes.iter();
    let strength = tied().tie_strength;
    assert!(outcomes(0).all(|tie| tie.force > strength && tie.elongation == 0.0 && !tie.broken));
    assert!(outcomes(1).all(|tie| tie.force == strength && tie.elongation == 0.0 && tie.broken));
    assert!(outcomes(2).all(|tie| tie.force == strength && tie.elongation <= 0.05));
    assert!(outcomes(3).all(|tie| tie.force == strength && tie.elongation > 0.0 && !tie.broken));
    let csv = table(&study, &rows).csv();
    let names: Vec<_> = csv.lines().next().unwrap().split(',').collect();
    assert_eq!(names[0], "ultimate_m");
    let last = ["elongation_median_m", "elongation_84_m", "elongation_max_m", "broken"];
    assert_eq!(names[names.len() - 4..], last);
    // a tie that stays elastic has the columns that it always had
    let elastic = study_of(&scene(), &ULTIMATE, &[-1.0]).unwrap();
    let rows = elastic.rows(1).unwrap();
    assert!(!table(&elastic, &rows).csv().contains("elongation"));
}

/// Each parameter can be varied: every value is another tie.
#[test]
fn every_parameter_of_a_tie_can_be_varied() {
    let mut barred = scene();
    let bar = [("diameter", 0.006), ("length", 6.0), ("yield_stress", 2e8), ("ultimate_strain", 0.02)];
    for (name, value) in bar {
        barred.set(&format!("bar_{name}"), &value.to_string()).unwrap();
    }
    let values = |varied: &Varied| match *varied {
        STIFFNESS => [1e4, 1e5],
        STRENGTH => [2e2, 1e3],
        SLACK => [0.0, 0.01],
        HEIGHT => [1.5, 3.0],
        ULTIMATE => [0.0, 0.1],
        _ => [0.004, 0.01],
    };
    for varied in ALL {
        let scene = if varied == BAR_DIAMETER { &barred } else { &scene() };
        let study = study_of(scene, &varied, &values(&varied)).unwrap();
        let rows = study.rows(1).unwrap();
        assert_eq!(rows.iter().map(|row| row.value).collect::<Vec<_>>(), values(&varied));
        assert_ne!(rows[0].outcomes, rows[1].outcomes, "{varied:?}");
        assert!(study::tie::figure::picture(&study, &rows).contains("plastic elongation"));
    }
}

#[test]
fn what_has_no_effect_is_refused() {
    let with = |edit: fn(&mut Parameters)| {
        let mut scene = scene();
        edit(&mut scene.parameters);
        scene
    };
    let (whole, no_height) = (scene(), with(|p| p.tie_height = 0.0));
    let (no_stiffness, no_strength) = (with(|p| p.tie_stiffness = 0.0), with(|p| p.tie_strength = 0.0));
    for (scene, varied, values, words) in [
        (
            &no_height,
            STRENGTH,
            &[1e3][..],
            "the wall has no tie_height, so tie_strength has no effect; set it",
        ),
        (&no_stiffness, SLACK, &[0.0], "no tie_stiffness, so tie_slack has no effect; set it"),
        (&no_strength, ULTIMATE, &[0.0], "no tie_strength, so tie_ultimate has no effect; set it"),
        (&whole, BAR_DIAMETER, &[0.01], "no bar, so bar_diameter has no effect; set it"),
        (&whole, STRENGTH, &[], "there is no value of tie_strength; give at least one"),
        (&whole, STIFFNESS, &[-1.0], "tie_stiffness = -1.0 N/m is below its minimum, 0.0 N/m"),
        (&whole, HEIGHT, &[3.5], "tie_height = 3.5"),
        (&whole, ULTIMATE, &[-0.5], "tie_ultimate = -0.5"),
    ] {
        let error = study_of(scene, &varied, values).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
    assert!(study_of(&no_height, &HEIGHT, &[2.0]).is_ok() && study_of(&no_strength, &STIFFNESS, &[]).is_ok());
}
