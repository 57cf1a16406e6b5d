//! Sequences of records whose last shock alone is scaled.

use std::borrow::Cow;

use files::choices;
use ground_motion::GroundMotion;
use record::{Outcome, RunEnd};
use rocking_wall::solver::{Peaks, State};
use rocking_wall::wall::Wall;
use run::shaking::{Shaken, Shaking, together};
use serde::{Deserialize, Serialize};

use super::curve::{Before, TieDemand};
use super::polarity::Polarity;
use super::{Case, IdaError, Study, intensity};

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

impl Before {
    fn of(wall: &Wall, state: &State) -> Self {
        let broken = TieDemand::of(wall, state).is_some_and(|tie| tie.broken);
        Self { demand: state.peaks.ratio(wall.body().instability), broken }
    }
}

impl Study {
    /// Sets what the levels scale. The intensity is that of what they scale.
    ///
    /// # Errors
    /// [`IdaError::NoSequence`] of a record without a shock before its last one, [`IdaError::LastOnStoreys`],
    /// [`IdaError::LastWorst`], and errors of intensities as in [`Study::new`].
    pub fn with_scaled(mut self, scaled: Scaled) -> Result<Self, IdaError> {
        self.scaled = scaled;
        if scaled == Scaled::All {
            return Ok(self);
        }
        if self.polarity == Polarity::Worst {
            return Err(IdaError::LastWorst);
        }
        if let Some(wall) = self.walls.iter().find(|wall| wall.floors.is_some()) {
            return Err(IdaError::LastOnStoreys { wall: wall.name.clone() });
        }
        if let Some(record) = self.records.iter().find(|record| record.motion.split_last().is_none()) {
            return Err(IdaError::NoSequence { record: record.name.clone() });
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

    /// Runs the shocks before the last one of some cases, whose last shocks are `shakings`, and lets these go
    /// on from there. Returns what the walls are then.
    pub(super) fn run_before_last(
        &self,
        cases: &[Case],
        shakings: &mut [Shaking<'_>],
    ) -> Vec<Result<Option<Before>, IdaError>> {
        let before = |case: &Case| self.records[case.record].motion.split_last().map(|[before, _]| before);
        let motions: Vec<_> = cases.iter().filter_map(before).collect();
        let earlier: Vec<_> =
            motions.iter().zip(&*shakings).map(|(motion, last)| last.under(motion)).collect();
        let runs: Vec<_> =
            earlier.iter().map(|shaking| Shaken { shaking, start: [0.0; 2], factor: 1.0 }).collect();
        let outcomes = together(&runs, RunEnd::OfRecord);
        let go_on = |((outcome, case), shaking): ((Result<Outcome, _>, &Case), &mut Shaking<'_>)| {
            let state =
                outcome.map_err(|source| self.failed(*case, self.intensities[case.record], source))?.state;
            if state.overturned {
                return Err(IdaError::OverturnedBefore {
                    wall: self.walls[case.wall].name.clone(),
                    record: self.records[case.record].name.clone(),
                    model: self.models[case.model].name.clone(),
                });
            }
            let before = Before::of(shaking.wall(), &state);
            shaking.go_on_from(State { peaks: Peaks::at(state.displacement), ..state });
            Ok(Some(before))
        };
        outcomes.into_iter().zip(cases).zip(shakings).map(go_on).collect()
    }
}
