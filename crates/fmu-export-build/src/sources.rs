//! What an FMI 3.0 unit was described from. It stays in the unit, so that one with fewer variables can be
//! made of it.
//!
//! ```
//! use fmu_export_build::archive::Archive;
//! use fmu_export_build::sources::Sources;
//!
//! // an FMI 2.0 unit has none
//! assert!(Sources::of(&Archive::default()).is_none());
//! ```

use crate::archive::Archive;
use crate::{Additions, Description, Fault};

/// Where a unit keeps them.
const DESCRIPTION: &str = "extra/fmu-export/modelDescription.xml";
const ADDITIONS: &str = "extra/fmu-export/fmi3.xml";

/// The FMI 2.0 description of an FMI 3.0 unit, and what that leaves open.
#[derive(Clone, Debug)]
pub struct Sources {
    /// The FMI 2.0 description, with its guid.
    pub description: Description,
    additions: Additions,
    texts: [String; 2],
}

impl Sources {
    /// Reads the texts of a description and of its additions.
    ///
    /// # Errors
    /// As [`Description::parse`] and [`Additions::parse`].
    pub fn parse(description: String, additions: String) -> Result<Self, Fault> {
        Ok(Self {
            description: Description::parse(&description)?,
            additions: Additions::parse(&additions)?,
            texts: [description, additions],
        })
    }

    /// Reads what a unit was described from. None if it is not an FMI 3.0 unit that keeps it.
    pub fn of(archive: &Archive) -> Option<Result<Self, Fault>> {
        let text = |name| Some(String::from_utf8_lossy(archive.get(name)?).into_owned());
        Some(Self::parse(text(DESCRIPTION)?, text(ADDITIONS)?))
    }

    /// Checks the additions against the description.
    ///
    /// # Errors
    /// As [`Additions::check`].
    pub fn check(&self) -> Result<(), Fault> {
        self.additions.check(&self.description)
    }

    /// Puts these sources into `archive`.
    pub fn keep(&self, archive: &mut Archive) {
        for (name, text) in [DESCRIPTION, ADDITIONS].into_iter().zip(&self.texts) {
            archive.insert(name, text.as_str());
        }
    }

    /// Makes `archive` an FMI 3.0 unit with the variables of `description`, which has them from these
    /// sources. The archive keeps no sources.
    ///
    /// # Errors
    /// As [`Description::to_fmi3`].
    pub fn describe(
        &self,
        description: &Description,
        token: &str,
        archive: &mut Archive,
    ) -> Result<(), Fault> {
        const TERMINALS: &str = "terminalsAndIcons/terminalsAndIcons.xml";
        let (xml, terminals) = description.to_fmi3(&self.additions, token)?;
        for name in [DESCRIPTION, ADDITIONS, TERMINALS] {
            archive.remove(name);
        }
        archive.insert("modelDescription.xml", xml);
        if let Some(terminals) = terminals {
            archive.insert(TERMINALS, terminals);
        }
        Ok(())
    }
}
