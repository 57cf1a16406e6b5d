//! The page of `wall stability`: heat maps of the error, with unstable cells crossed out, and the table of
//! extremes.

use std::fmt::Write;

use report::escaped;
use report::heat_map::{self, HeatMap, scale};
use report::palette::mixed;
use report::template;

use super::{Extreme, Map, MapCell, RowQuantity};

/// Size of a cell \[px\].
const CELL: [f64; 2] = [26.0, 20.0];
/// Exponents of the error at the ends of the colours.
const EXPONENTS: [f64; 2] = [-14.0, 0.0];

/// Writes the page.
pub fn page(maps: &[Map], extremes: &[Extreme]) -> String {
    let section = |quantity: RowQuantity| {
        let figures: Vec<String> = maps.iter().filter(|map| map.quantity == quantity).map(figure).collect();
        figures.concat()
    };
    let mut rows = String::new();
    for extreme in extremes {
        let class = if extreme.holds() { "holds" } else { "broken" };
        let _ = writeln!(
            rows,
            "<tr class=\"{class}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{class}</td></tr>",
            escaped(extreme.name),
            escaped(extreme.criterion),
            scientific(extreme.value, 1),
            scientific(extreme.limit, 0)
        );
    }
    template::page(
        include_str!("page.html"),
        &[
            ("title", "Stability"),
            ("steps", &section(RowQuantity::Step)),
            ("ratios", &section(RowQuantity::DampingRatio)),
            ("scale", &colours()),
            ("extremes", &rows),
        ],
    )
}

/// Writes a number with an exponent, and 0 without.
pub fn scientific(value: f64, decimals: usize) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.decimals$e}") }
}

/// Words for the second axis.
pub fn axis_words(quantity: RowQuantity) -> &'static str {
    match quantity {
        RowQuantity::Step => "step",
        RowQuantity::DampingRatio => "xi",
    }
}

fn figure(map: &Map) -> String {
    format!(
        "<figure><figcaption><b>{}</b>, {}</figcaption>{}</figure>\n",
        map.solver.name(),
        map.damping.name().replace('_', " "),
        drawing(map)
    )
}

fn drawing(map: &Map) -> String {
    let axis = axis_words(map.quantity);
    let paint = |row: usize, column: usize| {
        let (cell, a1, value) = (&map.cells[row][column], map.columns[column], map.rows[row]);
        heat_map::Cell {
            fill: colour(cell.error),
            title: format!("a1 = {a1:.1e}, {axis} = {value:.1e}: {}", words(cell)),
            crossed: !cell.stable,
        }
    };
    let middles = |values: &[f64]| -> Vec<(f64, String)> {
        values.iter().enumerate().map(|(index, value)| (index as f64 + 0.5, number(*value))).collect()
    };
    let mut columns = middles(&map.columns);
    // only whole powers of ten have a label
    let mut values = map.columns.iter();
    columns.retain(|_| values.next().is_some_and(|a1| (a1.log10() - a1.log10().round()).abs() < 1e-6));
    let label = match map.quantity {
        RowQuantity::Step => "step (s)",
        RowQuantity::DampingRatio => "ξ",
    };
    HeatMap {
        label: format!("error over a1 and {axis}"),
        columns: heat_map::Axis { label: "a₁".into(), count: map.columns.len(), ticks: columns },
        rows: heat_map::Axis { label: label.into(), count: map.rows.len(), ticks: middles(&map.rows) },
        size: CELL,
        own: None,
        cells: &paint,
    }
    .svg()
}

fn words(cell: &MapCell) -> String {
    let verdict = if cell.stable { "stable" } else { "unstable" };
    format!("{verdict}, error {:.1e}, growth of the energy {:.1e}", cell.error, cell.growth)
}

/// Short numbers for axes.
fn number(value: f64) -> String {
    match value {
        0.01..0.1 => format!("{value:.2}"),
        _ if value > 0.0 && value < 0.01 => format!("{value:.0e}"),
        _ => format!("{value}"),
    }
}

/// From dark blue (small) over pale to dark red (large), as exponents go.
fn colour(error: f64) -> String {
    if !error.is_finite() {
        return "#5c0a12".into();
    }
    let [low, high] = EXPONENTS;
    let stops = [
        [33.0, 76.0, 140.0],
        [120.0, 170.0, 210.0],
        [247.0, 240.0, 215.0],
        [232.0, 150.0, 90.0],
        [178.0, 34.0, 34.0],
    ];
    mixed(&stops, (error.max(1e-300).log10() - low) / (high - low))
}

/// The colours and their exponents.
fn colours() -> String {
    let [low, high] = EXPONENTS;
    let steps = 14;
    let swatches: Vec<_> = (0..=steps)
        .map(|step| {
            let exponent = low + (high - low) * f64::from(step) / f64::from(steps);
            (
                colour(10.0_f64.powf(exponent)),
                (step % 2 == 0)
                    .then(|| if exponent == 0.0 { "1".to_owned() } else { format!("1e{exponent:.0}") }),
            )
        })
        .collect();
    scale("colours of the error", &swatches)
}
