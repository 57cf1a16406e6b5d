//! A wall driven step by step, as a co-simulation master or a control loop would.
//!
//! ```text
//! cargo run --example step_by_step
//! ```

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::error::Error;

use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Parameters, Support};

fn main() -> Result<(), Box<dyn Error>> {
    let parameters = Parameters {
        mechanism: Mechanism::VerticalSpanning,
        height: 3.0,
        thickness: 0.25,
        u_start: 0.0,
        ..Parameters::default()
    };
    // The accelerations of the two floors and their drift, whatever they come from: here a pulse of 0.5 s.
    let floors = |time: f64| {
        let pulse = if time < 0.5 { 4.0 * (2.0 * std::f64::consts::PI * time).sin() } else { 0.0 };
        Support { bottom: pulse, top: 1.2 * pulse, drift: 0.0 }
    };

    let step = 0.01;
    let mut wall = Simulation::new(&parameters, None, 0.0, floors(0.0))?;
    for index in 0..300 {
        let time = f64::from(index) * step;
        // Between the two instants the supports' accelerations are linear.
        let segment = Segment { duration: step, from: floors(time), to: floors(time + step) };
        let outcome = wall.advance(&segment)?;
        if outcome.overturned {
            println!("overturned by t = {:.2} s", time + step);
        }
        if index % 50 == 49 {
            let outputs = wall.outputs(floors(time + step));
            println!(
                "t = {:.2} s: u = {:8.3} mm, force on the upper floor {:8.1} N",
                time + step,
                1e3 * outputs.displacement,
                -outputs.reactions.top
            );
        }
    }
    Ok(())
}
