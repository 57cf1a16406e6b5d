//! Capacity curves with their secants, and over a demand, as pictures.
//!
//! ```
//! use figures::capacity::{Curve, plot};
//!
//! let curve = Curve { name: "u > 0", points: vec![(0.0, 0.0), (0.01, 4e3), (0.2, 0.0)] };
//! let secants = vec![("0.4 u_ins, T = 1.1 s".to_owned(), (0.08, 3e3))];
//! assert!(plot(&[curve], secants).picture().svg().contains("T = 1.1 s"));
//! ```

use study::check::CapacityOverDemand;

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

/// Draws a capacity curve over the demand.
pub fn over_demand(demand: &CapacityOverDemand) -> Plot {
    let shown = |&(d, a): &(f64, f64)| (1000.0 * d, a);
    let (d_s, a_s) = demand.secant;
    let right = 1.25 * demand.capacity_displacement.max(demand.displacement);
    let points = || demand.capacity.iter().chain(&demand.spectrum).filter(|point| point.0 <= right);
    let top = 1.08 * points().map(|point| point.1).fold(0.0, f64::max);
    let named = |name: &str, line: Series| Series { name: name.to_owned(), ..line };
    let within = |points: &[(f64, f64)]| {
        let inside = points.iter().take_while(|point| point.0 <= right).count();
        let mut cut: Vec<_> = points[..inside].to_vec();
        if let (Some(&(d0, a0)), Some(&(d1, a1))) = (cut.last(), points.get(inside)) {
            cut.push((right, a0 + (a1 - a0) * (right - d0) / (d1 - d0)));
        }
        cut.iter().map(shown).collect::<Vec<_>>()
    };
    let ray = |factor: f64| (1000.0 * factor * d_s, factor * a_s);
    let longest = (right / d_s).min(top / a_s);
    let capacity = 1000.0 * demand.capacity_displacement;
    let dashed = |points| Series { look: Look::Dashed, ..Series::line(DARK_GREY, 1.3, points) };
    let secant = format!("secant, T = {:.3} s", demand.period);
    let series = vec![
        named("demand", Series::line(RED, 1.6, within(&demand.spectrum))),
        named("capacity curve", Series::line(BLUE, 2.0, within(&demand.capacity))),
        named(&secant, dashed(vec![(0.0, 0.0), ray(longest)])),
        named("displacement capacity", dashed(vec![(capacity, 0.0), (capacity, top)])),
    ];
    let axes = [Axis::over("d*, S_d (mm)", [0.0, 1000.0 * right]), Axis::over("a*, S_a (m/s²)", [0.0, top])];
    Plot::new([820.0, 460.0], axes, series)
}
