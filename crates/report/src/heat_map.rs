//! Heat maps as inline SVG: cells in colours with a title each, two axes, and the scale of the colours.
//!
//! ```
//! use report::heat_map::{Axis, Cell, HeatMap, scale};
//!
//! let values = [1.0, 2.0, 3.0];
//! let svg = HeatMap {
//!     label: "sums".into(),
//!     columns: Axis::even("a", &values),
//!     rows: Axis::even("b", &values),
//!     size: [26.0, 20.0],
//!     own: None,
//!     cells: &|row, column| Cell { fill: "#fff".into(), title: (row + column).to_string(), crossed: false },
//! }
//! .svg();
//! assert_eq!(svg.matches("<title>").count(), 9);
//! assert!(scale("colours", &[("#fff".into(), Some("0".into()))]).contains(">0</text>"));
//! ```

use std::fmt::Write;

use crate::axes::{ticks as round, write_text, write_upwards};

/// Margins around the cells \[px\].
const LEFT: f64 = 62.0;
const RIGHT: f64 = 8.0;
const BOTTOM: f64 = 44.0;
const TOP: f64 = 6.0;
/// Half the width of a character, with some space \[px\].
const HALF_CHARACTER: f64 = 4.5;

/// A map of cells, the first row at the bottom.
pub struct HeatMap<'a> {
    /// What the map shows, in words for screen readers.
    pub label: String,
    /// The horizontal axis.
    pub columns: Axis,
    /// The vertical axis.
    pub rows: Axis,
    /// Width and height of a cell \[px\].
    pub size: [f64; 2],
    /// A place to mark with words: cells from the start of the columns and of the rows.
    pub own: Option<([f64; 2], &'a str)>,
    /// The cell of a row and a column.
    pub cells: &'a dyn Fn(usize, usize) -> Cell,
}

/// An axis: its label, the number of cells along it, and marks at places counted in cells from its start.
pub struct Axis {
    /// Quantity, and its unit in brackets.
    pub label: String,
    /// Number of cells.
    pub count: usize,
    /// Places and texts of the marks.
    pub ticks: Vec<(f64, String)>,
}

/// How a cell looks, and the text shown when it is pointed at.
pub struct Cell {
    /// Colour.
    pub fill: String,
    /// Text shown when the cell is pointed at, as markup; none if empty.
    pub title: String,
    /// Whether it is crossed out.
    pub crossed: bool,
}

impl Axis {
    /// An axis of evenly spaced values at the middles of its cells, marked at round numbers.
    pub fn even(label: &str, values: &[f64]) -> Self {
        let count = values.len();
        let mut ticks = Vec::new();
        if let [first, .., last] = *values {
            let marked = |(tick, text)| place(values, tick).map(|place| (place, text));
            ticks = round([first, last], 7.0).into_iter().filter_map(marked).collect();
        }
        Self { label: label.to_owned(), count, ticks }
    }
}

/// Returns where a value is along an axis of evenly spaced ones, in cells from its start; `None` outside.
///
/// ```
/// assert_eq!(report::heat_map::place(&[1.0, 2.0, 3.0], 2.5), Some(2.0));
/// assert_eq!(report::heat_map::place(&[1.0, 2.0, 3.0], 3.6), None);
/// ```
pub fn place(values: &[f64], value: f64) -> Option<f64> {
    let [first, .., last] = *values else { return None };
    let place = (value - first) / (last - first) * (values.len() as f64 - 1.0) + 0.5;
    (0.0..=values.len() as f64).contains(&place).then_some(place)
}

