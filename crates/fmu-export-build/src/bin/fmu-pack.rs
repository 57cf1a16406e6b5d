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

fn parse(arguments: Vec<OsString>) -> Result<(Package, PathBuf), String> {
    let (mut description, mut documentation, mut resources, mut output) = (None, None, None, None);
    let (mut libraries, mut platforms, mut fmi3) = (Vec::new(), Vec::new(), false);
    let mut arguments = arguments.into_iter();
    while let Some(option) = arguments.next() {
        let option = option.to_string_lossy().into_owned();
        let mut value = || arguments.next().ok_or_else(|| format!("{option} needs a value; see --help"));
        let single = match option.as_str() {
            "--description" => &mut description,
            "--documentation" => &mut documentation,
            "--resources" => &mut resources,
            "--output" => &mut output,
            "--binary" => {
                libraries.push(PathBuf::from(value()?));
                continue;
            }
            "--fmi" => {
                fmi3 = match value()?.to_string_lossy().as_ref() {
                    "2" => false,
                    "3" => true,
                    other => return Err(format!("--fmi {other}: there are 2 and 3")),
                };
                continue;
            }
            "--platform" => {
                platforms.push(value()?.to_string_lossy().into_owned());
                continue;
            }
            _ => return Err(format!("{option:?} is not an option; see --help")),
        };
        if single.replace(PathBuf::from(value()?)).is_some() {
            return Err(format!("{option} is given twice"));
        }
    }
    if libraries.is_empty() || libraries.len() != platforms.len() {
        return Err(format!(
            "{} --binary and {} --platform: each library needs its platform; see --help",
            libraries.len(),
            platforms.len()
        ));
    }
    let missing = |option: &str| format!("{option} is missing; see --help");
    let package = Package {
        description: description.ok_or_else(|| missing("--description"))?,
        binaries: platforms.into_iter().zip(libraries).collect(),
        documentation: documentation.ok_or_else(|| missing("--documentation"))?,
        resources,
        fmi3,
    };
    Ok((package, output.ok_or_else(|| missing("--output"))?))
}
