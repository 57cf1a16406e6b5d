//! The general FMU of a model.

use std::path::Path;

use fmu_export_build::Description;
use fmu_export_build::archive::Archive;
use rocking_wall::scene;

use super::error::SceneFmuError;

/// The general FMU of a model.
#[derive(Clone, Debug)]
pub struct General {
    /// Its files.
    pub archive: Archive,
    /// Its description.
    pub description: Description,
    /// Without braces.
    guid: String,
}

impl General {
    /// Opens the general FMU at `path`.
    ///
    /// # Errors
    /// [`SceneFmuError`] if the file is missing, damaged, or itself the FMU of a scene.
    pub fn open(path: &Path) -> Result<Self, SceneFmuError> {
        let archive = Archive::open(path)?;
        let path = || path.to_path_buf();
        let xml = archive.get("modelDescription.xml").and_then(|xml| std::str::from_utf8(xml).ok());
        let xml = xml.ok_or_else(|| SceneFmuError::NoDescription { path: path() })?;
        let description = Description::parse(xml)
            .map_err(|source| SceneFmuError::Description { path: path(), source: Box::new(source) })?;
        let guid = description.declared_guid();
        let Some(guid) = guid.strip_prefix('{').and_then(|guid| guid.strip_suffix('}')) else {
            return Err(SceneFmuError::Guid { path: path(), guid: guid.to_owned() });
        };
        if guid.contains('-') {
            return Err(SceneFmuError::OfScene { path: path() });
        }
        let guid = guid.to_owned();
        Ok(Self { archive, description, guid })
    }

    /// Returns the guid of the FMU that contains a payload.
    pub fn guid_with(&self, payload: &str) -> String {
        format!("{{{}-{}}}", self.guid, scene::fingerprint(payload.as_bytes()))
    }
}
