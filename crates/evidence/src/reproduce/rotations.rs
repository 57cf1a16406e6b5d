//! Figures 2 and 3: small rotations beside full ones.

use crate::EvidenceError;
use run::rotations::{FreeMotion, period};

use crate::accuracy::linearisation::{Histories, figure_2, figure_2_wall, figure_3};
use report::plot::{Plot, Series};
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Parameters, equivalence};

use super::figure::{Figure, spaced};
use super::printed::START;

/// Length of the histories of Figure 2 \[s\].
const DURATION: f64 = 20.0;
/// p of Figure 3 \[rad/s\].
const FREQUENCIES: [f64; 4] = [2.0, 3.0, 4.0, 5.0];
/// α of the walls of Figure 3 a) and b) \[rad\].
const SLENDERNESS: f64 = 0.1;
const ANGLES: [f64; 8] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35];

/// Computes Figure 2.
pub(super) fn free_vibrations() -> Result<Figure, EvidenceError> {
    let [parapet, strip] = [Mechanism::Parapet, Mechanism::VerticalSpanning].map(|m| figure_2(m, DURATION));
    let (parapet, strip) = (parapet?, strip?);
    let ratio = |histories: &Histories| histories.time_ratio(0).unwrap_or(f64::NAN);
    let first = |motion: &FreeMotion| motion.impacts.first().copied().unwrap_or(f64::NAN);
    let chart = |title: &str, histories: &Histories| {
        let [small, full] = histories.points();
        let series = vec![Series::line("full rotations", 0, full), Series::dashed("Eq. (1)", 1, small)];
        Plot::titled(title, ("time (s)", [0.0, DURATION]), ("u / u_ins", [-1.0, 1.0]), series)
    };
    Ok(Figure {
        number: 2,
        title: "Free vibrations in full rotations and by Eq. (1)",
        notes: format!(
            "Parapet: first impact at {:.5} s in full rotations and {:.5} s by Eq. (1), a ratio of √cos α; \
             the histories are at most {:.3} u_ins apart.\n\
             Strip: the first impact comes {:.1} % early, so that the histories drift {:.2} u_ins apart in \
             phase, while the amplitudes stay within {:.3} u_ins; the paper calls the match good. Its e = \
             0.955 is given, not that of Eq. (3).",
            first(&parapet.trigonometric),
            first(&parapet.linear),
            parapet.largest_difference(),
            100.0 * (1.0 - ratio(&strip)),
            strip.largest_difference(),
            strip.largest_amplitude_difference()
        ),
        charts: vec![chart("a) parapet, e = 0.985", &parapet), chart("b) strip, e = 0.955", &strip)],
    })
}

/// Returns the parapet with a frequency parameter p \[rad/s\] and a slenderness angle.
fn with_frequency(p: f64, angle: f64) -> Parameters {
    let wall = figure_2_wall(Mechanism::Parapet);
    // p² = 3g/(4R), h = 2R cos α, b = 2R sin α
    let diagonal = 1.5 * wall.gravity / (p * p);
    Parameters { height: diagonal * angle.cos(), thickness: diagonal * angle.sin(), ..wall }
}

/// Computes Figure 3.
pub(super) fn periods() -> Result<Figure, EvidenceError> {
    let mut series = Vec::new();
    for (color, p) in FREQUENCIES.into_iter().enumerate() {
        let closed = spaced([0.0, 0.98], 98).map(|start| (start, equivalence::housner_period(p, start)));
        series.push(Series::line("", color, closed.collect()));
        let wall = with_frequency(p, SLENDERNESS);
        let points = spaced([0.1, 0.9], 8)
            .map(|start| Ok((start, period(&wall, start)?.linear)))
            .collect::<Result<_, EvidenceError>>()?;
        series.push(Series::marks(&format!("p = {p} rad/s"), color, points));
    }
    let over_angle = figure_3(Mechanism::Parapet, &ANGLES, START)?;
    let ratios = over_angle.iter().filter_map(|period| Some((period.slenderness, period.over_housner()?)));
    let roots = spaced([0.0, 0.4], 80).map(|angle| (angle, angle.cos().sqrt())).collect();
    let shown = [0.1, 0.2, 0.3].map(|angle: f64| format!("{:.4}", angle.cos().sqrt()));
    Ok(Figure {
        number: 3,
        title: "Period of a free-standing parapet",
        notes: format!(
            "Lines: Eq. (5); marks: Eq. (1). Which α were drawn is lost; a) has α = 0.1, b) shows what α \
             does.\n\
             The ratio is √cos α whatever p and θ₀: {} at α = 0.1, 0.2, 0.3.",
            shown.join(", ")
        ),
        charts: vec![
            Plot::titled(
                format!("a) over the initial rotation, α = {SLENDERNESS}"),
                ("θ0 / α", [0.0, 1.0]),
                ("period (s)", [0.0, 10.0]),
                series,
            ),
            Plot::titled(
                "b) Eq. (1) over Eq. (5)",
                ("α (rad)", [0.0, 0.4]),
                ("ratio of periods", [0.96, 1.005]),
                vec![Series::line("√cos α", 5, roots), Series::marks("Eq. (1)", 0, ratios.collect())],
            ),
        ],
    })
}
