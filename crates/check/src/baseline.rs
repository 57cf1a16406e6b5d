//! The state before an intervention, which a table `[check]` names as `baseline`.

use std::path::PathBuf;

use files::FileError;
use run::walls::NamedWall;
use scene::{Scene, SceneError};

use crate::code::before::Before;
use crate::code::{Code, Subject};
use crate::codes::read;
use crate::error::CheckError;
use crate::file::CheckFile;
use crate::walls::{WallCodes, WallVerdicts};

/// Checks the scene of `baseline`, by its own table `[check]` or, where it has none, by this code; `None`
/// where no baseline is named. Adds the files that are read to `inputs`.
///
/// # Errors
/// [`SceneError`] of a file that cannot be read, or of a wall that cannot be checked.
pub fn baseline(
    file: &CheckFile<'_>,
    code: &dyn Code,
    inputs: &mut Vec<PathBuf>,
) -> Result<Option<Before>, SceneError> {
    let Some(path) = file.baseline() else { return Ok(None) };
    let (name, text) = (path.display().to_string(), Scene::text(&path)?);
    let before = CheckFile::parse(&name, &text)?;
    let located = |error: CheckError| before.located(error);
    if before.has_walls() {
        return Err(located(CheckError::wall("a baseline is a scene with one wall")));
    }
    let scene = before.scene()?;
    let own = before.code().map(|_| read(&before)).transpose().map_err(located)?;
    inputs.push(path);
    inputs.extend(scene.files.iter().chain(own.iter().flat_map(|own| &own.records().files)).cloned());
    let assumed = before.assumed(&[]);
    let subject = Subject { assumed: &assumed, ..Subject::from(&scene) };
    let verdict = own.as_deref().unwrap_or(code).check(subject).map_err(located)?;
    Ok(Some(verdict.as_before(&scene.title)))
}

/// Sets the state before of walls that could be checked: that of the wall of the same name in the file of
/// walls that `baseline` names, by its own table `[check]` or, where it has none, by the code of the wall.
/// Adds the files that are read to `inputs`, and warnings about defaults.
///
/// # Errors
/// [`SceneError`] of a file that cannot be read, of a wall that it lacks, or of one that cannot be checked.
pub fn baselines(
    file: &CheckFile<'_>,
    codes: &WallCodes,
    walls: &[NamedWall],
    verdicts: &mut WallVerdicts<'_>,
    inputs: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Result<(), SceneError> {
    let Some(path) = file.baseline() else { return Ok(()) };
    let (name, text) = (path.display().to_string(), Scene::text(&path)?);
    let before = CheckFile::parse(&name, &text)?;
    if !before.has_walls() {
        let message = "a baseline of walls is a file of walls, each with the name of its wall";
        return Err(FileError::whole(name, message).into());
    }
    let states = before.walls(&[], inputs, warnings)?;
    let own = before.code().map(|_| WallCodes::read(&before, &states)).transpose()?;
    inputs.extend(own.iter().flat_map(|own| &own.shared().records().files).cloned());
    for wall in walls {
        let after = verdicts.walls.iter_mut().find(|(name, _)| *name == wall.name);
        let Some((_, Ok(after))) = after else { continue };
        let refused = |message: String| FileError::whole(&name, format!("wall {:?}{message}", wall.name));
        let state = states.iter().find(|state| state.name == wall.name);
        let state = state.ok_or_else(|| refused(" is missing: it stands for the state before".to_owned()))?;
        let NamedWall { parameters, floors, assumed, .. } = state;
        let subject = Subject { parameters, floors: floors.as_ref(), assumed };
        let code = own.as_ref().map_or(codes.of(wall), |own| own.of(state));
        let verdict = code.check(subject).map_err(|error| refused(format!(": {error}")))?;
        after.before = Some(verdict.as_before(&state.name));
    }
    Ok(())
}
