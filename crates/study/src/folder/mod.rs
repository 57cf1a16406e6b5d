//! A study in a folder: runs in parts (Parquet), and the tables and the page that are made of them.
//!
//! ```text
//! study ─► Folder ─► parts, in any order, by any process ─► finish ─► tables · page
//! ```
//!
//! Each module uses only modules above it in this table:
//!
//! | module | holds |
//! |---|---|
//! | `error` | errors |
//! | `rows` | a table that grows wall by wall |
//! | `finished` | a finished part of the report |
//! | `contents` | what the runs of a study depend on |
//! | `part` | a part as Parquet |
//! | `tables` | the rows of the tables of all studies |
//! | `given` | fragilities of the last shock of sequences, by what was before |
//! | `store` | the folder on disk |
//! | `compute` | computes the parts that are not on disk yet |
//! | `merge` | takes together the parts of several folders |
//! | `curves` | the curves of a complete folder, read part by part |
//! | `legend` | colours and marks of the damping models |
//! | `comparison` | the walls at one glance |
//! | `plots` | the plots of a wall |
//! | `subject` | walls and classes, with their fragilities |
//! | `shown` | their tables and plots on the page, classes first |
//! | `nrml` | fragility functions in the format of risk engines |
//! | `pelicun` | fragilities as components of pelicun |
//! | `rates` | annual rates of walls and classes |
//! | `losses` | losses of walls and classes |
//! | `samples` | samples of uncertain parameters, and what they explain |
//! | `measures` | which intensity measure to choose |
//! | `risk` | fragilities of walls and classes for risk engines |
//! | `page` | the page of a study |
//! | `population` | the walls of a large study together |
//! | `report` | all results of a complete folder |

mod comparison;
mod compute;
mod contents;
mod curves;
mod error;
mod finished;
mod given;
mod legend;
mod losses;
mod measures;
mod merge;
mod nrml;
mod page;
mod part;
mod pelicun;
mod plots;
mod population;
mod rates;
mod report;
mod risk;
mod rows;
mod samples;
mod shown;
mod store;
mod subject;
mod tables;

pub use compute::compute;
pub use contents::{Contents, Manifest, ModelNote, RecordNote, WallNote};
pub use curves::{curve_tables, each_wall};
pub use error::FolderError;
pub use merge::merge;
pub use part::{decode, encode};
pub use report::{Report, finish};
pub use rows::Rows;
pub use store::{FILES, Folder};
pub use subject::MOST_WALLS;
