#![doc = include_str!("../README.md")]
//!
//! # Modules
//! ```text
//! values ─► Plot ─► inline SVG for a page · picture (SVG) for a file
//! ```
//!
//! | module | draws |
//! |---|---|
//! | [`mod@plot`] | lines and marks over two axes: what the next five are made of |
//! | [`chart`] | the charts of a study, with title and legend |
//! | [`response`] | histories, the force path on its backbone, small beside full rotations |
//! | [`capacity`] | capacity curves with their secants |
//! | [`records`] | accelerograms above their response spectra |
//! | [`work_precision`] | error against run time |
//! | [`heat_map`] | cells in colours, and the scale of these colours |
//! | [`many_lines`] | thousands of lines in few bytes, with their style |
//! | [`rocking_spectrum`] | rocking spectra as heat maps |
//! | [`mod@calibration`] | calibrations as charts |
//! | [`tie`] | force and displacement over the stiffness of a tie |
//! | [`sheet`] | drawings side by side in a file |
//! | [`template`] | no chart; it fills the gaps of a page |
//! | [`palette`] | the colours and marks of all of them |

mod axes;
#[cfg(not(target_arch = "wasm32"))]
pub mod calibration;
pub mod capacity;
pub mod chart;
pub mod check;
mod frame;
pub mod heat_map;
pub mod many_lines;
pub mod palette;
pub mod plot;
mod points;
pub mod records;
pub mod response;
pub mod rocking_spectrum;
pub mod sheet;
pub mod template;
pub mod tie;
pub mod work_precision;

pub use axes::{number, ticks};

/// Escapes text for markup.
///
/// ```
/// assert_eq!(figures::escaped("a < b"), "a &lt; b");
/// ```
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
