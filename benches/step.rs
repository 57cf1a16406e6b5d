//! Measures the time per step: `cargo bench --bench step`. Each figure is the least of several runs. The
//! yardstick is the bare recurrence of a linear oscillator, timed in the same run.

#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use std::hint::black_box;
use std::time::Instant;

use fmu_export::{Environment, Interface, Log, Model, Step};
use ground_motion::SyntheticMotion;
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::unit::Unit;
use rocking_wall::variables::{DampingModel, RealVariable};
use rocking_wall::wall::{Parameters, Support};

const RUNS: usize = 25;

fn main() {
    let motion = SyntheticMotion::default().motion().expect("the default motion");
    let record = motion.samples();
    let steps = record.len() - 1;
    let oscillator = least(steps, || {
        // uₙ₊₁ = A uₙ + b₀ aₙ + b₁ aₙ₊₁, the piecewise-exact recurrence
        let (mut u, mut v) = (1e-4_f64, 0.0_f64);
        for ends in black_box(record).windows(2) {
            let (from, to) = (ends[0], ends[1]);
            (u, v) = (
                0.9986 * u + 0.004_99 * v - 1.2e-5 * from - 4e-6 * to,
                -0.55 * u + 0.9986 * v - 2.5e-3 * (from + to),
            );
        }
        black_box(u + v)
    });
    println!("{:<46}{oscillator:>9.1} ns", "bare linear oscillator");
    let walls = [
        ("elastic step, constant coefficient", DampingModel::ConstantCoefficient, 0.05),
        ("elastic step, constant ratio", DampingModel::ConstantRatio, 0.05),
        ("rocking, constant coefficient", DampingModel::ConstantCoefficient, 0.5),
        ("rocking, constant ratio", DampingModel::ConstantRatio, 0.5),
    ];
    for (name, damping_model, scale) in walls {
        let parameters = Parameters { damping_model, xi: 0.02, u_start: 0.0, ..Parameters::default() };
        let start = Simulation::new(&parameters, None, 0.0, Support::default()).expect("a valid wall");
        let cost = least(steps, || {
            let mut simulation = start.clone();
            for ends in black_box(record).windows(2) {
                let [from, to] = [ends[0], ends[1]].map(|a| Support::rigid(scale * a));
                let segment = Segment { duration: motion.step(), from, to };
                simulation.advance(&segment).expect("a bounded motion");
            }
            assert!(!simulation.progress().state.overturned, "{name}: the wall stands");
            black_box(simulation.progress().state.displacement)
        });
        println!("{name:<46}{cost:>9.1} ns, {:>6.1} times the oscillator", cost / oscillator);
    }
    let cost = do_step(record, motion.step());
    println!(
        "{:<46}{cost:>9.1} ns, {:>6.1} times the oscillator",
        "elastic do_step of the unit",
        cost / oscillator
    );
}

/// An elastic communication step of the unit, its input set before each.
fn do_step(record: &[f64], step: f64) -> f64 {
    let environment = Environment {
        interface: Interface::CoSimulation,
        instance_name: "wall",
        resources: None,
        payload: None,
    };
    let mut log = Log::silent();
    let mut start = Unit::instantiate(environment, &mut log).expect("the default wall");
    start.set_real(RealVariable::UStart, 0.0);
    start.initialize(&mut log).expect("the default wall");
    least(record.len() - 1, || {
        let mut unit = start.clone();
        let mut from = 0.0;
        for acceleration in &black_box(record)[1..] {
            unit.set_real(RealVariable::AG, 0.05 * acceleration);
            unit.do_step(Step { from, duration: step, may_end_early: false }, &mut log)
                .expect("a bounded motion");
            from += step;
        }
        unit.real(RealVariable::U)
    })
}

/// Nanoseconds a step, the least of several runs after a warm-up.
fn least(steps: usize, mut run: impl FnMut() -> f64) -> f64 {
    black_box(run());
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        black_box(run());
        least = least.min(start.elapsed().as_secs_f64());
    }
    #[allow(clippy::cast_precision_loss, reason = "a small count")]
    let steps = steps as f64;
    least * 1e9 / steps
}
