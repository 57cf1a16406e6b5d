//! The page of `wall stability`: heat maps of the error, with what is unstable marked, and the table of extremes.

use std::fmt::Write;

use rocking_wall::stability::{Axis, Cell, Extreme, Map};

use crate::figure::escaped;
use crate::stability::axis_words;

/// Size of a cell and of the margins \[px\].
const CELL: [f64; 2] = [26.0, 20.0];
const LEFT: f64 = 62.0;
const BOTTOM: f64 = 44.0;
const TOP: f64 = 6.0;
/// Exponents of the error at the ends of the colours.
const EXPONENTS: [f64; 2] = [-14.0, 0.0];

pub(crate) fn page(maps: &[Map], extremes: &[Extreme]) -> String {
    let section = |axis: Axis| {
        let figures: Vec<String> = maps.iter().filter(|map| map.axis == axis).map(figure).collect();
        figures.concat()
    };
    let mut rows = String::new();
    for extreme in extremes {
        let (class, verdict) = if extreme.holds() { ("holds", "holds") } else { ("broken", "broken") };
        let _ = writeln!(
            rows,
            "<tr class=\"{class}\"><td>{}</td><td>{}</td><td>{:.1e}</td><td>{:.0e}</td><td>{verdict}</td></tr>",
            escaped(extreme.name),
            escaped(extreme.what),
            extreme.figure,
            extreme.limit
        );
    }
    include_str!("heat_map.html")
        .replace("{{steps}}", &section(Axis::Step))
        .replace("{{ratios}}", &section(Axis::Ratio))
        .replace("{{scale}}", &scale())
        .replace("{{extremes}}", &rows)
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
    let [width, height] = CELL;
    let bottom = TOP + height * map.rows.len() as f64;
    let right = LEFT + width * map.columns.len() as f64;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {:.0} {:.0}\" role=\"img\" aria-label=\"error over a1 and {}\">",
        right + 8.0,
        bottom + BOTTOM,
        axis_words(map.axis)
    );
    for (r, (row, cells)) in map.rows.iter().zip(&map.cells).enumerate() {
        let y = bottom - height * (r + 1) as f64;
        let _ = write!(
            svg,
            "<text x=\"{:.0}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            LEFT - 5.0,
            y + 0.68 * height,
            number(*row)
        );
        for (c, (a1, cell)) in map.columns.iter().zip(cells).enumerate() {
            let x = LEFT + width * c as f64;
            let _ = write!(
                svg,
                "<rect x=\"{x:.0}\" y=\"{y:.0}\" width=\"{width}\" height=\"{height}\" fill=\"{}\">\
                 <title>a1 = {a1:.1e}, {} = {row:.1e}: {}</title></rect>",
                colour(cell.error),
                axis_words(map.axis),
                words(cell)
            );
            if !cell.stable {
                let _ = write!(
                    svg,
                    "<path d=\"M{:.0} {:.0}l{:.0} {:.0}m0 {:.0}l{:.0} {:.0}\" class=\"cross\"/>",
                    x + 8.0,
                    y + 5.0,
                    width - 16.0,
                    height - 10.0,
                    10.0 - height,
                    16.0 - width,
                    height - 10.0
                );
            }
        }
    }
    for (c, a1) in map.columns.iter().enumerate() {
        let x = LEFT + width * (c as f64 + 0.5);
        // whole powers of ten only
        if (a1.log10() - a1.log10().round()).abs() < 1e-6 {
            let _ = write!(
                svg,
                "<text x=\"{x:.0}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>",
                bottom + 15.0,
                number(*a1)
            );
        }
    }
    let axis = match map.axis {
        Axis::Step => "step (s)",
        Axis::Ratio => "ξ",
    };
    let _ = write!(
        svg,
        "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\">a₁</text><text transform=\"translate(12 {:.0}) rotate(-90)\" \
         text-anchor=\"middle\">{axis}</text></svg>",
        0.5 * (LEFT + right),
        bottom + 34.0,
        0.5 * (TOP + bottom)
    );
    svg
}

fn words(cell: &Cell) -> String {
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
    let share = ((error.max(1e-300).log10() - low) / (high - low)).clamp(0.0, 1.0);
    let stops = [
        [33.0, 76.0, 140.0],
        [120.0, 170.0, 210.0],
        [247.0, 240.0, 215.0],
        [232.0, 150.0, 90.0],
        [178.0, 34.0, 34.0],
    ];
    let place = share * (stops.len() - 1) as f64;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 3")]
    let index = (place as usize).min(stops.len() - 2);
    let part = place - index as f64;
    let mix =
        |channel: usize| stops[index][channel] + (stops[index + 1][channel] - stops[index][channel]) * part;
    format!("rgb({:.0},{:.0},{:.0})", mix(0), mix(1), mix(2))
}

/// The colours and their exponents.
fn scale() -> String {
    let [low, high] = EXPONENTS;
    let steps = 14;
    let mut svg = String::from(
        "<svg viewBox=\"0 0 420 44\" class=\"scale\" role=\"img\" aria-label=\"colours of the error\">",
    );
    for step in 0..=steps {
        let exponent = low + (high - low) * f64::from(step) / f64::from(steps);
        let x = 10.0 + 26.0 * f64::from(step);
        let _ = write!(
            svg,
            "<rect x=\"{x:.0}\" y=\"2\" width=\"26\" height=\"18\" fill=\"{}\"/>",
            colour(10.0_f64.powf(exponent))
        );
        if step % 2 == 0 {
            let _ = write!(
                svg,
                "<text x=\"{:.0}\" y=\"38\" text-anchor=\"middle\">1e{exponent:.0}</text>",
                x + 13.0
            );
        }
    }
    svg + "</svg>"
}
