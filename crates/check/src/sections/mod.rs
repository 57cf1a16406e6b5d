//! Parts of a report: where it comes from, the wall, its drawing.

pub(crate) mod drawing;
pub(crate) mod inputs;
pub(crate) mod origin;
