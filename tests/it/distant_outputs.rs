//! The work and the demands of a run do not depend on how far apart its outputs are.

use proptest::prelude::*;
use proptest::sample::select;
use rocking_wall::solver::{Demands, Extremes, Segment};
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Mechanism};
use rocking_wall::wall::{Parameters, Support, Wall};

use crate::configuration::mostly;
use crate::start;

/// Walls of every law, damping and impact, released as close to u_ins as 1e-6 of it, and the number of
/// outputs of the finer of two runs.
fn releases() -> impl Strategy<Value = (Parameters, u32)> {
    let laws = select(ForceLaw::ALL);
    let damping = prop_oneof![Just(DampingModel::None), select(DampingModel::ALL)];
    let ratio = prop_oneof![Just(0.0), 0.0_f64..0.1];
    let impacts = (select(Impact::ALL), prop_oneof![Just(1.0), 0.0_f64..1.0]);
    let wall = (select(Mechanism::ALL), 2.0_f64..5.0, 0.1_f64..0.5, 0.3_f64..0.7);
    let short = prop_oneof![Just(1e-6), Just(1e-4), 1e-3_f64..1.0]
        .prop_flat_map(|short| prop_oneof![Just(1.0 - short), Just(short - 1.0), Just(short)]);
    (laws, damping, ratio, impacts, wall, short, 2_u32..200).prop_map(
        |(force_law, damping_model, ratio, (impact, restitution), wall, share, outputs)| {
            let (mechanism, height, thickness, hinge_ratio) = wall;
            let parameters = Parameters {
                mechanism,
                height,
                thickness,
                hinge_ratio,
                force_law,
                damping_model,
                xi: ratio,
                c_bar: ratio,
                impact,
                restitution,
                tolerance: 1e-13,
                u_start: 0.0,
                ..Parameters::default()
            };
            let u_ins = Wall::new(&parameters).map_or(0.0, |wall| wall.body().instability.of(share));
            (Parameters { u_start: share * u_ins, ..parameters }, outputs)
        },
    )
}

/// The pieces and the demands of a run with so many outputs.
fn run(parameters: &Parameters, duration: f64, outputs: u32) -> (u64, bool, Demands) {
    let mut simulation = start(parameters);
    let mut demands = simulation.demands(Support::default(), &[0.1, 0.5]);
    let still =
        Segment { duration: duration / f64::from(outputs), from: Support::default(), to: Support::default() };
    for _ in 0..outputs {
        simulation.advance_watched(&still, &mut demands).unwrap();
    }
    let progress = simulation.progress();
    (progress.work.pieces, progress.state.overturned, demands)
}

/// Least share of the runs whose extremes are compared. The others fall, or amplify rounding too much.
const SHARE: f64 = 0.3;

/// Relative change of the start that shows how much the wall amplifies.
const PROBE: f64 = 1e-8;

/// The extremes of u, u̇ and ü in units of the wall, highest and lowest.
fn extremes(wall: &Wall, demands: &Demands) -> Vec<f64> {
    let (u, rate) = (wall.displacement_scale(), wall.rocking_rate().max(wall.omega1()));
    let Demands { displacement, velocity, acceleration, .. } = *demands;
    let scaled = [(displacement, u), (velocity, u * rate), (acceleration, u * rate * rate)];
    let ends =
        |(Extremes { highest, lowest }, scale): (Extremes, f64)| [highest, lowest].map(|at| at.value / scale);
    scaled.into_iter().flat_map(ends).collect()
}

/// Largest difference between extremes.
fn apart(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).fold(0.0, |most, (one, other)| (one - other).abs().max(most))
}

/// A run with one output makes no more pieces than one with many: up to 8, for pieces that end at other
/// instants, and for a series a quarter, because where it ends by itself it keeps a distance from its limit.
/// Extremes agree to the accuracy of the search, 1e-12 of their terms, and to what the wall makes of 16 ε for
/// each piece and of the tolerance, 1e-13.
#[test]
fn distant_outputs_cost_no_pieces() {
    mostly(SHARE, releases(), |(parameters, outputs)| {
        let Ok(wall) = Wall::new(&parameters) else { return Ok([0, 0]) };
        let duration = 40.0 / wall.rocking_rate();
        let (one, falls, coarse) = run(&parameters, duration, 1);
        let (many, also_falls, fine) = run(&parameters, duration, outputs);
        let most = many + 8 + if wall.has_closed_form() { 0 } else { many / 4 };
        prop_assert!(one <= most, "{one} pieces for {many}");
        let u_start = parameters.u_start * (1.0 - PROBE);
        let probed = Parameters { u_start, ..parameters.clone() };
        let (_, probed_falls, probed) = run(&probed, duration, 1);
        let [coarse, fine, probed] = [coarse, fine, probed].map(|demands| extremes(&wall, &demands));
        // an energy that errs by ε moves the turn, at A u_ins from the instability, by ε/(2A) u_ins, and the
        // fall from there by ε/(2A²) of its time
        let nearest = 1.0 - parameters.u_start.abs() / wall.body().instability.of(parameters.u_start);
        let amplification = 1.0 + apart(&coarse, &probed) / PROBE + 0.5 / (nearest * nearest);
        if falls || also_falls || probed_falls || amplification > 1e5 {
            return Ok([0, 1]);
        }
        let allowed = 1e-11 + amplification * (16.0 * f64::EPSILON * many as f64 + 1e-13);
        let difference = apart(&coarse, &fine);
        prop_assert!(difference <= allowed, "differs by {difference:e}, allowed {allowed:e}");
        Ok([1, 1])
    });
}
