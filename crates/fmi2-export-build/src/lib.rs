//! Turns a modelDescription.xml into Rust variables, and files into an FMU.
//!
//! The description is the one source of an FMU's variables. [`generate`], called by the `build.rs` of a model,
//! refuses a description that contradicts itself, with the line, and writes one enum per FMI base type, so
//! that a variable which is declared but not wired does not compile. [`Description::reduced`] makes the
//! description of an FMU with fewer variables, and the feature `archive` reads and writes the FMU itself.
//!
//! ```text
//! element      XML with line numbers ─► Element ─► XML in canonical form
//! description  Element ─► Description: the variables, types and structure
//! check        what the FMI 2.0 schema cannot say about variables; structure: about the ModelStructure
//! code         Description ─► variables.rs
//! reduced      Description ─► Description of a subset
//! archive      FMU ◄─► files in memory, the same bytes for the same content; pack: files of a build ─► FMU
//! ```

#[cfg(feature = "archive")]
pub mod archive;
mod check;
mod code;
mod description;
mod element;
mod error;
mod fingerprint;
#[cfg(feature = "archive")]
pub mod pack;
mod reduced;
mod structure;

pub use description::Description;
pub use error::{DescriptionError, Fault, Problem};
pub use fingerprint::{fingerprint, fnv1a_128};
pub use reduced::{DefaultExperiment, Reduction, ReductionError};

use std::path::Path;

/// Reads the description `xml`, checks it, and writes `variables.rs` into the folder `out_dir`.
///
/// The generated module refers to the crate `fmi2_export`.
///
/// # Errors
///
/// A file that cannot be read or written, and any [`Problem`] of the description, with its line.
pub fn generate(xml: &Path, out_dir: &Path) -> Result<(), DescriptionError> {
    let text = std::fs::read_to_string(xml)
        .map_err(|source| DescriptionError::Read { path: xml.to_path_buf(), source })?;
    let description = Description::parse(&text)
        .map_err(|fault| DescriptionError::Invalid { path: xml.to_path_buf(), fault: Box::new(fault) })?;
    let path = out_dir.join("variables.rs");
    std::fs::write(&path, code::module(&description))
        .map_err(|source| DescriptionError::Write { path, source })
}
