//! What the FMI 2.0 schema cannot say about a description.

use crate::description::{Description, Kind};
use crate::element::Element;
use crate::error::Fault;

/// Every check, in the order of the document.
pub(crate) fn all(_description: &Description) -> Result<(), Fault> {
    Ok(())
}

pub(crate) fn finite(_typed: &Element, _kind: &Kind) -> Result<(), Fault> {
    Ok(())
}
