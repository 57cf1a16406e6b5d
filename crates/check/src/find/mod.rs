//! The smallest thickness or tie, or the largest height, with which a wall passes each of its checks.

mod figure;

use std::fmt::Write;

use report::number;
use rocking_wall::wall::Parameters;
use run::bisection::first_true;
use run::parallel;
use serde::Serialize;
use serde_json::{Value, json};

use crate::code::sought::{Sought, load};
use crate::code::verdict::Verdict;
use crate::code::{Code, Subject};
use crate::error::CheckError;

/// Values that are tried, in equal ratios.
const TRIED: u32 = 241;
/// Values that are tried where each takes runs under records.
const TRIED_UNDER_RECORDS: u32 = 31;
/// Halvings of the step in which the wall begins to pass: the value is then known to 1e-9 of it.
const HALVINGS: u32 = 30;
/// Force of a tie over W + O above which it is said to be large \[-\].
const LARGE: f64 = 0.5;

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// What was sought.
    pub sought: Sought,
    /// The value from which on the wall passes every check that decides; `None` if there is none.
    pub value: Option<f64>,
    /// The range that was searched.
    pub range: [f64; 2],
    /// Each check, in the order of the verdict.
    pub checks: Vec<FoundCheck>,
    /// Force of the tie at the value over W + O \[-\].
    pub force_ratio: Option<f64>,
    /// Symbol of capacity over demand.
    symbol: &'static str,
}

/// What was found for one check.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FoundCheck {
    /// Its name.
    pub check: &'static str,
    /// Whether it decides.
    pub decides: bool,
    /// The value from which on the wall passes it, up to the end of the range (a height: down to its start).
    pub value: Option<f64>,
    /// Whether the wall passes it all over the range.
    #[serde(rename = "passes_everywhere")]
    pub everywhere: bool,
    /// Intervals of values that pass, apart from that one.
    pub intervals: Vec<[f64; 2]>,
    /// Why there is no value, where that can be said.
    pub reason: Option<String>,
    /// (value, capacity over demand) over the range; NaN where the wall or its check is impossible.
    pub curve: Vec<(f64, f64)>,
}

impl Found {
    /// Returns whether every value of the range passes what decides.
    pub fn everywhere(&self) -> bool {
        self.checks.iter().filter(|check| check.decides).all(|check| check.everywhere)
    }

    /// What was found, in lines.
    pub fn text(&self) -> String {
        let (name, unit) = (self.sought.name(), self.sought.unit());
        let [from, to] = self.range.map(|end| number(end, 5));
        let is_height = self.sought == Sought::Height;
        let extreme = if is_height { "largest" } else { "smallest" };
        let mut text = match self.value {
            None => format!("no {name} from {from} to {to} {unit} passes\n"),
            Some(_) if self.everywhere() => format!("every {name} from {from} to {to} {unit} passes\n"),
            Some(value) => format!("{extreme} {name} that passes: {value:.6} {unit}\n"),
        };
        for found in &self.checks {
            let FoundCheck { check, decides, value, .. } = found;
            let informs = if *decides { "" } else { " (for information)" };
            let end = if is_height { "up to" } else { "from" };
            let line = match value {
                Some(_) if found.everywhere => format!("  {check}{informs}: every value\n"),
                Some(value) => format!("  {check}{informs}: {end} {} {unit}\n", number(*value, 6)),
                None => {
                    let reason = found.reason.as_deref().map_or_else(String::new, |why| format!("; {why}"));
                    format!("  {check}{informs}: none{reason}\n")
                }
            };
            text.push_str(&line);
            for [low, high] in &found.intervals {
                let [low, high] = [low, high].map(|end| number(*end, 5));
                let _ = writeln!(text, "    passes from {low} to {high} {unit}, too, and fails beyond");
            }
        }
        if let Some(ratio) = self.force_ratio {
            let _ = write!(text, "  the tie has {} of W + O", number(ratio, 3));
            text += if ratio > LARGE { ": a large force for an anchor in masonry\n" } else { "\n" };
        }
        text
    }

    /// What was found, by names.
    pub fn json(&self) -> Value {
        let Self { sought, value, range, checks, force_ratio, symbol: _ } = self;
        json!({
            "parameter": sought.name(),
            "value": value,
            "range": range,
            "checks": checks,
            "force_over_load": force_ratio,
            "passes_everywhere": self.everywhere(),
        })
    }
}

