//! `cargo xtask demo`: builds the FMU and runs it under a ground motion.

use std::path::{Path, PathBuf};

use crate::command::{Result, output, read, root, succeed};
use crate::fmu;
use crate::python::Environment;

/// Runs the demo with the embedded motion, then with the user's record if there is one.
pub(crate) fn run(record: &[&str]) -> Result<()> {
    // side by side: one of the two waits for the network
    let (built, python) = std::thread::scope(|scope| {
        let python = scope.spawn(|| Environment::of("demo"));
        let programs =
            fmu::programs("demo", &["--package", "rocking-wall-cli", "--package", "fmu-export-build"]);
        let built = programs.and_then(|programs| Ok((fmu::quick_library(fmu::WALL)?, programs)));
        (built, python.join().unwrap_or_else(|_| Err("a thread of the demo panicked".to_owned())))
    });
    let ((library, programs), python) = (built?, python?);
    let unit = fmu::pack_version(fmu::WALL, &[library], &programs, "2")?;
    let wall = programs.join("wall");
    let out = root().join("fmu_out");
    shake(&unit, &python, &wall, &out.join("demo"), &["--synthetic", "--pga", "2.5"])?;
    if let [file, rest @ ..] = record {
        let mut arguments = vec!["--record", *file];
        if let [unit] = rest {
            arguments.extend(["--unit", *unit]);
        }
        let name = Path::new(file).file_stem().map_or_else(|| "record".into(), |stem| stem.to_string_lossy());
        shake(&unit, &python, &wall, &out.join(format!("demo_{name}")), &arguments)?;
    }
    Ok(())
}

/// Shakes the FMU in FMPy with a motion, and the same wall on the command line.
fn shake(unit: &Path, python: &Environment, wall: &Path, base: &Path, motion: &[&str]) -> Result<()> {
    let file = |suffix: &str| PathBuf::from(format!("{}{suffix}", base.display()));
    let (input, history, page) = (file("_input.csv"), file(".csv"), file(".html"));
    let command = |first: &str| {
        let mut command = crate::command::program(wall);
        command.arg(first).args(motion);
        command
    };
    let record = motion.strip_prefix(&["--record"]).unwrap_or(motion);
    run_quietly(crate::command::program(wall).arg("record").args(record).arg("--samples").arg(&input))?;
    let text = read(&input)?;
    let stop = text.lines().last().and_then(|line| line.split(',').next()).unwrap_or("30").to_owned();
    let mut fmpy = python.program("python");
    fmpy.arg("tests/python/shake.py").arg(unit).arg(&input).arg(&stop).arg(&history);
    let in_fmpy = output(&mut fmpy, "see its message")?;
    let held =
        output(command("simulate").args(["--hold", "--json", "--stop-time", &stop]), "see its message")?;
    run_quietly(command("simulate").arg("--html").arg(&page))?;
    println!("largest |u| of the FMU in FMPy:   {} m", in_fmpy.lines().last().unwrap_or("?"));
    println!("the same on the command line:     {} m", number(&held, "u_max"));
    for path in [&history, &page] {
        println!("written {}", path.display());
    }
    Ok(())
}

fn run_quietly(command: &mut std::process::Command) -> Result<()> {
    succeed(command.stdout(std::process::Stdio::null()), "see its message above")
}

/// Reads a number from flat JSON.
fn number<'a>(json: &'a str, key: &str) -> &'a str {
    let rest = json.split(&format!("\"{key}\":")).nth(1).unwrap_or("?");
    rest.split([',', '}', '\n']).next().unwrap_or("?").trim()
}
