//! What to know of the loads and thrusts of a body.

use rocking_wall::wall::Load;

use crate::circolare::curve::case::Case;
use crate::circolare::curve::level;
use crate::words::names::Side;
use crate::words::{Sentence, at_most, say};

/// What the loads of a wall leave to be known; `has_runs` says that there are runs under records.
pub(super) fn warnings(case: &Case<'_>, has_runs: bool) -> Vec<Sentence> {
    let loads = level::loads(&case.parameters);
    let is_partly = |load: &Load| load.force > 0.0 && load.moving_mass.is_some_and(|share| share < 1.0);
    let partly = loads.iter().enumerate().filter(|(_, load)| is_partly(load));
    let mut warnings: Vec<_> = partly
        .map(|(index, load)| {
            let [height, share] = [load.height, load.moving_mass.unwrap_or(0.0)].map(|it| at_most(it, 6));
            let said = |name: Sentence| {
                say! {
                    "load {number} at {height} m: {name} = {share} is below 1; the printed text moves the \
                     mass of all that rests on a body (C8.7.1.2.1.1)",
                    "carico {number} a {height} m: {name} = {share} è minore di 1; il testo della norma \
                     muove la massa di tutto ciò che poggia su un corpo (C8.7.1.2.1.1)",
                    number = (index + 1).to_string(), height, name, share
                }
            };
            let share_of_mass = say!("share of its mass that moves", "quota della massa in moto");
            said(Sentence::same("moving_mass")).on_page(said(share_of_mass))
        })
        .collect();
    for sign in case.sides() {
        let moment = level::left_out(&case.parameters, sign);
        if moment == 0.0 {
            continue;
        }
        let (side, moment) = (case.told(Side::of(sign)), at_most(1e-3 * moment, 4));
        warnings.push(say! {
            "{side}: thrusts with a moment of {moment} kN m would help and are left out; state thrust_lasts \
             = true of those that certainly last until collapse (C8.7.1.2.1.6)",
            "{side}: spinte favorevoli con momento {moment} kN m non considerate; dichiarare thrust_lasts = \
             true per quelle che certamente permangono fino al collasso (C8.7.1.2.1.6)", side, moment
        }.on_page(say! {
            "{side}: thrusts with a moment of {moment} kN m would help and are left out: that they last \
             until collapse is not stated (C8.7.1.2.1.6)",
            "{side}: spinte favorevoli con momento {moment} kN m non considerate: non è dichiarato che \
             permangono fino al collasso (C8.7.1.2.1.6)", side, moment
        }));
        if has_runs {
            warnings.push(say! {
                "{side}: the runs under records count these thrusts on both sides",
                "{side}: le analisi con accelerogrammi considerano queste spinte nei due versi", side
            });
        }
    }
    warnings
}
