//! Capacity over demand of each check over what is sought.

use report::number;
use report::palette::{BLUE, DARK_GREY, GREEN, RED};
use report::plot::{Axis, Look, Plot, Scale, Series, room_for_legend};

use super::{Found, FoundCheck, Sought};

/// Colours of the lines of checks.
const COLORS: [&str; 4] = [BLUE, RED, GREEN, DARK_GREY];

/// Width and height of the picture \[px\].
const SIZE: [f64; 2] = [820.0, 460.0];
/// Points (value, capacity over demand) of a line.
type Points = Vec<(f64, f64)>;

/// A line up to a height, with gaps where it is above.
fn below(points: &[(f64, f64)], top: f64) -> Points {
    let mut cut = Points::new();
    let mut last = None;
    for &(x, y) in points {
        if let Some((x0, y0)) = last.filter(|(_, y0)| (*y0 > top) != (y > top)) {
            cut.push((x0 + (x - x0) * (top - y0) / (y - y0), top));
        }
        cut.push((x, if y > top { f64::NAN } else { y }));
        last = Some((x, y));
    }
    cut
}

impl Found {
    /// Draws capacity over demand of each check over the values that were tried; the limit 1, and the value
    /// found. Sizes are drawn up to three times that value, strengths and stiffnesses over all their decades.
    pub fn plot(&self) -> Plot {
        let name = self.sought.name();
        let (unit, factor, scale) = match self.sought {
            Sought::TieStrength => ("kN", 1e-3, Scale::LogarithmicAcross),
            Sought::TieStiffness => ("kN/m", 1e-3, Scale::LogarithmicAcross),
            Sought::BarDiameter => ("mm", 1e3, Scale::Linear),
            Sought::Thickness | Sought::Height => ("m", 1.0, Scale::Linear),
        };
        let symbol = self.symbol.replace("zeta", "ζ");
        let [left, right] = self.range.map(|end| factor * end);
        let value = self.value.map(|value| factor * value);
        let near = value.filter(|_| scale == Scale::Linear);
        let right = near.map_or(right, |value| right.min(3.0 * value));
        let shown = |found: &FoundCheck| -> Vec<(f64, f64)> {
            let shown = found.curve.iter().map(|(value, zeta)| (factor * value, *zeta));
            shown.filter(|point| point.1.is_finite() && point.0 <= right).collect()
        };
        let lines: Vec<_> = self.checks.iter().map(|found| (found, shown(found))).collect();
        // far beyond the demand nothing is to be seen
        let top =
            lines.iter().flat_map(|(_, points)| points).map(|point| point.1).fold(1.2, f64::max).min(3.0);
        let line = |(index, (found, points)): (usize, (&FoundCheck, Points))| {
            let stroke = Series::stroke(COLORS[index % COLORS.len()], 2.0, below(&points, top));
            let look = if found.decides { Look::Solid } else { Look::Dotted };
            let informs = if found.decides { "" } else { " (for information)" };
            Series { name: format!("{}{informs}", found.check), look, ..stroke }
        };
        let mut series: Vec<_> = lines.into_iter().enumerate().map(line).collect();
        let top = top * room_for_legend(SIZE[1], series.len() + usize::from(value.is_some()));
        if let Some(value) = value {
            let line = Series::stroke(DARK_GREY, 1.3, vec![(value, 0.0), (value, top)]);
            let name = format!("{name} = {} {unit}", number(value, 4));
            series.push(Series { look: Look::Dashed, name, ..line });
        }
        let axes = [Axis::over(&format!("{name} ({unit})"), [left, right]), Axis::over(&symbol, [0.0, top])];
        Plot { limits: vec![(1.0, DARK_GREY)], scale, ..Plot::new(SIZE, axes, series) }
    }
}

#[cfg(test)]
mod tests {
    use super::below;

    #[test]
    fn lines_end_below_the_legend() {
        let cut = below(&[(0.0, 1.0), (1.0, 5.0), (2.0, 6.0), (3.0, 0.0)], 3.0);
        let drawn: Vec<_> = cut.iter().map(|(x, y)| (*x, (!y.is_nan()).then_some(*y))).collect();
        let ends = [(0.5, Some(3.0)), (1.0, None), (2.0, None), (2.5, Some(3.0)), (3.0, Some(0.0))];
        assert_eq!(drawn, [&[(0.0, Some(1.0))], &ends[..]].concat());
    }
}