/// Name, capacity over demand, whether it passes, and whether it decides.
type Outcome = (&'static str, f64, bool, bool);

/// Finds the smallest value, or the largest height, from which on a wall passes each of its checks. Counts
/// each value that was tried as [done](parallel::count_done).
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
/// let parameters = Parameters::default();
/// let found = find(&*code, Subject::new(&parameters), Sought::Thickness)?;
/// assert!((0.4..0.6).contains(&found.value.unwrap()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`CheckError`] of the wall as it is, so that a statement that is missing is named; and of a tie that is
/// sought for a wall without one.
pub fn find(code: &dyn Code, subject: Subject<'_>, sought: Sought) -> Result<Found, CheckError> {
    let Subject { floors, assumed, .. } = subject;
    let parameters = &code.prepared(subject.parameters)?;
    check_tie(parameters, sought)?;
    let deciding = code.deciding();
    let code = deciding.as_deref().unwrap_or(code);
    let tried = if code.takes_runs() { TRIED_UNDER_RECORDS } else { TRIED };
    let with = |value: f64| -> Result<Vec<Outcome>, CheckError> {
        let parameters = sought.applied(parameters, value)?;
        Ok(outcomes(&code.check(Subject { parameters: &parameters, floors, assumed })?))
    };
    let range = sought.range(parameters);
    let at = |index: u32| match index {
        0 => range[0],
        _ if index == tried - 1 => range[1],
        _ => range[0] * libm::pow(range[1] / range[0], f64::from(index) / f64::from(tried - 1)),
    };
    let mut tries = Vec::new();
    for index in 0..tried {
        tries.push((at(index), with(at(index))));
        parallel::count_done(tried as usize);
    }
    let mut checks: Vec<(&'static str, bool)> = Vec::new();
    for (check, .., decides) in tries.iter().filter_map(|(_, tried)| tried.as_ref().ok()).flatten() {
        if !checks.iter().any(|(name, _)| name == check) {
            checks.push((*check, *decides));
        }
    }
    if checks.is_empty() {
        // whatever is wrong is wrong with the wall as it is
        code.check(Subject { parameters, floors, assumed })?;
    }
    // of heights the largest is sought: the end that passes is the first
    if sought == Sought::Height {
        tries.reverse();
    }
    let mut found = Vec::new();
    for (check, decides) in checks {
        let passes = |value: f64| Ok(with(value).is_ok_and(|all| of(&all, check).is_some_and(|one| one.2)));
        found.push(one_check(&tries, check, decides, passes)?);
    }
    let (best, _) = &tries[tries.len() - 1];
    let last = sought.applied(parameters, *best)?;
    let last = Subject { parameters: &last, floors, assumed };
    for one in found.iter_mut().filter(|one| one.value.is_none()) {
        one.reason = code.blocks(last, one.check, sought);
    }
    let values = || found.iter().filter(|one| one.decides).map(|one| one.value);
    let all = values().all(|value| value.is_some()) && values().next().is_some();
    let extreme = if sought == Sought::Height { f64::min } else { f64::max };
    let value = values().flatten().reduce(extreme).filter(|_| all);
    let strength = value.filter(|_| sought.is_of_tie() && sought != Sought::TieStiffness);
    let strength = strength.map(|value| sought.applied(parameters, value)).transpose()?;
    let force_ratio = strength.map(|tied| tied.tie_strength / load(&tied));
    Ok(Found { sought, value, range, checks: found, force_ratio, symbol: code.entry().symbol })
}

fn check_tie(parameters: &Parameters, sought: Sought) -> Result<(), CheckError> {
    let is_held = match sought {
        Sought::Thickness | Sought::Height => return Ok(()),
        Sought::TieStiffness => true,
        Sought::TieStrength => parameters.tie_stiffness > 0.0,
        Sought::BarDiameter => parameters.bar.is_some(),
    };
    if is_held && parameters.tie_height > 0.0 {
        return Ok(());
    }
    Err(CheckError::wall(format!(
        "{} is sought, but the wall has no such tie; set tie_height and tie_stiffness, or give its bar in \
         [check.tie] or [tie]",
        sought.name()
    )))
}

/// The checks of a verdict: the least capacity over demand of all sides.
fn outcomes(verdict: &Verdict<'_>) -> Vec<Outcome> {
    let mut all: Vec<Outcome> = Vec::new();
    for row in &verdict.rows {
        match all.iter_mut().find(|one| one.0 == row.check) {
            Some(one) => (one.1, one.2) = (one.1.min(row.zeta), one.2 && row.passed),
            None => all.push((row.check, row.zeta, row.passed, row.decides)),
        }
    }
    all
}

fn of<'a>(all: &'a [Outcome], check: &str) -> Option<&'a Outcome> {
    all.iter().find(|one| one.0 == check)
}

/// Finds from which value on the last tries pass a check, and the other intervals that do.
fn one_check(
    tries: &[(f64, Result<Vec<Outcome>, CheckError>)],
    check: &'static str,
    decides: bool,
    mut passes: impl FnMut(f64) -> Result<bool, CheckError>,
) -> Result<FoundCheck, CheckError> {
    let one = |index: usize| tries[index].1.as_ref().ok().and_then(|all| of(all, check));
    let passed: Vec<bool> = (0..tries.len()).map(|index| one(index).is_some_and(|one| one.2)).collect();
    let zeta = |index: usize| one(index).map_or(f64::NAN, |one| one.1);
    let mut curve: Vec<_> = (0..tries.len()).map(|index| (tries[index].0, zeta(index))).collect();
    curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut edge =
        |fails: usize, holds: usize| first_true([tries[fails].0, tries[holds].0], HALVINGS, &mut passes);
    // tries that pass one after the other
    let (mut intervals, mut value) = (Vec::new(), None);
    let mut after = 0;
    for alike in passed.chunk_by(|a, b| a == b) {
        let first = after;
        after += alike.len();
        if !alike[0] {
            continue;
        }
        let begins = if first == 0 { tries[0].0 } else { edge(first - 1, first)? };
        if after == passed.len() {
            value = Some(begins);
        } else {
            let ends = edge(after, after - 1)?;
            intervals.push([begins.min(ends), begins.max(ends)]);
        }
    }
    let everywhere = passed.iter().all(|passed| *passed);
    Ok(FoundCheck { check, decides, value, everywhere, intervals, reason: None, curve })
}
