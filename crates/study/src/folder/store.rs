//! The folder of a study: its contents, and one file for each finished part.
//!
//! A part appears complete, by renaming, so that the program can be killed at any moment. It holds a
//! checksum, and a damaged part counts as missing. Several processes can work on one folder. The final
//! results are made from the parts alone, so their bytes do not depend on which process computed what.

use std::ffi::OsStr;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::ida::Curve;
use crate::loaded::LoadedStudy;

use run::file::{self, Draft};

use super::contents::{Contents, Manifest};
use super::error::FolderError;
use super::part;

const STUDY: &str = "study.json";
/// The page. It is removed before the tables are written, and comes last: with it they are complete.
pub(crate) const PAGE: &str = "study.html";
/// All files that a study may have beside its parts, none of which may be one of its inputs.
pub const FILES: [&str; 23] = [
    "study.json",
    "levels.csv",
    "collapses.csv",
    "fragilities.csv",
    "fragility_curves.csv",
    "fragilities.xml",
    "pelicun.csv",
    "pelicun.json",
    "ties.csv",
    "cloud.csv",
    PAGE,
    "rates.csv",
    "rate_shares.csv",
    "losses.csv",
    "vulnerability.csv",
    "vulnerability.xml",
    "samples.csv",
    "sensitivity.csv",
    "variance.csv",
    "measures.csv",
    "given.csv",
    "records.csv",
    "fragilities.svg",
];
/// The page, which is there only where all other files are complete, and the files that follow from options
/// of a report.
pub(super) const OPTIONAL: &[&str] = FILES.as_slice().split_at(10).1;
/// Largest description that is read; it has room for millions of walls.
const MAX_STUDY_BYTES: u64 = 4 << 30;
const RUNS: &str = "runs";
/// Most missing combinations that a message names.
const NAMED: usize = 3;

/// A folder that holds one study.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    manifest: Manifest,
    fingerprint: String,
    /// The folder of the runs, locked as long as this process works on it. The lock is shared with other
    /// processes, and exclusive to remove incomplete files. Where a folder cannot be locked, these stay.
    lock: Option<File>,
}

impl Folder {
    /// Opens or makes the folder of a study.
    ///
    /// # Errors
    /// [`FolderError`] if it holds another study, or cannot be read or written.
    pub fn of_study(path: &Path, loaded: &LoadedStudy) -> Result<Self, FolderError> {
        let contents = Contents::of(&loaded.study);
        Self::like(path, &Manifest::new(loaded.title.clone(), loaded.report.clone(), contents))
    }

    /// Opens or makes the folder that a study is merged into.
    ///
    /// # Errors
    /// As [`Self::of_study`].
    pub fn like(path: &Path, manifest: &Manifest) -> Result<Self, FolderError> {
        let earlier = path.join(STUDY).exists().then(|| read(path)).transpose()?;
        if let Some(earlier) = &earlier {
            expect(path, &earlier.contents, &manifest.contents)?;
        }
        if let Some(file) = foreign(path).filter(|_| earlier.is_none()) {
            return Err(FolderError::Foreign { file });
        }
        file::make_folder(&path.join(RUNS))?;
        if earlier.is_some_and(|earlier| earlier != *manifest) {
            // its tables are those of another report
            file::remove(&path.join(PAGE))?;
        }
        let mut draft = Draft::new(&path.join(STUDY), b"")?;
        draft.write(|file| Ok(serde_json::to_writer_pretty(&mut *file, manifest)?))?;
        draft.write(|file| file.write_all(b"\n"))?;
        draft.commit(true)?;
        Ok(Self::locked(path, manifest.clone()))
    }

    /// Opens a folder that holds a study.
    ///
    /// # Errors
    /// [`FolderError`] if there is none, or its description is damaged.
    pub fn open(path: &Path) -> Result<Self, FolderError> {
        Ok(Self::locked(path, read(path)?))
    }

    fn locked(path: &Path, manifest: Manifest) -> Self {
        let fingerprint = manifest.contents.fingerprint();
        let lock = File::open(path.join(RUNS)).ok().filter(|lock| lock.lock_shared().is_ok());
        Self { path: path.to_owned(), manifest, fingerprint, lock }
    }

    /// Checks that the folder holds the study of these contents.
    ///
    /// # Errors
    /// [`FolderError::OtherStudy`].
    pub fn expect(&self, contents: &Contents) -> Result<(), FolderError> {
        expect(&self.path, self.contents(), contents)
    }

    /// Returns the path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the description of the study.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Returns what the runs depend on.
    pub fn contents(&self) -> &Contents {
        &self.manifest.contents
    }

    fn file(&self, part: usize) -> PathBuf {
        // at most a thousand files in a folder, since large folders are slow
        self.path.join(RUNS).join(format!("{:04}", part / 1000)).join(format!("{part:07}.parquet"))
    }

    /// Reads the curves of a part, if its file is there and not damaged.
    pub fn part(&self, part: usize) -> Option<Vec<Curve>> {
        let bytes = std::fs::read(self.file(part)).ok()?;
        part::decode(self.contents(), &self.fingerprint, part, bytes)
    }

