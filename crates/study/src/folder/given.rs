//! The table `given.csv`: fragilities of the last shock, by the state of the walls before it.

use fragility::{Sample, Weights, fit};
use report::table::{Digits, Table};

use super::contents::Manifest;
use super::tables::{Kind, OF_INTENSITY};
use crate::ida::{Curve, Run};
use crate::results::WallResults;

/// The table.
pub(crate) const GIVEN: Kind = ("given", given);

/// The fragility of every model and limit state in every state: that of the records that lead to it, each
/// limit state by itself, by maximum likelihood. States overlap.
fn given(manifest: &Manifest, wall: usize, results: &WallResults) -> Table {
    let (report, contents) = (&manifest.report, &manifest.contents);
    let [lowest, highest] = [f64::NEG_INFINITY, f64::INFINITY];
    let least = report.given.iter().copied().fold(highest, f64::min);
    // a range of |u|/u_ins, and whether a tie has broken, where that counts
    let any = ("any".to_owned(), [lowest, highest], None);
    let below = (format!("d <= {least}"), [lowest, least], Some(false));
    let above = report.given.iter().map(|d| (format!("d > {d}"), [*d, highest], None));
    let broken = ("tie broken".to_owned(), [lowest, highest], Some(true));
    let broken = contents.walls[wall].has_yielding_tie.then_some(broken);
    let states: Vec<_> = [any, below].into_iter().chain(above).chain(broken).collect();
    let mut rows = Vec::new();
    for model in 0..contents.models.len() {
        for (name, range, broken) in &states {
            let holds = |run: &Run| {
                run.demand > range[0]
                    && run.demand <= range[1]
                    && broken.is_none_or(|broken| broken == run.tie.is_some_and(|tie| tie.broken))
            };
            let leads = |(_, curve): &(usize, &Curve)| curve.before().is_some_and(holds);
            let leading = results.curves(model).iter().enumerate().filter(leads);
            let weighed = leading.map(|(place, curve)| (report.weights.of_record(place), curve.clone()));
            let (weights, curves): (Vec<f64>, Vec<Curve>) = weighed.unzip();
            rows.extend(report.fractions.iter().map(|&fraction| {
                let sample = Sample::of_curves(&curves, fraction, report.collapse, contents.grid.as_deref());
                let sample = sample.weighted(&Weights::of(&weights));
                (model, name.clone(), fraction, curves.len(), fit(&sample).ok())
            }));
        }
    }
    Table::over(rows)
        .text("wall", "", |_| contents.walls[wall].name.clone())
        .text("model", "model", |row| contents.models[row.0].name.clone())
        .text("given", "given", |row| row.1.clone())
        .number("u_max_over_u_ins", "|u|/u_ins", Digits::AtMost(3), |row| row.2)
        .number("records", "records", Digits::AtMost(6), |row| row.3)
        .number(contents.in_unit("theta"), format!("θ [{}]", contents.unit.name()), OF_INTENSITY, |row| {
            row.4.map(|curve| contents.unit.of(curve.median))
        })
        .number("beta", "β", OF_INTENSITY, |row| row.4.map(|curve| curve.dispersion))
        .done()
}
