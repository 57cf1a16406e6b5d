//! The body that a wall has above a level, and the thrusts that count on one of its sides.

use rocking_wall::variables::{Mechanism, Rocking};
use rocking_wall::wall::{Load, Parameters, Part, Profile, TieNumbers};

use crate::error::CheckError;

/// Heights that differ by less than this share of the height are the same.
const SAME: f64 = 1e-9;

/// Returns the parameters of the body above a level of a wall \[m\].
///
/// # Errors
/// [`CheckError`] of a level that cuts no body out of the wall.
pub(crate) fn above(parameters: &Parameters, level: f64) -> Result<Parameters, CheckError> {
    if level == 0.0 {
        return Ok(parameters.clone());
    }
    let refused = |message: String| Err(CheckError::value(&["hinge_levels"], message));
    if parameters.mechanism != Mechanism::Parapet {
        let is_strip = parameters.mechanism == Mechanism::VerticalSpanning;
        let what = if is_strip { "a strip wall" } else { "a body given by its integrals" };
        return refused(format!(
            "hinge_levels = {level} m: {what} has no levels; leave hinge_levels out, or give the wall as a \
             parapet of [[geometry.part]]"
        ));
    }
    let profile = match &parameters.profile {
        Some(profile) => Ok(profile.as_ref().clone()),
        None => Profile::new(vec![rectangle(parameters)], Vec::new(), Vec::new()),
    };
    let body = match profile.and_then(|profile| profile.above(level)) {
        Ok(body) => body,
        Err(error) => return refused(format!("hinge_levels: {error}")),
    };
    let mut above = parameters.clone();
    above.set_profile(body);
    // one at the level or below holds what does not turn
    let holds = |tie: &TieNumbers| tie.stiffness > 0.0 && tie.height > level + SAME * parameters.height;
    let lowered = parameters.ties().filter(holds);
    let lowered = lowered.map(|tie| TieNumbers { height: tie.height - level, ..tie });
    above.set_ties(&lowered.collect::<Vec<_>>());
    Ok(above)
}

/// Makes the ties brittle that have a strength and no plastic elongation: the check has no others.
pub(crate) fn make_brittle(parameters: &mut Parameters) {
    let brittle = |tie: TieNumbers| {
        let ultimate = if tie.strength > 0.0 && tie.ultimate < 0.0 { 0.0 } else { tie.ultimate };
        TieNumbers { ultimate, ..tie }
    };
    let ties: Vec<_> = parameters.ties().map(brittle).collect();
    parameters.set_ties(&ties);
}

fn rectangle(parameters: &Parameters) -> Part {
    let Parameters { height, thickness, width, density, .. } = *parameters;
    let (thickness, width, outer) = ([thickness; 2], [width; 2], [0.0; 2]);
    Part { base: 0.0, height, thickness, width, outer, density }
}

/// The loads of a wall; none of a rectangle.
pub(crate) fn loads(parameters: &Parameters) -> &[Load] {
    match (&parameters.profile, &parameters.loads) {
        (Some(profile), _) => profile.loads(),
        (None, Some(loads)) => loads,
        (None, None) => &[],
    }
}

/// Returns whether the thrust of a load counts on the side of `sign`: where it takes from the side, and where
/// it certainly lasts until collapse.
fn counts(load: &Load, sign: f64) -> bool {
    load.thrust * sign >= 0.0 || load.thrust_lasts
}

/// The moment about the base of the thrusts that are left out on the side of `sign`, which they would help
/// \[N m\].
pub(crate) fn left_out(parameters: &Parameters, sign: f64) -> f64 {
    let out = loads(parameters).iter().filter(|load| !counts(load, sign));
    out.map(|load| load.thrust.abs() * load.height).sum()
}

/// Returns the parameters with the thrusts that count on the side of `sign`.
pub(crate) fn on_side(parameters: &Parameters, sign: f64) -> Parameters {
    let mut own = parameters.clone();
    if left_out(parameters, sign) == 0.0 {
        return own;
    }
    set_loads(&mut own, |load| if counts(load, sign) { *load } else { Load { thrust: 0.0, ..*load } });
    if own.profile.is_none() {
        let sum = |of: fn(&Load) -> f64| loads(&own).iter().map(of).sum::<f64>();
        let (thrust, moment) = (sum(|load| load.thrust), sum(|load| load.thrust * load.height));
        own.thrust = thrust;
        own.thrust_height = if thrust == 0.0 { 0.0 } else { moment / thrust };
    }
    own
}

/// Divides the forces of loads and of further ties by a factor, as of the runs; masses stay.
pub(crate) fn divide_loads(parameters: &mut Parameters, factor: f64) {
    set_loads(parameters, |load| Load { force: load.force / factor, thrust: load.thrust / factor, ..*load });
    parameters.load_force /= factor;
    parameters.thrust /= factor;
    let softer = |tie: &TieNumbers| TieNumbers {
        stiffness: tie.stiffness / factor,
        strength: tie.strength / factor,
        bar: None,
        ..*tie
    };
    parameters.further_ties = parameters.further_ties.iter().map(softer).collect();
}

fn set_loads(parameters: &mut Parameters, changed: impl Fn(&Load) -> Load) {
    let own: Vec<_> = loads(parameters).iter().map(changed).collect();
    if let Some(profile) = &parameters.profile {
        parameters.profile = Some(profile.with_loads(own).into());
    } else if parameters.loads.is_some() {
        parameters.loads = Some(own.into());
    }
}

/// Refuses what the check has to be told of a body, and what it cannot have.
///
/// # Errors
/// [`CheckError`] with the load or the part, its value and the remedy.
pub(crate) fn check_body(parameters: &Parameters) -> Result<(), CheckError> {
    for (index, load) in loads(parameters).iter().enumerate() {
        if load.force > 0.0 && load.moving_mass.is_none() {
            return Err(CheckError::wall(format!(
                "load {}: moving_mass is missing beside force = {} N at height = {} m: state the share \
                 of its mass that moves along in [[geometry.load]], 1 where it rests on the wall, 0 where \
                 its inertia goes elsewhere",
                index + 1,
                load.force,
                load.height
            )));
        }
    }
    let hanging = parameters.profile.as_ref().and_then(|profile| profile.hanging().first().copied());
    match hanging {
        Some(part) if parameters.rocking != Rocking::OneSidedPositive => Err(CheckError::wall(format!(
            "part {}: hangs on the side of another and stands on nothing, as a wedge of a transverse wall \
             does, so that the wall has no inner toe; state rocking = \"one_sided_positive\" in [check]",
            part + 1
        ))),
        _ => Ok(()),
    }
}

/// Returns whether a wall is of one section, and nothing but its own mass moves, as a uniform beam is.
pub(crate) fn is_uniform(parameters: &Parameters) -> bool {
    let is_one = |profile: &Profile| {
        Profile::new(profile.parts().to_vec(), profile.openings().to_vec(), Vec::new())
            .is_ok_and(|bare| bare.is_rectangle())
    };
    let moves = loads(parameters).iter().any(|load| load.moving(parameters.gravity) > 0.0);
    match &parameters.profile {
        Some(profile) => is_one(profile) && !moves,
        None => parameters.is_rectangle(),
    }
}
