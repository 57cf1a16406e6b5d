//! Puts an FMU together from the files of a build.

use fmu_export_build::pack::Package;
use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

const HELP: &str = "\
Puts an FMU together; the same files give the same bytes.

fmu-pack --description FILE --binary LIBRARY --platform NAME --documentation DIR [--resources DIR]
          [--fmi 3] --output FILE

  --description FILE    the modelDescription.xml; its guid is filled in, and a model.png and a folder extra/
                        beside it go in too
  --binary LIBRARY      the shared library; may be repeated, each followed by its
  --platform NAME       linux64, win64, darwin64, linux32, win32 or darwin32; for FMI 3.0 also aarch64-linux,
                        and wasm32-wasip2 for a WebAssembly component
  --documentation DIR   becomes documentation/ and needs an index.html
  --resources DIR       becomes resources/
  --fmi 3               an FMI 3.0 unit instead of FMI 2.0; a fmi3.xml beside the description says what that
                        leaves open: attributes of CoSimulation, and terminals
  --output FILE         the FMU to write

A library of another platform, of another version of FMI, or built from another description is refused. Hidden
files are left out. The exit code is 0, or 2 after an error.";

fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    if arguments.iter().any(|argument| argument == "--help" || argument == "-h") {
        let _ = writeln!(std::io::stdout(), "{HELP}");
        return ExitCode::SUCCESS;
    }
    match run(arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            let _ = writeln!(std::io::stderr(), "fmu-pack: {message}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: Vec<OsString>) -> Result<(), String> {
    let (package, output) = parse(arguments)?;
    let archive = package.archive().map_err(|error| error.to_string())?;
    let failed = |error| format!("{}: cannot be written: {error}", output.display());
    archive.to_bytes().and_then(|bytes| std::fs::write(&output, bytes)).map_err(failed)
}

/// The options that may be given once, and those that may be repeated.
const ONCE: [&str; 4] = ["--description", "--documentation", "--resources", "--output"];
const REPEATED: [&str; 3] = ["--binary", "--platform", "--fmi"];

fn parse(arguments: Vec<OsString>) -> Result<(Package, PathBuf), String> {
    let mut given: Vec<(String, OsString)> = Vec::new();
    let mut arguments = arguments.into_iter();
    while let Some(option) = arguments.next() {
        let option = option.to_string_lossy().into_owned();
        let is_single = ONCE.contains(&option.as_str());
        if !is_single && !REPEATED.contains(&option.as_str()) {
            return Err(format!("{option:?} is not an option; see --help"));
        }
        let value = arguments.next().ok_or_else(|| format!("{option} needs a value; see --help"))?;
        if is_single && given.iter().any(|(other, _)| *other == option) {
            return Err(format!("{option} is given twice"));
        }
        given.push((option, value));
    }
    let given = &given;
    let all = |wanted: &'static str| {
        given.iter().filter(move |(option, _)| option == wanted).map(|(_, value)| value)
    };
    let texts = |wanted: &'static str| all(wanted).map(|value| value.to_string_lossy().into_owned());
    let path = |wanted: &'static str| all(wanted).next().map(PathBuf::from);
    let required =
        |wanted: &'static str| path(wanted).ok_or_else(|| format!("{wanted} is missing; see --help"));
    let fmi3 = match texts("--fmi").next_back().as_deref() {
        None | Some("2") => false,
        Some("3") => true,
        Some(other) => return Err(format!("--fmi {other}: there are 2 and 3")),
    };
    let (libraries, platforms) = (all("--binary").count(), all("--platform").count());
    if libraries == 0 || libraries != platforms {
        return Err(format!(
            "{libraries} --binary and {platforms} --platform: each library needs its platform; see --help"
        ));
    }
    let package = Package {
        description: required("--description")?,
        binaries: texts("--platform").zip(all("--binary").map(PathBuf::from)).collect(),
        documentation: required("--documentation")?,
        resources: path("--resources"),
        fmi3,
    };
    Ok((package, required("--output")?))
}
