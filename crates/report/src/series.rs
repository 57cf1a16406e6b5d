//! Lines and marks of a plot.

use std::fmt::Write;

use crate::escaped;
use crate::palette::{Mark, SERIES};
use crate::points::{Points, within};

/// Points that belong together, and how they look.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// x and y; one whose y is NaN is a gap in a line.
    pub points: Points,
    /// A colour of the [palette](crate::palette).
    pub color: &'static str,
    /// A line, or marks.
    pub look: Look,
    /// Width of a line or size of a mark \[px\].
    pub width: f64,
    /// Name in a legend; empty for none, and for a series that belongs to a named one.
    pub name: String,
    /// The text shown when a mark or a line is pointed at: none, one for each mark, or one for the line.
    pub titles: Vec<String>,
}

/// How a series looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Look {
    Solid,
    Dashed,
    Dotted,
    /// A pale line, one of many; on a page it stands out when pointed at.
    Faint,
    Marks(Mark),
}

impl Series {
    /// A solid line with a name, in a colour of the palette by its number; series that belong together share
    /// one.
    pub fn line(name: &str, color: usize, points: Points) -> Self {
        Self { name: name.into(), ..Self::stroke(SERIES[color % SERIES.len()].0, 1.4, points) }
    }

    /// A dashed line, as [`Self::line`].
    pub fn dashed(name: &str, color: usize, points: Points) -> Self {
        Self { look: Look::Dashed, ..Self::line(name, color, points) }
    }

    /// Marks without a line, as [`Self::line`].
    pub fn marks(name: &str, color: usize, points: Points) -> Self {
        let look = Look::Marks(SERIES[color % SERIES.len()].1);
        Self { look, width: 3.5, ..Self::line(name, color, points) }
    }

    /// A solid line of a colour and a width \[px\].
    pub fn stroke(color: &'static str, width: f64, points: Points) -> Self {
        Self { points, color, look: Look::Solid, width, name: String::new(), titles: Vec::new() }
    }

    /// The pieces of a line inside ranges of x and y, cut at their edges; the first keeps the name. Of a line
    /// all outside, one piece without points keeps it.
    ///
    /// ```
    /// use report::plot::Series;
    ///
    /// let line = Series::line("above", 0, vec![(0.0, 5.0), (1.0, 6.0)]);
    /// let names: Vec<_> = line.within([[0.0, 1.0], [0.0, 3.0]]).map(|piece| piece.name).collect();
    /// assert_eq!(names, ["above"]);
    /// ```
    pub fn within(&self, ranges: [[f64; 2]; 2]) -> impl Iterator<Item = Self> {
        let mut pieces = within(&self.points, ranges);
        if pieces.is_empty() {
            pieces.push(Vec::new());
        }
        pieces.into_iter().enumerate().map(|(index, points)| {
            let name = if index == 0 { self.name.clone() } else { String::new() };
            Self { points, name, ..self.clone() }
        })
    }

    /// Writes the line or its marks at places \[px\].
    pub(crate) fn write(&self, svg: &mut String, places: &[[f64; 2]]) {
        // writing to a String cannot fail
        let Look::Marks(mark) = self.look else {
            let mut path = String::new();
            let mut step = "M";
            for [x, y] in places {
                // a point without a value is a gap
                if y.is_nan() {
                    step = "M";
                    continue;
                }
                let _ = write!(path, "{step}{x:.2} {y:.2}");
                step = "L";
            }
            let look = match self.look {
                Look::Dashed => " stroke-dasharray=\"8 4\"",
                Look::Dotted => " stroke-dasharray=\"2 4\"",
                Look::Faint => " opacity=\"0.4\" class=\"faint\"",
                Look::Solid | Look::Marks(_) => "",
            };
            let (color, width) = (self.color, self.width);
            let look = format!(" stroke=\"{color}\" stroke-width=\"{width}\" fill=\"none\"{look}");
            self.write_path(svg, 0, &path, &look);
            return;
        };
        let look = match mark {
            Mark::Dot => format!("stroke-width=\"{}\" stroke-linecap=\"round\" opacity=\"0.5\"", self.width),
            _ => "stroke-width=\"1.4\"".to_owned(),
        };
        let _ = write!(svg, "<g class=\"marks\" stroke=\"{0}\" fill=\"{0}\" {look}>", self.color);
        let outline = mark.outline(self.width);
        // without titles one path is enough for thousands of marks
        let at_once = if self.titles.is_empty() { places.len().max(1) } else { 1 };
        for (index, places) in places.chunks(at_once).enumerate() {
            let mut path = String::new();
            for [x, y] in places {
                let _ = write!(path, "M{x:.2} {y:.2}{outline}");
            }
            self.write_path(svg, index, &path, "");
        }
        svg.push_str("</g>");
    }

    /// Writes a path, with its title if it has one.
    fn write_path(&self, svg: &mut String, index: usize, path: &str, look: &str) {
        let _ = match self.titles.get(index) {
            Some(title) => write!(svg, "<path d=\"{path}\"{look}><title>{}</title></path>", escaped(title)),
            None => write!(svg, "<path d=\"{path}\"{look}/>"),
        };
    }
}
