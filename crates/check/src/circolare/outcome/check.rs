//! The check of a wall: its sides, its runs, what governs, and its warnings.

use rocking_wall::variables::{DampingModel, Impact, Rocking};
use rocking_wall::wall::{Parameters, Wall};

use super::warnings;
use super::{Checked, Governs, Outcome};
use crate::circolare::checks::crack;
use crate::circolare::checks::sides::SideVerdicts;
use crate::circolare::curve::case::Case;
use crate::circolare::runs::dynamic::{self, DynamicCheck};
use crate::circolare::statement::Statement;
use crate::circolare::statement::table::{Method, NAME};
use crate::code::Subject;
use crate::error::CheckError;
use crate::words::names::{Deciding, LimitState};

impl Statement {
    /// Checks a wall.
    ///
    /// ```
    /// use check::circolare::Statement;
    /// use check::{CheckFile, Subject};
    /// use rocking_wall::wall::Parameters;
    ///
    /// let text = r#"
    /// [check]
    /// code = "circolare-2019"
    /// before_activation = "rigid"
    /// soil = "B"
    /// SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }
    /// "#;
    /// let statement = Statement::read(&CheckFile::parse("scene.toml", text)?)?;
    /// let parameters = Parameters::default();
    /// let checked = statement.checked(Subject::new(&parameters))?;
    /// assert!(!checked.outcome.passed && (checked.outcome.governs.zeta - 0.855812).abs() < 5e-7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`CheckError`] of a statement that is missing or does not fit the wall, of a wall that the code does
    /// not cover, of a spectrum that ends too early, or of a run. Improbable numbers come first, since they
    /// may be the cause.
    pub fn checked<'a>(&'a self, subject: Subject<'a>) -> Result<Checked<'a>, CheckError> {
        self.check_wall(subject).map_err(|error| {
            let of_wall = subject.parameters.unusual();
            error.with_doubts(of_wall.chain(self.improbable(subject.floors)).collect())
        })
    }

    /// Checks the body above each level; the one with the least `ζ_E` has the others beside it.
    fn check_wall<'a>(&'a self, subject: Subject<'a>) -> Result<Checked<'a>, CheckError> {
        let level = |index| {
            self.check_body(subject, index).map_err(|error| match self.hinge_levels.len() {
                1 => error,
                _ => error.within(&format!("above the level {} m", self.hinge_levels[index])),
            })
        };
        let mut levels = (0..self.hinge_levels.len()).map(level).collect::<Result<Vec<_>, _>>()?;
        let zeta = |index: &usize| levels[*index].outcome.governs.zeta;
        let least = (0..levels.len()).min_by(|a, b| zeta(a).total_cmp(&zeta(b))).unwrap_or(0);
        let passed = levels.iter().all(|level| level.outcome.passed);
        let mut governing = levels.remove(least);
        governing.outcome.passed = passed;
        governing.beside = levels;
        Ok(governing)
    }

    fn check_body<'a>(&'a self, subject: Subject<'a>, level: usize) -> Result<Checked<'a>, CheckError> {
        let case = crack::searched(Case::new(self, subject, level)?)?;
        let sides = SideVerdicts::new(&case)?;
        let dynamic = dynamic::check(subject.parameters, &case, &sides)?;
        let governs = governing(&case, &sides, dynamic.as_ref())?;
        let passed = governs.zeta >= self.target
            && dynamic.as_ref().is_none_or(|d| self.table.method != Method::Dynamic || d.passed());
        // the wall as it is drawn: with the hinge of the side that governs
        let mut parameters = case.parameters.clone();
        let hinge = sides.shown(governs.side).and_then(|side| side.curve.hinge);
        parameters.hinge_ratio = hinge.unwrap_or(parameters.hinge_ratio);
        let wall = drawn(&parameters)?;
        let demands = case.demands_at(wall.body())?;
        let (alike, rule, floors) = (case.alike, case.rule, case.floors.clone());
        let (target, beside) = (self.target, Vec::new());
        let outcome =
            Outcome { code: NAME, passed, target, governs, alike, sides, dynamic, warnings: Vec::new() };
        let mut checked =
            Checked { statement: self, parameters, level, floors, wall, rule, demands, outcome, beside };
        checked.outcome.warnings = warnings::all(&case, &checked, subject.parameters);
        Ok(checked)
    }
}

/// Returns the smallest `ζ_E` of the checks that decide.
fn governing(
    case: &Case<'_>,
    sides: &SideVerdicts,
    dynamic: Option<&DynamicCheck>,
) -> Result<Governs, CheckError> {
    let statement = case.statement;
    let level = statement.stated_level(case.level);
    let is_dynamic = statement.table.method == Method::Dynamic;
    let mut all = Vec::new();
    for (side, verdict) in sides.iter() {
        for (limit_state, zeta) in Deciding::ALL.into_iter().zip(verdict.checks.zetas()) {
            let by_runs = is_dynamic && limit_state != Deciding::Sld;
            if statement.decides(limit_state) && !by_runs && zeta.is_finite() {
                all.push(Governs { side, limit_state, level, zeta });
            }
        }
    }
    if is_dynamic {
        let Some(dynamic) = dynamic else {
            let message = "method = \"dynamic\" needs records; add [check.records] with files";
            return Err(CheckError::value(&["method"], message));
        };
        let by_runs = dynamic.states().map(|(state, found)| Governs {
            side: found.judged.side,
            limit_state: if state == LimitState::Slc { Deciding::Slc } else { Deciding::Slv },
            level,
            zeta: found.zeta,
        });
        all.extend(by_runs);
    }
    let least = all.into_iter().min_by(|a, b| a.zeta.total_cmp(&b.zeta));
    least.ok_or_else(|| CheckError::wall("no limit state decides; give [check.SLV] or [check.SLC]"))
}

/// Makes the wall of a drawing. Damping and impacts that do not go with the wall have no part in the static
/// checks.
fn drawn(parameters: &Parameters) -> Result<Wall, CheckError> {
    Ok(Wall::new(parameters).or_else(|_| {
        let impact = if parameters.rocking == Rocking::TwoSided { Impact::None } else { Impact::Restitution };
        let (damping_model, restitution) = (DampingModel::None, 0.5);
        Wall::new(&Parameters { impact, damping_model, restitution, ..parameters.clone() })
    })?)
}
