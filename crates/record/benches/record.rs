//! Measures the time per sample of a record: `cargo bench -p rocking-record [-- RECORD.AT2]`. The walls are
//! 2, 5 and 6 of Table 5 of the paper, under the first 30 s of the record or under the embedded motion. The
//! yardstick is the bare recurrence of a linear oscillator, timed in the same run.

#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use std::hint::black_box;
use std::time::Instant;

use ground_motion::{GroundMotion, RecordOptions, SyntheticMotion};
use record::{BatchRun, Blocks, Forcing, RecordSolver, RunEnd, RunStart, run_together};
use rocking_wall::simulation::{Excitation, Simulation};
use rocking_wall::solver::{Motion, Segment};
use rocking_wall::variables::{DampingModel, ForceLaw, Impact};
use rocking_wall::wall::{Parameters, Support};

const RUNS: usize = 200;
/// Runs of one batch.
const BATCH: usize = 64;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    if let [flag, path, runs] = arguments.as_slice()
        && flag == "--count"
    {
        println!("{}", count(path, runs.parse().expect("a number of runs")));
        return;
    }
    let record = match arguments.first() {
        Some(path) => ground_motion::read(path, &RecordOptions::default()).expect("a record").motion,
        None => SyntheticMotion::default().motion().expect("the default motion"),
    };
    let record = record.trimmed(0.0, record.duration().min(30.0)).expect("30 s");
    let samples = record.samples().len() - 1;
    let bare = least(samples, || oscillator(black_box(record.samples())));
    println!("{:<44}{bare:>8.2} ns a sample", "bare linear oscillator");
    println!(
        "runs/s: runs of {:.0} s at {:.0} ms with every corner located, a second and core: {BATCH} at once \
         on one thread, over its time",
        record.duration(),
        1e3 * record.step(),
    );
    for (name, damping_model) in [
        ("constant coefficient", DampingModel::ConstantCoefficient),
        ("constant ratio", DampingModel::ConstantRatio),
    ] {
        one_level(name, |size| Parameters {
            height: 6.0 * size,
            thickness: 0.6,
            a1: 0.018,
            damping_model,
            u_start: 0.0,
            ..Parameters::default()
        });
    }
    for (number, height, thickness, a1) in
        [(6, 6.0, 0.6, 0.018), (5, 3.0, 0.6, 0.0024), (2, 1.5, 0.3, 0.0012)]
    {
        let wall = Parameters { height, thickness, a1, u_start: 0.0, ..Parameters::default() };
        let damped = |damping_model| Parameters { damping_model, ..wall.clone() };
        let bouncing = |force_law| Parameters {
            force_law,
            damping_model: DampingModel::None,
            impact: Impact::Restitution,
            ..wall.clone()
        };
        for (model, parameters) in [
            ("constant coefficient", damped(DampingModel::ConstantCoefficient)),
            ("constant ratio", damped(DampingModel::ConstantRatio)),
            ("stiffness-proportional", damped(DampingModel::StiffnessProportional)),
            ("restitution, bilinear", bouncing(ForceLaw::Bilinear)),
            ("restitution, rigid", bouncing(ForceLaw::RigidLinear)),
        ] {
            for scale in [0.02, 0.8, 1.2, 1.3] {
                measure(&record, bare, (number, model), &parameters, scale);
            }
        }
    }
}

