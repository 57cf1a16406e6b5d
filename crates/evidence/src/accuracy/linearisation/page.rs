//! What small rotations leave out, on the page of `wall accuracy`: Figures 2 and 3 of the paper.

use std::fmt::Write;

use report::palette::{BLUE, GREY, RED};
use report::plot::Plot;
use run::figure::{both_rotations, period_ratios};

use super::{BothRotations, Comparison, Period};

/// Size of the plots \[px\].
const SIZE: [f64; 2] = [440.0, 290.0];

/// The section of the page of `wall accuracy`.
pub(crate) fn section(both: &[BothRotations]) -> String {
    let mut section = format!(
        "<h2>What small rotations leave out</h2>\n<p>The wall of Figure 2 of the paper (b = 0.4 m, \
         h = 4 m, released from 0.9 u<sub>ins</sub>) with small and with full rotations, and the ratio \
         of the two periods against slenderness, hinge of the strip at mid-height.</p>\n\
         <p class=\"key\">{}</p>\n<main class=\"figures\">\n",
        key(&[("full rotations", BLUE), ("small rotations", RED), ("Eq. (1) over Eq. (5), √cos α", GREY)])
    );
    for BothRotations { name, duration, restitution, history, .. } in both {
        let _ = writeln!(
            section,
            "<figure><figcaption><b>{name}, e = {restitution}</b><br>at most {:.3} u<sub>ins</sub> \
             apart, amplitudes within {:.0e} u<sub>ins</sub></figcaption>{}</figure>",
            history.largest_difference(),
            history.largest_amplitude_difference(),
            histories(history, *duration)
        );
    }
    for BothRotations { name, periods, .. } in both {
        let _ = writeln!(
            section,
            "<figure><figcaption><b>{name}</b><br>started at 0.1 (dotted), 0.5 (dashed) and 0.9 (solid) \
             of u<sub>ins</sub></figcaption>{}</figure>",
            ratios(periods)
        );
    }
    section + "</main>\n"
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
