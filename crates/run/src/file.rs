//! Files, written completely or not at all.

use std::fs::{File, OpenOptions, Permissions};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// A file or folder that cannot be read, written, made or removed.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be {what}: {source}", path.display())]
pub struct FileError {
    /// Its path.
    pub path: PathBuf,
    /// What cannot be done: `read`, `written` …
    pub what: &'static str,
    /// Why.
    pub source: io::Error,
}

/// Most links that lead from one to the next.
const MOST_LINKS: usize = 40;

/// Writes a file completely or not at all, and waits until it is on the disk. A link stays, and its target is
/// written. An existing file keeps its permissions. A pipe or a device gets the bytes directly.
///
/// # Errors
/// [`FileError`].
pub fn to_file(path: &Path, content: &[u8]) -> Result<(), FileError> {
    Draft::new(path, content)?.commit(true).map(drop)
}

/// Makes a folder, and those that it lies in.
///
/// # Errors
/// [`FileError`].
pub fn make_folder(path: &Path) -> Result<(), FileError> {
    let failed = |source| FileError { path: path.to_owned(), what: "made", source };
    std::fs::create_dir_all(path).map_err(failed)
}

/// Removes a file, if there is one.
///
/// # Errors
/// [`FileError`].
pub fn remove(path: &Path) -> Result<(), FileError> {
    match std::fs::remove_file(path) {
        Err(source) if source.kind() != ErrorKind::NotFound => {
            Err(FileError { path: path.to_owned(), what: "removed", source })
        }
        _ => Ok(()),
    }
}

/// A file that is renamed to its final name once it is complete.
pub struct Draft {
    path: PathBuf,
    file: BufWriter<File>,
    /// The incomplete file, and its later name; `None` for a pipe or a device.
    names: Option<[PathBuf; 2]>,
    permissions: Option<Permissions>,
}

impl Draft {
    /// Begins a file with some content.
    ///
    /// # Errors
    /// [`FileError`].
    pub fn new(path: &Path, content: &[u8]) -> Result<Self, FileError> {
        let mut draft = Self::open(path).map_err(|source| unwritten(path, source))?;
        draft.write(|file| file.write_all(content))?;
        Ok(draft)
    }

    /// Writes what `fill` writes.
    ///
    /// # Errors
    /// [`FileError`].
    pub fn write<T>(
        &mut self,
        fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<T>,
    ) -> Result<T, FileError> {
        fill(&mut self.file).map_err(|source| unwritten(&self.path, source))
    }

    /// Gives the file its name, and returns the path; waits for the disk where `sync` is set.
    ///
    /// # Errors
    /// [`FileError`].
    pub fn commit(mut self, sync: bool) -> Result<PathBuf, FileError> {
        let completed = self.complete(sync);
        completed.map_err(|source| unwritten(&self.path, source))?;
        Ok(std::mem::take(&mut self.path))
    }

    fn open(path: &Path) -> io::Result<Self> {
        let draft = |file, names, permissions| Self {
            path: path.to_owned(),
            file: BufWriter::new(file),
            names,
            permissions,
        };
        // opening shows whether the file may be written, and what kind of file it is
        let permissions = match OpenOptions::new().write(true).open(path) {
            Ok(existing) => {
                let metadata = existing.metadata()?;
                if !metadata.is_file() {
                    return Ok(draft(existing, None, None));
                }
                Some(metadata.permissions())
            }
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        let target = behind_links(path);
        // unique, also among processes with the same number on other machines
        let own = RandomState::new().hash_one(std::process::id());
        let part = folder(&target).join(format!(".{own:016x}.part"));
        Ok(draft(File::create_new(&part)?, Some([part, target]), permissions))
    }

    fn complete(&mut self, sync: bool) -> io::Result<()> {
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
            // make the new name durable; not every file system can
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

fn unwritten(path: &Path, source: io::Error) -> FileError {
    FileError { path: path.to_owned(), what: "written", source }
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
