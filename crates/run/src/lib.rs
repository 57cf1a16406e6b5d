#![doc = include_str!("../README.md")]
//!
//! # Modules
//! Nothing here prints. Only [`mod@file`], [`walls`], [`selection`] and [`records`] open files.
//!
//! | module | holds |
//! |---|---|
//! | [`parallel`] | work shared by threads, which another thread can watch and stop |
//! | [`mod@file`] | files, written completely or not at all |
//! | [`bisection`] | the first value at which a condition holds |
//! | [`sample`] | medians, fractiles, random numbers that are the same on every machine |
//! | [`free_motion`] | free motion of a wall, with impacts or with viscous damping |
//! | [`model`] | damping models: names, meanings and colours; walls that have them |
//! | [`polarity`] | motions with both signs |
//! | [`shaking`] | runs of one wall through one record, multiplied by factors |
//! | [`walls`] | walls by their names, from study files, scenes and tables |
//! | [`mod@wall_parameters`] | the parameters that a wall of a study may state |
//! | [`selection`] | lists of records with factors and weights, as selectors write them |
//! | [`records`] | records by their names, from files, folders and patterns |
//! | [`capacity`] | the static capacity curve: table, JSON, CSV, plot |
//! | [`drawing`] | the wall to scale: its section and, where it needs one, its front |
//! | [`demands`] | demands as lines of text |
//! | [`rotations`] | free rocking of a rigid wall in small and in full rotations |
//! | [`counterpart`] | a run beside the same run in small or in full rotations |
//! | [`mod@figure`] | histories, the force path on its backbone |
//! | [`record_facts`] | what record files hold, as tables, JSON and a picture with response spectra |
//! | [`motions`] | one wall under several motions: a row for each |
//! | [`page`] | the page of a run |

pub mod bisection;
pub mod capacity;
pub mod counterpart;
pub mod demands;
pub mod drawing;
pub mod figure;
pub mod file;
pub mod free_motion;
pub mod model;
pub mod motions;
mod named_wall;
pub mod page;
pub mod parallel;
pub mod polarity;
pub mod record_facts;
mod record_warning;
pub mod records;
pub mod rotations;
pub mod sample;
pub mod selection;
pub mod shaking;
mod wall_columns;
pub mod wall_parameters;
mod wall_table;
pub mod wall_text;
pub mod walls;
