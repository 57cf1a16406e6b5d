//! Pages: HTML from templates, and animated pictures.

mod animation;
pub(crate) mod building;
pub(crate) mod check_report;
pub(crate) mod linearisation;
mod moving;
pub(crate) mod spectrum;
pub(crate) mod stability;
pub(crate) mod wall;
pub(crate) mod work_precision;
