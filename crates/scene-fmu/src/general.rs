//! The general FMU of a model.

use std::path::Path;

use fmu_export_build::archive::Archive;
use fmu_export_build::sources::Sources;
use fmu_export_build::{Description, Reduction, ReductionError};

use super::error::SceneFmuError;
use super::page;

/// The page that importers open.
const PAGE: &str = "documentation/index.html";
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

    /// Makes a unit of it: with the file `payload` in `resources`, by the name given, and a guid that states
    /// its fingerprint; with the variables and names of `reduction`, in the same version of FMI, and a page
    /// of documentation on these; without the reference results, which are those of the general FMU. Returns
    /// its files and its description.
    ///
    /// # Errors
    /// As [`Description::reduced`]; and a variable that FMI 3.0 has another use for.
    pub fn unit(
        self,
        name: &str,
        payload: Vec<u8>,
        reduction: &Reduction<'_>,
    ) -> Result<(Archive, Description), SceneFmuError> {
        let Self { mut archive, description, sources, guid } = self;
        let guid = format!("{{{guid}-{}}}", scene::fingerprint(&payload));
        let reduced = description.reduced(reduction, &guid)?;
        archive.remove_folder(REFERENCES);
        if let Some(page) = archive.remove(PAGE) {
            let has = |of: &Description, name: &str| of.variable_names().any(|variable| variable == name);
            let page = String::from_utf8_lossy(&page);
            let page = page::without(&page, |name| has(&description, name) && !has(&reduced, name));
            archive.insert(PAGE, page);
        }
        match &sources {
            None => archive.insert("modelDescription.xml", reduced.to_xml()),
            Some(sources) => sources.describe(&reduced, &mut archive).map_err(ReductionError::from)?,
        }
        archive.insert(format!("resources/{name}"), payload);
        Ok((archive, reduced))
    }
}
