#![doc = include_str!("../README.md")]
//!
//! # Map
//! The description is the one source of an FMU's variables. [`build_script`], the `build.rs` of a model,
//! refuses a description that contradicts itself and names the line. It writes one enum per FMI base type, so
//! that a variable which is declared but not wired does not compile. [`Description::reduced`] makes the
//! description of an FMU with fewer variables, [`Description::to_fmi3`] that of an FMI 3.0 unit, and the
//! feature `archive` reads and writes the FMU itself.
//!
//! Each module uses those above it:
//!
//! ```text
//! element      XML with line numbers ─► Element ─► XML in canonical form
//! condition    where a variable matters, from `<Where>`
//! variable     Element ─► variables and enumerations
//! usage        what conditions mean for each other
//! check        what the FMI 2.0 schema cannot check of these; structure: of the ModelStructure
//! description  Description: what has passed every check
//! choices      Description ─► choices.rs; code: ─► variables.rs
//! reduced      Description ─► Description of a subset
//! fmi3         Description ─► description and terminals of FMI 3.0
//! archive      FMU ◄─► files in memory, the same bytes for the same content
//! sources      FMI 3.0 unit ◄─► the description it is made from
//! library      library ─► its platforms, its version of FMI, its model
//! pack         files of a build ─► FMU
//! version      commit and profile of a program, for its build.rs
//! ```

#[cfg(feature = "archive")]
pub mod archive;
mod check;
mod choices;
mod code;
mod condition;
mod description;
mod element;
mod error;
mod fingerprint;
mod fmi3;
#[cfg(feature = "archive")]
mod library;
mod names;
#[cfg(feature = "archive")]
pub mod pack;
mod reduced;
#[cfg(feature = "archive")]
pub mod sources;
mod structure;
mod types3;
mod usage;
mod variable;
mod version;

pub use description::Description;
pub use error::{DescriptionError, Fault};
pub use fingerprint::fingerprint;
pub use fmi3::Additions;
pub use reduced::{DefaultExperiment, Reduction, ReductionError};
pub use version::state_version;

use std::path::Path;
use std::process::ExitCode;

/// Is the `build.rs` of a model: generates the variables of the description `xml` where cargo wants them.
///
/// ```no_run
/// fn main() -> std::process::ExitCode {
///     fmu_export_build::build_script("modelDescription/modelDescription.xml")
/// }
/// ```
#[allow(clippy::print_stdout, reason = "this is how a build script speaks to cargo")]
pub fn build_script(xml: &str) -> ExitCode {
    println!("cargo::rerun-if-changed={xml}");
    let Some(out_dir) = std::env::var_os("OUT_DIR") else {
        println!("cargo::error=OUT_DIR is not set: this program is run by cargo");
        return ExitCode::FAILURE;
    };
    match generate(xml.as_ref(), out_dir.as_ref()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            println!("cargo::error={error}");
            ExitCode::FAILURE
        }
    }
}

/// Reads the description `xml`, checks it, and writes `choices.rs` and `variables.rs` into the folder
/// `out_dir`.
///
/// `choices.rs` stands alone: enumerations, `start_values!` for a struct `Parameters` with one field per
/// parameter, and `usages!`, which says where each variable matters. `variables.rs` refers to the crate
/// `fmu_export`, and needs `Parameters` and the enumerations in scope.
///
/// # Errors
/// A file that cannot be read or written, and any problem of the description, with its line.
pub fn generate(xml: &Path, out_dir: &Path) -> Result<(), DescriptionError> {
    let text = std::fs::read_to_string(xml)
        .map_err(|source| DescriptionError::Read { path: xml.to_path_buf(), source })?;
    let description = Description::parse(&text)
        .map_err(|fault| DescriptionError::Invalid { path: xml.to_path_buf(), fault })?;
    for (name, code) in
        [("choices.rs", choices::module(&description)), ("variables.rs", code::module(&description))]
    {
        let path = out_dir.join(name);
        std::fs::write(&path, code).map_err(|source| DescriptionError::Write { path, source })?;
    }
    Ok(())
}
