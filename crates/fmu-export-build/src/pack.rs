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
//!     fmi3: false,
//! };
//! // there are no such files beside this example
//! assert!(package.archive().unwrap_err().to_string().contains("cannot be read"));
//! ```

use crate::archive::Archive;
use crate::library;
use crate::sources::Sources;
use crate::{Description, DescriptionError};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// FMI 2.0's platforms, the ending of their libraries, and FMI 3.0's folders for these.
const PLATFORMS: [(&str, &str, &[&str]); 8] = [
    ("linux64", "so", &["x86_64-linux"]),
    ("win64", "dll", &["x86_64-windows"]),
    ("darwin64", "dylib", &["x86_64-darwin", "aarch64-darwin"]),
    ("linux32", "so", &["x86-linux"]),
    ("win32", "dll", &["x86-windows"]),
    ("darwin32", "dylib", &["x86-darwin"]),
    ("aarch64-linux", "so", &["aarch64-linux"]),
    (COMPONENT, "wasm", &[COMPONENT]),
];

/// The platform of a WebAssembly component.
const COMPONENT: &str = "wasm32-wasip2";

/// The manifest that goes with a component. The draft of fmi-ls-wasm (section "Layered Standard Manifest")
/// names the file `manifest.xml`, the schema of FMI 3.0.2 `fmi-ls-manifest.xml`: it goes in under both names.
const MANIFEST: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmi-ls:fmiLayeredStandardManifest xmlns:fmi-ls="http://fmi-standard.org/fmi-ls-manifest"
    fmi-ls:fmi-ls-name="org.modelica.fmi-ls-wasm" fmi-ls:fmi-ls-version="0.1.0"
    fmi-ls:fmi-ls-description="FMI Layered Standard for WebAssembly"/>
"#;
const MANIFESTS: [&str; 2] =
    ["extra/org.modelica.fmi-ls-wasm/fmi-ls-manifest.xml", "extra/org.modelica.fmi-ls-wasm/manifest.xml"];

/// Deeper folders than this are a mistake, or a link to a folder above.
const MAX_DEPTH: usize = 8;

/// What goes into an FMU.
#[derive(Clone, Debug, Default)]
pub struct Package {
    /// The model description; a `model.png` and a folder `extra` beside it go in as well.
    pub description: PathBuf,
    /// Platform by its name in FMI 2.0 (such as `linux64`), and library, which was built from this
    /// description. FMI 3.0 also has `aarch64-linux`, and `wasm32-wasip2` for a WebAssembly component.
    pub binaries: Vec<(String, PathBuf)>,
    /// Folder that becomes `documentation/`.
    pub documentation: PathBuf,
    /// Folder that becomes `resources/`.
    pub resources: Option<PathBuf>,
    /// An FMI 3.0 unit; a `fmi3.xml` beside the description says what that leaves open.
    pub fmi3: bool,
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
    /// The platform is not one of FMI.
    #[error(
        "the platform {platform:?} is not one of FMI 2.0's: linux64, win64, darwin64, linux32, win32, \
         darwin32; aarch64-linux and wasm32-wasip2 are for FMI 3.0"
    )]
    UnknownPlatform { platform: String },
    /// The library is some other file.
    #[error(
        "{}: is neither a shared library of Linux, Windows or macOS nor a WebAssembly component",
        path.display()
    )]
    NoLibrary { path: PathBuf },
    /// The library is for other machines.
    #[error("{}: is for {found}, and not for the platform {platform}", path.display())]
    OtherPlatform { path: PathBuf, found: String, platform: String },
    /// The library is of another version of FMI.
    #[error(
        "{}: does not export the functions of FMI {version}.0; fmu_export::export_fmu! says which model gets \
         which",
        path.display()
    )]
    OtherVersion { path: PathBuf, version: u8 },
    /// The library was built from another description.
    #[error(
        "{}: does not hold the guid {guid} of this description, so it was built from another one; build it \
         again",
        path.display()
    )]
    OtherModel { path: PathBuf, guid: String },
    /// The documentation does not have the page importers open.
    #[error("{}: has no index.html, the page that importers open", path.display())]
    NoIndex { path: PathBuf },
    /// The documentation asks for a condition that the description does not have.
    #[error("documentation/index.html: {{where {name}}}, but the description has no <Where> of `{name}`")]
    NoCondition { name: String },
}

