//! The smallest thickness or tie, or the largest height, thrust or load, with which a wall passes its checks.

mod figure;
mod text;

use rocking_wall::wall::Parameters;
use run::bisection::first_true;
use run::parallel;
use serde::Serialize;
use serde_json::{Value, json};

use crate::code::sought::{Sought, load};
use crate::code::verdict::Verdict;
use crate::code::{Code, Subject};
use crate::error::CheckError;
use crate::words::Sentence;

/// Values that are tried, in equal ratios.
const TRIED: u32 = 241;
/// Values that are tried where each takes runs under records.
const TRIED_UNDER_RECORDS: u32 = 31;
/// Halvings of the step in which the wall begins to pass: the value is then known to 1e-9 of it.
const HALVINGS: u32 = 30;

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// What was sought.
    pub sought: Sought,
    /// The value from which on the wall passes every check that decides; `None` if there is none.
    pub value: Option<f64>,
    /// The same without the rules of the code that replace the ratio of a check by a larger one.
    pub value_without_raise: Option<f64>,
    /// The range that was searched.
    pub range: [f64; 2],
    /// Each check, in the order of the verdict.
    pub checks: Vec<FoundCheck>,
    /// Force of the tie at the value over W + O \[-\].
    pub force_ratio: Option<f64>,
    /// What is to be said of the checks that pass at the value only by such a rule.
    remarks: Vec<Sentence>,
    /// Symbol of capacity over demand.
    symbol: Sentence,
    /// The ratio from which on a check passes \[-\].
    target: f64,
}

/// What was found for one check.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FoundCheck {
    /// Its name.
    pub check: &'static str,
    /// The same for people.
    #[serde(skip)]
    title: Sentence,
    /// Whether it decides.
    pub decides: bool,
    /// The value from which on the wall passes it, up to the end of the range (a height: down to its start).
    pub value: Option<f64>,
    /// The same without the rules of the code that replace its ratio by a larger one.
    pub value_without_raise: Option<f64>,
    /// Whether such a rule replaces it anywhere in the range.
    #[serde(skip)]
    can_be_raised: bool,
    /// Whether the wall passes it all over the range.
    #[serde(rename = "passes_everywhere")]
    pub everywhere: bool,
    /// Intervals of values that pass, apart from that one.
    pub intervals: Vec<[f64; 2]>,
    /// Why there is no value, where that can be said.
    pub reason: Option<Sentence>,
    /// (value, capacity over demand) over the range; NaN where the wall or its check is impossible.
    pub curve: Vec<(f64, f64)>,
}

impl Found {
    /// Returns whether every value of the range passes what decides.
    pub fn everywhere(&self) -> bool {
        self.checks.iter().filter(|check| check.decides).all(|check| check.everywhere)
    }

    /// What was found, by names.
    pub fn json(&self) -> Value {
        let Self { sought, value, value_without_raise, range, checks, force_ratio, .. } = self;
        json!({
            "parameter": sought.name(),
            "value": value,
            "value_without_raise": value_without_raise,
            "range": range,
            "checks": checks,
            "force_over_load": force_ratio,
            "passes_everywhere": self.everywhere(),
        })
    }
}

