//! From the files of a build to an FMU.
//!
//! ```
//! use fmu_export_build::pack::Package;
//!
//! let package = Package {
//!     description: "modelDescription/modelDescription.xml".into(),
//!     binaries: vec![("linux64".to_owned(), "target/release/libclock.so".into())],
//!     documentation: "modelDescription/documentation".into(),
//!     resources: None,
//! };
//! // there are no such files beside this example
//! assert!(package.archive().unwrap_err().to_string().contains("cannot be read"));
//! ```

use crate::archive::Archive;
use crate::{Description, DescriptionError};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// FMI 2.0's platforms and the ending of their libraries.
const PLATFORMS: [(&str, &str); 6] = [
    ("linux64", "so"),
    ("win64", "dll"),
    ("darwin64", "dylib"),
    ("linux32", "so"),
    ("win32", "dll"),
    ("darwin32", "dylib"),
];

/// Deeper folders than this are a mistake, or a link to a folder above.
const MAX_DEPTH: usize = 8;

/// What goes into an FMU.
#[derive(Clone, Debug, Default)]
pub struct Package {
    /// The model description; a `model.png` beside it goes in as well.
    pub description: PathBuf,
    /// Platform (such as `linux64`) and library.
    pub binaries: Vec<(String, PathBuf)>,
    /// Folder that becomes `documentation/`.
    pub documentation: PathBuf,
    /// Folder that becomes `resources/`.
    pub resources: Option<PathBuf>,
}

/// Why an FMU cannot be put together.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum PackError {
    /// The model description is not usable.
    #[error(transparent)]
    Description(#[from] DescriptionError),
    /// A file or folder cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read { path: PathBuf, source: io::Error },
    /// The folder has folders inside folders without end.
    #[error("{}: more than {MAX_DEPTH} folders deep", path.display())]
    TooDeep { path: PathBuf },
    /// A file's name is not valid Unicode, or not usable in an archive.
    #[error("{}: this name cannot be used inside an FMU", path.display())]
    BadName { path: PathBuf },
    /// The platform is not one of FMI 2.0.
    #[error(
        "the platform {platform:?} is not one of FMI 2.0's: linux64, win64, darwin64, linux32, win32, \
         darwin32"
    )]
    UnknownPlatform { platform: String },
    /// The documentation does not have the page importers open.
    #[error("{}: has no index.html, the page that importers open", path.display())]
    NoIndex { path: PathBuf },
}

impl Package {
    /// Reads everything and puts it together; the description gets its guid.
    ///
    /// # Errors
    /// A description that contradicts itself, files that cannot be read, an unknown platform, no
    /// `index.html`.
    pub fn archive(&self) -> Result<Archive, PackError> {
        let text = String::from_utf8(read(&self.description)?).map_err(|error| PackError::Read {
            path: self.description.clone(),
            source: io::Error::new(io::ErrorKind::InvalidData, error),
        })?;
        let description = Description::parse(&text).map_err(|fault| DescriptionError::Invalid {
            path: self.description.clone(),
            fault: Box::new(fault),
        })?;
        let mut archive = Archive::default();
        archive.insert("modelDescription.xml", description.text_with_guid(&description.guid()));
        let icon = self.description.with_file_name("model.png");
        if icon.exists() {
            archive.insert("model.png", read(&icon)?);
        }
        for (platform, library) in &self.binaries {
            let (_, ending) = PLATFORMS
                .iter()
                .find(|(name, _)| name == platform)
                .ok_or_else(|| PackError::UnknownPlatform { platform: platform.clone() })?;
            let name = description.model_identifier();
            archive.insert(format!("binaries/{platform}/{name}.{ending}"), read(library)?);
        }
        add_folder(&mut archive, "documentation", &self.documentation, MAX_DEPTH)?;
        if archive.get("documentation/index.html").is_none() {
            return Err(PackError::NoIndex { path: self.documentation.clone() });
        }
        if let Some(resources) = &self.resources {
            add_folder(&mut archive, "resources", resources, MAX_DEPTH)?;
        }
        Ok(archive)
    }
}

fn read(path: &Path) -> Result<Vec<u8>, PackError> {
    fs::read(path).map_err(|source| PackError::Read { path: path.to_path_buf(), source })
}

/// Adds the files of `folder` and of the folders inside, without hidden ones (`.gitignore`).
fn add_folder(archive: &mut Archive, name: &str, folder: &Path, depth: usize) -> Result<(), PackError> {
    let unreadable = |source| PackError::Read { path: folder.to_path_buf(), source };
    if depth == 0 {
        return Err(PackError::TooDeep { path: folder.to_path_buf() });
    }
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let bad_name = || PackError::BadName { path: path.clone() };
        let file = path.file_name().and_then(|file| file.to_str()).ok_or_else(bad_name)?;
        if file.starts_with('.') {
            continue;
        }
        if file.contains(['\\', ':']) {
            return Err(bad_name());
        }
        let inside = format!("{name}/{file}");
        if path.is_dir() {
            add_folder(archive, &inside, &path, depth - 1)?;
        } else {
            archive.insert(inside, read(&path)?);
        }
    }
    Ok(())
}
