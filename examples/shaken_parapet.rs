//! The default parapet under a motion: the page of its run, and the samples for a master.
//!
//! ```text
//! cargo run -p rocking-run --example shaken_parapet parapet [RECORD [UNIT]]
//! ```
//!
//! Writes `parapet.html`, and the samples into `parapet_input.csv`, which `fmpy simulate --input-file` takes.
//! Prints the largest |u| in m where each sample is held until the next, as FMPy holds it. `cargo xtask demo`
//! runs this beside the FMU.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example shows what it finds")]

use std::error::Error;

use ground_motion::{RecordOptions, SyntheticMotion};
use rocking_wall::simulation::Excitation;
use rocking_wall::wall::Wall;
use run::file::to_file;
use run::record_facts::samples;
use scene::response::Response;
use scene::{DEFAULT_TAIL, Scene};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (name, note, motion) = match &arguments[..] {
        [name] => (name, "synthetic motion", SyntheticMotion::default().motion()?.scaled_to_peak(2.5)?),
        [name, file, unit @ ..] => {
            let unit = unit.first().map(|unit| unit.parse()).transpose()?;
            let record = ground_motion::read(file, &RecordOptions { unit, ..RecordOptions::default() })?;
            record.check().warnings.iter().for_each(|warning| eprintln!("{file}: {warning}"));
            (name, file.as_str(), record.motion)
        }
        [] => return Err("name the files that are written, such as `parapet`".into()),
    };
    let mut scene = Scene { title: "The default parapet, shaken".into(), ..Scene::default() };
    scene.shake(Excitation::new(motion.clone(), None), DEFAULT_TAIL, vec![note.to_owned()]);
    let page = run::page::render(&scene, &Wall::new(&scene.parameters)?, &Response::of(&scene)?)?;
    to_file(format!("{name}.html").as_ref(), page.as_bytes())?;
    to_file(format!("{name}_input.csv").as_ref(), samples(&motion).as_bytes())?;
    scene.excitation = Some(Excitation::new(motion.clone(), None).held());
    scene.set_output(Some(motion.duration()), None, None)?;
    println!("{}", Response::of(&scene)?.summary.u_max);
    Ok(())
}