/// A check at a value that was tried: the least capacity over demand of all sides.
#[derive(Clone)]
#[allow(clippy::struct_excessive_bools, reason = "what a row says, and no state")]
struct Outcome {
    check: &'static str,
    title: Sentence,
    zeta: f64,
    passed: bool,
    /// Whether it passes without a rule that replaces its ratio.
    passes_itself: bool,
    /// Whether such a rule replaces it.
    raised: bool,
    decides: bool,
}

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
    let parameters = &code.prepared(subject.parameters)?;
    check_tie(parameters, sought)?;
    let deciding = code.deciding();
    let search = Search { code: deciding.as_deref().unwrap_or(code), subject, parameters, sought };
    let tries = search.tries();
    let mut checks: Vec<Outcome> = Vec::new();
    for one in tries.iter().filter_map(|(_, tried)| tried.as_ref().ok()).flatten() {
        match checks.iter_mut().find(|own| own.check == one.check) {
            Some(own) => own.raised |= one.raised,
            None => checks.push(one.clone()),
        }
    }
    if checks.is_empty() {
        // whatever is wrong is wrong with the wall as it is
        search.check(parameters, |_| ())?;
    }
    let found = checks.iter().map(|one| search.one(&tries, one)).collect::<Result<Vec<_>, _>>()?;
    let extreme = if sought.is_largest() { f64::min } else { f64::max };
    let of_all = |bound: fn(&FoundCheck) -> Option<f64>| {
        let values: Option<Vec<f64>> = found.iter().filter(|one| one.decides).map(bound).collect();
        values.and_then(|values| values.into_iter().reduce(extreme))
    };
    let value = of_all(|one| one.value);
    let value_without_raise = of_all(|one| one.value_without_raise);
    let strength = value.filter(|_| sought.is_of_tie() && sought != Sought::TieStiffness);
    let strength = strength.map(|value| sought.applied(parameters, value)).transpose()?;
    let raised = value.filter(|_| value != value_without_raise);
    Ok(Found {
        sought,
        value,
        value_without_raise,
        range: sought.range(parameters),
        checks: found,
        force_ratio: strength.map(|tied| tied.tie_strength / load(&tied)),
        remarks: raised.map(|value| search.remarks(value)).transpose()?.unwrap_or_default(),
        symbol: code.entry().ratio(),
        target: code.target(),
    })
}

/// A search: a wall and what varies of it.
struct Search<'a> {
    code: &'a dyn Code,
    subject: Subject<'a>,
    /// The wall with the tie of the check.
    parameters: &'a Parameters,
    sought: Sought,
}

impl Search<'_> {
    /// What a verdict on a wall says.
    fn check<T>(&self, parameters: &Parameters, of: impl FnOnce(&Verdict<'_>) -> T) -> Result<T, CheckError> {
        Ok(of(&self.code.check(Subject { parameters, ..self.subject })?))
    }

    fn outcomes(&self, value: f64) -> Result<Vec<Outcome>, CheckError> {
        self.check(&self.sought.applied(self.parameters, value)?, outcomes)
    }

    /// The range in equal ratios, with the checks of each value; the end that may pass is the last.
    fn tries(&self) -> Vec<Tried> {
        let tried = if self.code.takes_runs() { TRIED_UNDER_RECORDS } else { TRIED };
        let range = self.sought.range(self.parameters);
        let at = |index: u32| match index {
            0 => range[0],
            _ if index == tried - 1 => range[1],
            _ => range[0] * libm::pow(range[1] / range[0], f64::from(index) / f64::from(tried - 1)),
        };
        let mut tries = Vec::new();
        for index in 0..tried {
            tries.push((at(index), self.outcomes(at(index))));
            parallel::count_done(tried as usize);
        }
        // of heights, thrusts and loads the largest is sought
        if self.sought.is_largest() {
            tries.reverse();
        }
        tries
    }

    /// Finds the bounds of a check, and why there is none.
    fn one(&self, tries: &[Tried], check: &Outcome) -> Result<FoundCheck, CheckError> {
        let bounds = |rule: fn(&Outcome) -> bool| {
            Bounds::find(tries, check.check, rule, |value| {
                let outcomes = self.outcomes(value);
                Ok(outcomes.is_ok_and(|all| of(&all, check.check).is_some_and(rule)))
            })
        };
        let ruled = bounds(|outcome| outcome.passed)?;
        let itself = if check.raised { bounds(|outcome| outcome.passes_itself)?.value } else { ruled.value };
        let reason = match (ruled.value, tries.last()) {
            (None, Some((best, _))) => {
                let parameters = &self.sought.applied(self.parameters, *best)?;
                self.code.blocks(Subject { parameters, ..self.subject }, check.check, self.sought)
            }
            _ => None,
        };
        Ok(FoundCheck { value_without_raise: itself, reason, ..FoundCheck::new(check, tries, ruled) })
    }

    /// What is to be said of the checks that pass at a value only by a rule that replaces their ratio.
    fn remarks(&self, value: f64) -> Result<Vec<Sentence>, CheckError> {
        self.check(&self.sought.applied(self.parameters, value)?, |verdict| {
            let raised = verdict.rows.iter().filter(|row| row.decides && row.zeta > row.ratio);
            raised.map(|row| row.remark.clone()).collect()
        })
    }
}

