//! Calibrations as plots.
//!
//! ```
//! use study::calibration::figure::charts;
//! use study::calibration::{Calibration, DampingModel, Fit};
//!
//! let fit = Fit { a1: 0.03, start: 0.9, restitution: 0.85, damping: 0.04, error: 1e-3, samples: 500 };
//! let found = Calibration::new(DampingModel::ConstantRatio, vec![fit]);
//! assert_eq!(charts(&[found]).len(), 2);
//! ```

use crate::calibration::{Calibration, Coefficient, DampingModel, FREE_STANDING, Fit, REGRESSIONS};
use report::plot::{Axis, Plot, Series};
use rocking_wall::wall::Ratio;
use run::model::{Label, label};

/// Series that a plot holds without repeating a colour.
const MOST_SERIES: usize = 6;

/// Draws the fits of each calibration over e, their errors and, where there are laws, x over a₁.
pub fn charts(found: &[Calibration]) -> Vec<Plot> {
    let mut charts: Vec<_> = found.iter().map(over_restitution).collect();
    charts.push(least_errors(found));
    if found.iter().any(|calibration| !calibration.laws.is_empty()) {
        charts.push(over_stiffness(found));
    }
    charts
}

/// Returns what the paper prints for x at a₁.
pub fn printed(model: DampingModel, a1: f64) -> Option<f64> {
    let regression = REGRESSIONS.iter().find(|(of, ..)| *of == model);
    match regression {
        Some((.., [q, r])) if a1 > 0.0 => Some(q * a1.powf(*r)),
        _ => (model == DampingModel::FreeStandingBlock).then_some(FREE_STANDING),
    }
}

/// Draws ξ over e for some of the a₁ and u₀.
fn over_restitution(found: &Calibration) -> Plot {
    let every = found.coefficients.len().div_ceil(MOST_SERIES);
    let mut series = Vec::new();
    for (color, Coefficient { a1, start, x }) in found.coefficients.iter().step_by(every).enumerate() {
        let fits: Vec<&Fit> = found.fits.iter().filter(|fit| (fit.a1, fit.start) == (*a1, *start)).collect();
        let ends = fits
            .iter()
            .fold([1.0_f64, 0.0], |[low, high], fit| [low.min(fit.restitution), high.max(fit.restitution)]);
        let line = (0..=50).map(|part| {
            let e = ends[0] + (ends[1] - ends[0]) * f64::from(part) / 50.0;
            (e, -x * e.ln())
        });
        series.push(Series::line("", color, line.collect()));
        let points = fits.iter().map(|fit| (fit.restitution, fit.damping)).collect();
        series.push(Series::marks(&format!("a₁ = {a1}, u₀ = {start} u_ins"), color, points));
    }
    let damping = Axis::new(match found.model.ratio() {
        Some(Ratio::CBar) => "c̄",
        Some(Ratio::Xi) | None => "damping ratio",
    });
    Plot::titled(
        format!("{}: best fits and −x ln e", label(found.model).name),
        Axis::new("e"),
        damping,
        series,
    )
}

/// Draws √Err over e at the middle a₁ and u₀.
fn least_errors(found: &[Calibration]) -> Plot {
    let mut title = String::new();
    let mut series = Vec::new();
    for calibration in found {
        let middle = calibration.coefficients[calibration.coefficients.len() / 2];
        title = format!("least error, a₁ = {}, u₀ = {} u_ins", middle.a1, middle.start);
        let fits = calibration.fits.iter().filter(|fit| (fit.a1, fit.start) == (middle.a1, middle.start));
        let points = fits.map(|fit| (fit.restitution, fit.error.sqrt())).collect();
        let Label { name, color, .. } = label(calibration.model);
        series.push(Series::marks(name, color, points));
    }
    Plot::titled(title, Axis::new("e"), Axis::new("√Err"), series)
}

/// Draws x over a₁, fitted and as printed.
fn over_stiffness(found: &[Calibration]) -> Plot {
    let mut series = Vec::new();
    let with_laws = found.iter().filter(|calibration| !calibration.laws.is_empty());
    for calibration in with_laws {
        let (start, law) = calibration.laws[calibration.laws.len() - 1];
        let points: Vec<_> =
            calibration.coefficients.iter().filter(|c| c.start == start).map(|c| (c.a1, c.x)).collect();
        let [low, high] =
            points.iter().fold([1.0_f64, 0.0], |[low, high], point| [low.min(point.0), high.max(point.0)]);
        let a1 = |part: i32| low + (high - low) * f64::from(part) / 100.0;
        let Label { name, color, .. } = label(calibration.model);
        let paper: Vec<_> = (0..=100)
            .filter_map(|part| printed(calibration.model, a1(part)).map(|x| (a1(part), x)))
            .collect();
        series.push(Series::dashed(&format!("{name}, paper"), color, paper));
        let fitted = (0..=100).map(|part| (a1(part), law.at(a1(part)))).collect();
        series.push(Series::line("", color, fitted));
        let name = format!("{name}: {:.3} a₁^{:.3}", law.q, law.r);
        series.push(Series::marks(&name, color, points));
    }
    Plot::titled("x over a₁", Axis::new("a₁"), Axis::new("x"), series)
}
