//! The hazard of a site and its spectra: NTC 2018, 3.2, and Circolare 7/2019, C7.2.3.

pub(crate) mod demand;
pub(crate) mod floor;
pub(crate) mod grid;
pub(crate) mod ground;