/// Measures 64 runs at one level, of eight walls through eight records of the embedded kind, beside batches
/// of 64 factors about that level, one of each wall and record.
fn one_level(model: &str, wall: impl Fn(f64) -> Parameters) {
    let walls: Vec<_> = (0..8).map(|n| wall(1.0 + 0.02 * f64::from(n))).collect();
    let motions = walls.iter().map(|wall| Motion::of(wall, 1e-8).expect("a valid wall")).collect::<Vec<_>>();
    let record = |seed| SyntheticMotion { seed, ..SyntheticMotion::default() }.motion().expect("a motion");
    let records: Vec<_> = (1..=8).map(record).collect();
    let forcings: Vec<_> = records.iter().map(|record| Forcing::Samples(record.samples())).collect();
    let start = |motion: &Motion, factor: f64| {
        let participation = motion.wall().body().forcing(Support::rigid(1.0));
        RunStart { state: motion.start(0.0, 0.0, Support::default()), factor: factor * participation }
    };
    let step = records[0].step();
    let pairs = || motions.iter().flat_map(|motion| forcings.iter().map(move |forcing| (motion, *forcing)));
    let together = least_of(20, BATCH, || {
        let solvers: Vec<_> = motions.iter().map(|motion| RecordSolver::new(motion, step)).collect();
        let blocks: Vec<_> = forcings.iter().map(|forcing| Blocks::new(*forcing)).collect();
        let of = |solver| blocks.iter().map(move |record| (solver, record));
        let run = |(solver, record)| BatchRun { solver, record, start: start(solver.motion(), 1.0) };
        let runs: Vec<_> = solvers.iter().flat_map(of).map(run).collect();
        run_together(&runs, RunEnd::AtOverturning).len() as f64
    });
    // the least of each pair, as another program may take its time from a longer measurement
    let of_pair = |factors: &[f64]| {
        let least = |(motion, forcing): (&Motion, Forcing<'_>)| {
            let starts: Vec<_> = factors.iter().map(|factor| start(motion, *factor)).collect();
            least_of(20, factors.len(), || {
                let outcomes =
                    RecordSolver::new(motion, step).batch(forcing).run(&starts, RunEnd::AtOverturning);
                outcomes.expect("bounded motions").len() as f64
            })
        };
        pairs().map(least).sum::<f64>() / BATCH as f64
    };
    let alone = of_pair(&[1.0]);
    let about: Vec<_> = (0..BATCH).map(|n| 0.9 + 0.2 * n as f64 / (BATCH - 1) as f64).collect();
    let factors = of_pair(&about);
    println!(
        "at one level, 8 walls and 8 records, {model}: {:.1} us a run together, {:.2} times one of {BATCH} \
         factors; {:.2} times each by itself",
        1e-3 * together,
        together / factors,
        alone / factors,
    );
}

fn measure(
    record: &GroundMotion,
    bare: f64,
    (number, model): (u32, &str),
    parameters: &Parameters,
    scale: f64,
) {
    let motion = Motion::of(parameters, 1e-8).expect("a valid wall");
    let participation = motion.wall().body().forcing(Support::rigid(1.0));
    let samples = record.samples();
    let count = samples.len() - 1;
    let solver = RecordSolver::new(&motion, record.step());
    let state = motion.start(0.0, 0.0, Support::default());
    let start = |factor: f64| RunStart { state, factor: factor * participation };
    let run = |factor: f64| {
        let forcing = Forcing::Samples(black_box(samples));
        solver.run(start(factor), forcing, RunEnd::OfRecord).expect("a bounded motion")
    };
    let outcome = run(scale);
    let one = least(count, || run(scale).state.displacement);
    let batch = batch(scale, start);
    let side_by_side = solver.batch(Forcing::Samples(samples)).is_side_by_side();
    let way = if side_by_side { "side by side" } else { "one by one  " };
    let many = least(count * BATCH, || {
        let outcomes = solver.batch(Forcing::Samples(black_box(samples))).run(&batch, RunEnd::OfRecord);
        outcomes.expect("bounded motions")[0].state.displacement
    });
    println!(
        "wall {number}, {:<23} x{scale}: {one:>8.2} ns, {:>5.1} times; {BATCH} {way} {many:>6.2} ns a run, \
         {:>6.0} runs/s; {:>4} corners, u_max/u_ins {:.3}{}",
        model,
        one / bare,
        1e9 / (many * count as f64),
        outcome.work.corners,
        outcome.state.peaks.largest() / motion.wall().displacement_scale(),
        if outcome.overturning.is_some() { ", overturned" } else { "" },
    );
}

/// Runs whose factors go from 0.65 of a scale to the scale.
fn batch(scale: f64, start: impl Fn(f64) -> RunStart) -> Vec<RunStart> {
    (0..BATCH).map(|i| start(scale * (0.65 + 0.35 * i as f64 / (BATCH - 1) as f64))).collect()
}

/// uₙ₊₁ = A uₙ + b₀ aₙ + b₁ aₙ₊₁, the piecewise-exact recurrence.
fn oscillator(record: &[f64]) -> f64 {
    let (mut u, mut v) = (1e-4_f64, 0.0_f64);
    for ends in record.windows(2) {
        let (from, to) = (ends[0], ends[1]);
        (u, v) = (
            0.9986 * u + 0.004_99 * v - 1.2e-5 * from - 4e-6 * to,
            -0.55 * u + 0.9986 * v - 2.5e-3 * (from + to),
        );
    }
    u + v
}

