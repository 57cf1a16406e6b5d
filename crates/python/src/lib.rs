//! The part of the Python package `rocking_wall` that is in Rust.
//!
//! The module `_native` passes plain values to the libraries and back: numbers, texts, arrays and
//! dictionaries. The classes that people use stand in `python/rocking_wall`, where their arguments, types and
//! documentation are.
//!
//! | module | holds |
//! |---|---|
//! | `errors` | errors of the libraries as exceptions |
//! | `arrays` | samples from Python, arrays to Python |
//! | `tables` | tables for Python |
//! | `watch` | the number of threads, work that Ctrl-C stops |
//! | `motions` | records, pulses, response spectra |
//! | `variables` | the schemas of scenes and studies, what follows from parameters |
//! | `responses` | results of a run |
//! | `walls` | the class `Wall` |
//! | `many` | runs of many walls through many records |
//! | `jobs` | checks by codes, rocking spectra, ties of any stiffness, damping that matches restitution |
//! | `buildings` | the class `Building` |
//! | `studies` | the class `Study` |
//! | `study_walls` | the walls of a study |
//! | `folders` | the class `Folder` |

#![allow(clippy::needless_pass_by_value, reason = "PyO3 hands over what it has made of the arguments")]
#![allow(clippy::too_many_arguments, reason = "they are keywords in Python")]

mod arrays;
mod buildings;
mod errors;
mod folders;
mod jobs;
mod many;
mod motions;
mod responses;
mod studies;
mod study_walls;
mod tables;
mod variables;
mod walls;
mod watch;

/// The part of `rocking_wall` that is in Rust.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::{
        arrays::plain,
        buildings::Building,
        folders::Folder,
        jobs::{
            calibrate_wall, check_report, check_wall, record_pulses, spectrum_over_pulses,
            spectrum_over_walls, tie_of_wall, verify_formulas,
        },
        many::simulate_many,
        motions::{
            average_sa, displacement, housner, in_si, intensities, picture, pulse, read_channels, scaled,
            scaled_to, sequence, spectrum, synthetic, trimmed, velocity, warnings_of,
        },
        responses::picture_of_response,
        studies::Study,
        variables::{calculated, schemas},
        walls::Wall,
    };
    #[pymodule_export]
    const VERSION: &str = env!("PACKAGE_VERSION");
}
