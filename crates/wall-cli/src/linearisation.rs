//! What small rotations leave out, as a table, as CSV and as figures: Figures 2 and 3 of the paper.

use std::fmt::Write;

use anyhow::Result;
use figures::palette::{BLUE, GREY, RED};
use figures::plot::Plot;
use figures::response::{both_rotations, cut, period_ratios};
use rocking_wall::response::Response;
use rocking_wall::scene::Scene;
use rocking_wall::variables::{Mechanism, Solver};
use rocking_wall::wall::{Kinematics, Parameters, Wall};
use study::accuracy::linearisation::{
    Comparison, Period, SLENDERNESS, STARTS, figure_2, figure_2_wall, figure_3, period,
};

use study_folder::csv::optional;

/// The figures' output step \[s\].
const STEP: f64 = 0.01;
/// Names of the two mechanisms, and how long Figure 2 watches them \[s\].
const MECHANISMS: [(Mechanism, &str, f64); 2] =
    [(Mechanism::Parapet, "parapet", 20.0), (Mechanism::VerticalSpanning, "strip", 12.0)];

/// One mechanism.
struct Measured {
    name: &'static str,
    duration: f64,
    restitution: f64,
    history: Comparison,
    /// For each of `STARTS` one period for each of `SLENDERNESS`.
    periods: Vec<Vec<Period>>,
}

/// Figures 2 and 3 for both mechanisms.
pub(crate) struct Linearisation(Vec<Measured>);

impl Linearisation {
    pub(crate) fn measure() -> Result<Self> {
        let measured = |&(mechanism, name, duration): &(Mechanism, &'static str, f64)| {
            let periods = STARTS.iter().map(|&start| figure_3(mechanism, &SLENDERNESS, start));
            Ok(Measured {
                name,
                duration,
                restitution: figure_2_wall(mechanism).restitution,
                history: figure_2(mechanism, duration, STEP)?,
                periods: periods.collect::<Result<_, _>>()?,
            })
        };
        Ok(Self(MECHANISMS.iter().map(measured).collect::<Result<_>>()?))
    }

    pub(crate) fn table(&self) -> String {
        let mut text =
            String::from("small rotations: their period over that of full rotations, by start over u_ins\n");
        let _ = write!(text, "  {:<8}{:>9}", "alpha", "Eq. (5)");
        for measured in &self.0 {
            for start in STARTS {
                let _ = write!(text, "{:>13}", format!("{} {start}", measured.name));
            }
        }
        text.push('\n');
        for (index, alpha) in SLENDERNESS.iter().enumerate() {
            let housner = self.0[0].periods[0][index].over_housner().unwrap_or(f64::NAN);
            let _ = write!(text, "  {alpha:<8.2}{housner:>9.5}");
            for periods in self.0.iter().flat_map(|measured| &measured.periods) {
                let _ = write!(text, "{:>13.5}", periods[index].ratio());
            }
            text.push('\n');
        }
        for Measured { name, duration, restitution, history, .. } in &self.0 {
            let (linear, full) = (first(&history.linear.impacts), first(&history.trigonometric.impacts));
            let _ = writeln!(
                text,
                "  Figure 2, {name}, e = {restitution}: first impact at {linear:.5} s instead of {full:.5} s \
                 ({:.2} % short);\n    over {duration} s at most {:.3} u_ins apart, amplitudes within {:.1e} \
                 u_ins",
                100.0 * (1.0 - linear / full),
                history.largest_difference(),
                history.largest_amplitude_difference()
            );
        }
        text
    }

    pub(crate) fn csv(&self) -> String {
        let mut text = String::from(
            "mechanism,alpha_rad,start_over_u_ins,period_linear_s,period_trigonometric_s,period_eq5_s,ratio,\
             ratio_eq5\n",
        );
        for measured in &self.0 {
            for period in measured.periods.iter().flatten() {
                let _ = writeln!(
                    text,
                    "{},{},{},{:?},{:?},{},{:?},{}",
                    measured.name,
                    period.slenderness,
                    period.start,
                    period.linear,
                    period.trigonometric,
                    optional(period.housner),
                    period.ratio(),
                    optional(period.over_housner())
                );
            }
        }
        text
    }

    /// The section of the page of `wall accuracy`.
    pub(crate) fn section(&self) -> String {
        let mut section = format!(
            "<h2>What small rotations leave out</h2>\n<p>The wall of Figure 2 of the paper (b = 0.4 m, \
             h = 4 m, released from 0.9 u<sub>ins</sub>) with small and with full rotations, and the ratio \
             of the two periods against slenderness, hinge of the strip at mid-height.</p>\n\
             <p class=\"key\">{}</p>\n<main class=\"figures\">\n",
            key(&[
                ("full rotations", BLUE),
                ("small rotations", RED),
                ("Eq. (1) over Eq. (5), √cos α", GREY)
            ])
        );
        for Measured { name, duration, restitution, history, .. } in &self.0 {
            let _ = writeln!(
                section,
                "<figure><figcaption><b>{name}, e = {restitution}</b><br>at most {:.3} u<sub>ins</sub> \
                 apart, amplitudes within {:.0e} u<sub>ins</sub></figcaption>{}</figure>",
                history.largest_difference(),
                history.largest_amplitude_difference(),
                histories(history, *duration)
            );
        }
        for Measured { name, periods, .. } in &self.0 {
            let _ = writeln!(
                section,
                "<figure><figcaption><b>{name}</b><br>started at 0.1 (dotted), 0.5 (dashed) and 0.9 (solid) \
                 of u<sub>ins</sub></figcaption>{}</figure>",
                ratios(periods)
            );
        }
        section + "</main>\n"
    }
}

