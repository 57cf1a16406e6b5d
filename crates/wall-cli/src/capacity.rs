//! The static capacity curve in `wall describe`: table, JSON, CSV and plot.

use std::fmt::Write;

use kuva::plot::{LegendPosition, LinePlot};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};
use rocking_wall::wall::{CapacityPoint, Wall};
use serde_json::{Value, json};

use crate::describe::significant;

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
        let mut sides = vec![side("u > 0", 1.0)];
        if wall.body().strength.positive != wall.body().strength.negative {
            sides.push(side("u < 0", -1.0));
        }
        Self { sides }
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
                let _ = writeln!(text, "{:22}{}", "", columns(point));
            }
            if !limits.is_empty() {
                let _ = writeln!(text, "limit states{:10}{:83} {:>13}", "", "", "T_sec [s]");
            }
            for point in limits {
                let period = point.secant_period.map_or_else(|| format!("{:>13}", "-"), significant);
                let _ = writeln!(text, "{:22}{} {period}", "", columns(point));
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
            "side,point,u_m,force_n,u_ratio,force_ratio,d_star_m,a_star_m_s2,secant_stiffness_n_m,secant_period_s\n",
        );
        for side in &self.sides {
            for (kind, points) in [("corner", &side.corners), ("limit_state", &side.limits)] {
                for point in points {
                    let optional =
                        |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
                    let _ = writeln!(
                        text,
                        "{},{kind},{:?},{:?},{:?},{:?},{:?},{:?},{},{}",
                        side.name,
                        point.displacement,
                        point.force,
                        point.displacement_ratio,
                        point.force_ratio,
                        point.spectral_displacement,
                        point.spectral_acceleration,
                        optional(point.secant_stiffness),
                        optional(point.secant_period)
                    );
                }
            }
        }
        text
    }

    /// The curve of each side, and the secants of the first one.
    pub(crate) fn drawing(&self) -> Scene {
        let place = |point: &CapacityPoint| (1000.0 * point.displacement, point.force / 1000.0);
        let mut lines = Vec::new();
        for (side, color) in self.sides.iter().zip([CURVE, OTHER_CURVE]) {
            let points: Vec<_> = side.corners.iter().map(place).collect();
            let line = LinePlot::new().with_data(points).with_color(color).with_stroke_width(2.0);
            lines.push(Plot::Line(line.with_legend(format!("capacity curve, {}", side.name))));
        }
        let secants = self.sides[0].limits.iter().filter_map(|point| Some((point, point.secant_period?)));
        for ((point, period), color) in secants.zip(SECANTS.iter().cycle()) {
            let line = LinePlot::new().with_data(vec![(0.0, 0.0), place(point)]).with_color(*color);
            let legend = format!("{} u_ins, T = {period:.3} s", point.displacement_ratio);
            lines.push(Plot::Line(line.with_stroke_width(1.3).with_dashed().with_legend(legend)));
        }
        let points = || self.sides.iter().flat_map(|side| &side.corners).map(place);
        let right = points().map(|point| point.0).fold(0.0, f64::max);
        let top = points().map(|point| point.1).fold(0.0, f64::max);
        let low = points().map(|point| point.1).fold(0.0, f64::min);
        let layout = Layout::auto_from_plots(&lines)
            .with_width(820.0)
            .with_height(460.0)
            .with_x_axis_min(0.0)
            .with_x_axis_max(1.02 * right)
            .with_y_axis_min(1.05 * low)
            .with_y_axis_max(1.08 * top)
            .with_x_label("displacement |u| (mm)")
            .with_y_label("restoring force |F| (kN)")
            .with_label_size(14)
            .with_tick_size(12)
            .with_legend_position(LegendPosition::InsideTopRight)
            .with_font_family("system-ui, sans-serif");
        render_multiple(lines, layout)
    }
}

const CURVE: &str = "#1f5fa8";
const OTHER_CURVE: &str = "#4d4d4d";
const SECANTS: [&str; 4] = ["#2e7d32", "#c98a00", "#b3371e", "#8e5bb5"];

fn columns(point: &CapacityPoint) -> String {
    let values = [
        point.displacement,
        point.force,
        point.displacement_ratio,
        point.force_ratio,
        point.spectral_displacement,
        point.spectral_acceleration,
    ];
    values.map(significant).join(" ")
}
