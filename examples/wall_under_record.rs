//! A parapet under a record: peaks, demands and overturning.
//!
//! ```text
//! cargo run --package rocking-scene --example wall_under_record
//! ```

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::error::Error;

use ground_motion::SyntheticMotion;
use rocking_wall::simulation::Excitation;
use scene::Scene;
use scene::response::Response;

fn main() -> Result<(), Box<dyn Error>> {
    // Every parameter that is not set keeps the default of modelDescription.xml.
    let mut scene = Scene::default();
    scene.parameters.height = 2.4;
    scene.parameters.thickness = 0.25;
    scene.parameters.a1 = 0.02;
    scene.parameters.xi = 0.05;

    // A record file: `ground_motion::read("record.AT2".as_ref(), &options)?.motion`
    let motion = SyntheticMotion::default().motion()?.scaled_to_peak(3.0)?;
    let tail = 5.0;
    scene.shake(Excitation::new(motion, None), tail, vec![]);

    let response = Response::of(&scene)?;
    println!("largest |u|: {:.1} mm", 1e3 * response.summary.u_max);
    println!(
        "             {:.0} % of the static instability displacement",
        100.0 * response.summary.u_ratio_max
    );
    match response.summary.overturn_time {
        Some(time) => println!("overturned at {time:.2} s"),
        None => println!("still standing after {:.1} s", response.summary.end_time),
    }
    for warning in &response.warnings {
        println!("warning: {warning}");
    }
    Ok(())
}
