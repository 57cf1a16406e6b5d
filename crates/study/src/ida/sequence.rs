//! Sequences of records whose last shock alone is scaled.

use std::borrow::Cow;

use files::choices;
use ground_motion::GroundMotion;
use record::{RecordSolver, RunEnd};
use rocking_wall::solver::{Peaks, State};
use run::shaking::{Shaken, Shaking, together};
use serde::{Deserialize, Serialize};

use super::outcome::run_of;
use super::{Case, IdaError, Run, Study, intensity};

/// What the levels of a study scale, of records that are sequences.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scaled {
    /// All shocks.
    #[default]
    All,
    /// The last shock; those before it are run as they are.
    Last,
}

choices!(Scaled);

impl Study {
    /// Sets what the levels scale. The intensity is that of what they scale.
    ///
    /// # Errors
    /// [`IdaError::LastShock`] of a record without a shock before its last one, and of walls on storeys;
    /// errors of intensities as in [`Study::new`].
    pub fn with_scaled(mut self, scaled: Scaled) -> Result<Self, IdaError> {
        self.scaled = scaled;
        if scaled == Scaled::All {
            return Ok(self);
        }
        let on_storeys = self.walls.iter().find(|wall| wall.floors.is_some());
        let on_storeys = on_storeys.map(|wall| format!("wall {:?} stands on storeys", wall.name));
        let single = self.records.iter().find(|record| record.motion.split_last().is_none());
        let single = single.map(|record| format!("record {:?} is no sequence with a pause", record.name));
        if let Some(what) = on_storeys.or(single) {
            return Err(IdaError::LastShock { what });
        }
        let of =
            |index: usize| intensity(&self.measure, &self.records[index].name, &self.scaled_motion(index));
        self.intensities = (0..self.records.len()).map(of).collect::<Result<_, _>>()?;
        Ok(self)
    }

    /// Returns the part of a record that the levels scale.
    pub fn scaled_motion(&self, record: usize) -> Cow<'_, GroundMotion> {
        let motion = &self.records[record].motion;
        match self.scaled {
            Scaled::All => Cow::Borrowed(motion),
            Scaled::Last => motion.split_last().map_or(Cow::Borrowed(motion), |[_, last]| Cow::Owned(last)),
        }
    }

    /// Runs the shocks before the last one, from whose end `shaking` goes on, and returns this run; `None`
    /// where all shocks are scaled.
    pub(super) fn run_before(
        &self,
        case: Case,
        solver: &RecordSolver<'_>,
        shaking: &mut Shaking<'_>,
    ) -> Result<Option<Run>, IdaError> {
        let record = &self.records[case.record];
        let Some([before, _]) = record.motion.split_last().filter(|_| self.scaled == Scaled::Last) else {
            return Ok(None);
        };
        let run = Shaken { shaking: &Shaking::new(solver, &before, 0.0), start: [0.0; 2], factor: 1.0 };
        let outcome = together(&[run], RunEnd::OfRecord).remove(0);
        let outcome = outcome.map_err(|source| self.failed(case, self.intensities[case.record], source))?;
        if outcome.state.overturned {
            let [wall, model] = [&self.walls[case.wall].name, &self.models[case.model].name];
            let what =
                format!("wall {wall:?} with {model:?} overturns before the last shock of {:?}", record.name);
            return Err(IdaError::LastShock { what });
        }
        shaking.go_on_from(State { peaks: Peaks::at(outcome.state.displacement), ..outcome.state });
        Ok(Some(run_of(solver.motion(), 0.0, &outcome)))
    }
}
