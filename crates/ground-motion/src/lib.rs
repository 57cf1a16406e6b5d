#![doc = include_str!("../README.md")]
//!
//! # Map
//!
//! | item | gives |
//! |---|---|
//! | [`read`], [`read_channels`], [`parse`] | a [`Record`] of a file, in any [`Format`] |
//! | [`is_companion`] | whether a file has the times of a record beside it |
//! | [`is_listed`] | whether a list of records has a file of a folder |
//! | [`read_file`] | the content of any regular file of a limited size |
//! | [`columns`] | columns of text, whatever separates them: tables of numbers and of words |
//! | [`SpectrumFile`] | a response spectrum of a file |
//! | [`Record::check`] | warnings: baseline, unit, missing start or tail, another peak than stated |
//! | [`is_vertical_channel`] | whether a channel such as `HNZ` is vertical |
//! | [`GroundMotion::warning`] | a warning: a peak that no record has, as of a PGA in another unit |
//! | [`GroundMotion`] | uniform step, m/s², linear between samples, zero outside; scaling and trimming |
//! | [`GroundMotion::peak_velocity`] … | PGV, PGD, Arias intensity, CAV; velocity and displacement |
//! | [`Spectrum`] | Sa at any period and damping, AvgSA, Housner's intensity |
//! | [`Storeys`] | the motion of floors above the ground, in closed form per mode |
//! | [`Pulse`], [`SyntheticMotion`] | Ricker pulses, sines; filtered noise from a seed |
//!
//! The format is found from a file's content. A file whose unit or step is not known, whose numbers are
//! damaged or which is cut short is refused; the message names file, line, what was expected, what was found
//! and what to do. A [`GroundMotion`] that exists is valid: a positive step, at least two samples, all
//! finite. Units are converted where a file is read and nowhere else.
//!
//! # Modules
//! Each module uses only modules above it in this table, or before it in its row:
//!
//! | module | holds |
//! |---|---|
//! | `error`, `unit`, `warning`, `motion` | what is refused and warned of; a motion |
//! | `file`, `format`, `quantity`, `acceleration` | files; formats; what a unit measures |
//! | `fields`, `options`, `times`, `vertical`, [`columns`] | numbers in texts; what the user states |
//! | `parsed`, `readers` | one channel as a reader returns it; a reader for each format |
//! | `companion`, `record`, `check` | record files, and how they are checked |
//! | `sequence`, `pulse`, `synthetic` | motions made of records, of formulas and of noise |
//! | [`spectrum`], `storeys`, `intensity`, `spectrum_file` | the effect of motions |

mod acceleration;
mod check;
pub mod columns;
mod companion;
mod error;
mod fields;
mod file;
mod format;
mod intensity;
mod motion;
mod options;
mod parsed;
mod pulse;
mod quantity;
mod readers;
mod record;
mod sequence;
pub mod spectrum;
mod spectrum_file;
mod storeys;
mod synthetic;
mod times;
mod unit;
mod vertical;
mod warning;

pub use acceleration::Acceleration;
pub use check::Check;
pub use companion::{is_companion, is_listed};
pub use error::GroundMotionError;
pub use file::{MAX_FILE_BYTES, escapes, file_name, read_file, shown_path, utf8_text};
pub use format::Format;
pub use motion::GroundMotion;
pub use options::RecordOptions;
pub use pulse::{Pulse, Shape};
pub use readers::CSV_HEADER;
pub use record::{Record, parse, parse_channels, read, read_channels};
pub use sequence::DEFAULT_PAUSE;
pub use spectrum::{Maxima, Spectrum};
pub use spectrum_file::SpectrumFile;
pub use storeys::{FloorMotion, Storey, Storeys};
pub use synthetic::SyntheticMotion;
pub use unit::{STANDARD_GRAVITY, Unit};
pub use vertical::is_vertical_channel;
pub use warning::Warning;
