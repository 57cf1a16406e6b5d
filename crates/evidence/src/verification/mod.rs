//! The formulas of `docs/model.md`, each against a reference that does not come from this program.
//!
//! | module | holds |
//! |---|---|
//! | `error` | the error |
//! | `formula` | formulas and their checks as data |
//! | `scenes` | formulas that the variables of a wall show, in scenes: data of `formulas.toml` |
//! | `library` | variables of a scene, computed by this library |
//! | `studies` | formulas of spectra, capacity, fragilities; the list of all that are not scenes |
//! | `circolare` | the worked examples of the check by Circolare 7/2019 |
//! | `paper` | the paper's tables of damping ratios |
//! | [`page`] | the verification manual with the results |
//!
//! The references of `scenes` stand in `references.csv`. `tests/data/references.py` writes them, in decimal
//! arithmetic of 40 digits, or takes them from the reference cases in 113-bit arithmetic.
//!
//! ```
//! use evidence::verification::{library, verify};
//!
//! let formulas = verify(library)?;
//! assert!(formulas.iter().all(|formula| formula.checks.iter().all(|check| check.passes())));
//! # Ok::<(), evidence::verification::VerificationError>(())
//! ```

mod circolare;
mod error;
mod formula;
mod library;
pub mod page;
mod paper;
mod scenes;
mod studies;

use rocking_wall::scene::Scene;

pub use error::VerificationError;
pub use formula::{Check, Counts, Formula};
pub use library::library;
pub use scenes::{Quantity, verify_scenes};

/// Checks every formula; `values` computes the quantities of a scene, which come by rising times. It returns
/// `None` for a quantity that it does not know. [`library`] is one such function, an FMU another.
///
/// # Errors
/// Those of `values`, and [`VerificationError`] where a formula of `studies` cannot be computed.
pub fn verify<E: From<VerificationError>>(
    values: impl FnMut(&Scene, &[Quantity]) -> Result<Vec<Option<f64>>, E>,
) -> Result<Vec<Formula>, E> {
    let mut formulas = verify_scenes(values)?;
    for formula in studies::FORMULAS {
        formulas.push(formula()?);
    }
    Ok(formulas)
}
