//! The map of `wall spectrum`, as a page and as a file.

use figures::heat_map::{Axis, Cell, HeatMap, place, scale};
use figures::palette::{Mark, mixed};
use figures::sheet::sheet;
use figures::{escaped, number, template};
use study::spectrum::{Point, RockingSpectrum};

/// A spectrum with its texts.
pub(crate) struct Shown {
    pub(crate) spectrum: RockingSpectrum,
    pub(crate) title: String,
    pub(crate) notes: Vec<String>,
    /// Labels of the columns and the rows, for the page.
    pub(crate) labels: [&'static str; 2],
    /// Their names in the CSV file.
    pub(crate) names: [&'static str; 2],
    /// Explains the axes.
    pub(crate) axes: String,
    /// The scene's own wall: its place on the axes, and its result.
    pub(crate) own: Option<([f64; 2], Point)>,
}

/// Says the result of a wall.
fn words_of(point: Point) -> String {
    match point {
        Point { overturning: Some(time), .. } => format!("overturns at {time:.3} s"),
        Point { rocked: false, ratio, .. } => format!("does not rock, u_max/u_ins = {ratio:.2e}"),
        Point { ratio, .. } => format!("u_max/u_ins = {ratio:.4}"),
    }
}

/// The scene's own wall and its result.
pub(crate) fn own_words(shown: &Shown, ([x, y], point): &([f64; 2], Point)) -> String {
    let [size, slenderness] = shown.labels;
    let outside = if place(&shown.spectrum.columns, *x).and(place(&shown.spectrum.rows, *y)).is_none() {
        ", outside the map"
    } else {
        ""
    };
    format!("{size} = {}, {slenderness} = {}: {}{outside}", number(*x, 4), number(*y, 4), words_of(*point))
}

/// What the plot area should measure \[px\].
const AREA: [f64; 2] = [960.0, 560.0];
/// That of a file.
const FILE_AREA: [f64; 2] = [580.0, 340.0];
const STILL: &str = "#ffffff";
const FALLEN: &str = "#a32020";
/// From pale to dark blue.
const ROCKING: [[f64; 3]; 4] =
    [[226.0, 236.0, 247.0], [150.0, 194.0, 223.0], [60.0, 135.0, 190.0], [22.0, 58.0, 112.0]];

/// Draws the map over an area \[px\], with its width and height; its cells say what they are if `named`.
fn map(shown: &Shown, area: [f64; 2], named: bool) -> (String, [f64; 2]) {
    let RockingSpectrum { columns, rows, points } = &shown.spectrum;
    let paint = |row: usize, column: usize| {
        let point = points[row][column];
        let fill = match point {
            Point { overturning: Some(_), .. } => FALLEN.into(),
            Point { rocked: false, .. } => STILL.into(),
            Point { ratio, .. } => mixed(&ROCKING, ratio),
        };
        let [x, y] = shown.labels;
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
        columns: Axis::even(shown.labels[0], columns),
        rows: Axis::even(shown.labels[1], rows),
        size: [side(area[0], columns.len()), side(area[1], rows.len())],
        own: shown
            .own
            .as_ref()
            .and_then(|&([x, y], _)| Some(([place(columns, x)?, place(rows, y)?], "your wall"))),
        cells: &paint,
    };
    (map.svg(), map.extent())
}

pub(crate) fn page(shown: &Shown) -> String {
    let swatches: Vec<_> = (0..=10_u32)
        .map(|step| {
            let ratio = f64::from(step) / 10.0;
            (mixed(&ROCKING, ratio), (step % 2 == 0).then(|| format!("{ratio:.1}")))
        })
        .collect();
    let own = shown.own.as_ref().map_or_else(String::new, |own| {
        format!("<p><b>Your wall:</b> {}.</p>", escaped(&own_words(shown, own)))
    });
    template::page(
        include_str!("spectrum.html"),
        &[
            ("title", &escaped(&shown.title)),
            ("subtitle", &escaped(&shown.notes.join("; "))),
            ("axes", &escaped(&shown.axes)),
            ("own", &own),
            ("still", STILL),
            ("fallen", FALLEN),
            ("scale", &scale("colours of u_max/u_ins", &swatches)),
            ("map", &map(shown, AREA, true).0),
        ],
    )
}

/// Draws the map as an SVG file of its own.
pub(crate) fn svg(shown: &Shown) -> String {
    let (drawing, size) = map(shown, FILE_AREA, false);
    // the last note, the force law, has no room
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
