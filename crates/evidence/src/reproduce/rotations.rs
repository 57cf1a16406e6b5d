//! Figures 2 and 3: small rotations, Eq. (1), beside full ones, also as a table and in words.
//!
//! Displacements are fractions of the unstable equilibrium: u/`u_ins` for small rotations, θ/`θ_ins` for full
//! ones, so that both start at the same θ₀/α of Eq. (5).
//!
//! ```
//! use evidence::reproduce::rotations::wall;
//! use rocking_wall::variables::Mechanism;
//! use run::rotations::period;
//!
//! let period = period(&wall(Mechanism::Parapet), 0.9)?;
//! assert!((period.ratio() - 0.9975).abs() < 1e-3);
//! # Ok::<(), evidence::EvidenceError>(())
//! ```

use std::fmt::Write;

use report::plot::{Axis, Plot, Series};
use report::table::{Digits, Table};
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Parameters, equivalence};
use run::rotations::{FreeMotion, Period, SLENDERNESS, both, period};

use super::figure::{Figure, spaced};
use super::printed::{FIGURE_2_RESTITUTION, FIGURE_WALL, START};
use crate::EvidenceError;

/// Length and output step of the histories of Figure 2 \[s\].
const DURATION: f64 = 20.0;
const STEP: f64 = 0.01;
/// Initial rotations θ₀/α at which the period is compared; the last is that of Figure 2.
pub const STARTS: [f64; 3] = [0.1, 0.5, START];
/// p of Figure 3 \[rad/s\], and α of its panel a) \[rad\].
const FREQUENCIES: [f64; 4] = [2.0, 3.0, 4.0, 5.0];
const ANGLE: f64 = 0.1;

/// Figures 2 and 3 for the wall of one mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotations {
    /// What tables call the wall.
    pub name: &'static str,
    /// Its coefficient of restitution \[-\].
    pub restitution: f64,
    /// Figure 2, released from 0.9: small rotations, Eq. (1).
    pub linear: FreeMotion,
    /// The same in full rotations.
    pub trigonometric: FreeMotion,
    /// Figure 3: for each of [`STARTS`] one period for each of [`SLENDERNESS`].
    pub periods: Vec<Vec<Period>>,
}

impl Rotations {
    /// Computes them.
    ///
    /// # Errors
    /// [`EvidenceError::Rotations`] if a run fails.
    pub fn of(mechanism: Mechanism) -> Result<Self, EvidenceError> {
        let wall = wall(mechanism);
        let [linear, trigonometric] = both(&wall, |release| release.run(START, DURATION, STEP))?;
        let name = if mechanism == Mechanism::Parapet { "parapet" } else { "strip" };
        let periods = STARTS.iter().map(|&start| periods(mechanism, &SLENDERNESS, start));
        let periods = periods.collect::<Result<_, _>>()?;
        Ok(Self { name, restitution: wall.restitution, linear, trigonometric, periods })
    }

    /// Computes those of the parapet and those of the strip.
    ///
    /// # Errors
    /// As [`Self::of`].
    pub fn of_both() -> Result<[Self; 2], EvidenceError> {
        Ok([Self::of(Mechanism::Parapet)?, Self::of(Mechanism::VerticalSpanning)?])
    }

    /// Returns the largest difference between the two histories \[-\].
    pub fn largest_difference(&self) -> f64 {
        largest_difference(&self.linear.history, &self.trigonometric.history)
    }

    /// Returns the largest difference between amplitudes of half cycles, which do not depend on phase \[-\].
    pub fn largest_amplitude_difference(&self) -> f64 {
        largest_difference(&self.linear.amplitudes, &self.trigonometric.amplitudes)
    }

    /// Returns the times of the first impact \[s\], in small rotations and in full ones.
    fn first_impacts(&self) -> [f64; 2] {
        [&self.linear, &self.trigonometric].map(|motion| motion.impacts.first().copied().unwrap_or(f64::NAN))
    }
}

