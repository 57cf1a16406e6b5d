//! The smallest thickness or tie, or the largest height, with which a wall passes.

use report::palette::{BLUE, DARK_GREY, RED};
use report::plot::{Axis, Look, Plot, Series};
use rocking_wall::wall::Parameters;
use run::bisection::first_true;
use serde_json::{Value, json};

use crate::code::{Code, Subject};
use crate::error::CheckError;

/// Values that are tried, in equal ratios.
const TRIED: u32 = 121;
/// Values that are tried where each takes runs under records.
const TRIED_UNDER_RECORDS: u32 = 31;
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

    fn is_of_tie(self) -> bool {
        matches!(self, Self::TieStrength | Self::TieStiffness)
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
    /// What was sought.
    pub sought: Sought,
    /// The value at which the wall begins to pass; `None` if it passes nowhere in the range.
    pub value: Option<f64>,
    /// The range that was searched.
    pub range: [f64; 2],
    /// The wall passes all over the range: `value` is its end.
    pub everywhere: bool,
    /// There are values beyond the one found with which the wall fails.
    pub fails_beyond: bool,
    /// (value, capacity over demand) over the range; NaN where the wall or its check is impossible.
    pub curve: Vec<(f64, f64)>,
    /// Symbol of capacity over demand.
    symbol: &'static str,
}

impl Found {
    /// What was found, in lines.
    pub fn text(&self) -> String {
        let (name, unit) = (self.sought.name(), self.sought.unit());
        let [from, to] = self.range.map(|end| format!("{end:.4}"));
        let (extreme, beyond) =
            if self.sought == Sought::Height { ("largest", "smaller") } else { ("smallest", "larger") };
        let text = match self.value {
            None if self.sought.is_of_tie() => format!(
                "no {name} from {from} to {to} {unit} passes; a side without a tie may govern: see tie_side\n"
            ),
            None => format!("no {name} from {from} to {to} {unit} passes\n"),
            Some(_) if self.everywhere => format!("every {name} from {from} to {to} {unit} passes\n"),
            Some(value) => format!("{extreme} {name} that passes: {value:.6} {unit}\n"),
        };
        let look = format!("some {beyond} values fail; look at the chart (--plot)\n");
        text + if self.fails_beyond { &look } else { "" }
    }

    /// What was found, by names.
    pub fn json(&self) -> Value {
        json!({
            "parameter": self.sought.name(),
            "value": self.value,
            "range": self.range,
            "passes_everywhere": self.everywhere,
            "fails_beyond": self.fails_beyond,
            "curve": self.curve,
        })
    }

    /// Draws capacity over demand over the values that were tried, up to three times the one found; the limit
    /// 1, and that value.
    pub fn plot(&self) -> Plot {
        let (name, unit) = (self.sought.name(), self.sought.unit());
        let symbol = self.symbol.replace("zeta", "ζ");
        let [left, right] = self.range;
        let right = self.value.map_or(right, |value| right.min(3.0 * value));
        let shown = self.curve.iter().copied().filter(|point| point.1.is_finite() && point.0 <= right);
        let points: Vec<(f64, f64)> = shown.collect();
        // far beyond the demand nothing is to be seen
        let top = points.iter().map(|point| point.1).fold(1.2, f64::max).min(3.0);
        let inside = points.into_iter().filter(|point| point.1 <= top).collect();
        let mut series = vec![Series { name: symbol.clone(), ..Series::stroke(BLUE, 2.0, inside) }];
        if let Some(value) = self.value {
            let line = Series::stroke(RED, 1.3, vec![(value, 0.0), (value, top)]);
            let name = format!("{name} = {value:.4} {unit}");
            series.push(Series { look: Look::Dashed, name, ..line });
        }
        let axes = [
            Axis::over(&format!("{name} ({unit})"), [left.min(right), right]),
            Axis::over(&symbol, [0.0, 1.05 * top]),
        ];
        Plot { limits: vec![(1.0, DARK_GREY)], ..Plot::new([820.0, 460.0], axes, series) }
    }
}

/// Finds the smallest value, or the largest height, with which a wall passes its check.
///
/// ```
/// use check::{CheckFile, Sought, Subject, find, read};
/// use rocking_wall::wall::Parameters;
///
/// let text = r#"
/// [check]
/// code = "circolare-2019"
/// before_activation = "rigid"
/// soil = "B"
/// SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }
/// "#;
/// let code = read(&CheckFile::parse("scene.toml", text)?)?;
/// let wall = Subject { parameters: &Parameters::default(), floors: None };
/// let found = find(&*code, wall, Sought::Thickness)?;
/// assert!((0.4..0.6).contains(&found.value.unwrap()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`CheckError`] of the wall as it is, so that a statement that is missing is named; and of a tie that is
/// sought for a wall without one.
pub fn find(code: &dyn Code, subject: Subject<'_>, sought: Sought) -> Result<Found, CheckError> {
    let Subject { parameters, floors } = subject;
    let has_tie =
        parameters.tie_height > 0.0 && (parameters.tie_stiffness > 0.0 || sought == Sought::TieStiffness);
    if sought.is_of_tie() && !has_tie {
        let name = sought.name();
        let message = format!("{name} is sought, but the wall has no tie; set tie_height and tie_stiffness");
        return Err(CheckError::wall(message));
    }
    let deciding = code.deciding();
    let code = deciding.as_deref().unwrap_or(code);
    let tried = if code.takes_runs() { TRIED_UNDER_RECORDS } else { TRIED };
    let zeta = |value: f64| {
        let parameters = sought.applied(parameters, value);
        let verdict = code.check(Subject { parameters: &parameters, floors });
        verdict.map_or((f64::NAN, false), |verdict| (verdict.zeta, verdict.passed))
    };
    let range = sought.range(parameters);
    let at = |index: u32| range[0] * libm::pow(range[1] / range[0], f64::from(index) / f64::from(tried - 1));
    let mut tries: Vec<(f64, (f64, bool))> = (0..tried).map(|index| (at(index), zeta(at(index)))).collect();
    if tries.iter().all(|(_, (zeta, _))| zeta.is_nan()) {
        // whatever is wrong is wrong with the wall as it is
        code.check(subject)?;
    }
    let curve = tries.iter().map(|&(value, (zeta, _))| (value, zeta)).collect();
    // of heights the largest is sought
    if sought == Sought::Height {
        tries.reverse();
    }
    let none = Found {
        sought,
        value: None,
        range,
        everywhere: false,
        fails_beyond: false,
        curve,
        symbol: code.entry().symbol,
    };
    let Some(first) = tries.iter().position(|(_, (_, passed))| *passed) else { return Ok(none) };
    let fails_beyond = tries[first..].iter().any(|(_, (zeta, passed))| zeta.is_finite() && !passed);
    let Some(before) = first.checked_sub(1) else {
        let value = Some(tries[0].0);
        return Ok(Found { value, everywhere: !fails_beyond, fails_beyond, ..none });
    };
    let bracket = [tries[before].0, tries[first].0];
    let value = first_true(bracket, HALVINGS, |value| Ok::<_, CheckError>(zeta(value).1))?;
    Ok(Found { value: Some(value), fails_beyond, ..none })
}
