//! Plots of one run: histories, the force on its backbone, and small rotations beside full ones.
//!
//! ```
//! let points: Vec<_> = (0..=100).map(|i| 0.1 * f64::from(i)).map(|t| (t, t.cos())).collect();
//! let plot = run::figure::history(&points, 10.0);
//! assert_eq!(plot.ranges()[..2], [0.0, 10.0]);
//! assert!(plot.svg().contains("u / u_ins"));
//! ```

use report::palette::{AMBER, BLUE, DARK_GREY, Mark, RED};
use report::plot::{Axis, Look, Plot, Series};
use report::points::{Point, Points, decimated, within};
use rocking_wall::wall::{Tie, Wall};
use scene::response::Sample;

/// Width of the plots \[px\].
pub const WIDTH: f64 = 620.0;
/// Largest |u|/`u_ins` of a history.
pub(crate) const EDGE: f64 = 1.25;
/// Distance below which points of a path are drawn as one, as a share of its plot.
const PATH_DETAIL: f64 = 1.0 / 400.0;
/// Ends a history of u/`u_ins` where it leaves the plot for good: drawn on, a fallen wall would look like one
/// at rest.
///
/// ```
/// use run::figure::cut;
///
/// let fallen = cut(vec![(0.0, 0.5), (0.1, 1.2), (0.2, 1.9), (0.3, 10.0)]);
/// assert_eq!(fallen, [(0.0, 0.5), (0.1, 1.2), (0.2, 1.25)]);
/// let held_by_a_tie = [(0.0, 0.5), (0.1, 1.4), (0.2, 0.3)];
/// assert_eq!(cut(held_by_a_tie.to_vec()), held_by_a_tie);
/// ```
pub fn cut(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let leaving = points.iter().rposition(|point| point.1.abs() <= EDGE).map_or(0, |within| within + 1);
    points.truncate(leaving + 1);
    if let Some(point) = points.get_mut(leaving) {
        point.1 = point.1.clamp(-EDGE, EDGE);
    }
    points
}

/// Draws u/`u_ins` over the time \[s\], with the limits ±1.
pub fn history(points: &[(f64, f64)], end: f64) -> Plot {
    let limits = [-1.0, 1.0];
    let plot = histories(&[(points, BLUE)], [0.0, end], "u / u_ins", &limits);
    Plot { size: [WIDTH, 250.0], limits: limits.map(|limit| (limit, RED)).to_vec(), ..plot }
}

/// Draws the acceleration of the bottom support and, where it has its own, of the top one \[m/s²\] over the
/// time \[s\].
pub fn motion(bottom: &[(f64, f64)], top: Option<&[(f64, f64)]>, end: f64) -> Plot {
    let top = top.map(|points| (points, AMBER));
    let lines: Vec<_> = [(bottom, DARK_GREY)].into_iter().chain(top).collect();
    histories(&lines, [0.0, end], "a (m/s²)", &[])
}

