//! Times the wall's solvers and those of other Rust crates on the same problems, and writes the problems for
//! tools outside Rust: `rocking-wall-peers FOLDER [RECORD.AT2]`. `cargo xtask bench --peers` runs it.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line speaks to its user")]

mod dormand_prince;
mod measure;
mod own;
mod problem;
mod root_finding;

use std::path::Path;
use std::process::ExitCode;

use ground_motion::{GroundMotion, RecordOptions, SyntheticMotion, read};

use measure::Rows;
use problem::Problem;

/// Part of the record that is used \[s\].
const DURATION: f64 = 30.0;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.as_slice() {
        [folder] => compare(Path::new(folder), None),
        [folder, record] => compare(Path::new(folder), Some(Path::new(record))),
        _ => Err("usage: rocking-wall-peers FOLDER [RECORD.AT2]".to_owned()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("rocking-wall-peers: {message}");
            ExitCode::FAILURE
        }
    }
}

fn compare(folder: &Path, record: Option<&Path>) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let motion = motion(record)?;
    let mut rows = Rows::new();
    for problem in Problem::all(&motion)? {
        println!("{}: our solvers, ode_solvers, diffsol", problem.scene);
        problem.write(folder)?;
        own::measure(&problem, &mut rows);
        dormand_prince::measure(&problem, &mut rows);
        root_finding::measure(&problem, &mut rows);
    }
    let path = folder.join("rows.csv");
    std::fs::write(&path, rows.text()).map_err(|error| format!("{}: {error}", path.display()))
}

/// A synthetic motion under which every wall rocks beyond a third of `u_ins`, none overturns, and a change of
/// the input grows at most a thousandfold. Under many other motions a comparison would measure chance.
const SYNTHETIC: SyntheticMotion = SyntheticMotion { seed: 11, duration: 30.0, step: 0.005, peak: 3.2 };

/// Returns the first 30 s of a record, or a synthetic motion.
fn motion(record: Option<&Path>) -> Result<GroundMotion, String> {
    let motion = match record {
        Some(path) => read(path, &RecordOptions::default()).map(|record| record.motion),
        None => SYNTHETIC.motion(),
    };
    let motion = motion.map_err(|error| error.to_string())?;
    let end = DURATION.min(motion.duration());
    motion.trimmed(0.0, end).map_err(|error| error.to_string())
}
