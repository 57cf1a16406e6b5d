//! The table `given.csv`: fragilities of the last shock, by the state of the walls before it.

use report::table::{Digits, Table};

use super::contents::Manifest;
use super::tables::{Kind, OF_INTENSITY};
use crate::fragility::{Sample, Weights, fit};
use crate::ida::{Before, Curve};
use crate::results::WallResults;

/// The table.
pub(crate) const GIVEN: Kind = ("given", given);

/// A state of a wall before the last shock.
#[derive(Clone, Copy)]
enum State {
    /// Any.
    Any,
    /// |u| has not exceeded this fraction of `u_ins`, and no tie has broken.
    Below(f64),
    /// |u| has exceeded this fraction of `u_ins`.
    Above(f64),
    /// A tie has broken.
    Broken,
}

impl State {
    fn name(self) -> String {
        match self {
            Self::Any => "any".into(),
            Self::Below(fraction) => format!("d <= {fraction}"),
            Self::Above(fraction) => format!("d > {fraction}"),
            Self::Broken => "tie broken".into(),
        }
    }

    fn holds(self, before: &Before) -> bool {
        match self {
            Self::Any => true,
            Self::Below(fraction) => before.demand <= fraction && !before.broken,
            Self::Above(fraction) => before.demand > fraction,
            Self::Broken => before.broken,
        }
    }
}

/// The fragility of every model and limit state in every state: that of the records that lead to it, each
/// limit state by itself, by maximum likelihood.
fn given(manifest: &Manifest, wall: usize, results: &WallResults) -> Table {
    let Manifest { report, contents, .. } = manifest;
    let least = report.given.iter().copied().fold(f64::INFINITY, f64::min);
    let broken = contents.walls[wall].has_yielding_tie.then_some(State::Broken);
    let above = report.given.iter().map(|fraction| State::Above(*fraction));
    let states: Vec<_> = [State::Any, State::Below(least)].into_iter().chain(above).chain(broken).collect();
    let row = |model: usize, state: State, fraction: f64| {
        let leads = |(_, curve): &(usize, &Curve)| curve.before().is_some_and(|before| state.holds(&before));
        let leading = results.curves(model).iter().enumerate().filter(leads);
        let weighed = leading.map(|(place, curve)| (report.weights.of_record(place), curve.clone()));
        let (weights, curves): (Vec<f64>, Vec<Curve>) = weighed.unzip();
        let sample = Sample::of_curves(&curves, fraction, report.collapse, contents.grid.as_deref());
        let sample = sample.weighted(&Weights::of(&weights));
        (model, state, fraction, curves.len(), fit(&sample).ok())
    };
    let models = 0..contents.models.len();
    let rows = models.flat_map(|model| states.iter().map(move |state| (model, *state)));
    let rows = rows.flat_map(|(model, state)| report.fractions.iter().map(move |d| row(model, state, *d)));
    Table::over(rows)
        .text("wall", "", |_| contents.walls[wall].name.clone())
        .text("model", "model", |row| contents.models[row.0].name.clone())
        .text("given", "given", |row| row.1.name())
        .number("u_max_over_u_ins", "d", Digits::AtMost(3), |row| row.2)
        .number("records", "records", Digits::AtMost(6), |row| row.3)
        .number(contents.in_unit("theta"), "θ", OF_INTENSITY, |row| {
            row.4.map(|curve| contents.unit.of(curve.median))
        })
        .number("beta", "β", OF_INTENSITY, |row| row.4.map(|curve| curve.dispersion))
        .done()
}
