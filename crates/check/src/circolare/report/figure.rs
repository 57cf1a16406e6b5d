//! Spectra, and capacity over demand.

use ::report::palette::{BLACK, BLUE, GREEN, Mark, RED};
use ::report::plot::{Axis, Look, Plot, Series};
use ::report::points::simplified;

use crate::circolare::checks::DisplacementCheck;
use crate::circolare::checks::sides::SideVerdict;
use crate::circolare::statement::Statement;
use crate::circolare::statement::states::StateStatement;
use crate::error::CheckError;
use crate::ntc::demand::Demand;
use crate::words::names::LimitState;
use crate::words::{Language, Sentence, say};

/// Size of spectra and of capacity over demand \[px\].
const SIZE: [f64; 2] = [820.0, 400.0];
/// Steps of a spectrum along the periods.
const STEPS: u32 = 400;
/// Mark of what a wall can take.
const CAPACITY: Mark = Mark::Circle;
/// Mark of what is demanded.
const DEMAND: Mark = Mark::Triangle;

/// The colour of a limit state.
fn color(state: LimitState) -> &'static str {
    match state {
        LimitState::Sld => GREEN,
        LimitState::Slv => BLUE,
        LimitState::Slc => RED,
    }
}

/// A demand as it is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawn<'a> {
    /// Limit state.
    pub(crate) state: LimitState,
    /// Its demand.
    pub(crate) demand: &'a Demand,
    /// ξ \[-\].
    pub(crate) damping: f64,
    /// Period to mark; 0 for a rigid wall \[s\].
    pub(crate) period: Option<f64>,
}

/// Periods of a spectrum from 0 to `last`.
fn periods(last: f64) -> impl Iterator<Item = f64> {
    (0..=STEPS).map(move |step| last * f64::from(step) / f64::from(STEPS))
}

/// Draws spectra over the period up to `last` \[s\], or where given points end.
///
/// # Errors
/// [`CheckError`] of a record, or of points with another damping.
pub(crate) fn spectra(
    demands: &[Drawn<'_>],
    label: &str,
    last: f64,
    language: Language,
) -> Result<Plot, CheckError> {
    let (mut lines, mut marks, mut top) = (Vec::new(), Vec::new(), 0.0_f64);
    for Drawn { state, demand, damping, period } in demands {
        let at = |period: f64| Ok((period, demand.acceleration(*state, period, *damping)?));
        let end = last.min(demand.last_period());
        let points = periods(end).map(at).collect::<Result<Vec<_>, CheckError>>()?;
        top = points.iter().map(|point| point.1).fold(top, f64::max);
        let name = format!("{state}, {} %", language.shown(100.0 * damping));
        lines.push((name, color(*state), points));
        if let Some(period) = period {
            let place = vec![at(*period)?];
            marks.push(Series { look: Look::Marks(DEMAND), ..Series::stroke(color(*state), 5.0, place) });
        }
    }
    let axes = [Axis::over("T (s)", [0.0, last]), Axis::over(label, [0.0, 1.08 * top])];
    let [width, height] = SIZE;
    let scale = [width / last, height / top];
    let lines = lines.into_iter().map(|(name, color, points)| Series {
        name,
        ..Series::stroke(color, 1.8, simplified(&points, scale))
    });
    Ok(Plot::new(SIZE, axes, lines.chain(marks).collect()))
}

/// Draws the curve a(d) of a side over the demands of SLV and SLC, in acceleration and displacement: the
/// secants to `d_SLV` and `d_SLC` (dashed), the rays of `T_SLV` and `T_SLC` (dotted) and the demands on them.
/// `cut` ends the axis of d before the curve ends \[m\].
///
/// # Errors
/// [`CheckError`] of a record, or of points with another damping.
pub(crate) fn over_demand(
    side: &SideVerdict,
    statement: &Statement,
    demands: &[Option<Demand>; 3],
    cut: Option<f64>,
    language: Language,
) -> Result<Plot, CheckError> {
    let of = |said: Sentence| said.of(language).to_owned();
    let corners = side.curve.corners();
    let shown = side.by_displacement().filter_map(|(state, check)| {
        Some((statement.state(state)?, demands[state as usize].as_ref()?, check))
    });
    let shown: Vec<(&StateStatement, &Demand, DisplacementCheck)> = shown.collect();
    // the demand on the ray of its period
    let place = |check: &DisplacementCheck| {
        (check.demand, check.demand * (std::f64::consts::TAU / check.period).powi(2))
    };
    let ends = shown.iter().map(|(.., check)| place(check)).chain(corners.iter().copied());
    let last = cut.unwrap_or(f64::INFINITY);
    let ends = ends.filter(|end| end.0 <= last);
    let (right, top) = ends.fold((0.0_f64, 0.0_f64), |(d, a), end| (d.max(end.0), a.max(end.1)));
    // the plateau of a spectrum is far above what the wall takes
    let (right, top) = (cut.unwrap_or(1.1 * right), 1.35 * top);
    let [width, height] = SIZE;
    let scale = [width / right, height / top];
    let (mut series, mut marks) = (Vec::new(), Vec::new());
    let longest = shown.iter().map(|(.., check)| check.period).fold(0.0, f64::max);
    for (given, demand, check) in shown {
        let color = color(given.state);
        let last = demand.last_period().min(2.0 * longest);
        let at = |period: f64| {
            let displacement = demand.spectral_displacement(given.state, period, given.damping)?;
            let acceleration = displacement * (std::f64::consts::TAU / period).powi(2);
            Ok((displacement, acceleration))
        };
        let points = periods(last).skip(1).map(at).collect::<Result<Vec<_>, CheckError>>()?;
        let state = given.state;
        let spectrum = Series {
            name: of(say!("spectrum of {state}", "spettro allo {state}", state)),
            ..Series::stroke(color, 1.3, points)
        };
        for piece in spectrum.within([[0.0, right], [0.0, top]]) {
            series.push(Series { points: simplified(&piece.points, scale), ..piece });
        }
        let ray = |look, name, to| Series { look, name, ..Series::stroke(color, 1.2, vec![(0.0, 0.0), to]) };
        series.push(ray(
            Look::Dashed,
            of(say!("secant to d_{state}", "secante a d_{state}", state)),
            (check.d, check.a),
        ));
        series.push(ray(Look::Dotted, format!("T_{state}"), place(&check)));
        let mark =
            |mark, name, at| Series { look: Look::Marks(mark), name, ..Series::stroke(color, 5.0, vec![at]) };
        marks.push(mark(CAPACITY, format!("d_{state}"), (check.d, check.a)));
        marks.push(mark(DEMAND, of(say!("demand of {state}", "domanda allo {state}", state)), place(&check)));
    }
    let curve = Series::stroke(BLACK, 2.2, corners);
    series.push(Series { name: of(say!("capacity, with FC", "capacità, con FC")), ..curve });
    series.extend(marks);
    let in_mm = |(d, a): (f64, f64)| (1000.0 * d, a);
    for line in &mut series {
        line.points = line.points.iter().copied().map(in_mm).collect();
    }
    let axes = [Axis::over("d, S_d (mm)", [0.0, 1000.0 * right]), Axis::over("a, S_e (m/s²)", [0.0, top])];
    Ok(Plot::new(SIZE, axes, series))
}
