//! A number of a spectrum with its formula and the numbers put in.

use crate::circolare::ground::damping_factor;
use crate::circolare::{Demand, FloorSpectrum, GroundSpectrum};
use crate::report::markup::shown as n;

/// Share by which a formula may differ from the number that it explains: rounding only \[-\].
const ROUNDING: f64 = 1e-9;

/// Returns whether a formula gives a number.
pub(super) fn gives(formula: f64, number: f64) -> bool {
    (formula - number).abs() <= ROUNDING * number.abs()
}

/// The formula of `S_e` or `S_eZ` at a period with a name, and the numbers put in, for the damping ξ; bare
/// where the number has no short formula.
pub(super) fn of(demand: &Demand, (name, period): (&str, f64), xi: f64) -> [String; 2] {
    match demand {
        Demand::Ground(ground) => on_ground(ground, ("S_e", name, period), xi),
        Demand::Floor(floor) => at_height(floor, (name, period), xi),
        Demand::Points(..) | Demand::Records(_) => [format!("S_e({name}, ξ)"), String::new()],
    }
}

/// [3.2.2].
fn on_ground(ground: &GroundSpectrum, (symbol, name, period): (&str, &str, f64), xi: f64) -> [String; 2] {
    let GroundSpectrum { a_g, f0, s, t_b, t_c, t_d, .. } = *ground;
    let eta = damping_factor(xi);
    let left = format!("{symbol}({name}, ξ)");
    if !gives(ground.acceleration(period, xi), ground.pseudo_acceleration(period, xi)) {
        return [format!("{left} = S_De({name}, ξ) 4π²/{name}²"), String::new()];
    }
    let put = format!("{} · {} · {} · {}", n(a_g), n(s), n(eta), n(f0));
    let [t, t_b_of, t_c_of, t_d_of] = [period, t_b, t_c, t_d].map(n);
    let (more, more_put) = if period < t_b {
        (
            format!(" [{name}/T_B + (1 − {name}/T_B)/(η F0)]"),
            format!(" · [{t}/{t_b_of} + (1 − {t}/{t_b_of})/({} · {})]", n(eta), n(f0)),
        )
    } else if period < t_c {
        Default::default()
    } else if period < t_d {
        (format!(" T_C/{name}"), format!(" · {t_c_of}/{t}"))
    } else {
        (format!(" T_C T_D/{name}²"), format!(" · {t_c_of} · {t_d_of}/{t}²"))
    };
    [format!("{left} = a_g S η F0{more}"), put + &more_put]
}

/// [C7.2.5], [C7.2.6].
fn at_height(floor: &FloorSpectrum, (name, period): (&str, f64), xi: f64) -> [String; 2] {
    let left = format!("S_eZ({name}, ξ)");
    let ground = floor.ground();
    if floor.ground_governs(period, xi) {
        return [format!("{left} = a_g S"), format!("{} · {}", n(ground.a_g), n(ground.s))];
    }
    let value = floor.acceleration(period, xi);
    let modes = floor.modes();
    if period > floor.first_period() && gives(ground.pseudo_acceleration(period, xi), value) {
        let [formula, put] = on_ground(ground, ("S_e", name, period), xi);
        return [format!("{left} = {formula}"), put];
    }
    let (Some(mode), 1) = (modes.first(), modes.len()) else {
        return [format!("{left} = √(Σ S_eZ,k²)"), String::new()];
    };
    let (from, to) = FloorSpectrum::PLATEAU;
    let (a_z, most) = (n(floor.mode_accelerations()[0]), n(floor.amplification(xi)));
    let less = n(floor.amplification(xi) - 1.0);
    let [t, t_1] = [period, mode.period].map(n);
    if period < from * mode.period {
        let formula = format!("{left} = a_Z A/[1 + (A − 1) (1 − {name}/(a T_1))^1.6]");
        return [formula, format!("{a_z} · {most}/[1 + {less} · (1 − {t}/({from} · {t_1}))^1.6]")];
    }
    if period < to * mode.period {
        return [format!("{left} = a_Z A"), format!("{a_z} · {most}")];
    }
    let formula = format!("{left} = a_Z A/[1 + (A − 1) ({name}/(b T_1) − 1)^1.2]");
    [formula, format!("{a_z} · {most}/[1 + {less} · ({t}/({to} · {t_1}) − 1)^1.2]")]
}
