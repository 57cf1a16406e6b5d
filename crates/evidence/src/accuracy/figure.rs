//! Error against run time, on logarithmic axes.
//!
//! ```
//! use evidence::accuracy::figure::{SOLVERS, Tool, plot};
//!
//! let (_, color, mark) = SOLVERS[0];
//! let (name, points) = ("exact", vec![(0.4, 1e-9)]);
//! let tool = Tool { name, color, mark, points, titles: vec!["1 sample".into()], joined: true };
//! assert!(plot(&[tool], Some(1e-12)).svg().contains("1e-9"));
//! ```

use report::palette::{AMBER, BLUE, DARK_GREY, GREEN, GREY, Mark, PURPLE, RED};
use report::plot::{Axis, Look, Plot, Scale, Series};

/// Name, colour and mark of the solvers.
pub const SOLVERS: [(&str, &str, Mark); 3] =
    [("exact", BLUE, Mark::Circle), ("adaptive", GREEN, Mark::Square), ("newmark", RED, Mark::Triangle)];
/// Name, colour and mark of the tools that a comparison may name.
pub const TOOLS: [(&str, &str, Mark); 6] = [
    ("rocking-wall", BLUE, Mark::Circle),
    ("ode_solvers", GREEN, Mark::Square),
    ("diffsol", PURPLE, Mark::Diamond),
    ("numba", AMBER, Mark::Cross),
    ("OpenSeesPy", RED, Mark::Triangle),
    ("SciPy", DARK_GREY, Mark::Plus),
];
/// Smallest error that is drawn: smaller ones are rounding, and the logarithm stays finite.
const FLOOR: f64 = 1e-17;

/// The measurements of one solver or tool.
#[derive(Clone, Debug)]
pub struct Tool {
    /// Its name in the legend of a picture.
    pub name: &'static str,
    /// A colour of the palette.
    pub color: &'static str,
    /// Its mark.
    pub mark: Mark,
    /// Run time \[ms\] and error over `u_ins`.
    pub points: Vec<(f64, f64)>,
    /// The text shown when each point is pointed at.
    pub titles: Vec<String>,
    /// Points that follow from one another are joined by a line.
    pub joined: bool,
}

/// Draws all tools; `rounding` is the error that rounding alone may cause.
pub fn plot(tools: &[Tool], rounding: Option<f64>) -> Plot {
    let exponent = |error: f64| error.max(FLOOR).log10();
    let mut series = Vec::new();
    for Tool { name, color, mark, points, titles, joined } in
        tools.iter().filter(|tool| !tool.points.is_empty())
    {
        let line =
            Series::stroke(color, 1.2, points.iter().map(|&(time, error)| (time, exponent(error))).collect());
        let look = Look::Marks(*mark);
        let marks = Series { look, width: 4.5, titles: titles.clone(), ..line.clone() };
        let name = (*name).to_owned();
        if *joined {
            series.extend([Series { name, ..line }, marks]);
        } else {
            series.push(Series { name, ..marks });
        }
    }
    let times = tools.iter().flat_map(|tool| tool.points.iter().map(|point| point.0));
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
