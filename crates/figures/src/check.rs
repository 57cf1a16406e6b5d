//! `ζ_E` of a check over a parameter of the wall.

use study::circolare::{Found, Sought};

use crate::palette::{BLUE, DARK_GREY, RED};
use crate::plot::{Axis, Look, Plot, Series};

/// Draws `ζ_E` over the values that were tried up to three times the one found, the limit 1, and that value.
pub fn over_parameter(found: &Found, sought: Sought) -> Plot {
    let [left, right] = found.range;
    let right = found.value.map_or(right, |value| right.min(3.0 * value));
    let shown = found.curve.iter().copied().filter(|point| point.1.is_finite() && point.0 <= right);
    let points: Vec<(f64, f64)> = shown.collect();
    // far beyond the demand nothing is to be seen
    let top = points.iter().map(|point| point.1).fold(1.2, f64::max).min(3.0);
    let inside = points.into_iter().filter(|point| point.1 <= top).collect();
    let named = |name: String, look: Look, line: Series| Series { look, name, ..line };
    let mut series = vec![named("ζ_E".into(), Look::Solid, Series::line(BLUE, 2.0, inside))];
    if let Some(value) = found.value {
        let name = format!("{} = {value:.4} {}", sought.name(), sought.unit());
        let line = Series::line(RED, 1.3, vec![(value, 0.0), (value, top)]);
        series.push(named(name, Look::Dashed, line));
    }
    let axes = [
        Axis::over(&format!("{} ({})", sought.name(), sought.unit()), [left.min(right), right]),
        Axis::over("ζ_E", [0.0, 1.05 * top]),
    ];
    Plot { limits: vec![(1.0, DARK_GREY)], ..Plot::new([820.0, 460.0], axes, series) }
}
