//! The state before an intervention, which a table `[check]` names as `baseline`.

use rocking_wall::scene::{Scene, SceneError};

use crate::code::before::Before;
use crate::code::{Code, Subject};
use crate::codes::read;
use crate::error::CheckError;
use crate::file::CheckFile;

/// Checks the scene of `baseline`, by its own table `[check]` or, where it has none, by this code; `None`
/// where no baseline is named.
///
/// # Errors
/// [`SceneError`] of a file that cannot be read, or of a wall that cannot be checked.
pub fn baseline(file: &CheckFile<'_>, code: &dyn Code) -> Result<Option<Before>, SceneError> {
    let Some(path) = file.baseline() else { return Ok(None) };
    let (name, text) = (path.display().to_string(), Scene::text(&path)?);
    let before = CheckFile::parse(&name, &text)?;
    let located = |error: CheckError| before.located(error);
    if before.has_walls() {
        return Err(located(CheckError::wall("a baseline is a scene with one wall")));
    }
    let scene = before.scene()?;
    let own = before.code().map(|_| read(&before)).transpose().map_err(located)?;
    let assumed = before.assumed(&[]);
    let subject = Subject { assumed: &assumed, ..Subject::from(&scene) };
    let verdict = own.as_deref().unwrap_or(code).check(subject).map_err(located)?;
    Ok(Some(Before::new(&scene.title, verdict.passed, verdict.headline(), &verdict.rows)))
}
