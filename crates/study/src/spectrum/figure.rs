//! Rocking spectra as heat maps.
//!
//! ```
//! use study::spectrum::figure::{Shown, svg};
//! use study::spectrum::{Point, QUANTITIES, RockingSpectrum};
//!
//! let still = Point { ratio: 0.01, rocked: false, overturning: None };
//! let fallen = Point { ratio: 1.0, rocked: true, overturning: Some(2.5) };
//! let points = vec![vec![still; 2], vec![still, fallen]];
//! let quantities = [QUANTITIES[4], QUANTITIES[5]];
//! let spectrum = RockingSpectrum { quantities, columns: vec![2.0, 4.0], rows: vec![0.5, 5.0], points };
//! let shown = Shown {
//!     spectrum,
//!     title: "Rocking spectrum".into(),
//!     notes: Vec::new(),
//!     axes: String::new(),
//!     own: None,
//! };
//! // an index stands low
//! assert!(svg(&shown).contains(&report::label("a_p / a₀")));
//! ```

use crate::spectrum::{Own, Point, RockingSpectrum};

use report::heat_map::{Axis, Cell, HeatMap, place, scale};
use report::number;
use report::palette::{Mark, mixed};
use report::sheet::sheet;

/// A spectrum with its texts.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The spectrum.
    pub spectrum: RockingSpectrum,
    /// Title.
    pub title: String,
    /// Facts about the spectrum. A file has no room for the last one.
    pub notes: Vec<String>,
    /// Explains the axes.
    pub axes: String,
    /// The scene's own wall: its place on the axes, and its result.
    pub own: Option<Own>,
}

/// What the plot area of a file should measure \[px\].
const FILE_AREA: [f64; 2] = [580.0, 340.0];
/// Colours of walls that do not rock, and of those that overturn.
pub const STILL: &str = "#ffffff";
/// See [`STILL`].
pub const FALLEN: &str = "#a32020";
/// From pale to dark blue.
const ROCKING: [[f64; 3]; 4] =
    [[226.0, 236.0, 247.0], [150.0, 194.0, 223.0], [60.0, 135.0, 190.0], [22.0, 58.0, 112.0]];

/// The scene's own wall and its result.
pub fn own_words(shown: &Shown, own: &Own) -> String {
    let Own { place: [x, y], point } = *own;
    let [size, slenderness] = shown.spectrum.quantities.map(|quantity| quantity.label);
    let outside = if place(&shown.spectrum.columns, x).and(place(&shown.spectrum.rows, y)).is_none() {
        ", outside the map"
    } else {
        ""
    };
    format!("{size} = {}, {slenderness} = {}: {}{outside}", number(x, 4), number(y, 4), words_of(point))
}

/// Describes the result of a wall.
fn words_of(point: Point) -> String {
    match point {
        Point { overturning: Some(time), .. } => format!("overturns at {time:.3} s"),
        Point { rocked: false, ratio, .. } => format!("does not rock, u_max/u_ins = {ratio:.2e}"),
        Point { ratio, .. } => format!("u_max/u_ins = {ratio:.4}"),
    }
}

/// Draws the map over an area \[px\], with its width and height. If `named`, cells show their results when
/// pointed at.
pub fn map(shown: &Shown, area: [f64; 2], named: bool) -> (String, [f64; 2]) {
    let RockingSpectrum { quantities, columns, rows, points } = &shown.spectrum;
    let [x, y] = quantities.map(|quantity| quantity.label);
    let paint = |row: usize, column: usize| {
        let point = points[row][column];
        let fill = match point {
            Point { overturning: Some(_), .. } => FALLEN.into(),
            Point { rocked: false, .. } => STILL.into(),
            Point { ratio, .. } => mixed(&ROCKING, ratio),
        };
        let title = if named {
            format!("{x} = {}, {y} = {}: {}", columns[column], rows[row], words_of(point))
        } else {
            String::new()
        };
        Cell { fill, title, crossed: false }
    };
    let side = |area: f64, count: usize| (area / count as f64).floor().max(2.0);
    let map = HeatMap {
        label: "u_max/u_ins of rocking walls".into(),
        columns: Axis::even(x, columns),
        rows: Axis::even(y, rows),
        size: [side(area[0], columns.len()), side(area[1], rows.len())],
        own: shown.own.as_ref().and_then(|Own { place: [x, y], .. }| {
            Some(([place(columns, *x)?, place(rows, *y)?], "your wall"))
        }),
        cells: &paint,
    };
    (map.svg(), map.extent())
}

/// Draws the scale of the colours of u/`u_ins`.
pub fn legend() -> String {
    let swatches: Vec<_> = (0..=10_u32)
        .map(|step| {
            let ratio = f64::from(step) / 10.0;
            (mixed(&ROCKING, ratio), (step % 2 == 0).then(|| format!("{ratio:.1}")))
        })
        .collect();
    scale("colours of u_max/u_ins", &swatches)
}

/// Draws the map as an SVG file of its own.
pub fn svg(shown: &Shown) -> String {
    let (drawing, size) = map(shown, FILE_AREA, false);
    // there is no room for the last note, the force law
    let caption = shown.notes[..shown.notes.len().saturating_sub(1)].join("; ");
    let pale = mixed(&ROCKING, 0.1);
    let dark = mixed(&ROCKING, 1.0);
    let legend = [
        (&*pale, Mark::Square, "rocks a little"),
        (&dark, Mark::Square, "rocks up to u_ins"),
        (FALLEN, Mark::Square, "overturns (white: does not rock)"),
    ];
    sheet(&shown.title, &legend, &[(caption, drawing)], size)
}
