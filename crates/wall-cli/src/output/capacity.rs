//! The static capacity curve in `wall describe`: table, JSON, CSV and plot.

use std::fmt::Write;

use figures::capacity::{Curve, plot};
use figures::plot::Picture;
use rocking_wall::wall::{CapacityPoint, Wall};
use serde_json::{Value, json};

use study_folder::csv::optional;

/// The curve of one side.
struct Side {
    name: &'static str,
    corners: Vec<CapacityPoint>,
    /// Points at the limit states.
    limits: Vec<CapacityPoint>,
}

/// The capacity curve of a wall, of both sides where they differ.
pub(crate) struct Capacity {
    sides: Vec<Side>,
}

impl Capacity {
    pub(crate) fn new(wall: &Wall, fractions: &[f64]) -> Self {
        let side = |name, sign: f64| Side {
            name,
            corners: wall.capacity_corners(sign),
            limits: fractions.iter().map(|&fraction| wall.capacity_at(sign, fraction)).collect(),
        };
        let named = |sign: f64| side(if sign > 0.0 { "u > 0" } else { "u < 0" }, sign);
        Self { sides: wall.sides().take(if wall.has_equal_sides() { 1 } else { 2 }).map(named).collect() }
    }

    pub(crate) fn table(&self) -> String {
        let mut text = String::new();
        for Side { name, corners, limits } in &self.sides {
            let _ = writeln!(
                text,
                "\ncapacity curve, {name:<6}{:>13} {:>13} {:>13} {:>13} {:>13} {:>13}",
                "u [m]", "F [N]", "u/u_ins", "F/F0", "d* [m]", "a* [m/s2]"
            );
            for point in corners {
                let _ = writeln!(text, "{:22}{}", "", values(point).map(significant).join(" "));
            }
            if !limits.is_empty() {
                let _ = writeln!(text, "limit states{:10}{:83} {:>13}", "", "", "T_sec [s]");
            }
            for point in limits {
                let period = point.secant_period.map_or_else(|| format!("{:>13}", "-"), significant);
                let _ = writeln!(text, "{:22}{} {period}", "", values(point).map(significant).join(" "));
            }
        }
        text
    }

    pub(crate) fn json(&self) -> Value {
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

    pub(crate) fn csv(&self) -> String {
        let mut text = String::from(
            "side,point,u_m,force_n,u_ratio,force_ratio,d_star_m,a_star_m_s2,secant_stiffness_n_m,\
             secant_period_s\n",
        );
        for side in &self.sides {
            for (kind, points) in [("corner", &side.corners), ("limit_state", &side.limits)] {
                for point in points {
                    let cells = values(point).map(|value| format!("{value:?}")).join(",");
                    let [stiffness, period] = [point.secant_stiffness, point.secant_period].map(optional);
                    let _ = writeln!(text, "{},{kind},{cells},{stiffness},{period}", side.name);
                }
            }
        }
        text
    }

    /// The curve of each side, and the secants of the first one.
    pub(crate) fn picture(&self) -> Picture {
        let place = |point: &CapacityPoint| (point.displacement, point.force);
        let curve = |side: &Side| Curve { name: side.name, points: side.corners.iter().map(place).collect() };
        let secant = |point: &CapacityPoint| {
            let name = format!("{} u_ins, T = {:.3} s", point.displacement_ratio, point.secant_period?);
            Some((name, place(point)))
        };
        let curves: Vec<_> = self.sides.iter().map(curve).collect();
        plot(&curves, self.sides[0].limits.iter().filter_map(secant).collect()).picture()
    }
}

/// Returns the numbers of a point that the table and the CSV have in common.
fn values(point: &CapacityPoint) -> [f64; 6] {
    [
        point.displacement,
        point.force,
        point.displacement_ratio,
        point.force_ratio,
        point.spectral_displacement,
        point.spectral_acceleration,
    ]
}

/// Six significant figures, right-aligned.
pub(crate) fn significant(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || (1e-3..1e6).contains(&magnitude) {
        let digits = if value == 0.0 { 1.0 } else { magnitude.log10().floor() };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 8 decimals")]
        let decimals = (5.0 - digits).clamp(0.0, 8.0) as usize;
        format!("{value:>13.decimals$}")
    } else {
        format!("{value:>13.5e}")
    }
}
