//! The general FMU of a model.

use std::path::Path;

use fmu_export_build::archive::Archive;
use fmu_export_build::sources::Sources;
use fmu_export_build::{Description, ReductionError};
use rocking_wall::scene;

use super::error::SceneFmuError;

/// Reference results, after the layered standard fmi-ls-ref.
const REFERENCES: &str = "extra/org.fmi-standard.fmi-ls-ref";

/// The general FMU of a model.
#[derive(Clone, Debug)]
pub struct General {
    /// Its files.
    pub archive: Archive,
    /// Its description; of an FMI 3.0 unit, the FMI 2.0 description that it was made from.
    pub description: Description,
    /// What an FMI 3.0 unit was made from; none of FMI 2.0.
    sources: Option<Sources>,
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
        let wrong = |source| SceneFmuError::Description { path: path(), source: Box::new(source) };
        let sources = Sources::of(&archive).transpose().map_err(wrong)?;
        let description = match &sources {
            Some(sources) => sources.description.clone(),
            None if xml.contains("fmiVersion=\"3.0\"") => {
                return Err(SceneFmuError::OfScene { path: path() });
            }
            None => Description::parse(xml).map_err(wrong)?,
        };
        let guid = description.declared_guid();
        let Some(guid) = guid.strip_prefix('{').and_then(|guid| guid.strip_suffix('}')) else {
            return Err(SceneFmuError::Guid { path: path(), guid: guid.to_owned() });
        };
        if guid.contains('-') {
            return Err(SceneFmuError::OfScene { path: path() });
        }
        let guid = guid.to_owned();
        Ok(Self { archive, description, sources, guid })
    }

    /// Describes the archive as `reduced`, which was made from its description, in its version of FMI. Takes
    /// out the reference results, which are those of the general FMU.
    ///
    /// # Errors
    /// A variable that FMI 3.0 has another use for.
    pub fn describe(&mut self, reduced: &Description) -> Result<(), SceneFmuError> {
        self.archive.remove_folder(REFERENCES);
        match &self.sources {
            None => self.archive.insert("modelDescription.xml", reduced.to_xml()),
            Some(sources) => sources
                .describe(reduced, reduced.declared_guid(), &mut self.archive)
                .map_err(ReductionError::from)?,
        }
        Ok(())
    }

    /// Returns the guid of the FMU that contains a payload.
    pub fn guid_with(&self, payload: &str) -> String {
        format!("{{{}-{}}}", self.guid, scene::fingerprint(payload.as_bytes()))
    }
}
