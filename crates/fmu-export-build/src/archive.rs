//! The FMU as an archive: files in memory. The same content gives the same bytes.
//!
//! ```
//! use fmu_export_build::archive::Archive;
//!
//! let mut archive = Archive::default();
//! archive.insert("documentation/index.html", "<!DOCTYPE html>");
//! archive.insert("binaries/linux64/clock.so", vec![0_u8; 4]);
//! assert_eq!(archive.names().next(), Some("binaries/linux64/clock.so"));
//! assert_eq!(archive.to_bytes()?, archive.clone().to_bytes()?);
//! # Ok::<(), std::io::Error>(())
//! ```

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{Cursor, Read as _, Write as _};
use std::path::{Path, PathBuf};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// Largest content of an FMU \[bytes\]: a small archive can unpack to anything.
const MAX_CONTENT: u64 = 1 << 30;

/// The files of an FMU by their path inside it, in the order of the paths.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Archive {
    files: BTreeMap<String, Vec<u8>>,
}

/// Why an archive cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum ArchiveError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    /// The file is not an archive, or is damaged.
    #[error("{}: is not a readable zip archive: {source}", path.display())]
    Damaged { path: PathBuf, source: zip::result::ZipError },
    /// A file inside has a path that leads elsewhere.
    #[error("{}: contains {name:?}, which is not a path inside an FMU", path.display())]
    BadName { path: PathBuf, name: String },
    /// The content is larger than any FMU's.
    #[error("{}: unpacks to more than {MAX_CONTENT} bytes", path.display())]
    TooLarge { path: PathBuf },
}

impl Archive {
    /// Reads the archive at `path`.
    ///
    /// # Errors
    /// A file that cannot be read, is not a zip archive, fails its checksum, unpacks to more than 1 GiB, or
    /// contains paths that lead out of it.
    pub fn open(path: &Path) -> Result<Self, ArchiveError> {
        let read = |source| ArchiveError::Read { path: path.to_path_buf(), source };
        let damaged = |source| ArchiveError::Damaged { path: path.to_path_buf(), source };
        // opening a pipe would block until something writes to it
        if !fs::metadata(path).map_err(read)?.is_file() {
            return Err(read(std::io::Error::other("not a regular file")));
        }
        let mut zip = ZipArchive::new(File::open(path).map_err(read)?).map_err(damaged)?;
        let mut archive = Self::default();
        let mut left = MAX_CONTENT;
        for index in 0..zip.len() {
            let file = zip.by_index(index).map_err(damaged)?;
            if file.is_dir() {
                continue;
            }
            let name = file.name().map_err(damaged)?.into_owned();
            if !is_inside(&name) {
                return Err(ArchiveError::BadName { path: path.to_path_buf(), name });
            }
            let mut content = Vec::new();
            // Reads one byte more than is left, so that content above the limit is noticed. The size in the
            // header is not trusted.
            let size =
                file.take(left + 1).read_to_end(&mut content).map_err(|error| damaged(error.into()))?;
            left = left
                .checked_sub(size as u64)
                .ok_or_else(|| ArchiveError::TooLarge { path: path.to_path_buf() })?;
            archive.files.insert(name, content);
        }
        Ok(archive)
    }

    /// The content of the file at `name`.
    pub fn get(&self, name: &str) -> Option<&[u8]> {
        self.files.get(name).map(Vec::as_slice)
    }

    /// Adds a file, or replaces it.
    ///
    /// # Panics
    /// If `name` is not a relative path with `/` between its parts.
    pub fn insert(&mut self, name: impl Into<String>, content: impl Into<Vec<u8>>) {
        let name = name.into();
        assert!(is_inside(&name), "{name:?} is not a path inside an FMU");
        self.files.insert(name, content.into());
    }

    /// Takes a file out.
    pub fn remove(&mut self, name: &str) -> Option<Vec<u8>> {
        self.files.remove(name)
    }

    /// Takes out all files of the folder `name`, and of those inside.
    pub fn remove_folder(&mut self, name: &str) {
        let is_inside = |path: &str| path.strip_prefix(name).is_some_and(|rest| rest.starts_with('/'));
        self.files.retain(|path, _| !is_inside(path));
    }

    /// The paths inside, sorted.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// The archive's bytes: sorted paths, deflate, no dates, equal permissions.
    ///
    /// # Errors
    /// Content beyond the limits of the format.
    pub fn to_bytes(&self) -> std::io::Result<Vec<u8>> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::DEFAULT)
            .unix_permissions(0o644);
        let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, content) in &self.files {
            writer.start_file(name.as_str(), options)?;
            writer.write_all(content)?;
        }
        Ok(writer.finish()?.into_inner())
    }
}

/// Returns whether `name` is a relative path with `/` between its parts and none of them `..`.
fn is_inside(name: &str) -> bool {
    let plain = |part: &str| !matches!(part, "" | "." | "..") && !part.contains(['\\', ':', '\0']);
    name.split('/').all(plain)
}
