//! How a number of a spectrum follows: its equation, and where it comes from.

use crate::circolare::curve::ledger::gives;
use crate::ntc::demand::{Demand, MEAN_COUNTS_FROM};
use crate::ntc::floor::FloorSpectrum;
use crate::ntc::ground::{GroundSpectrum, damping_factor};
use crate::words::ledger::Ledger;
use crate::words::{Sentence, say};

/// Where the spectrum of a demand comes from.
pub(super) fn source(demand: &Demand) -> Sentence {
    match demand {
        Demand::Ground(_) => Sentence::same("[3.2.2]"),
        Demand::Floor(_) => Sentence::same("[C7.2.6]"),
        Demand::Points(..) => say!("the spectrum given", "lo spettro fornito"),
        Demand::Records(records) if records.len() >= MEAN_COUNTS_FROM => {
            say!("mean of the records", "media degli accelerogrammi")
        }
        Demand::Records(_) => say!("envelope of the records", "inviluppo degli accelerogrammi"),
    }
}

/// A period, and its symbol.
#[derive(Clone, Copy)]
pub(super) struct At<'a> {
    pub(super) symbol: &'a str,
    pub(super) period: f64,
}

/// The equation of `S_e` or `S_eZ` at a period with a name, for the damping ξ; bare where the number has no
/// short one. The ledger then knows its symbols.
pub(super) fn equation(ledger: &mut Ledger, demand: &Demand, at: At<'_>, xi: f64) -> String {
    let At { symbol: name, period } = at;
    ledger.know(&[(name, period), ("η", damping_factor(xi))]);
    if let Some(GroundSpectrum { a_g, f0, s, t_b, t_c, t_d, .. }) = demand.ground().copied() {
        ledger.know(&[("a_g", a_g), ("S", s), ("F0", f0), ("T_B", t_b), ("T_C", t_c), ("T_D", t_d)]);
    }
    match demand {
        Demand::Ground(ground) => on_ground(ground, at, xi),
        Demand::Floor(floor) => at_height(ledger, floor, at, xi),
        Demand::Points(..) | Demand::Records(_) => format!("S_e({name}, ξ)"),
    }
}

/// [3.2.2].
fn on_ground(ground: &GroundSpectrum, at: At<'_>, xi: f64) -> String {
    let At { symbol: name, period } = at;
    let GroundSpectrum { t_b, t_c, t_d, .. } = *ground;
    let left = format!("S_e({name}, ξ)");
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
fn at_height(ledger: &mut Ledger, floor: &FloorSpectrum, at: At<'_>, xi: f64) -> String {
    let At { symbol: name, period } = at;
    let left = format!("S_eZ({name}, ξ)");
    let ground = floor.ground();
    if floor.ground_governs(period, xi) {
        return format!("{left} = a_g S");
    }
    let modes = floor.modes();
    if period > floor.first_period()
        && gives(ground.pseudo_acceleration(period, xi), floor.acceleration(period, xi))
    {
        return format!("{left} = {}", on_ground(ground, at, xi));
    }
    let (Some(mode), 1) = (modes.first(), modes.len()) else {
        return format!("{left} = √(Σ S_eZ,k²)");
    };
    let ((from, to), most) = (FloorSpectrum::PLATEAU, floor.amplification(xi));
    ledger.know(&[("a_Z", floor.mode_accelerations()[0]), ("A", most), ("(A − 1)", most - 1.0)]);
    ledger.know(&[("a", from), ("b", to), ("T_1", mode.period)]);
    if period < from * mode.period {
        format!("{left} = a_Z A/[1 + (A − 1) (1 − {name}/(a T_1))^1.6]")
    } else if period < to * mode.period {
        format!("{left} = a_Z A")
    } else {
        format!("{left} = a_Z A/[1 + (A − 1) ({name}/(b T_1) − 1)^1.2]")
    }
}
