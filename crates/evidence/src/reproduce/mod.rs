//! The paper's tables and figures, computed now, beside the printed numbers.
//!
//! Each module uses only modules above it in this table:
//!
//! | module | holds |
//! |---|---|
//! | [`printed`] | the numbers that the paper prints |
//! | `figure` | figures as data |
//! | `formulas` | Tables 1 and 2 |
//! | [`tables`] | Tables 3, 4 and 5 |
//! | [`rotations`] | Figures 2 and 3: full rotations |
//! | `closed_forms` | Figures 4 and 13: closed forms |
//! | `free_vibrations` | Figures 5, 6 and 7: free vibrations |
//! | `section_5` | Figures 8 to 12: calibration |
//! | `harmonic` | Figure 14: forced vibrations |
//! | [`collapse`] | Figure 15: incremental dynamic analyses |
//! | [`page`] | the page |
//!
//! ```
//! assert!(evidence::reproduce::tables::table_3().agreeing() >= 8);
//! ```

mod closed_forms;
pub mod collapse;
mod figure;
mod formulas;
mod free_vibrations;
mod harmonic;
pub mod page;
pub mod printed;
pub mod rotations;
mod section_5;
pub mod tables;

use std::num::NonZeroUsize;

use crate::{Comparison, EvidenceError};

pub use figure::Figure;

/// A table of the paper, computed.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperTable {
    /// Name, such as "Table 5".
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// Assumptions, and why some numbers do not match print; a paragraph a line.
    pub notes: String,
    /// Its numbers beside the printed ones.
    pub rows: Vec<Comparison>,
}

impl PaperTable {
    /// Counts the numbers that round to the printed ones.
    pub fn agreeing(&self) -> usize {
        self.rows.iter().filter(|row| row.passes()).count()
    }
}

/// All tables and figures that need no records, in the order of the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Reproduction {
    /// Tables; the last one holds numbers from captions and text.
    pub tables: Vec<PaperTable>,
    /// Figures.
    pub figures: Vec<Figure>,
}

/// Computes all tables and figures that need no records, on `threads` threads. Figure 15, which needs
/// records, is computed by [`collapse::figure_15`]. Counts the calibrations, which take most of the time, as
/// [done](run::parallel::count_done).
///
/// # Errors
/// [`EvidenceError`] if a wall, a motion, a run or a calibration fails.
pub fn reproduce(threads: NonZeroUsize) -> Result<Reproduction, EvidenceError> {
    let [table_1, table_2] = formulas::tables_1_and_2()?;
    let section_5 = section_5::Section5::new(threads)?;
    let tables = vec![
        table_1,
        table_2,
        tables::table_3(),
        tables::table_4(),
        tables::table_5()?,
        section_5.equations(),
        free_vibrations::captions(threads)?,
    ];
    let [figure_2, figure_3] = rotations::figures(&rotations::Rotations::of_both()?)?;
    let mut figures = vec![
        figure_2,
        figure_3,
        closed_forms::figure_4()?,
        free_vibrations::figure_5()?,
        free_vibrations::figure_6()?,
        free_vibrations::figure_7()?,
    ];
    figures.extend(section_5.figures());
    figures.extend([closed_forms::figure_13(), harmonic::figure_14()?]);
    Ok(Reproduction { tables, figures })
}
