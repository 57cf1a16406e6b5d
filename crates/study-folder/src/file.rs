//! Files, written completely or not at all.

use std::fs::{File, OpenOptions, Permissions};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::error::FolderError;

/// Most links that lead from one to the next.
const MOST_LINKS: usize = 40;

/// Writes a file completely or not at all, and waits until the disk has it. A link stays and its target is
/// written, an existing file keeps its permissions, and a pipe or a device is written to.
///
/// # Errors
/// [`FolderError::File`].
pub fn to_file(path: &Path, content: &[u8]) -> Result<(), FolderError> {
    write(path, |file| file.write_all(content))
}

/// Writes a file like [`to_file`], with what `fill` writes.
///
/// # Errors
/// [`FolderError::File`].
pub fn write(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), FolderError> {
    let failed = |source| FolderError::File { path: path.to_owned(), what: "written", source };
    let mut draft = Draft::new(path).map_err(failed)?;
    fill(&mut draft.file).and_then(|()| draft.commit(true)).map_err(failed)
}

/// Writes a file like [`to_file`] without waiting for the disk: after a power failure its content may be
/// damaged.
pub(crate) fn to_file_unsynced(path: &Path, content: &[u8]) -> Result<(), FolderError> {
    let failed = |source| FolderError::File { path: path.to_owned(), what: "written", source };
    let written = Draft::new(path).and_then(|mut draft| {
        draft.file.write_all(content)?;
        draft.commit(false)
    });
    written.map_err(failed)
}

/// Removes a file, if there is one.
///
/// # Errors
/// [`FolderError::File`].
pub(crate) fn remove(path: &Path) -> Result<(), FolderError> {
    match std::fs::remove_file(path) {
        Err(source) if source.kind() != ErrorKind::NotFound => {
            Err(FolderError::File { path: path.to_owned(), what: "removed", source })
        }
        _ => Ok(()),
    }
}

/// A file that gets its name when it is complete.
pub(crate) struct Draft {
    pub(crate) file: BufWriter<File>,
    /// The incomplete file, and its later name; `None` for a pipe or a device.
    names: Option<[PathBuf; 2]>,
    permissions: Option<Permissions>,
}

impl Draft {
    pub(crate) fn new(path: &Path) -> io::Result<Self> {
        // whether the file may be written, and what it is
        let permissions = match OpenOptions::new().write(true).open(path) {
            Ok(existing) => {
                let metadata = existing.metadata()?;
                if !metadata.is_file() {
                    return Ok(Self { file: BufWriter::new(existing), names: None, permissions: None });
                }
                Some(metadata.permissions())
            }
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        let path = behind_links(path);
        // unique, also among processes with the same number on other machines
        let own = RandomState::new().hash_one(std::process::id());
        let part = folder(&path).join(format!(".{own:016x}.part"));
        let file = BufWriter::new(File::create_new(&part)?);
        Ok(Self { file, names: Some([part, path]), permissions })
    }

    /// Gives the file its name; waits for the disk where `sync` is set.
    pub(crate) fn commit(mut self, sync: bool) -> io::Result<()> {
        self.file.flush()?;
        let Some([part, path]) = &self.names else { return Ok(()) };
        let file = self.file.get_ref();
        if let Some(permissions) = self.permissions.take() {
            file.set_permissions(permissions)?;
        }
        if sync {
            file.sync_all()?;
        }
        std::fs::rename(part, path)?;
        #[cfg(unix)]
        if sync {
            // the new name; not every file system can
            let _ = File::open(folder(path)).and_then(|folder| folder.sync_all());
        }
        self.names = None;
        Ok(())
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        if let Some([part, _]) = &self.names {
            // the first error is the one to report; there may be nothing to remove
            let _ = std::fs::remove_file(part);
        }
    }
}

/// Returns the folder of a file.
pub fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Follows the links at a path to a file, which need not exist.
pub fn behind_links(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match path.read_link() {
            Ok(target) => path = folder(&path).join(target),
            Err(_) => break,
        }
    }
    path
}
