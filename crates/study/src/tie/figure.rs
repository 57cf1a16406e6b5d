//! Force of a tie and displacement of the wall over the stiffness of the tie.
//!
//! ```
//! use study::tie::Row;
//!
//! let picture = study::tie::figure::picture(&[] as &[Row]);
//! assert!(picture.svg().contains("force of the tie"));
//! ```

use crate::tie::{Outcome, Row};

use report::palette::{BLUE, Mark, RED};
use report::plot::{Axis, Look, Picture, Plot, Series};

/// Draws medians (lines) and largest values (marks) of force and displacement over the stiffness.
pub fn picture(rows: &[Row]) -> Picture {
    let tied: Vec<&Row> = rows.iter().filter(|row| row.stiffness > 0.0).collect();
    let panel = |label: &str, color, pick: fn(&Outcome) -> f64, scale: f64| {
        let points = |part: usize| -> Vec<(f64, f64)> {
            tied.iter().map(|row| (row.stiffness.log10(), scale * row.of(pick)[part])).collect()
        };
        let largest = points(1);
        let top = 1.08 * largest.iter().map(|point| point.1).fold(0.0, f64::max);
        let marks = Series { look: Look::Marks(Mark::Circle), ..Series::stroke(color, 3.0, largest) };
        let series = vec![Series::stroke(color, 1.6, points(0)), marks];
        let x = [points(0).first().map_or(0.0, |p| p.0 - 0.1), points(0).last().map_or(1.0, |p| p.0 + 0.1)];
        let axes = [Axis::over("log10 of the stiffness (N/m)", x), Axis::over(label, [-0.02 * top, top])];
        Plot::new([820.0, 320.0], axes, series)
    };
    Picture::stacked(&[
        Plot {
            title: "Line: median of the motions; dots: largest".to_owned(),
            ..panel("force of the tie (kN)", RED, |outcome| outcome.force, 1e-3)
        },
        panel("largest |u|/u_ins", BLUE, |outcome| outcome.u_ratio, 1.0),
    ])
}