/// Draws lines in their colours over the times \[s\]. The vertical axis has the label, and its range includes
/// the values `shown`.
pub fn histories(
    lines: &[(&[(f64, f64)], &'static str)],
    times: [f64; 2],
    label: &str,
    shown: &[f64],
) -> Plot {
    let values = lines.iter().flat_map(|(points, _)| points.iter().map(|point| point.1));
    let y_range = padded(values.chain(shown.iter().copied()));
    let axes = [Axis::over("time (s)", times), Axis::over(label, y_range)];
    let series = lines.iter().map(|(points, color)| Series::stroke(color, 1.2, decimated(points, times[1])));
    Plot::new([WIDTH, 190.0], axes, series.collect())
}

/// Draws the restoring force of a run, F \[kN\] over u/`u_ins`, on its backbone. The force of a tie that
/// yields leaves it in loops. The history of u/`u_ins` is [`cut`].
pub fn force_path<'a>(
    wall: &Wall,
    samples: impl Iterator<Item = &'a Sample>,
    history: &[(f64, f64)],
) -> Plot {
    let u_ins = wall.body().instability;
    let backbone: Vec<_> =
        wall.backbone().iter().map(|&(u, force)| (u / u_ins.of(u), 1e-3 * force)).collect();
    let of = |pick: fn(f64, f64) -> f64| history.iter().map(|point| point.1).fold(0.0, pick);
    let [lowest, highest] = [of(f64::min), of(f64::max)];
    let breaks = wall.ties().iter().filter_map(Tie::fracture_displacement).reduce(f64::max);
    let breaks = breaks.map(|breaks| breaks / u_ins.positive);
    let reach = 1.05 * highest.max(-lowest).max(breaks.unwrap_or(1.0).min(1.0));
    let across = |range| within(&backbone, [range, [f64::NEG_INFINITY, f64::INFINITY]]).concat();
    let law = across([-reach, reach]);
    let y_range = padded(law.iter().map(|point| point.1));
    let apart = [2.0 * reach, y_range[1] - y_range[0]].map(|range| PATH_DETAIL * range);
    let path = if breaks.is_some() {
        let shown = samples.map(|Sample { outputs, .. }| (outputs.ratio, 1e-3 * outputs.restoring_force));
        let mut path: Vec<_> = shown.filter(|point| point.0.abs() <= EDGE).collect();
        path.dedup_by(|next, last| (next.0 - last.0).abs() < apart[0] && (next.1 - last.1).abs() < apart[1]);
        path
    } else {
        across([lowest, highest])
    };
    let law = Series { look: Look::Dashed, ..Series::stroke(RED, 1.0, law) };
    let axes = [Axis::over("u / u_ins", [-reach, reach]), Axis::over("restoring force F (kN)", y_range)];
    Plot::new([WIDTH, 320.0], axes, vec![law, Series::stroke(BLUE, 1.6, path)])
}

/// Adds the points of the capacity curve that the force law was made of to a plot of the force, where it
/// shows them.
pub(crate) fn with_points(mut plot: Plot, wall: &Wall, curve: &scene::Curve) -> Plot {
    let [left, right, ..] = plot.ranges();
    let points = curve.points.iter().map(|&[u, force]| (u / wall.body().instability.of(u), 1e-3 * force));
    let shown = points.filter(|point| (left..=right).contains(&point.0)).collect();
    plot.series.push(Series { look: Look::Marks(Mark::Circle), ..Series::stroke(AMBER, 2.0, shown) });
    plot
}

/// Draws u/`u_ins` over the time \[s\] with full rotations and, dashed, with small ones.
pub fn both_rotations(full: &[(f64, f64)], small: &[(f64, f64)], end: f64, height: f64) -> Plot {
    let mut plot = histories(&[(small, RED), (full, BLUE)], [0.0, end], "u / u_ins", &[]);
    plot.series[0].look = Look::Dashed;
    Plot { size: [WIDTH, height], ..plot }
}

/// Draws periods with small rotations over those with full ones, against the slenderness \[rad\]; `wall`
/// marks a point of its own.
pub fn period_ratios(ratios: Points, wall: Point, height: f64) -> Plot {
    let lowest = ratios.iter().map(|point| point.1).fold(1.0, f64::min);
    let widest = ratios.iter().map(|point| point.0).fold(0.0, f64::max);
    let room = 0.08 * (1.0 - lowest).max(1e-6);
    let axes = [
        Axis::over("slenderness α (rad)", [0.0, widest]),
        Axis::over("period, small / full rotations", [lowest - room, 1.0 + room]),
    ];
    let mark = Series { look: Look::Marks(Mark::Circle), ..Series::stroke(RED, 4.5, vec![wall]) };
    Plot::new([WIDTH, height], axes, vec![Series::stroke(BLUE, 1.4, ratios), mark])
}

/// The range of some values with room around it.
fn padded(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (low, high) = values.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    // nothing but zeros: an axis of ones
    let room = if high > low { 0.06 * (high - low) } else { 1.0 };
    [low - room, high + room]
}
