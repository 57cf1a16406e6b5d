//! What a step costs: `cargo bench --bench step`. Each figure is the least of several runs, beside the bare recurrence of a
//! linear oscillator timed in the same run.

#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use std::hint::black_box;
use std::time::Instant;

use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::variables::{DampingModel, DampingSource};
use rocking_wall::wall::{Parameters, Support};

const STEPS: usize = 20_000;
const RUNS: usize = 15;
const STEP: f64 = 0.005;

fn main() {
    let record: Vec<f64> = (0..=STEPS).map(acceleration).collect();
    let oscillator = least(|| {
        // uₙ₊₁ = A uₙ + b₀ aₙ + b₁ aₙ₊₁, the piecewise-exact recurrence
        let (mut u, mut v) = (1e-4_f64, 0.0_f64);
        for ends in black_box(&record).windows(2) {
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
        ("elastic step, constant coefficient", DampingModel::ConstantCoefficient, 1e-3),
        ("elastic step, constant ratio", DampingModel::ConstantRatio, 1e-3),
        ("rocking, constant coefficient", DampingModel::ConstantCoefficient, 0.6),
        ("rocking, constant ratio", DampingModel::ConstantRatio, 0.6),
    ];
    for (name, damping_model, scale) in walls {
        let parameters = Parameters {
            damping_model,
            damping_source: DampingSource::Given,
            xi: 0.02,
            u_start: 0.0,
            ..Parameters::default()
        };
        let start = Simulation::new(&parameters, None, 0.0, Support::default()).expect("a valid wall");
        let cost = least(|| {
            let mut simulation = start.clone();
            for ends in black_box(&record).windows(2) {
                let [from, to] = [ends[0], ends[1]].map(|a| Support::rigid(scale * a));
                let segment = Segment { duration: STEP, from, to };
                simulation.advance(&segment).expect("a bounded motion");
            }
            assert!(!simulation.progress().state.overturned, "{name}: the wall stands");
            black_box(simulation.progress().state.displacement)
        });
        println!("{name:<46}{cost:>9.1} ns, {:>6.1} times the oscillator", cost / oscillator);
    }
}

/// A smooth made-up motion that makes the default wall rock without overturning \[m/s²\].
fn acceleration(index: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "a small index")]
    let t = index as f64 * STEP;
    0.9 * (7.0 * t).sin() + 0.3 * (2.3 * t).sin()
}

/// Nanoseconds a step, the least of several runs after a warm-up.
fn least(mut run: impl FnMut() -> f64) -> f64 {
    black_box(run());
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        black_box(run());
        least = least.min(start.elapsed().as_secs_f64());
    }
    #[allow(clippy::cast_precision_loss, reason = "a small count")]
    let steps = STEPS as f64;
    least * 1e9 / steps
}
