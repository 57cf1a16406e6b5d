//! The smallest thickness or tie, or the largest height, with which a wall passes.

use rocking_wall::scene::Floors;
use rocking_wall::wall::Parameters;

use super::error::CheckError;
use super::{Method, Records, Source, Statement, check};
use run::bisection::begins_at;

/// Values that are tried, in equal ratios.
const TRIED: u32 = 121;
/// Values that are tried where each takes runs under records.
const TRIED_DYNAMIC: u32 = 31;
/// Halvings of the step in which the wall begins to pass: the value is then known to 1e-9 of it.
const HALVINGS: u32 = 30;

/// What is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// The smallest thickness \[m\].
    Thickness,
    /// The largest height \[m\].
    Height,
    /// The smallest strength of the tie \[N\].
    TieStrength,
    /// The smallest stiffness of the tie \[N/m\].
    TieStiffness,
}

impl Sought {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Thickness, Self::Height, Self::TieStrength, Self::TieStiffness];

    /// Name of the parameter.
    pub fn name(self) -> &'static str {
        ["thickness", "height", "tie_strength", "tie_stiffness"][self as usize]
    }

    /// Unit of the parameter.
    pub fn unit(self) -> &'static str {
        ["m", "m", "N", "N/m"][self as usize]
    }

    /// The wall with another value of the parameter.
    pub fn applied(self, parameters: &Parameters, value: f64) -> Parameters {
        let mut parameters = parameters.clone();
        *match self {
            Self::Thickness => &mut parameters.thickness,
            Self::Height => &mut parameters.height,
            Self::TieStrength => &mut parameters.tie_strength,
            Self::TieStiffness => &mut parameters.tie_stiffness,
        } = value;
        parameters
    }

    /// The range of values that is searched: an eighth to eight times the wall's own size, or ties from very
    /// weak to very strong beside its weight.
    fn range(self, parameters: &Parameters) -> [f64; 2] {
        let Parameters { height, thickness, width, density, gravity, .. } = *parameters;
        let weight = density * gravity * height * thickness * width;
        match self {
            Self::Thickness => [thickness / 8.0, 8.0 * thickness],
            Self::Height => [height / 8.0, 8.0 * height],
            Self::TieStrength => [1e-3 * weight, 1e2 * weight],
            Self::TieStiffness => [1e-2 * weight / height, 1e5 * weight / height],
        }
    }
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The value at which the wall begins to pass; `None` if it passes nowhere in the range.
    pub value: Option<f64>,
    /// The range that was searched.
    pub range: [f64; 2],
    /// The wall passes all over the range: `value` is its end.
    pub everywhere: bool,
    /// There are values beyond the one found with which the wall fails.
    pub fails_beyond: bool,
    /// (value, `ζ_E`) over the range; NaN where the wall or its check is impossible.
    pub curve: Vec<(f64, f64)>,
}

/// Finds the smallest value, or the largest height, with which a wall passes its check.
///
/// ```
/// use rocking_wall::scene::Place;
/// use rocking_wall::wall::Parameters;
/// use check::circolare::{Records, Sought, find, read_table};
///
/// let text = r#"
/// [check]
/// code = "circolare-2019"
/// before_activation = "rigid"
/// soil = "B"
/// SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }
/// "#;
/// let statement = read_table(&Place::new("scene.toml", text))?.unwrap().statement()?;
/// let found =
///     find(&Parameters::default(), None, &statement, &Records::default(), Sought::Thickness)?;
/// assert!((0.4..0.6).contains(&found.value.unwrap()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`CheckError`] of the wall as it is, so that a statement that is missing is named; and of a tie that is
/// sought for a wall without one.
pub fn find(
    parameters: &Parameters,
    floors: Option<&Floors>,
    statement: &Statement,
    records: &Records,
    sought: Sought,
) -> Result<Found, CheckError> {
    let is_tie = matches!(sought, Sought::TieStrength | Sought::TieStiffness);
    if is_tie
        && !(parameters.tie_height > 0.0
            && (parameters.tie_stiffness > 0.0 || sought == Sought::TieStiffness))
    {
        let message =
            format!("{} is sought, but the wall has no tie; set tie_height and tie_stiffness", sought.name());
        return Err(CheckError::wall(message));
    }
    let none = Records::default();
    let demanded = statement.states.iter().flatten().any(|given| given.source == Source::Records);
    let is_dynamic = demanded || statement.method == Method::Dynamic;
    let (records, tried) = if is_dynamic { (records, TRIED_DYNAMIC) } else { (&none, TRIED) };
    let run = |value: f64| check(&sought.applied(parameters, value), floors, statement, records);
    let zeta =
        |value: f64| run(value).map_or((f64::NAN, false), |verdict| (verdict.governs.zeta, verdict.passed));
    let range = sought.range(parameters);
    let at = |index: u32| range[0] * libm::pow(range[1] / range[0], f64::from(index) / f64::from(tried - 1));
    let mut tries: Vec<(f64, (f64, bool))> = (0..tried).map(|index| (at(index), zeta(at(index)))).collect();
    if tries.iter().all(|(_, (zeta, _))| zeta.is_nan()) {
        // whatever is wrong is wrong with the wall as it is
        check(parameters, floors, statement, records)?;
    }
    let curve = tries.iter().map(|&(value, (zeta, _))| (value, zeta)).collect();
    // of heights the largest is sought
    if sought == Sought::Height {
        tries.reverse();
    }
    let passes = |&(_, (_, passed)): &(f64, (f64, bool))| passed;
    let Some(first) = tries.iter().position(passes) else {
        return Ok(Found { value: None, range, everywhere: false, fails_beyond: false, curve });
    };
    let fails = |&(_, (zeta, passed)): &(f64, (f64, bool))| zeta.is_finite() && !passed;
    let fails_beyond = tries[first..].iter().any(fails);
    let Some(before) = first.checked_sub(1) else {
        let value = Some(tries[0].0);
        return Ok(Found { value, range, everywhere: !fails_beyond, fails_beyond, curve });
    };
    let bracket = [tries[before].0, tries[first].0];
    let value = begins_at(bracket, HALVINGS, |value| Ok::<_, CheckError>(zeta(value).1))?;
    Ok(Found { value: Some(value), range, everywhere: false, fails_beyond, curve })
}
