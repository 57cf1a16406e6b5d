//! The smallest thickness or tie, or the largest height, with which a wall passes.

use report::palette::{BLUE, DARK_GREY, RED};
use report::plot::{Axis, Look, Plot, Series};
use rocking_wall::wall::Parameters;
use run::bisection::begins_at;
use serde::Serialize;

use crate::code::{Code, Subject};
use crate::error::CheckError;

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

/// What was found. Serialized it is what `wall check --find --json` prints.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Found {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// The value at which the wall begins to pass; `None` if it passes nowhere in the range.
    pub value: Option<f64>,
    /// The range that was searched.
    pub range: [f64; 2],
    /// The wall passes all over the range: `value` is its end.
    #[serde(rename = "passes_everywhere")]
    pub everywhere: bool,
    /// There are values beyond the one found with which the wall fails.
    pub fails_beyond: bool,
    /// (value, `ζ_E`) over the range; NaN where the wall or its check is impossible.
    pub curve: Vec<(f64, f64)>,
}

/// Finds the smallest value, or the largest height, with which a wall passes its check.
///
/// ```
/// use check::code::{Given, Subject, read};
/// use check::find::{Sought, find};
/// use rocking_wall::scene::Place;
/// use rocking_wall::wall::Parameters;
///
/// let text = r#"
/// [check]
/// code = "circolare-2019"
/// before_activation = "rigid"
/// soil = "B"
/// SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }
/// "#;
/// let code = read(&Place::new("scene.toml", text), Given::default())?.expect("there is a table [check]");
/// let parameters = Parameters::default();
/// let subject = Subject { title: "", parameters: &parameters, floors: None, is_tried: true };
/// let found = find(&*code, &subject, Sought::Thickness)?;
/// assert!((0.4..0.6).contains(&found.value.unwrap()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`CheckError`] of the wall as it is, so that a statement that is missing is named; and of a tie that is
/// sought for a wall without one.
pub fn find(code: &dyn Code, subject: &Subject<'_>, sought: Sought) -> Result<Found, CheckError> {
    let parameters = subject.parameters;
    let is_tie = matches!(sought, Sought::TieStrength | Sought::TieStiffness);
    if is_tie
        && !(parameters.tie_height > 0.0
            && (parameters.tie_stiffness > 0.0 || sought == Sought::TieStiffness))
    {
        let message =
            format!("{} is sought, but the wall has no tie; set tie_height and tie_stiffness", sought.name());
        return Err(CheckError::wall(message));
    }
    let tried = if code.takes_runs() { TRIED_DYNAMIC } else { TRIED };
    let zeta = |value: f64| {
        let parameters = sought.applied(parameters, value);
        let verdict = code.check(&Subject { parameters: &parameters, is_tried: true, ..*subject });
        verdict.map_or((f64::NAN, false), |verdict| (verdict.zeta, verdict.passed))
    };
    let range = sought.range(parameters);
    let at = |index: u32| range[0] * libm::pow(range[1] / range[0], f64::from(index) / f64::from(tried - 1));
    let mut tries: Vec<(f64, (f64, bool))> = (0..tried).map(|index| (at(index), zeta(at(index)))).collect();
    if tries.iter().all(|(_, (zeta, _))| zeta.is_nan()) {
        // whatever is wrong is wrong with the wall as it is
        code.check(subject)?;
    }
    let parameter = sought.name();
    let curve = tries.iter().map(|&(value, (zeta, _))| (value, zeta)).collect();
    // of heights the largest is sought
    if sought == Sought::Height {
        tries.reverse();
    }
    let passes = |&(_, (_, passed)): &(f64, (f64, bool))| passed;
    let Some(first) = tries.iter().position(passes) else {
        return Ok(Found { parameter, value: None, range, everywhere: false, fails_beyond: false, curve });
    };
    let fails = |&(_, (zeta, passed)): &(f64, (f64, bool))| zeta.is_finite() && !passed;
    let fails_beyond = tries[first..].iter().any(fails);
    let Some(before) = first.checked_sub(1) else {
        let value = Some(tries[0].0);
        return Ok(Found { parameter, value, range, everywhere: !fails_beyond, fails_beyond, curve });
    };
    let bracket = [tries[before].0, tries[first].0];
    let value = begins_at(bracket, HALVINGS, |value| Ok::<_, CheckError>(zeta(value).1))?;
    Ok(Found { parameter, value: Some(value), range, everywhere: false, fails_beyond, curve })
}

impl Found {
    /// Returns what was found, in lines.
    pub fn text(&self, sought: Sought) -> String {
        let (name, unit) = (sought.name(), sought.unit());
        let [from, to] = self.range.map(|end| format!("{end:.4}"));
        let [extreme, beyond] =
            if sought == Sought::Height { ["largest", "smaller"] } else { ["smallest", "larger"] };
        let text = match self.value {
            None if name.starts_with("tie") => format!(
                "no {name} from {from} to {to} {unit} passes; a side without a tie may govern: see tie_side\n"
            ),
            None => format!("no {name} from {from} to {to} {unit} passes\n"),
            Some(_) if self.everywhere => format!("every {name} from {from} to {to} {unit} passes\n"),
            Some(value) => format!("{extreme} {name} that passes: {value:.6} {unit}\n"),
        };
        let look = format!("some {beyond} values fail; look at the chart (--plot)\n");
        text + if self.fails_beyond { &look } else { "" }
    }
}

/// Draws `ζ_E` over the values that were tried up to three times the one found, the limit 1, and that value.
pub fn over_parameter(found: &Found, sought: Sought) -> Plot {
    let [left, right] = found.range;
    let right = found.value.map_or(right, |value| right.min(3.0 * value));
    let shown = found.curve.iter().copied().filter(|point| point.1.is_finite() && point.0 <= right);
    let points: Vec<(f64, f64)> = shown.collect();
    // far beyond the demand nothing is to be seen
    let top = points.iter().map(|point| point.1).fold(1.2, f64::max).min(3.0);
    let inside = points.into_iter().filter(|point| point.1 <= top).collect();
    let named = |name: String, look: Look, line: Series| Series { look, name, ..line };
    let mut series = vec![named("ζ_E".into(), Look::Solid, Series::line(BLUE, 2.0, inside))];
    if let Some(value) = found.value {
        let name = format!("{} = {value:.4} {}", sought.name(), sought.unit());
        let line = Series::line(RED, 1.3, vec![(value, 0.0), (value, top)]);
        series.push(named(name, Look::Dashed, line));
    }
    let axes = [
        Axis::over(&format!("{} ({})", sought.name(), sought.unit()), [left.min(right), right]),
        Axis::over("ζ_E", [0.0, 1.05 * top]),
    ];
    Plot { limits: vec![(1.0, DARK_GREY)], ..Plot::new([820.0, 460.0], axes, series) }
}
