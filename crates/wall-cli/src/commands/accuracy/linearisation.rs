//! What small rotations leave out, Figures 2 and 3 of the paper, as a table and as CSV.

use std::fmt::Write;

use crate::output::optional;
use evidence::accuracy::linearisation::{BothRotations, STARTS};
use run::rotations::SLENDERNESS;

pub(super) fn table(both: &[BothRotations]) -> String {
    let mut text =
        String::from("small rotations: their period over that of full rotations, by start over u_ins\n");
    let _ = write!(text, "  {:<8}{:>9}", "alpha", "Eq. (5)");
    for measured in both {
        for start in STARTS {
            let _ = write!(text, "{:>13}", format!("{} {start}", measured.name));
        }
    }
    text.push('\n');
    for (index, alpha) in SLENDERNESS.iter().enumerate() {
        let housner = both[0].periods[0][index].over_housner().unwrap_or(f64::NAN);
        let _ = write!(text, "  {alpha:<8.2}{housner:>9.5}");
        for periods in both.iter().flat_map(|measured| &measured.periods) {
            let _ = write!(text, "{:>13.5}", periods[index].ratio());
        }
        text.push('\n');
    }
    for BothRotations { name, duration, restitution, history, .. } in both {
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

pub(super) fn csv(both: &[BothRotations]) -> String {
    let mut text = String::from(
        "mechanism,alpha_rad,start_over_u_ins,period_linear_s,period_trigonometric_s,period_eq5_s,ratio,\
         ratio_eq5\n",
    );
    for measured in both {
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

fn first(times: &[f64]) -> f64 {
    times.first().copied().unwrap_or(f64::NAN)
}
