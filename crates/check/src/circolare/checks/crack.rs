//! The crack of a transverse wall: how much of it a façade takes along.
//!
//! A wedge hangs on the inner face of the façade with its tip below. Its crack climbs from the tip at an
//! angle β from the vertical. The code takes the shape of the blocks from the least α0 within a class of
//! mechanisms (C8.7.1.2.1.1) and gives no range for β, which the engineer states.

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Parameters, Part, Profile, Statics};

use super::activation::at_activation;
use crate::circolare::curve::Curve;
use crate::circolare::curve::case::Case;
use crate::circolare::curve::hinge::{FINE, least};
use crate::error::CheckError;

/// Limits of β \[°\].
const LIMITS: [f64; 2] = [1.0, 80.0];
/// Faces that differ by less go on from each other \[m\].
const SAME: f64 = 1e-6;

/// Returns the case with the cracks of its wedges at the angle of the least α0, ties that count at the
/// activation included; the case as it is where no angles are stated.
///
/// # Errors
/// [`CheckError`] of angles that do not rise, of a wall without a wedge, and of one that has no check at an
/// angle.
pub(crate) fn searched(mut case: Case<'_>) -> Result<Case<'_>, CheckError> {
    let Some([from, to]) = case.statement.table.crack_angles else { return Ok(case) };
    let refused = |message: String| Err(CheckError::value(&["crack_angles"], message));
    if !(from >= LIMITS[0] && to <= LIMITS[1] && from < to) {
        let [least, most] = LIMITS;
        return refused(format!(
            "crack_angles = [{from}, {to}] must rise, within {least} to {most} degrees from the vertical"
        ));
    }
    let profile = case.parameters.profile.clone();
    let is_parapet = case.parameters.mechanism == Mechanism::Parapet;
    let Some(profile) = profile.filter(|own| is_parapet && has_wedge(own)) else {
        // what is above a level may have none
        if case.level > 0 {
            return Ok(case);
        }
        return refused(format!(
            "crack_angles = [{from}, {to}]: the wall has no wedge; give a part that hangs on the inner face, \
             with base, outer and thickness = [0, t], or leave crack_angles out"
        ));
    };
    let sign = case.sides().next().unwrap_or(1.0);
    let alpha0 = |angle: f64| {
        let mut own = case.clone();
        own.parameters = cracked(&case.parameters, &profile, angle)?;
        let curve = Curve::new(&own, sign, None)?;
        Ok([at_activation(&curve, case.statement)?.alpha0])
    };
    let at =
        |angle: f64| move |error: CheckError| error.within(&format!("with the crack at {angle} degrees"));
    let angle = least(FINE, [from, to], &[], |angle, _| alpha0(angle).map_err(at(angle)))?[0];
    let angle = angle.unwrap_or(from);
    case.parameters = cracked(&case.parameters, &profile, angle)?;
    case.crack = Some(angle);
    if case.shared.is_some() {
        case.shared = Some(case.demands_at(Statics::new(&case.parameters)?.body())?);
    }
    Ok(case)
}

/// Whether a part hangs on the side of another with its tip below.
fn has_wedge(profile: &Profile) -> bool {
    profile.hanging().into_iter().any(|index| profile.parts()[index].thickness[0] == 0.0)
}

/// The wall with the cracks of its wedges at an angle \[°\].
fn cracked(parameters: &Parameters, profile: &Profile, angle: f64) -> Result<Parameters, CheckError> {
    let (hanging, slope) = (profile.hanging(), angle.to_radians().tan());
    // the tip of the crack of each part of a wedge
    let mut tips: Vec<Option<[f64; 2]>> = Vec::new();
    for (index, part) in profile.parts().iter().enumerate() {
        let goes_on = |own: &Part| {
            let gaps = [own.top() - part.base, inner(own)[1] - inner(part)[0]];
            gaps.iter().all(|gap| gap.abs() < SAME)
        };
        let below = profile.parts().iter().zip(&tips).find(|(own, tip)| tip.is_some() && goes_on(own));
        let is_tip = part.thickness[0] == 0.0 && hanging.contains(&index);
        let tip = is_tip.then_some([part.base, part.outer[0]]);
        tips.push(tip.or_else(|| below.and_then(|(_, tip)| *tip)));
    }
    let parts = profile.parts().iter().zip(tips).map(|(part, tip)| {
        let Some([z, x]) = tip else { return *part };
        let face = [part.base, part.top()].map(|height| x + slope * (height - z));
        Part { thickness: [face[0] - part.outer[0], face[1] - part.outer[1]], ..*part }
    });
    let profile = profile
        .with_parts(parts.collect())
        .map_err(|error| CheckError::wall(format!("the wedges of crack_angles: {error}")))?;
    let mut cracked = parameters.clone();
    cracked.set_profile(profile);
    Ok(cracked)
}

/// The inner face of a part at its bottom and top \[m\].
fn inner(part: &Part) -> [f64; 2] {
    [part.outer[0] + part.thickness[0], part.outer[1] + part.thickness[1]]
}
