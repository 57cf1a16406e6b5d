//! Error against run time, on logarithmic axes.
//!
//! ```
//! use evidence::accuracy::figure::{Point, SOLVERS, plot};
//!
//! let point = Point { tool: "exact".into(), seconds: 4e-4, error: 1e-9, title: "1 sample".into() };
//! assert!(plot(&SOLVERS, &[point], Some(1e-12), true).svg().contains("1e-9"));
//! ```

use report::palette::{AMBER, BLUE, BROWN, DARK_GREY, GREEN, GREY, Mark, PURPLE, RED, TEAL};
use report::plot::{Axis, Look, Plot, Scale, Series};

/// Name, colour and mark of a solver or tool.
pub type Sign = (&'static str, &'static str, Mark);
/// The solvers.
pub const SOLVERS: [Sign; 3] =
    [("exact", BLUE, Mark::Circle), ("adaptive", GREEN, Mark::Square), ("newmark", RED, Mark::Triangle)];
/// The tools that a comparison may name.
pub const TOOLS: [Sign; 8] = [
    ("rocking-wall", BLUE, Mark::Circle),
    ("ode_solvers", GREEN, Mark::Square),
    ("diffsol", PURPLE, Mark::Diamond),
    ("numba", AMBER, Mark::Cross),
    ("OpenSeesPy", RED, Mark::Triangle),
    ("SciPy", DARK_GREY, Mark::Plus),
    ("JAX", TEAL, Mark::TriangleDown),
    ("diffrax", BROWN, Mark::Star),
];
/// Smallest error that is drawn: smaller ones are rounding, and the logarithm stays finite.
const FLOOR: f64 = 1e-17;

/// A measurement of a solver or tool.
#[derive(Clone, Debug)]
pub struct Point {
    /// Name of the solver or tool.
    pub tool: String,
    /// Run time \[s\].
    pub seconds: f64,
    /// Error over `u_ins` \[-\].
    pub error: f64,
    /// The text shown when it is pointed at.
    pub title: String,
}

/// Draws the points of some tools, with their names if they are `named`. With the error that `rounding` alone
/// may cause, a line joins the points of each tool.
pub fn plot(tools: &[Sign], points: &[Point], rounding: Option<f64>, named: bool) -> Plot {
    let exponent = |error: f64| error.max(FLOOR).log10();
    let mut series = Vec::new();
    for (tool, color, mark) in tools {
        let own: Vec<_> = points.iter().filter(|point| point.tool == *tool).collect();
        let places = own.iter().map(|point| (point.seconds * 1e3, exponent(point.error))).collect();
        let line =
            Series { name: if named { tool } else { "" }.into(), ..Series::stroke(color, 1.2, places) };
        let titles = own.iter().map(|point| point.title.clone()).collect();
        let marks = Series { look: Look::Marks(*mark), width: 4.5, titles, ..line.clone() };
        match rounding {
            _ if own.is_empty() => {}
            Some(_) => series.extend([line, Series { name: String::new(), ..marks }]),
            None => series.push(marks),
        }
    }
    let times = points.iter().map(|point| point.seconds * 1e3);
    let (low, high) = times.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    let decade = |value: f64, round: fn(f64) -> f64| 10.0_f64.powf(round(value.log10()));
    let left = decade(low, f64::floor);
    let axes = [
        // one decade at least
        Axis::over("run time (ms)", [left, decade(high, f64::ceil).max(10.0 * left)]),
        Axis::over("max error / u_ins", [exponent(FLOOR), 1.0]),
    ];
    let limits = rounding.map(|error| (exponent(error), GREY)).into_iter().collect();
    Plot { scale: Scale::Logarithmic, limits, ..Plot::new([440.0, 290.0], axes, series) }
}
