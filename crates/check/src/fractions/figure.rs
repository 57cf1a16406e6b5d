//! The capacity curve over the demand.

use ::report::palette::{BLUE, DARK_GREY, RED};
use ::report::plot::{Axis, Look, Plot, Series};
use ::report::points::within;
use rocking_wall::wall::Wall;

use super::demand::Demand;
use super::sides::SideCheck;
use crate::error::CheckError;
use crate::sections::origin::Figure;
use crate::words::{Language, Sentence, fixed, say};

/// Draws the capacity curve of a side over the demand.
///
/// # Errors
/// [`CheckError`] for a period that the demand does not have.
pub(super) fn figure(
    wall: &Wall,
    demand: &Demand,
    side: &SideCheck,
    language: Language,
) -> Result<Figure, CheckError> {
    let (d_s, a_s) = (side.secant_displacement, side.secant_acceleration);
    let right = 1.25 * side.displacement_capacity.max(side.displacement_demand);
    let corners = wall.capacity_corners(side.sign);
    let curve: Vec<_> =
        corners.iter().map(|corner| (corner.spectral_displacement, corner.spectral_acceleration)).collect();
    let spectrum = demand.drawn(side.secant_period)?;
    let points = curve.iter().chain(&spectrum).filter(|point| point.0 <= right);
    let top = 1.08 * points.map(|point| point.1).fold(0.0, f64::max);
    let in_mm = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
        let pieces = within(points, [[0.0, right], [0.0, top]]).concat();
        pieces.into_iter().map(|(d, a)| (1000.0 * d, a)).collect()
    };
    let longest = (right / d_s).min(top / a_s);
    let capacity = 1000.0 * side.displacement_capacity;
    let named = |name: Sentence, line: Series| Series { name: name.of(language).to_owned(), ..line };
    let dashed = |points| Series { look: Look::Dashed, ..Series::stroke(DARK_GREY, 1.3, points) };
    let period = fixed(side.secant_period, 3);
    let series = vec![
        named(say!("demand", "domanda"), Series::stroke(RED, 1.6, in_mm(&spectrum))),
        named(say!("capacity curve", "curva di capacità"), Series::stroke(BLUE, 2.0, in_mm(&curve))),
        named(
            say!("secant, T = {period} s", "secante, T = {period} s", period),
            dashed(vec![(0.0, 0.0), (1000.0 * longest * d_s, longest * a_s)]),
        ),
        named(
            say!("displacement capacity", "capacità di spostamento"),
            dashed(vec![(capacity, 0.0), (capacity, top)]),
        ),
    ];
    let axes = [Axis::over("d*, S_d (mm)", [0.0, 1000.0 * right]), Axis::over("a*, S_a (m/s²)", [0.0, top])];
    let caption = say! {
        "Capacity curve of the governing side over the demand in acceleration and displacement.",
        "Curva di capacità del verso determinante e domanda, in accelerazione e spostamento."
    };
    Ok(Figure { caption: caption.markup(language), plot: Plot::new([820.0, 460.0], axes, series) })
}