/// Nanoseconds per unit, the least of several runs after a warm-up.
fn least(units: usize, run: impl FnMut() -> f64) -> f64 {
    least_of(RUNS, units, run)
}

/// Nanoseconds per unit, the least of some runs after a warm-up.
fn least_of(runs: usize, units: usize, mut run: impl FnMut() -> f64) -> f64 {
    black_box(run());
    let mut least = f64::INFINITY;
    for _ in 0..runs {
        let start = Instant::now();
        black_box(run());
        least = least.min(start.elapsed().as_secs_f64());
    }
    least * 1e9 / units as f64
}

/// Returns the wall of a path whose instructions are counted.
fn wall_of(path: &str) -> Parameters {
    let (damping_model, force_law, impact) = match path {
        "adaptive" | "adaptive-batch" => (DampingModel::ConstantRatio, ForceLaw::Bilinear, Impact::None),
        "settling" | "settling-segments" => (DampingModel::None, ForceLaw::RigidLinear, Impact::Restitution),
        _ => (DampingModel::ConstantCoefficient, ForceLaw::Bilinear, Impact::None),
    };
    let wall = Parameters { height: 3.0, thickness: 0.6, a1: 0.0024, u_start: 0.0, ..Parameters::default() };
    Parameters { damping_model, force_law, impact, ..wall }
}

/// Runs one path several times to count its instructions; returns the number of samples.
fn count(path: &str, runs: u32) -> u64 {
    let record = SyntheticMotion::default().motion().expect("the default motion");
    let parameters = wall_of(path);
    let motion = Motion::of(&parameters, 1e-8).expect("a valid wall");
    let participation = motion.wall().body().forcing(Support::rigid(1.0));
    let solver = RecordSolver::new(&motion, record.step());
    let state = motion.start(0.0, 0.0, Support::default());
    let start = |factor: f64| RunStart { state, factor: factor * participation };
    let mut lanes = 1;
    for _ in 0..runs {
        let samples = black_box(record.samples());
        match path {
            "segments" | "settling-segments" | "demands" => {
                follow_segments(&parameters, &record, path == "demands");
            }
            "record" | "adaptive" | "settling" => {
                let outcome = solver.run(start(1.0), Forcing::Samples(samples), RunEnd::OfRecord);
                black_box(outcome.expect("a bounded motion"));
            }
            "batch" | "adaptive-batch" => {
                let outcomes =
                    solver.batch(Forcing::Samples(samples)).run(&batch(1.0, start), RunEnd::OfRecord);
                lanes = black_box(outcomes.expect("bounded motions")).len();
            }
            "together" => {
                let blocks = [0, 1].map(|_| Blocks::new(Forcing::Samples(samples)));
                let run = |(n, start)| BatchRun { solver: &solver, record: &blocks[n % 2], start };
                let given: Vec<_> = batch(1.0, start).into_iter().enumerate().map(run).collect();
                lanes = black_box(run_together(&given, RunEnd::OfRecord)).len();
            }
            other => panic!("no path {other}: see `cargo xtask bench`"),
        }
    }
    (record.samples().len() - 1) as u64 * u64::from(runs) * lanes as u64
}

/// Follows a wall by segments: sample by sample, or with demands and no history.
fn follow_segments(parameters: &Parameters, record: &GroundMotion, with_demands: bool) {
    let mut simulation = Simulation::new(parameters, None, 0.0, Support::default()).expect("a valid wall");
    if with_demands {
        let (excitation, mut demands) =
            (Excitation::new(record.clone(), None), simulation.demands(Support::default(), &[]));
        let end = record.duration();
        simulation.advance_to(end, Some(&excitation), Some(&mut demands)).expect("a bounded motion");
    } else {
        for ends in black_box(record.samples()).windows(2) {
            let [from, to] = [ends[0], ends[1]].map(Support::rigid);
            let segment = Segment { duration: record.step(), from, to };
            simulation.advance(&segment).expect("a bounded motion");
        }
    }
    black_box(simulation.progress().state);
}