    /// Writes the curves of a part.
    ///
    /// # Errors
    /// [`FolderError`] if the file cannot be written.
    pub fn keep(&self, part: usize, curves: &[Curve]) -> Result<(), FolderError> {
        self.keep_bytes(part, &part::encode(self.contents(), &self.fingerprint, part, curves)?)
    }

    /// Writes a part that another process has encoded.
    ///
    /// # Errors
    /// [`FolderError`] if it is not that part of this study, or its file cannot be written.
    pub fn keep_encoded(&self, part: usize, bytes: &[u8]) -> Result<(), FolderError> {
        if part::decode(self.contents(), &self.fingerprint, part, bytes.to_vec()).is_none() {
            return Err(FolderError::Part { part });
        }
        self.keep_bytes(part, bytes)
    }

    fn keep_bytes(&self, part: usize, bytes: &[u8]) -> Result<(), FolderError> {
        let file = self.file(part);
        file::make_folder(file::folder(&file))?;
        // no need to wait for the disk: a part that a power failure damages is computed again
        Draft::new(&file, bytes)?.commit(false)?;
        Ok(())
    }

    /// Returns those of the parts given that are missing.
    pub fn missing(&self, parts: impl IntoIterator<Item = usize>) -> Vec<usize> {
        parts.into_iter().filter(|&part| self.part(part).is_none()).collect()
    }

    /// Lists the files of missing parts that exist, because they are damaged.
    pub fn damage(&self, missing: &[usize]) -> Option<String> {
        let files: Vec<_> =
            missing.iter().map(|&part| self.file(part)).filter(|file| file.exists()).collect();
        files.first().map(|first| {
            format!(
                "{} of {} parts are damaged or of another study and count as missing; the first is {}",
                files.len(),
                self.contents().parts(),
                first.display()
            )
        })
    }

    /// Makes the error that names what is missing, and what of it is damaged, here or in other folders.
    pub(crate) fn incomplete(&self, missing: &[usize], others: &[Self]) -> FolderError {
        let contents = self.contents();
        let name = |index: usize| {
            let case = contents.case(index);
            format!(
                "wall {:?} with {} under {:?}",
                contents.walls[case.wall].name,
                contents.models[case.model].name,
                contents.records[case.record].name
            )
        };
        let count = missing.iter().map(|&part| contents.part(part).len()).sum();
        let cases = missing.iter().flat_map(|&part| contents.part(part));
        let names: Vec<_> = cases.take(NAMED).map(name).collect();
        let more = if count > NAMED { " …" } else { "" };
        let damage = others.iter().chain([self]).filter_map(|folder| folder.damage(missing));
        // each after what is missing
        let damage = std::iter::once(String::new()).chain(damage).collect::<Vec<_>>();
        FolderError::Missing {
            missing: count,
            all: contents.count(),
            names: names.join(", ") + more,
            damage: damage.join("; "),
        }
    }

    /// Removes the incomplete files of killed processes, unless another process works on the folder.
    pub fn sweep(&self) {
        let Some(lock) = &self.lock else { return };
        if lock.try_lock().is_ok() {
            self.remove_incomplete();
        }
        // an attempt that fails may lose the shared lock too
        let _ = lock.lock_shared();
    }

    fn remove_incomplete(&self) {
        let entries = |path: &Path| std::fs::read_dir(path).into_iter().flatten().flatten();
        let folders = entries(&self.path.join(RUNS)).map(|entry| entry.path());
        for folder in folders.chain([self.path.clone()]) {
            for entry in entries(&folder) {
                let name = entry.file_name().to_string_lossy().into_owned();
                if name.starts_with('.') && name.strip_suffix(".part").is_some() {
                    // another process may have removed it
                    let _ = std::fs::remove_file(entry.path());
                }
            }
        }
    }
}

/// Finds a file of the user that a result would replace: where there are no runs, none is a result.
fn foreign(folder: &Path) -> Option<PathBuf> {
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_result = |file: &PathBuf| {
        let name = file.file_name().and_then(OsStr::to_str).unwrap_or_default();
        let is_input = file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
        FILES.contains(&name) || name.starts_with("reliability") && !is_input
    };
    files.filter(|_| !folder.join(RUNS).exists()).filter(is_result).min()
}

/// Reads the description of the study in a folder.
fn read(path: &Path) -> Result<Manifest, FolderError> {
    let path = path.join(STUDY);
    let bytes = ground_motion::read_file(&path, "the description of a study", MAX_STUDY_BYTES)
        .map_err(|source| FolderError::NoStudy { path: path.clone(), source })?;
    let manifest: Manifest = serde_json::from_slice(&bytes)
        .map_err(|error| FolderError::Description { path: path.clone(), line: error.line() })?;
    if manifest.checksum != manifest.fingerprint() {
        return Err(FolderError::Damaged { path });
    }
    Ok(manifest)
}

/// Checks that a folder with some contents has those of a study.
fn expect(path: &Path, found: &Contents, study: &Contents) -> Result<(), FolderError> {
    if found == study {
        return Ok(());
    }
    Err(FolderError::OtherStudy { path: path.to_owned(), difference: found.difference(study) })
}
