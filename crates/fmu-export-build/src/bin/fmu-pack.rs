//! Puts an FMU together from the files of a build.

use fmu_export_build::pack::Package;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

const HELP: &str = "\
Puts an FMU together; the same files give the same bytes.

fmu-pack --description FILE --binary LIBRARY... --documentation DIR [--resources DIR] [--fmi 3] --output FILE

  --description FILE    the modelDescription.xml; its guid is filled in, and a model.png and a folder extra/
                        beside it go in too; what is in extra/ has names such as org.example.notes
  --binary LIBRARY      a shared library of Linux, Windows or macOS, and for FMI 3.0 also a WebAssembly
                        component; may be repeated, one for each platform
  --documentation DIR   becomes documentation/ and needs an index.html; licences in its folder licenses/ need
                        a license.txt, license.html or license.spdx beside them, the entry of FMI 3.0
  --resources DIR       becomes resources/
  --fmi 3               an FMI 3.0 unit instead of FMI 2.0; a fmi3.xml beside the description says what that
                        leaves open: attributes of CoSimulation, and terminals
  --output FILE         the FMU to write

A library of another version of FMI, or built from another description is refused. Hidden files are left out.
The exit code is 0, or 2 after an error.";

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

/// The options that may be given once. The other one, which may be repeated, is `--binary`.
const ONCE: [&str; 5] = ["--description", "--documentation", "--resources", "--fmi", "--output"];

fn parse(arguments: Vec<OsString>) -> Result<(Package, PathBuf), String> {
    let mut once: BTreeMap<String, OsString> = BTreeMap::new();
    let mut libraries = Vec::new();
    let mut arguments = arguments.into_iter();
    while let Some(option) = arguments.next() {
        let option = option.to_string_lossy().into_owned();
        if option != "--binary" && !ONCE.contains(&option.as_str()) {
            return Err(format!("{option:?} is not an option; see --help"));
        }
        let value = arguments.next().ok_or_else(|| format!("{option} needs a value; see --help"))?;
        if option == "--binary" {
            libraries.push(value.into());
        } else if once.insert(option.clone(), value).is_some() {
            return Err(format!("{option} is given twice"));
        }
    }
    if libraries.is_empty() {
        return Err("--binary is missing; see --help".to_owned());
    }
    let fmi3 = match once.remove("--fmi").map(|version| version.to_string_lossy().into_owned()).as_deref() {
        None | Some("2") => false,
        Some("3") => true,
        Some(other) => return Err(format!("--fmi {other}: there are 2 and 3")),
    };
    let resources = once.remove("--resources").map(PathBuf::from);
    let mut required = |wanted: &str| {
        once.remove(wanted).map(PathBuf::from).ok_or_else(|| format!("{wanted} is missing; see --help"))
    };
    let (description, documentation) = (required("--description")?, required("--documentation")?);
    let package = Package { description, libraries, documentation, resources, fmi3 };
    Ok((package, required("--output")?))
}
