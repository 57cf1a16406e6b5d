//! Capacity over demand of each check over what is sought.

use report::number;
use report::palette::{BLUE, DARK_GREY, GREEN, RED};
use report::plot::{Axis, Look, Plot, Scale, Series, room_for_legend};

use super::{Found, Sought};
use crate::sections::origin::locale;
use crate::words::Language;

/// Colours of the lines of checks.
const COLORS: [&str; 4] = [BLUE, RED, GREEN, DARK_GREY];

/// Width and height of the picture \[px\].
const SIZE: [f64; 2] = [820.0, 460.0];
impl Found {
    /// Draws capacity over demand of each check over the values that were tried; the limit 1, and the value
    /// found. Sizes are drawn up to three times that value, strengths and stiffnesses over all their decades.
    pub fn plot(&self, language: Language) -> Plot {
        let name = self.sought.title();
        let name = name.of(language);
        let (unit, factor, scale) = match self.sought {
            Sought::TieStrength | Sought::Thrust | Sought::Load => ("kN", 1e-3, Scale::LogarithmicAcross),
            Sought::TieStiffness => ("kN/m", 1e-3, Scale::LogarithmicAcross),
            Sought::BarDiameter => ("mm", 1e3, Scale::Linear),
            Sought::Thickness | Sought::Height => ("m", 1.0, Scale::Linear),
        };
        let symbol = self.symbol.of(language).replace("zeta", "ζ");
        let [left, right] = self.range.map(|end| factor * end);
        let value = self.value.map(|value| factor * value);
        let near = value.filter(|_| scale == Scale::Linear);
        let right = near.map_or(right, |value| right.min(3.0 * value));
        let lines = self.checks.iter().zip(COLORS.into_iter().cycle()).map(|(found, color)| {
            let points = found.curve.iter().map(|(value, zeta)| (factor * value, *zeta)).collect();
            let look = if found.decides { Look::Solid } else { Look::Dotted };
            let name = found.told().of(language).to_owned();
            Series { name, look, ..Series::stroke(color, 2.0, points) }
        });
        // far beyond the demand nothing is to be seen
        let heights =
            self.checks.iter().flat_map(|found| &found.curve).filter(|point| factor * point.0 <= right);
        let heights = heights.map(|point| point.1).filter(|zeta| zeta.is_finite());
        let top = heights.fold(1.2, f64::max).min(3.0);
        let mut series: Vec<_> =
            lines.flat_map(|line| line.within([[left, right], [0.0, top]]).collect::<Vec<_>>()).collect();
        let rows = self.checks.len() + usize::from(value.is_some());
        let top = top * room_for_legend(SIZE[1], rows);
        if let Some(value) = value {
            let line = Series::stroke(DARK_GREY, 1.3, vec![(value, 0.0), (value, top)]);
            let name = language.decimal(&format!("{name} = {} {unit}", number(value, 4)));
            series.push(Series { look: Look::Dashed, name, ..line });
        }
        let axes = [Axis::over(&format!("{name} ({unit})"), [left, right]), Axis::over(&symbol, [0.0, top])];
        let locale = locale(language);
        Plot { limits: vec![(1.0, DARK_GREY)], scale, locale, ..Plot::new(SIZE, axes, series) }
    }
}
