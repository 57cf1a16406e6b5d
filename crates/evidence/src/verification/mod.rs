//! The formulas of `docs/model.md`, each against a reference that does not come from this program.
//!
//! Each module uses only modules above it in this table:
//!
//! | module | holds |
//! |---|---|
//! | `scenes` | the variables of a wall in scenes, and their references |
//! | `given` | computed numbers beside given ones |
//! | `overturning` | rigid walls under pulses, and their steady rocking |
//! | `circolare` | the worked examples of the check by Circolare 7/2019 |
//! | `paper` | the paper's tables of damping ratios |
//! | `studies` | numbers of spectra, capacity, fragilities |
//! | [`page`] | the manual: on a terminal, as JSON, as Markdown, as a page |
//!
//! The texts and the scenes stand in `formulas.toml`, the references of the scenes in `references.csv`.
//! `tests/data/references.py` writes these, in decimal arithmetic of 40 digits, or takes them from the
//! reference cases in 113-bit arithmetic.
//!
//! ```
//! let formulas = evidence::verification::verify()?;
//! assert!(formulas.iter().all(|formula| formula.comparisons.iter().all(|number| number.passes())));
//! # Ok::<(), evidence::EvidenceError>(())
//! ```

mod circolare;
mod given;
mod overturning;
pub mod page;
mod paper;
mod scenes;
mod studies;

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::{Comparison, EvidenceError};

/// A formula, what it is compared with, and the numbers.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Formula {
    /// Title.
    pub title: String,
    /// Heading of `docs/model.md` that states it, as a link.
    pub section: String,
    /// The formula.
    pub statement: String,
    /// Where the reference comes from.
    pub reference: String,
    /// Why the bound is what it is.
    pub why: String,
    /// Numbers.
    #[serde(skip)]
    pub comparisons: Vec<Comparison>,
    /// Texts of scenes by their names.
    #[serde(default)]
    pub scenes: BTreeMap<String, String>,
    /// Motion of all scenes.
    motion: Option<scenes::Samples>,
    /// The name of the study that computes it.
    study: Option<String>,
}

/// Computes every formula.
///
/// # Errors
/// [`EvidenceError`] where one cannot be computed.
pub fn verify() -> Result<Vec<Formula>, EvidenceError> {
    let mut formulas: Vec<_> = document().into_values().flatten().collect();
    for formula in &mut formulas {
        for text in [&mut formula.statement, &mut formula.reference, &mut formula.why] {
            *text = text.trim().replace('\n', " ");
        }
        formula.comparisons = match &formula.study {
            Some(name) => studies::compare(name)?,
            None => scenes::compare(&formula.scenes, formula.motion.as_ref())?,
        };
    }
    Ok(formulas)
}

fn document() -> BTreeMap<String, Vec<Formula>> {
    toml::from_str(include_str!("formulas.toml")).expect("formulas.toml is part of the program")
}