impl HeatMap<'_> {
    /// Returns width and height of the drawing \[px\].
    pub fn extent(&self) -> [f64; 2] {
        let [width, height] = self.size;
        let (columns, rows) = (self.columns.count as f64, self.rows.count as f64);
        [LEFT + width * columns + RIGHT, TOP + height * rows + BOTTOM]
    }

    /// Draws the map.
    pub fn svg(&self) -> String {
        let ([width, height], [all, high]) = (self.size, self.extent());
        let (right, bottom) = (all - RIGHT, high - BOTTOM);
        let mut svg =
            format!("<svg viewBox=\"0 0 {all:.0} {high:.0}\" role=\"img\" aria-label=\"{}\">", self.label);
        svg.push_str("<g shape-rendering=\"crispEdges\">");
        for row in 0..self.rows.count {
            let y = bottom - height * (row + 1) as f64;
            for column in 0..self.columns.count {
                self.draw_cell(&mut svg, [LEFT + width * column as f64, y], (self.cells)(row, column));
            }
        }
        svg.push_str("</g>");
        let _ = write!(
            svg,
            "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{:.0}\" height=\"{:.0}\" class=\"frame\" \
             fill=\"none\" stroke=\"#888\"/>",
            right - LEFT,
            bottom - TOP
        );
        if let Some(([column, row], words)) = self.own {
            let (x, y) = (LEFT + width * column, bottom - height * row);
            // the words stand on the side with more room
            let (side, anchor) = if x < 0.5 * (LEFT + right) { (12.0, "start") } else { (-12.0, "end") };
            for color in ["stroke=\"#fff\" stroke-width=\"5\"", "stroke=\"#000\" stroke-width=\"2\""] {
                let _ = write!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\" fill=\"none\" {color}/>");
            }
            svg.push_str("<g class=\"own\" stroke=\"#fff\" stroke-width=\"4\" paint-order=\"stroke\">");
            write_text(&mut svg, [x + side, y + 5.0], anchor, words);
            svg.push_str("</g>");
        }
        for (place, text) in &self.rows.ticks {
            write_text(&mut svg, [LEFT - 5.0, bottom - height * place + 4.0], "end", text);
        }
        // a text that would touch the one before it is left out
        let mut free = 0.0;
        for (place, text) in &self.columns.ticks {
            let (x, half) = (LEFT + width * place, HALF_CHARACTER * text.chars().count() as f64);
            if x - half >= free {
                write_text(&mut svg, [x, bottom + 15.0], "middle", text);
                free = x + half;
            }
        }
        write_text(&mut svg, [0.5 * (LEFT + right), bottom + 34.0], "middle", &self.columns.label);
        write_upwards(&mut svg, [12.0, 0.5 * (TOP + bottom)], &self.rows.label);
        svg + "</svg>"
    }

    fn draw_cell(&self, svg: &mut String, [x, y]: [f64; 2], cell: Cell) {
        let [width, height] = self.size;
        let Cell { fill, title, crossed } = cell;
        let _ = write!(
            svg,
            "<rect x=\"{x:.0}\" y=\"{y:.0}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\""
        );
        let _ = match &*title {
            "" => write!(svg, "/>"),
            _ => write!(svg, "><title>{title}</title></rect>"),
        };
        if crossed {
            let _ = write!(
                svg,
                "<path d=\"M{:.0} {:.0}l{:.0} {:.0}m0 {:.0}l{:.0} {:.0}\" fill=\"none\" \
                 stroke=\"#000\" stroke-width=\"1.6\"/>",
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

/// Draws the scale of colours: swatches side by side, some with a text below.
pub fn scale(label: &str, swatches: &[(String, Option<String>)]) -> String {
    let width = 26.0;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {:.0} 44\" class=\"scale\" role=\"img\" aria-label=\"{label}\">",
        width * swatches.len() as f64 + 30.0
    );
    for (index, (fill, text)) in swatches.iter().enumerate() {
        let x = 10.0 + width * index as f64;
        let _ =
            write!(svg, "<rect x=\"{x:.0}\" y=\"2\" width=\"{width:.0}\" height=\"18\" fill=\"{fill}\"/>");
        if let Some(text) = text {
            write_text(&mut svg, [x + 0.5 * width, 38.0], "middle", text);
        }
    }
    svg + "</svg>"
}
