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

use crate::axes::{ticks as round, write_text};
use crate::frame::Frame;
use crate::plot::Scale;

/// Margins around the cells \[px\]: left, right, top, bottom.
const MARGINS: [f64; 4] = [68.0, 8.0, 6.0, 44.0];
/// Size of the numbers on the axes \[px\].
const NUMBERS: f64 = 12.0;

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
        let ([width, height], [left, right, top, bottom]) = (self.size, MARGINS);
        let (columns, rows) = (self.columns.count as f64, self.rows.count as f64);
        [left + width * columns + right, top + height * rows + bottom]
    }

    /// Draws the map.
    pub fn svg(&self) -> String {
        let [width, height] = self.extent();
        let axes = [&self.columns, &self.rows];
        let frame = Frame {
            size: [width, height],
            margins: MARGINS,
            ranges: axes.map(|axis| [0.0, axis.count as f64]),
            labels: axes.map(|axis| &*axis.label),
            scale: Scale::Linear,
            number_size: NUMBERS,
            comma: false,
            numbers: Some(axes.map(|axis| axis.ticks.clone())),
        };
        let mut inside = "<g shape-rendering=\"crispEdges\">".to_owned();
        for row in 0..self.rows.count {
            for column in 0..self.columns.count {
                let corner = frame.place((column as f64, (row + 1) as f64));
                self.draw_cell(&mut inside, corner, (self.cells)(row, column));
            }
        }
        inside.push_str("</g>");
        if let Some(([column, row], words)) = self.own {
            let [x, y] = frame.place((column, row));
            // the words stand on the side with more room
            let (side, anchor) = if x < 0.5 * width { (12.0, "start") } else { (-12.0, "end") };
            for color in ["stroke=\"#fff\" stroke-width=\"5\"", "stroke=\"#000\" stroke-width=\"2\""] {
                let _ = write!(inside, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\" fill=\"none\" {color}/>");
            }
            inside.push_str("<g class=\"own\" stroke=\"#fff\" stroke-width=\"4\" paint-order=\"stroke\">");
            write_text(&mut inside, [x + side, y + 5.0], anchor, words);
            inside.push_str("</g>");
        }
        format!(
            "<svg viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" aria-label=\"{}\">{}</svg>",
            self.label,
            frame.around(&inside)
        )
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