fn check_tie(parameters: &Parameters, sought: Sought) -> Result<(), CheckError> {
    let refused = |message: &str| Err(CheckError::wall(format!("{} {message}", sought.name())));
    let is_held = match sought {
        Sought::Thickness | Sought::Height if !parameters.is_rectangle() => {
            return refused("is that of a rectangle; of a wall of parts thrust, load and a tie are sought");
        }
        Sought::Thrust | Sought::Load if sought.sum(parameters) == 0.0 => {
            return refused("is sought, but the wall has none; state it in [[geometry.load]]");
        }
        _ if sought.is_of_tie() && !parameters.further_ties.is_empty() => {
            return refused("is sought of one tie; leave the others out");
        }
        Sought::Thickness | Sought::Height | Sought::Thrust | Sought::Load => return Ok(()),
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

/// The checks of a verdict.
fn outcomes(verdict: &Verdict<'_>) -> Vec<Outcome> {
    let mut all: Vec<Outcome> = Vec::new();
    for row in &verdict.rows {
        let passes_itself = row.passed && row.ratio >= verdict.target;
        let raised = row.zeta > row.ratio;
        match all.iter_mut().find(|one| one.check == row.check) {
            Some(one) => {
                one.zeta = one.zeta.min(row.zeta);
                one.passed &= row.passed;
                one.passes_itself &= passes_itself;
                one.raised |= raised;
            }
            None => all.push(Outcome {
                check: row.check,
                title: row.title.clone(),
                zeta: row.zeta,
                passed: row.passed,
                passes_itself,
                raised,
                decides: row.decides,
            }),
        }
    }
    all
}

fn of<'a>(all: &'a [Outcome], check: &str) -> Option<&'a Outcome> {
    all.iter().find(|one| one.check == check)
}

/// A value that was tried, with the checks of its wall.
type Tried = (f64, Result<Vec<Outcome>, CheckError>);

/// From which value on tries pass, and the other intervals that do.
struct Bounds {
    value: Option<f64>,
    everywhere: bool,
    intervals: Vec<[f64; 2]>,
}

impl Bounds {
    /// Finds from which value on the last tries pass a check.
    fn find(
        tries: &[Tried],
        check: &'static str,
        rule: impl Fn(&Outcome) -> bool,
        mut passes: impl FnMut(f64) -> Result<bool, CheckError>,
    ) -> Result<Self, CheckError> {
        let one = |tried: &Tried| tried.1.as_ref().ok().and_then(|all| of(all, check)).is_some_and(&rule);
        let passed: Vec<bool> = tries.iter().map(one).collect();
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
        Ok(Self { value, everywhere: passed.iter().all(|passed| *passed), intervals })
    }
}

impl FoundCheck {
    /// Makes what was found for a check.
    fn new(check: &Outcome, tries: &[Tried], bounds: Bounds) -> Self {
        let Outcome { check, title, raised, decides, .. } = check.clone();
        let Bounds { value, everywhere, intervals } = bounds;
        let zeta = |tried: &Tried| tried.1.as_ref().ok().and_then(|all| of(all, check)).map(|one| one.zeta);
        let mut curve: Vec<_> = tries.iter().map(|one| (one.0, zeta(one).unwrap_or(f64::NAN))).collect();
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self {
            check,
            title,
            decides,
            value,
            value_without_raise: value,
            can_be_raised: raised,
            everywhere,
            intervals,
            reason: None,
            curve,
        }
    }

    /// Whether the value rests on a rule that replaces the ratio of the check.
    pub(super) fn rests_on_raise(&self) -> bool {
        self.value != self.value_without_raise
    }
}
