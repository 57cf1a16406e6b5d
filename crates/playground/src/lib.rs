//! A page that computes rocking walls in the browser.
//!
//! The crate compiles to WebAssembly. The page sends a request as JSON and gets an answer as JSON: the
//! libraries compute and draw, and the page's script only shows. Compiled for other targets, the crate gives
//! the same answers to tests. `cargo xtask playground` packs the page into one file.
//!
//! ```
//! use playground::Session;
//!
//! let mut session = Session::default();
//! let request = r#"{"run": {"parameters": {"height": "3"}, "motion": {"kind": "none"}, "width": 600}}"#;
//! assert!(session.answer(request).contains("\"headline\":"));
//! let request = r#"{"run": {"parameters": {"height": "-3"}, "motion": {"kind": "none"}, "width": 600}}"#;
//! assert!(session.answer(request).contains("height = -3.0 m is below its minimum"));
//! ```
//!
//! Each module uses only modules above it in this table:
//!
//! | module | holds |
//! |---|---|
//! | `request` | what the page asks for, and what is wrong with it, field by field |
//! | `parameters` | what the page's fields need to know of the model description |
//! | `upload` | the record file that the user has dropped |
//! | `check_table` | the table `[check]` of a scene file |
//! | `scene` | from a request to a scene, and to its text |
//! | `check` | the check by a code |
//! | `verdict` | the result in a sentence, and its numbers |
//! | `charts` | the charts of a run |
//! | `fragility` | the fragility of a wall under twenty synthetic motions |
//! | `session` | from a request to its answer |
//! | `boundary` | the functions that WebAssembly exports |

#[cfg(target_arch = "wasm32")]
mod boundary;
mod charts;
mod check;
mod check_table;
mod fragility;
mod parameters;
mod request;
mod scene;
mod session;
mod upload;
mod verdict;

pub use session::Session;

#[cfg(test)]
mod tests;