pub(crate) fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Returns the wall of Figure 2: b = 0.4 m, h = 4 m, no overburden, e = 0.985 (parapet) or 0.955 (strip,
/// hinge at mid-height).
pub fn wall(mechanism: Mechanism) -> Parameters {
    let ([height, thickness], [parapet, strip]) = (FIGURE_WALL, FIGURE_2_RESTITUTION);
    let restitution = if mechanism == Mechanism::Parapet { parapet } else { strip };
    Parameters { mechanism, height, thickness, hinge_ratio: 0.5, restitution, ..Parameters::default() }
}

/// Computes periods at each of `slenderness` \[rad\], which sets the thickness of a wall of 4 m with its
/// hinge at mid-height. Ratios of periods depend only on the slenderness, the hinge ratio and the start.
///
/// # Errors
/// [`EvidenceError`] if a slenderness makes no wall or a run fails.
pub fn periods(mechanism: Mechanism, slenderness: &[f64], start: f64) -> Result<Vec<Period>, EvidenceError> {
    let wall = wall(mechanism);
    let lower = match mechanism {
        Mechanism::Parapet | Mechanism::RigidBody => wall.height,
        Mechanism::VerticalSpanning => wall.hinge_ratio * wall.height,
    };
    let at = |alpha: &f64| {
        Ok(period(&Parameters { thickness: lower * libm::tan(*alpha), ..wall.clone() }, start)?)
    };
    slenderness.iter().map(at).collect()
}

/// Returns the periods, one a row.
pub fn table(both: &[Rotations]) -> Table {
    let rows = both.iter().flat_map(|of| of.periods.iter().flatten().map(|period| (of.name, period)));
    Table::over(rows)
        .value("mechanism", |(name, _)| *name)
        .value("alpha_rad", |(_, period)| period.slenderness)
        .value("start_over_u_ins", |(_, period)| period.start)
        .value("period_linear_s", |(_, period)| period.linear)
        .value("period_trigonometric_s", |(_, period)| period.trigonometric)
        .value("period_eq5_s", |(_, period)| period.housner)
        .value("ratio", |(_, period)| period.ratio())
        .value("ratio_eq5", |(_, period)| period.over_housner())
        .done()
}

/// Returns the ratios of periods by slenderness and start, and Figure 2 in numbers.
pub fn text(both: &[Rotations]) -> String {
    let ratio = Digits::Decimals(5);
    let mut table = Table::over(SLENDERNESS.into_iter().enumerate())
        .number("", "alpha", Digits::Decimals(2), |(_, alpha)| *alpha)
        .number("", "Eq. (5)", ratio, |(index, _)| both[0].periods[0][*index].over_housner());
    for Rotations { name, periods, .. } in both {
        for (start, periods) in STARTS.iter().zip(periods) {
            table = table.number("", format!("{name} {start}"), ratio, |(index, _)| periods[*index].ratio());
        }
    }
    let table = table.done().text();
    let mut text =
        format!("small rotations: their period over that of full rotations, by start over u_ins\n{table}");
    for of in both {
        let [linear, full] = of.first_impacts();
        let _ = writeln!(
            text,
            "Figure 2, {}, e = {}: first impact at {linear:.5} s instead of {full:.5} s \
             ({:.2} % short);\n  over {DURATION} s at most {:.3} u_ins apart, amplitudes within {:.1e} u_ins",
            of.name,
            of.restitution,
            100.0 * (1.0 - linear / full),
            of.largest_difference(),
            of.largest_amplitude_difference()
        );
    }
    text
}

/// Draws Figures 2 and 3.
///
/// # Errors
/// [`EvidenceError`] if a run of Figure 3 fails.
pub fn figures(both: &[Rotations; 2]) -> Result<[Figure; 2], EvidenceError> {
    Ok([figure_2(both), figure_3(&both[0])?])
}

fn figure_2([parapet, strip]: &[Rotations; 2]) -> Figure {
    let chart = |panel: &str, Rotations { name, restitution, linear, trigonometric, .. }: &Rotations| {
        let points = |motion: &FreeMotion| {
            motion.history.iter().enumerate().map(|(index, u)| (index as f64 * STEP, *u)).collect()
        };
        let full = Series::line("full rotations", 0, points(trigonometric));
        let series = vec![full, Series::dashed("Eq. (1)", 1, points(linear))];
        let title = format!("{panel}) {name}, e = {restitution}");
        Plot::titled(
            title,
            Axis::over("time (s)", [0.0, DURATION]),
            Axis::over("u / u_ins", [-1.0, 1.0]),
            series,
        )
    };
    let ([small, full], [of_strip, of_strip_full]) = (parapet.first_impacts(), strip.first_impacts());
    Figure {
        number: 2,
        title: "Free vibrations in full rotations and by Eq. (1)",
        notes: format!(
            "Parapet: first impact at {full:.5} s in full rotations and {small:.5} s by Eq. (1), a ratio of \
             √cos α; the histories are at most {:.3} u_ins apart.\n\
             Strip: the first impact comes {:.1} % early, so that the histories drift {:.2} u_ins apart in \
             phase, while the amplitudes stay within {:.3} u_ins; the paper calls the match good. Its e = \
             0.955 is given, not that of Eq. (3).",
            parapet.largest_difference(),
            100.0 * (1.0 - of_strip / of_strip_full),
            strip.largest_difference(),
            strip.largest_amplitude_difference()
        ),
        charts: vec![chart("a", parapet), chart("b", strip)],
    }
}

/// Returns the parapet with a frequency parameter p \[rad/s\] and the angle of panel a).
fn with_frequency(p: f64) -> Parameters {
    let wall = wall(Mechanism::Parapet);
    // p² = 3g/(4R), h = 2R cos α, b = 2R sin α
    let diagonal = 1.5 * wall.gravity / (p * p);
    Parameters { height: diagonal * ANGLE.cos(), thickness: diagonal * ANGLE.sin(), ..wall }
}

fn figure_3(parapet: &Rotations) -> Result<Figure, EvidenceError> {
    let mut series = Vec::new();
    for (color, p) in FREQUENCIES.into_iter().enumerate() {
        let closed = spaced([0.0, 0.98], 98).map(|start| (start, equivalence::housner_period(p, start)));
        series.push(Series::line("", color, closed.collect()));
        let wall = with_frequency(p);
        let points = spaced([0.1, 0.9], 8)
            .map(|start| Ok((start, period(&wall, start)?.linear)))
            .collect::<Result<_, EvidenceError>>()?;
        series.push(Series::marks(&format!("p = {p} rad/s"), color, points));
    }
    let over_angle = parapet.periods.last().into_iter().flatten();
    let ratios = over_angle.filter_map(|period| Some((period.slenderness, period.over_housner()?)));
    let roots = spaced([0.0, 0.4], 80).map(|angle| (angle, angle.cos().sqrt())).collect();
    let shown = [0.1, 0.2, 0.3].map(|angle: f64| format!("{:.4}", angle.cos().sqrt()));
    Ok(Figure {
        number: 3,
        title: "Period of a free-standing parapet",
        notes: format!(
            "Lines: Eq. (5); marks: Eq. (1). Which α were drawn is lost; a) has α = {ANGLE}, b) shows what α \
             does.\n\
             The ratio is √cos α whatever p and θ₀: {} at α = 0.1, 0.2, 0.3.",
            shown.join(", ")
        ),
        charts: vec![
            Plot::titled(
                format!("a) over the initial rotation, α = {ANGLE}"),
                Axis::over("θ0 / α", [0.0, 1.0]),
                Axis::over("period (s)", [0.0, 10.0]),
                series,
            ),
            Plot::titled(
                "b) Eq. (1) over Eq. (5)",
                Axis::over("α (rad)", [0.0, 0.4]),
                Axis::over("ratio of periods", [0.96, 1.005]),
                vec![Series::line("√cos α", 5, roots), Series::marks("Eq. (1)", 0, ratios.collect())],
            ),
        ],
    })
}
