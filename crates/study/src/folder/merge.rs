//! Takes together the parts of one study that several folders hold.

use std::path::Path;

use super::error::FolderError;
use super::store::Folder;

/// Copies the parts of some folders into another one, or completes the only one.
///
/// # Errors
/// [`FolderError`] if the folders hold different studies, parts are missing (it counts those that are
/// damaged), there are several folders and none to merge into, or a file cannot be written.
pub fn merge(mut folders: Vec<Folder>, into: Option<&Path>) -> Result<Folder, FolderError> {
    for folder in folders.iter().skip(1) {
        let (path, found, first) = (folder.path().to_owned(), folder.contents(), folders[0].contents());
        if found != first {
            return Err(FolderError::OtherThanFirst { path, difference: found.difference(first) });
        }
    }
    let target = match (into, folders.len()) {
        (Some(path), 1..) => Folder::like(path, folders[0].manifest())?,
        (None, 1) => folders.remove(0),
        (_, 0) => return Err(FolderError::NoFolder),
        (None, _) => return Err(FolderError::NoTarget),
    };
    let mut missing = Vec::new();
    for part in target.missing(0..target.contents().parts()) {
        match folders.iter().find_map(|folder| folder.part(part)) {
            Some(curves) => target.keep(part, &curves)?,
            None => missing.push(part),
        }
    }
    if missing.is_empty() { Ok(target) } else { Err(target.incomplete(&missing, &folders)) }
}
