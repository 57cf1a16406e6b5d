//! Capacity curves with their secants, as a picture.
//!
//! ```
//! use figures::capacity::{Curve, plot};
//!
//! let curve = Curve { name: "u > 0", points: vec![(0.0, 0.0), (0.01, 4e3), (0.2, 0.0)] };
//! let secants = vec![("0.4 u_ins, T = 1.1 s".to_owned(), (0.08, 3e3))];
//! assert!(plot(&[curve], secants).picture().svg().contains("T = 1.1 s"));
//! ```

use crate::palette::{AMBER, BLUE, DARK_GREY, GREEN, PURPLE, RED};
use crate::plot::{Axis, Look, Plot, Series};

/// Colours of the curves and of the secants, in turn.
const CURVES: [&str; 2] = [BLUE, DARK_GREY];
const SECANTS: [&str; 4] = [GREEN, AMBER, RED, PURPLE];

/// The curve of one side of a wall.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Name of the side.
    pub name: &'static str,
    /// Its corners: |u| \[m\] and |F| \[N\].
    pub points: Vec<(f64, f64)>,
}

/// Draws the curve of each side, and secants from the origin: a name and the point they go to, |u| \[m\] and
/// |F| \[N\].
pub fn plot(curves: &[Curve], secants: Vec<(String, (f64, f64))>) -> Plot {
    let shown = |&(u, force): &(f64, f64)| (1000.0 * u, force / 1000.0);
    let points = || curves.iter().flat_map(|curve| &curve.points).map(shown);
    let right = points().map(|point| point.0).fold(0.0, f64::max);
    let top = points().map(|point| point.1).fold(0.0, f64::max);
    let low = points().map(|point| point.1).fold(0.0, f64::min);
    let mut series = Vec::new();
    for (curve, color) in curves.iter().zip(CURVES) {
        let line = Series::line(color, 2.0, curve.points.iter().map(shown).collect());
        series.push(Series { name: format!("capacity curve, {}", curve.name), ..line });
    }
    for ((name, point), color) in secants.into_iter().zip(SECANTS.iter().cycle()) {
        let line = Series::line(color, 1.3, vec![(0.0, 0.0), shown(&point)]);
        series.push(Series { name, look: Look::Dashed, ..line });
    }
    let axes = [
        Axis::over("displacement |u| (mm)", [0.0, 1.02 * right]),
        Axis::over("restoring force |F| (kN)", [1.05 * low, 1.08 * top]),
    ];
    Plot::new([820.0, 460.0], axes, series)
}
