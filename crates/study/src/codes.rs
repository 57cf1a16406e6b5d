//! What a study asks of building codes. A study knows none: the crate that does answers.

use files::{FileError, TomlFile};
use scene::SceneError;

/// Answers what a study asks of its table `[check]`.
pub trait Codes {
    /// Returns the spectrum of the ground over its acceleration, `S_e`(T)/`a_g` at 5 % damping, at some
    /// periods \[s\]; `None` where the table states no site.
    ///
    /// # Errors
    /// [`SceneError`] of the table.
    fn spectral_shape(&self, file: &TomlFile<'_>, periods: &[f64]) -> Result<Option<Vec<f64>>, SceneError>;

    /// Returns the text of a study with the files in it that its table names; `name` stands for its file in
    /// messages.
    ///
    /// # Errors
    /// [`FileError`] of the table, or of a file.
    fn self_contained(&self, name: &str, text: &str) -> Result<String, FileError>;
}

/// No code: a table `[check]` is passed over, and `measure = "code"` refused.
#[derive(Clone, Copy, Debug)]
pub struct NoCodes;

impl Codes for NoCodes {
    fn spectral_shape(&self, _: &TomlFile<'_>, _: &[f64]) -> Result<Option<Vec<f64>>, SceneError> {
        Ok(None)
    }

    fn self_contained(&self, _: &str, text: &str) -> Result<String, FileError> {
        Ok(text.to_owned())
    }
}
