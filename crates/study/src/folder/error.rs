//! Errors of a study's folder.

use std::path::PathBuf;

use run::file::FileError;

use crate::ida::IdaError;

/// Why a study cannot be computed or kept in a folder, or its results not be written.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum FolderError {
    /// A file or folder cannot be written, made or removed.
    #[error(transparent)]
    File(#[from] FileError),
    /// A run failed.
    #[error(transparent)]
    Run(#[from] IdaError),
    /// There is no study.
    #[error("{}: cannot be read; expected a folder that `wall study ida` has made: {source}", path.display())]
    NoStudy { path: PathBuf, source: std::io::Error },
    /// The description of a study is not one.
    #[error(
        "{}, line {line}: not the description of a study by this version; remove the folder or give another",
        path.display()
    )]
    Description { path: PathBuf, line: usize },
    /// The description of a study is damaged.
    #[error(
        "{}: is damaged; remove it, and `wall study ida` writes it again and keeps the runs",
        path.display()
    )]
    Damaged { path: PathBuf },
    /// The folder holds results of another study.
    #[error(
        "{}: holds results of another study ({difference}); give another folder, or remove this one",
        path.display()
    )]
    OtherStudy { path: PathBuf, difference: String },
    /// A result would replace a file that is none of a study.
    #[error(
        "{}: is there and no result of a study, which would replace it; give another folder, or move it",
        file.display()
    )]
    Foreign { file: PathBuf },
    /// Folders that are to be merged hold different studies.
    #[error(
        "{}: holds another study than the first folder ({difference}); merge folders of one study only",
        path.display()
    )]
    OtherThanFirst { path: PathBuf, difference: String },
    /// Several folders, and none for what they hold together.
    #[error("merging several folders needs one for the result; name it (-o FOLDER; in Python into=)")]
    NoTarget,
    /// No folder.
    #[error("there is no folder to merge; name those of the shards")]
    NoFolder,
    /// The runs are not complete.
    #[error(
        "{missing} of {all} combinations are missing: {names}; run their shards again, or name the folders \
         that hold them too{damage}"
    )]
    Missing { missing: usize, all: usize, names: String, damage: String },
    /// A part is damaged or of another study.
    #[error("part {part}: is damaged or of another study")]
    Part { part: usize },
    /// A part cannot be made.
    #[error("part {part}: {source}")]
    Parquet { part: usize, source: Box<dyn std::error::Error + Send + Sync> },
}
