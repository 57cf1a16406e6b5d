//! The maps and the extremes in words, as CSV, and as a page with heat maps.

use report::heat_map::{self, HeatMap, scale};
use report::page::Page;
use report::palette::mixed;
use report::table::{Digits, Table};

use super::{Map, RowQuantity};
use crate::Comparison;
use crate::comparison::{STYLE, html, table};

/// Size of a cell \[px\].
const CELL: [f64; 2] = [26.0, 20.0];
/// Exponents of the error at the ends of the colours.
const EXPONENTS: [f64; 2] = [-14.0, 0.0];

/// Returns the table of extremes.
pub fn of_extremes(extremes: &[Comparison]) -> Table {
    let headings = ["case", "what happens, and what the figure is", "", "", "figure", "", "limit", "result"];
    table(extremes, headings, Digits::Exponent(1))
}

/// Returns the line of a map: how many cells are unstable, and the largest error.
pub fn summary(map: &Map) -> String {
    let cells = || map.cells.iter().flatten();
    let unstable = cells().filter(|cell| !cell.stable).count();
    let worst = cells().map(|cell| cell.error).fold(0.0, f64::max);
    format!(
        "{:<10}{:<24} a1 x {:<5} {:>4} cells, {unstable:>3} unstable, largest error {worst:.1e}\n",
        map.solver.name(),
        map.damping.name(),
        map.quantity.names()[1],
        cells().count()
    )
}

/// Returns the table of the cells. The error is over `u_ins`, the growth over the energy at the start.
pub fn of_cells(maps: &[Map]) -> Table {
    let mut rows = Vec::new();
    for map in maps {
        for (value, cells) in map.rows.iter().zip(&map.cells) {
            rows.extend(map.columns.iter().zip(cells).map(|(a1, cell)| (map, *a1, *value, cell)));
        }
    }
    Table::over(rows)
        .value("solver", |(map, ..)| map.solver.name())
        .value("damping_model", |(map, ..)| map.damping.name())
        .value("axis", |(map, ..)| map.quantity.names()[0])
        .value("a1", |(_, a1, ..)| *a1)
        .value("value", |(.., value, _)| *value)
        .value("stable", |(.., cell)| cell.stable)
        .value("error", |(.., cell)| cell.error)
        .value("growth", |(.., cell)| cell.growth)
        .done()
}

/// Style of heat maps.
const MAPS: &str = "figure svg, svg.scale { font-size: 12px; }
svg.scale { display: block; width: 100%; max-width: 460px; }
rect:hover { stroke: #000; }";

/// Writes the page.
pub fn page(maps: &[Map], extremes: &[Comparison]) -> String {
    let drawn = |quantity: RowQuantity, words: &str| {
        let figures: String = maps.iter().filter(|map| map.quantity == quantity).map(figure).collect();
        format!("{words}<div class=\"figures\">\n{figures}</div>")
    };
    let steps = "<p>For <i>automatic</i> the step is the communication step; for <i>newmark</i> it is the \
                 step of the scheme.</p>\n";
    Page::new("Stability")
        .styled(MAPS)
        .styled(STYLE)
        .text(&format!(
            "<p>Each cell is a free motion of a parapet of 3 m by 0.3 m from 0.6 u<sub>ins</sub> over 4 s. \
             The colour is the largest error of u over u<sub>ins</sub>, compared with the exact solver, or \
             with the adaptive one at 1e-13 where there is no closed form. A cross marks an unstable run: \
             the energy grew in a step by more than 10<sup>−7</sup> of its start, |u| exceeded its start, or \
             a number was not finite. Point at a cell to see its figures.</p>\n{}",
            colours()
        ))
        .section("Over a₁ and the step, ξ = 0.03", &drawn(RowQuantity::Step, steps))
        .section("Over a₁ and ξ, step 5 ms", &drawn(RowQuantity::DampingRatio, ""))
        .section("Extremes", &html(&of_extremes(extremes)))
        .html()
}

fn figure(map: &Map) -> String {
    let [_, axis, label] = map.quantity.names();
    let paint = |row: usize, column: usize| {
        let (cell, a1, value) = (&map.cells[row][column], map.columns[column], map.rows[row]);
        heat_map::Cell {
            fill: colour(cell.error),
            title: format!(
                "a1 = {a1:.1e}, {axis} = {value:.1e}: {}, error {:.1e}, growth of the energy {:.1e}",
                if cell.stable { "stable" } else { "unstable" },
                cell.error,
                cell.growth
            ),
            crossed: !cell.stable,
        }
    };
    let axis_of = |label: &str, values: &[f64]| {
        let ticks =
            values.iter().enumerate().map(|(index, value)| (index as f64 + 0.5, format!("{value:.0e}")));
        heat_map::Axis { label: label.into(), count: values.len(), ticks: ticks.collect() }
    };
    let drawing = HeatMap {
        label: format!("error over a1 and {axis}"),
        columns: axis_of("a₁", &map.columns),
        rows: axis_of(label, &map.rows),
        size: CELL,
        own: None,
        cells: &paint,
    };
    format!(
        "<figure><figcaption><b>{}</b>, {}</figcaption>{}</figure>\n",
        map.solver.name(),
        map.damping.name().replace('_', " "),
        drawing.svg()
    )
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
