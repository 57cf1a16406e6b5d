//! Pages: HTML from templates, and animated pictures.

mod animation;
pub(crate) mod building;
pub(crate) mod check_report;
mod moving;
pub(crate) mod spectrum;
pub(crate) mod wall;
