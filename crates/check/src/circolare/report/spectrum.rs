//! A number of a spectrum with its formula and the numbers put in.

use crate::circolare::ground::damping_factor;
use crate::circolare::{Demand, FloorSpectrum, GroundSpectrum};
use crate::report::markup::Calculation;

/// Share by which a formula may differ from the number that it explains: rounding only \[-\].
const ROUNDING: f64 = 1e-9;

/// Returns whether a formula gives a number.
pub(super) fn gives(formula: f64, number: f64) -> bool {
    (formula - number).abs() <= ROUNDING * number.abs()
}

/// The formula of `S_e` or `S_eZ` at a period with a name, for the damping ξ; bare where the number has no
/// short formula. The calculation then knows its symbols.
pub(super) fn of(lines: &mut Calculation, demand: &Demand, (name, period): (&str, f64), xi: f64) -> String {
    lines.know(&[(name, period), ("η", damping_factor(xi))]);
    if let Some(GroundSpectrum { a_g, f0, s, t_b, t_c, t_d, .. }) = demand.ground().copied() {
        lines.know(&[("a_g", a_g), ("S", s), ("F0", f0), ("T_B", t_b), ("T_C", t_c), ("T_D", t_d)]);
    }
    match demand {
        Demand::Ground(ground) => on_ground(ground, ("S_e", name, period), xi),
        Demand::Floor(floor) => at_height(lines, floor, (name, period), xi),
        Demand::Points(..) | Demand::Records(_) => format!("S_e({name}, ξ)"),
    }
}

/// [3.2.2].
fn on_ground(ground: &GroundSpectrum, (symbol, name, period): (&str, &str, f64), xi: f64) -> String {
    let GroundSpectrum { t_b, t_c, t_d, .. } = *ground;
    let left = format!("{symbol}({name}, ξ)");
    if !gives(ground.acceleration(period, xi), ground.pseudo_acceleration(period, xi)) {
        return format!("{left} = S_De({name}, ξ) 4π²/{name}²");
    }
    let more = if period < t_b {
        format!(" [{name}/T_B + (1 − {name}/T_B)/(η F0)]")
    } else if period < t_c {
        String::new()
    } else if period < t_d {
        format!(" T_C/{name}")
    } else {
        format!(" T_C T_D/{name}²")
    };
    format!("{left} = a_g S η F0{more}")
}

/// [C7.2.5], [C7.2.6].
fn at_height(lines: &mut Calculation, floor: &FloorSpectrum, (name, period): (&str, f64), xi: f64) -> String {
    let left = format!("S_eZ({name}, ξ)");
    let ground = floor.ground();
    if floor.ground_governs(period, xi) {
        return format!("{left} = a_g S");
    }
    let modes = floor.modes();
    if period > floor.first_period()
        && gives(ground.pseudo_acceleration(period, xi), floor.acceleration(period, xi))
    {
        return format!("{left} = {}", on_ground(ground, ("S_e", name, period), xi));
    }
    let (Some(mode), 1) = (modes.first(), modes.len()) else {
        return format!("{left} = √(Σ S_eZ,k²)");
    };
    let ((from, to), most) = (FloorSpectrum::PLATEAU, floor.amplification(xi));
    lines.know(&[("a_Z", floor.mode_accelerations()[0]), ("A", most), ("(A − 1)", most - 1.0)]);
    lines.know(&[("a", from), ("b", to), ("T_1", mode.period)]);
    if period < from * mode.period {
        format!("{left} = a_Z A/[1 + (A − 1) (1 − {name}/(a T_1))^1.6]")
    } else if period < to * mode.period {
        format!("{left} = a_Z A")
    } else {
        format!("{left} = a_Z A/[1 + (A − 1) ({name}/(b T_1) − 1)^1.2]")
    }
}