impl Package {
    /// Reads everything and puts it together; the description gets its guid, and the page the conditions of
    /// variables where it says `{where NAME}`.
    ///
    /// # Errors
    /// A description that contradicts itself, files that cannot be read, an unknown platform, a library of
    /// another platform, version of FMI or model, no `index.html`, or one that asks for a condition that is
    /// not there.
    pub fn archive(&self) -> Result<Archive, PackError> {
        let text = read_text(&self.description)?;
        let invalid = |path: &Path, fault| DescriptionError::Invalid { path: path.to_path_buf(), fault };
        let description = Description::parse(&text).map_err(|fault| invalid(&self.description, fault))?;
        let mut archive = Archive::default();
        let icon = self.description.with_file_name("model.png");
        if icon.exists() {
            let name = if self.fmi3 { "terminalsAndIcons/icon.png" } else { "model.png" };
            archive.insert(name, read(&icon)?);
        }
        let guid = description.guid();
        let text = description.text_with_guid(&guid);
        if self.fmi3 {
            let path = self.description.with_file_name("fmi3.xml");
            let additions = if path.exists() { read_text(&path)? } else { "<fmi3/>".to_owned() };
            let sources = Sources::parse(text, additions).map_err(|fault| invalid(&path, fault))?;
            sources
                .describe(&sources.description, &mut archive)
                .map_err(|fault| invalid(&self.description, fault))?;
            sources.keep(&mut archive);
        } else {
            archive.insert("modelDescription.xml", text);
        }
        for (platform, library) in &self.binaries {
            let (content, machines) = self.library(library, &guid)?;
            let (folders, ending) = self.folders(platform, library, &machines)?;
            for folder in folders {
                let name = description.model_identifier();
                archive.insert(format!("binaries/{folder}/{name}.{ending}"), content.clone());
            }
            if platform == COMPONENT {
                for name in MANIFESTS {
                    archive.insert(name, MANIFEST);
                }
            }
        }
        add_folder(&mut archive, "documentation", &self.documentation, MAX_DEPTH)?;
        let page =
            archive.get(PAGE).ok_or_else(|| PackError::NoIndex { path: self.documentation.clone() })?;
        let page = with_conditions(&String::from_utf8_lossy(page), &description)?;
        archive.insert(PAGE, page);
        if let Some(resources) = &self.resources {
            add_folder(&mut archive, "resources", resources, MAX_DEPTH)?;
        }
        let extra = self.description.with_file_name("extra");
        if extra.exists() {
            add_folder(&mut archive, "extra", &extra, MAX_DEPTH)?;
        }
        Ok(archive)
    }

    /// Reads a library, which must be of this version of FMI and of the model with this guid. Returns it with
    /// the folders of FMI 3.0 that it belongs into.
    fn library(&self, path: &Path, guid: &str) -> Result<(Vec<u8>, Vec<&'static str>), PackError> {
        let (content, path) = (read(path)?, path.to_path_buf());
        let Some(machines) = library::platforms(&content) else { return Err(PackError::NoLibrary { path }) };
        if !library::is_of_version(&content, self.fmi3) {
            return Err(PackError::OtherVersion { path, version: if self.fmi3 { 3 } else { 2 } });
        }
        if !library::is_of_model(&content, guid) {
            return Err(PackError::OtherModel { path, guid: guid.to_owned() });
        }
        Ok((content, machines))
    }

    /// The folders for `platform` of the library at `path`, which is for these machines, and its ending.
    fn folders(
        &self,
        platform: &str,
        path: &Path,
        machines: &[&'static str],
    ) -> Result<(Vec<&'static str>, &'static str), PackError> {
        let found = PLATFORMS
            .iter()
            .find(|(known, _, of_3)| *known == platform && (self.fmi3 || !of_3.contains(&platform)));
        let unknown = || PackError::UnknownPlatform { platform: platform.to_owned() };
        let &(of_2, ending, of_3) = found.ok_or_else(unknown)?;
        let folders: Vec<_> = of_3.iter().copied().filter(|folder| machines.contains(folder)).collect();
        if folders.is_empty() {
            let (path, platform) = (path.to_path_buf(), platform.to_owned());
            return Err(PackError::OtherPlatform { path, found: machines.join(" and "), platform });
        }
        Ok((if self.fmi3 { folders } else { vec![of_2] }, ending))
    }
}

/// The page that importers open.
const PAGE: &str = "documentation/index.html";

/// Writes the condition of a variable where the page says `{where NAME}`.
fn with_conditions(page: &str, description: &Description) -> Result<String, PackError> {
    let mut parts = page.split("{where ");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once('}').unwrap_or((part, ""));
        let condition =
            description.condition(name).ok_or_else(|| PackError::NoCondition { name: name.to_owned() })?;
        text.push_str("; where ");
        text.push_str(&condition);
        text.push_str(rest);
    }
    Ok(text)
}

fn read_text(path: &Path) -> Result<String, PackError> {
    String::from_utf8(read(path)?).map_err(|error| PackError::Read {
        path: path.to_path_buf(),
        source: io::Error::new(io::ErrorKind::InvalidData, error),
    })
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
