//! Drawings of one size side by side, under a title and a legend, as an SVG file of its own.
//!
//! ```
//! use report::palette::{BLUE, Mark};
//!
//! let drawings = [("wall 1".to_owned(), "<svg viewBox=\"0 0 9 9\"></svg>".to_owned())];
//! let svg = report::sheet::sheet("Walls", &[(BLUE, Mark::Circle, "CDC")], &drawings, [9.0, 9.0]);
//! assert!(svg.starts_with("<svg xmlns") && svg.contains("wall 1") && svg.contains("●</tspan> CDC"));
//! ```

use std::fmt::Write;

use crate::escaped;
use crate::palette::{Mark, character};

/// Most drawings in a row.
const COLUMNS: usize = 3;
/// Heights of the head and of a caption, margin \[px\].
const HEAD: f64 = 56.0;
const CAPTION: f64 = 20.0;
const MARGIN: f64 = 12.0;

/// Puts drawings of a size \[px\], each with its caption, on a white sheet.
pub fn sheet(
    title: &str,
    legend: &[(&str, Mark, &str)],
    drawings: &[(String, String)],
    [width, height]: [f64; 2],
) -> String {
    let columns = drawings.len().clamp(1, COLUMNS);
    let size = [
        2.0 * MARGIN + width * columns as f64,
        HEAD + (CAPTION + height) * drawings.len().div_ceil(columns) as f64,
    ];
    let title = escaped(title);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0} {1:.0}\" \
         font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#1c1c1c\" role=\"img\" \
         aria-label=\"{title}\">\n\
         <rect width=\"{0:.0}\" height=\"{1:.0}\" fill=\"#fff\"/>\n\
         <text x=\"{MARGIN}\" y=\"22\" font-size=\"15\" font-weight=\"600\">{title}</text>\n\
         <text x=\"{MARGIN}\" y=\"42\" xml:space=\"preserve\">",
        size[0], size[1]
    );
    for (color, mark, name) in legend {
        let (character, name) = (character(*mark), escaped(name));
        let _ = write!(svg, "<tspan fill=\"{color}\">{character}</tspan> {name}    ");
    }
    svg.push_str("</text>\n");
    for (index, (caption, drawing)) in drawings.iter().enumerate() {
        let (x, y) =
            (MARGIN + width * (index % columns) as f64, HEAD + (CAPTION + height) * (index / columns) as f64);
        let place = format!("<svg x=\"{x}\" y=\"{:.0}\" width=\"{width}\" height=\"{height}\" ", y + CAPTION);
        let _ = writeln!(
            svg,
            "<text x=\"{:.0}\" y=\"{:.0}\" font-weight=\"600\">{}</text>{}",
            x + 6.0,
            y + 10.0,
            escaped(caption),
            drawing.replacen("<svg ", &place, 1)
        );
    }
    svg + "</svg>\n"
}
