//! The static capacity curve of a wall: its corners and its points at limit states, as table, JSON and plot.
//!
//! ```
//! use rocking_wall::wall::{Parameters, Wall};
//! use run::capacity::Capacity;
//!
//! let capacity = Capacity::new(&Wall::new(&Parameters::default())?, &[0.4]);
//! assert!(capacity.table().text().contains("limit_state"));
//! assert!(capacity.plot().picture().contains("0.4 u_ins, T = "));
//! # Ok::<(), rocking_wall::wall::ParameterError>(())
//! ```

use report::palette::{AMBER, BLUE, DARK_GREY, GREEN, Mark, PURPLE, RED};
use report::plot::{Axis, Look, Plot, Series};
use report::table::{Digits, Table};
use rocking_wall::wall::{CapacityPoint, Wall};
use serde_json::{Value, json};

/// The curve of one side.
struct Side {
    name: &'static str,
    corners: Vec<CapacityPoint>,
    /// Points at the limit states.
    limits: Vec<CapacityPoint>,
}

/// The capacity curve of a wall, of both sides where they differ.
pub struct Capacity {
    sides: Vec<Side>,
}

impl Capacity {
    /// Makes the curve, with points at fractions of `u_ins` \[-\].
    pub fn new(wall: &Wall, fractions: &[f64]) -> Self {
        let side = |name, sign: f64| Side {
            name,
            corners: wall.capacity_corners(sign),
            limits: fractions.iter().map(|&fraction| wall.capacity_at(sign, fraction)).collect(),
        };
        let named = |sign: f64| side(if sign > 0.0 { "u > 0" } else { "u < 0" }, sign);
        Self { sides: wall.sides().take(if wall.has_equal_sides() { 1 } else { 2 }).map(named).collect() }
    }

    /// Returns a row for each point; limit states have a secant.
    pub fn table(&self) -> Table {
        let six = Digits::Significant(6);
        let rows = self.sides.iter().flat_map(|side| {
            let kinds = [("corner", &side.corners), ("limit_state", &side.limits)];
            let points = kinds.into_iter().flat_map(|(kind, points)| points.iter().map(move |p| (kind, p)));
            points.map(move |(kind, point)| (side.name, kind, point))
        });
        Table::over(rows)
            .text("side", "side", |(side, ..)| *side)
            .text("point", "point", |(_, kind, _)| *kind)
            .number("u_m", "u [m]", six, |(.., point)| point.displacement)
            .number("force_n", "F [N]", six, |(.., point)| point.force)
            .number("u_ratio", "u/u_ins", six, |(.., point)| point.displacement_ratio)
            .number("force_ratio", "F/F0", six, |(.., point)| point.force_ratio)
            .number("d_star_m", "d* [m]", six, |(.., point)| point.spectral_displacement)
            .number("a_star_m_s2", "a* [m/s2]", six, |(.., point)| point.spectral_acceleration)
            .value("secant_stiffness_n_m", |(.., point)| point.secant_stiffness)
            .number("secant_period_s", "T_sec [s]", six, |(.., point)| point.secant_period)
            .done()
    }

    /// Returns the sides with their corners and limit states, in SI units.
    pub fn json(&self) -> Value {
        let point = |point: &CapacityPoint| {
            json!({
                "u": point.displacement,
                "force": point.force,
                "u_ratio": point.displacement_ratio,
                "force_ratio": point.force_ratio,
                "d_star": point.spectral_displacement,
                "a_star": point.spectral_acceleration,
                "secant_stiffness": point.secant_stiffness,
                "secant_period": point.secant_period,
            })
        };
        let side = |side: &Side| {
            json!({
                "side": side.name,
                "corners": side.corners.iter().map(point).collect::<Vec<_>>(),
                "limit_states": side.limits.iter().map(point).collect::<Vec<_>>(),
            })
        };
        self.sides.iter().map(side).collect()
    }

    /// Draws the curve of each side, and the secants of the first one.
    pub fn plot(&self) -> Plot {
        let place = |point: &CapacityPoint| (point.displacement, point.force);
        let curve = |side: &Side| (side.name, side.corners.iter().map(place).collect());
        let secant = |point: &CapacityPoint| {
            let name = format!("{} u_ins, T = {:.3} s", point.displacement_ratio, point.secant_period?);
            Some((name, place(point)))
        };
        let curves: Vec<_> = self.sides.iter().map(curve).collect();
        plot(&curves, self.sides[0].limits.iter().filter_map(secant).collect())
    }
}

/// Colours of the curves and of the secants, in turn.
const CURVES: [&str; 2] = [BLUE, DARK_GREY];
const SECANTS: [&str; 4] = [GREEN, AMBER, RED, PURPLE];

/// The name of a side of a wall, and the corners of its curve: |u| \[m\] and |F| \[N\].
pub type Curve = (&'static str, Vec<(f64, f64)>);

/// Draws the curve of each side, and secants from the origin: a name and the point they go to, |u| \[m\] and
/// |F| \[N\].
pub fn plot(curves: &[Curve], secants: Vec<(String, (f64, f64))>) -> Plot {
    let shown = |&(u, force): &(f64, f64)| (1000.0 * u, force / 1000.0);
    let points = || curves.iter().flat_map(|(_, points)| points).map(shown);
    let right = points().map(|point| point.0).fold(0.0, f64::max);
    let top = points().map(|point| point.1).fold(0.0, f64::max);
    let low = points().map(|point| point.1).fold(0.0, f64::min);
    let mut series = Vec::new();
    for ((name, points), color) in curves.iter().zip(CURVES) {
        let line = Series::stroke(color, 2.0, points.iter().map(shown).collect());
        series.push(Series { name: format!("capacity curve, {name}"), ..line });
    }
    for ((name, point), color) in secants.into_iter().zip(SECANTS.iter().cycle()) {
        let line = Series::stroke(color, 1.3, vec![(0.0, 0.0), shown(&point)]);
        series.push(Series { name, look: Look::Dashed, ..line });
    }
    let axes = [
        Axis::over("displacement |u| (mm)", [0.0, 1.02 * right]),
        Axis::over("restoring force |F| (kN)", [1.05 * low, 1.08 * top]),
    ];
    Plot::new([820.0, 460.0], axes, series)
}

/// Adds the capacity curve that a force law was made of, as it was given.
pub fn with_curve(mut plot: Plot, curve: Option<&scene::Curve>) -> Plot {
    let Some(curve) = curve.filter(|curve| !curve.points.is_empty()) else { return plot };
    let points = curve.points.iter().map(|point| (1000.0 * point[0].abs(), point[1].abs() / 1000.0));
    // a legend has room for the points and the largest deviation alone
    let (name, look) = (format!("as given: {}", curve.short_note()), Look::Marks(Mark::Circle));
    plot.series.push(Series { name, look, ..Series::stroke(RED, 2.0, points.collect()) });
    plot
}
