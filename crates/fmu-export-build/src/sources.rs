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
const DESCRIPTION: &str = "resources/fmu-export/modelDescription.xml";
const ADDITIONS: &str = "resources/fmu-export/fmi3.xml";

/// The FMI 2.0 description of an FMI 3.0 unit, and what that leaves open.
#[derive(Clone, Debug)]
pub struct Sources {
    /// The FMI 2.0 description, with its guid.
    pub description: Description,
    additions: Additions,
    texts: [String; 2],
}

impl Sources {
    /// Reads the texts of a description and of its additions, and checks these against it.
    ///
    /// # Errors
    /// As [`Description::parse`], [`Additions::parse`] and [`Additions::check`].
    pub fn parse(description: String, additions: String) -> Result<Self, Fault> {
        let texts = [description, additions];
        let (description, additions) = (Description::parse(&texts[0])?, Additions::parse(&texts[1])?);
        additions.check(&description)?;
        Ok(Self { description, additions, texts })
    }

    /// Reads what a unit was described from. None if it is not an FMI 3.0 unit that keeps it.
    pub fn of(archive: &Archive) -> Option<Result<Self, Fault>> {
        let text = |name| Some(String::from_utf8_lossy(archive.get(name)?).into_owned());
        Some(Self::parse(text(DESCRIPTION)?, text(ADDITIONS)?))
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
    pub fn describe(&self, description: &Description, archive: &mut Archive) -> Result<(), Fault> {
        const TERMINALS: &str = "terminalsAndIcons/terminalsAndIcons.xml";
        let (xml, terminals) = description.to_fmi3(&self.additions)?;
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
