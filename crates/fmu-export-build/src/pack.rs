//! From the files of a build to an FMU.
//!
//! ```
//! use fmu_export_build::pack::Package;
//!
//! let package = Package {
//!     description: "modelDescription/modelDescription.xml".into(),
//!     libraries: vec!["target/release/libclock.so".into()],
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
use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};

/// FMI 3.0's folders for libraries, FMI 2.0's, if there is one, and the ending of their names.
const PLATFORMS: [(&str, Option<&str>, &str); 9] = [
    ("x86_64-linux", Some("linux64"), "so"),
    ("x86_64-windows", Some("win64"), "dll"),
    ("x86_64-darwin", Some("darwin64"), "dylib"),
    ("aarch64-darwin", Some("darwin64"), "dylib"),
    ("x86-linux", Some("linux32"), "so"),
    ("x86-windows", Some("win32"), "dll"),
    ("x86-darwin", Some("darwin32"), "dylib"),
    ("aarch64-linux", None, "so"),
    (COMPONENT, None, "wasm"),
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
    /// The model description; a `model.png` and a folder `extra` beside it go in as well. What is in `extra`
    /// has names such as `org.example.notes`.
    pub description: PathBuf,
    /// The libraries, which were built from this description: each goes into the folders of the machines that
    /// it is for. FMI 3.0 also takes a WebAssembly component.
    pub libraries: Vec<PathBuf>,
    /// Folder that becomes `documentation/`; a folder `licenses` in it has an entry, such as `license.txt`.
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
    /// A file or folder cannot be read, or not be used.
    #[error("{}: {problem}", path.display())]
    File { path: PathBuf, problem: String },
}

impl PackError {
    fn file(path: &Path, problem: impl Into<String>) -> Self {
        Self::File { path: path.to_path_buf(), problem: problem.into() }
    }
}

impl Package {
    /// Reads everything and puts it together; the description gets its guid, and the page the conditions of
    /// variables where it says `{where NAME}`.
    ///
    /// # Errors
    /// A description that contradicts itself, files that cannot be read, a library for a machine that FMI has
    /// no folder for, of another version of FMI or model, no `index.html`, or one that asks for a condition
    /// that is not there; licences without an entry, and names in `extra` that FMI does not allow.
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
        for path in &self.libraries {
            self.add_library(&mut archive, path, &description, &guid)?;
        }
        add_folder(&mut archive, "documentation", &self.documentation, MAX_DEPTH)?;
        let no_page =
            || PackError::file(&self.documentation, "has no index.html, the page that importers open");
        let page = archive.get(PAGE).ok_or_else(no_page)?;
        let page = with_conditions(&String::from_utf8_lossy(page), &description)?;
        archive.insert(PAGE, page);
        if let Some(resources) = &self.resources {
            add_folder(&mut archive, "resources", resources, MAX_DEPTH)?;
        }
        let extra = self.description.with_file_name("extra");
        if extra.exists() {
            add_folder(&mut archive, "extra", &extra, MAX_DEPTH)?;
        }
        self.check_names(&archive)?;
        Ok(archive)
    }

    /// Checks the names that FMI 3.0 asks for in `documentation/licenses` and `extra`.
    fn check_names(&self, archive: &Archive) -> Result<(), PackError> {
        let inside = |folder| archive.names().filter_map(move |name| name.strip_prefix(folder));
        let entry = |name| matches!(name, "license.spdx" | "license.txt" | "license.html");
        let licenses = || inside("documentation/licenses/");
        if licenses().next().is_some() && !licenses().any(entry) {
            let problem = "has no license.spdx, license.txt or license.html, where FMI 3.0 begins to read";
            return Err(PackError::file(&self.documentation.join("licenses"), problem));
        }
        let own = |name: &&str| !name.split('/').next().is_some_and(|first| first.contains('.'));
        match inside("extra/").find(own) {
            None => Ok(()),
            Some(name) => {
                let path = self.description.with_file_name("extra").join(name);
                Err(PackError::file(&path, "name what is in extra by a domain, as in org.example.notes"))
            }
        }
    }

    /// Adds a library, which must be of this version of FMI and of the model with this guid.
    fn add_library(
        &self,
        archive: &mut Archive,
        path: &Path,
        description: &Description,
        guid: &str,
    ) -> Result<(), PackError> {
        let content = read(path)?;
        let refused = |problem: String| PackError::file(path, problem);
        let machines = library::platforms(&content).ok_or_else(|| {
            refused(
                "is neither a shared library of Linux, Windows or macOS nor a WebAssembly component".into(),
            )
        })?;
        let version = if self.fmi3 { 3 } else { 2 };
        let mut names = Vec::new();
        for machine in machines {
            let platform = PLATFORMS.iter().find(|(of_3, ..)| *of_3 == machine);
            let folder = platform.and_then(|(of_3, of_2, _)| if self.fmi3 { Some(*of_3) } else { *of_2 });
            let (Some(folder), Some((.., ending))) = (folder, platform) else {
                return Err(refused(format!("is for {machine}, which FMI {version}.0 has no folder for")));
            };
            names.push(format!("binaries/{folder}/{}.{ending}", description.model_identifier()));
        }
        if !library::is_of_version(&content, self.fmi3) {
            return Err(refused(format!(
                "does not export the functions of FMI {version}.0; fmu_export::export_fmu! says which model \
                 gets which"
            )));
        }
        if !library::is_of_model(&content, guid) {
            return Err(refused(format!(
                "does not hold the guid {guid} of this description, so it was built from another one; build \
                 it again"
            )));
        }
        if let Some(name) = names.iter().find(|name| archive.get(name).is_some()) {
            return Err(refused(format!("another library is {name} already")));
        }
        for name in names {
            if name.contains(COMPONENT) {
                for manifest in MANIFESTS {
                    archive.insert(manifest, MANIFEST);
                }
            }
            archive.insert(name, content.clone());
        }
        Ok(())
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
        let condition = description.condition(name).ok_or_else(|| {
            let problem = format!("{{where {name}}}, but the description has no <Where> of `{name}`");
            PackError::file(Path::new(PAGE), problem)
        })?;
        text.push_str("; where ");
        text.push_str(&condition);
        text.push_str(rest);
    }
    Ok(text)
}

fn read_text(path: &Path) -> Result<String, PackError> {
    String::from_utf8(read(path)?).map_err(|error| unreadable(path, error))
}

fn read(path: &Path) -> Result<Vec<u8>, PackError> {
    fs::read(path).map_err(|error| unreadable(path, error))
}

fn unreadable(path: &Path, error: impl Display) -> PackError {
    PackError::file(path, format!("cannot be read: {error}"))
}

/// Adds the files of `folder` and of the folders inside, without hidden ones (`.gitignore`).
fn add_folder(archive: &mut Archive, name: &str, folder: &Path, depth: usize) -> Result<(), PackError> {
    if depth == 0 {
        return Err(PackError::file(folder, format!("more than {MAX_DEPTH} folders deep")));
    }
    for entry in fs::read_dir(folder).map_err(|error| unreadable(folder, error))? {
        let path = entry.map_err(|error| unreadable(folder, error))?.path();
        let file = path.file_name().and_then(|file| file.to_str()).filter(|file| !file.contains(['\\', ':']));
        let file = file.ok_or_else(|| PackError::file(&path, "this name cannot be used inside an FMU"))?;
        if file.starts_with('.') {
            continue;
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