/// Size of the plots on the page of `wall accuracy` \[px\].
const SIZE: [f64; 2] = [440.0, 290.0];

fn first(times: &[f64]) -> f64 {
    times.first().copied().unwrap_or(f64::NAN)
}

/// A key of colours.
fn key(entries: &[(&str, &str)]) -> String {
    let entry = |(name, color): &(&str, &str)| {
        format!("<span><i class=\"chip\" style=\"background:{color}\"></i>{name}</span>\n")
    };
    entries.iter().map(entry).collect()
}

fn histories(comparison: &Comparison, duration: f64) -> String {
    let timed = |history: &[f64]| -> Vec<(f64, f64)> {
        history.iter().enumerate().map(|(index, &u)| (index as f64 * comparison.step, u)).collect()
    };
    let (linear, full) = (timed(&comparison.linear.history), timed(&comparison.trigonometric.history));
    Plot { size: SIZE, ..both_rotations(&full, &linear, duration, SIZE[1]) }.svg()
}

/// Ratios of periods of one mechanism.
fn ratios(periods: &[Vec<Period>]) -> String {
    let points = |of: &dyn Fn(&Period) -> Option<f64>, periods: &[Period]| -> Vec<(f64, f64)> {
        let upright = std::iter::once((0.0, 1.0));
        upright.chain(periods.iter().filter_map(|period| Some((period.slenderness, of(period)?)))).collect()
    };
    let curves = periods.iter().map(|periods| points(&|period| Some(period.ratio()), periods)).collect();
    let housner = points(&Period::over_housner, &periods[0]);
    Plot { size: SIZE, ..period_ratios(curves, housner, None, SIZE[1]) }.svg()
}

/// The same run with the other kinematics, for a rigid wall that allows it.
pub(crate) struct Counterpart {
    /// Histories of u/`u_ins` side by side.
    pub(crate) histories: Plot,
    /// Period ratios of this wall, marked, and with other thicknesses.
    pub(crate) ratios: Plot,
    /// Largest distance of the histories while both stand \[-\].
    pub(crate) apart: f64,
    /// Period of small rotations over that of full ones \[-\], from the largest |u|/`u_ins` of the run.
    pub(crate) ratio: f64,
    pub(crate) start: f64,
}

/// Amplitudes between which a period makes sense \[-\].
const AMPLITUDES: [f64; 2] = [0.01, 0.99];

impl Counterpart {
    /// Runs a scene with the other kinematics and draws both up to a time \[s\]; `None` for walls that full
    /// rotations do not allow.
    pub(crate) fn of(scene: &Scene, response: &Response, end: f64) -> Option<Self> {
        let other = counterpart(scene)?;
        let twin = Response::of(&other).ok()?;
        let column = |response: &Response| -> Vec<(f64, f64)> {
            cut(response.samples.iter().map(|sample| (sample.time, sample.outputs.ratio)).collect())
        };
        let (own, twin_column) = (column(response), column(&twin));
        let [linear, full] = match scene.parameters.kinematics {
            Kinematics::Linear => [&own, &twin_column],
            Kinematics::Trigonometric => [&twin_column, &own],
        };
        let pairs = own.iter().zip(&twin_column).take_while(|(a, b)| a.1.abs() <= 1.0 && b.1.abs() <= 1.0);
        let apart = pairs.map(|(a, b)| (a.1 - b.1).abs()).fold(0.0, f64::max);
        let start = response.summary.u_ratio_max.clamp(AMPLITUDES[0], AMPLITUDES[1]);
        let period_of = |parameters: &Parameters| period(parameters, start).ok();
        let wall = period_of(&scene.parameters)?;
        let base = scene.parameters.thickness / libm::tan(wall.slenderness);
        let widest = wall.slenderness.max(SLENDERNESS[SLENDERNESS.len() - 1]);
        let curve: Vec<_> = std::iter::once((0.0, 1.0))
            .chain(SLENDERNESS.iter().chain([&widest]).filter_map(|alpha| {
                let thickness = base * libm::tan(*alpha);
                let period = period_of(&Parameters { thickness, ..scene.parameters.clone() })?;
                Some((*alpha, period.ratio()))
            }))
            .collect();
        let mark = (wall.slenderness, wall.ratio());
        let ratios = period_ratios(vec![curve], Vec::new(), Some(mark), 250.0);
        let histories = both_rotations(full, linear, end, 250.0);
        Some(Self { histories, ratios, apart, ratio: wall.ratio(), start })
    }
}

/// The scene with the other kinematics.
fn counterpart(scene: &Scene) -> Option<Scene> {
    let mut other = scene.clone();
    other.parameters.solver = Solver::Automatic;
    other.parameters.kinematics = Kinematics::Trigonometric;
    // full rotations allow rigid walls without damping only
    Wall::new(&other.parameters).ok()?;
    other.support_motion().ok()?;
    if scene.parameters.kinematics == Kinematics::Trigonometric {
        other.parameters.kinematics = Kinematics::Linear;
    }
    Some(other)
}
