//! Demands on the tie and displacement of the wall over what is varied.

use crate::tie::{Outcome, Row, TieStudy};

use report::palette::{BLUE, GREEN, Mark, RED};
use report::plot::{Axis, Look, Plot, Scale, Series, stacked};

/// Draws medians (lines), 84 % fractiles (dashed) and largest values (marks) of force and displacement over
/// what is varied; where a tie may yield, of its plastic elongation, too. What a logarithmic axis cannot
/// show, and a tie that stays elastic beside others, is left out.
pub fn picture(study: &TieStudy, rows: &[Row]) -> String {
    let varied = study.varied();
    let is_shown = |row: &&Row| row.value > 0.0 || (row.value == 0.0 && !varied.is_logarithmic);
    let shown: Vec<&Row> = rows.iter().filter(is_shown).collect();
    let panel = |label: &str, color, pick: fn(&Outcome) -> f64, scale: f64| {
        let points = |part: usize| -> Vec<(f64, f64)> {
            shown.iter().map(|row| (varied.factor * row.value, scale * row.of(pick)[part])).collect()
        };
        let largest = points(2);
        let (x, scale) = match (varied.is_logarithmic, largest.first(), largest.last()) {
            (true, Some(first), Some(last)) => {
                (Axis::over(varied.label, [0.8 * first.0, 1.25 * last.0]), Scale::LogarithmicAcross)
            }
            _ => (Axis::new(varied.label), Scale::Linear),
        };
        let marks = Series { look: Look::Marks(Mark::Circle), ..Series::stroke(color, 3.0, largest) };
        let upper = Series { look: Look::Dashed, ..Series::stroke(color, 1.3, points(1)) };
        let series = vec![Series::stroke(color, 1.6, points(0)), upper, marks];
        Plot { scale, ..Plot::new([820.0, 320.0], [x, Axis::new(label)], series) }
    };
    let mut panels = vec![
        Plot {
            title: "Line: median of the motions; dashed: 84 % fractile; dots: largest".to_owned(),
            ..panel("force of the tie (kN)", RED, |outcome| outcome.force, 1e-3)
        },
        panel("largest |u|/u_ins", BLUE, |outcome| outcome.u_ratio, 1.0),
    ];
    if study.yields() {
        panels.push(panel("plastic elongation (mm)", GREEN, |outcome| outcome.elongation, 1e3));
    }
    stacked(&panels)
}
