//! What a study asks of the codes.

use check::{CheckFile, read};
use files::{FileError, TomlFile};
use scene::SceneError;

/// The codes that this program knows, for studies.
///
/// ```
/// use reliability::Codes;
/// use study::document::StudyFile;
/// use study::ida::IntensityMeasure;
///
/// let text = r#"
/// models = ["CR"]
/// intensity = { measure = "code", periods = [0.2] }
/// levels = { method = "step", step = 0.1, top = 2 }
/// [check]
/// code = "circolare-2019"
/// before_activation = "rigid"
/// soil = "A"
/// SLV = { ag = 0.2, F0 = 2.4, TC = 0.3 }
/// "#;
/// let measure = StudyFile::parse("study.toml", text, &Codes)?.measure;
/// assert!(matches!(measure, IntensityMeasure::Code { shape, .. } if shape == [2.4]));
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Codes;

impl study::codes::Codes for Codes {
    fn spectral_shape(&self, file: &TomlFile<'_>, periods: &[f64]) -> Result<Option<Vec<f64>>, SceneError> {
        let file = CheckFile::new(file.clone()).without_records();
        let code = read(&file).map_err(|error| file.located(error))?;
        Ok(code.spectral_shape(periods))
    }

    fn self_contained(&self, name: &str, text: &str) -> Result<String, FileError> {
        CheckFile::parse(name, text)?.self_contained()
    }
}
