//! Curves at few levels, as of clouds and short grids: all records of a wall and model go together.

use std::ops::Range;

use record::{LANES, Outcome, RecordSolver};
use rocking_wall::solver::SolverError;
use run::shaking::{Shaken, Shaking, together};

use super::polarity::worse;
use super::{Curve, IdaError, Levels, Run, Study};

impl Study {
    /// Splits some combinations into those that [`curves`](Self::curves) takes together: at few levels those
    /// of one wall and model, else each by itself.
    pub fn groups(&self, cases: Range<usize>) -> impl Iterator<Item = Range<usize>> {
        let size = if self.levels.few(0.0).is_some() { self.records.len() } else { 1 };
        let Range { start: mut first, end } = cases;
        std::iter::from_fn(move || {
            let group = first..end.min((first / size + 1) * size);
            first = group.end;
            (!group.is_empty()).then_some(group)
        })
    }

    /// Computes the curves of a group of combinations, in the order of their numbers. Each has the bits of
    /// [`curve`](Self::curve).
    ///
    /// # Errors
    /// That of the first combination whose run fails.
    pub fn curves(&self, group: Range<usize>) -> Result<Vec<Curve>, IdaError> {
        let cases: Vec<_> = group.map(|index| self.case(index)).collect();
        if cases.len() < 2 {
            return cases.into_iter().map(|case| self.curve(case)).collect();
        }
        let motion = self.motion(cases[0].wall, cases[0].model);
        let supports = cases.iter().map(|case| self.support_motion(*case)).collect::<Result<Vec<_>, _>>()?;
        let mut steps: Vec<f64> = supports.iter().map(|support| support.step()).collect();
        steps.sort_by(f64::total_cmp);
        steps.dedup();
        let solvers: Vec<_> = steps.iter().map(|step| RecordSolver::new(&motion, *step)).collect();
        let mut shakings = Vec::with_capacity(cases.len());
        for support in &supports {
            let solver = &solvers[steps.partition_point(|step| *step < support.step())];
            shakings.push(Shaking::new(&motion, solver, support, self.tail));
        }
        // each level once, or with both signs
        let signs: &[f64] = if self.takes_the_worse(&motion) { &[1.0, -1.0] } else { &[1.0] };
        let (mut levels, mut shaken) = (Vec::new(), Vec::new());
        for (case, shaking) in cases.iter().zip(&shakings) {
            let own = self.levels.few(self.own_level(case.record)).unwrap_or_default();
            for level in &own {
                let factor = self.factor(*case, *level);
                let with = |sign| Shaken { shaking, start: [0.0, 0.0], factor: sign * factor };
                shaken.extend(signs.iter().map(with));
            }
            levels.push(own);
        }
        let outcomes = together(&shaken, self.collapse.end());
        let mut of_levels = outcomes.chunks(signs.len());
        let curve = |(case, levels): (_, Vec<f64>)| {
            let run = |(level, outcomes): (f64, &[Result<Outcome, SolverError>])| {
                let run = |outcome: &Result<Outcome, SolverError>| match outcome {
                    Ok(outcome) => Ok(Run::of(&motion, level, outcome)),
                    Err(source) => Err(self.failed(case, level, *source)),
                };
                let first = run(&outcomes[0])?;
                outcomes[1..].iter().try_fold(first, |one, other| Ok(worse(one, run(other)?)))
            };
            let runs = levels.into_iter().zip(of_levels.by_ref());
            Ok(Curve::new(runs.map(run).collect::<Result<_, _>>()?))
        };
        cases.into_iter().zip(levels).map(curve).collect()
    }
}

impl Levels {
    /// Returns the levels of a curve that are known before it runs, and too few to fill the lanes of a batch.
    /// `own` is the level of the record in a cloud.
    fn few(&self, own: f64) -> Option<Vec<f64>> {
        match self {
            Self::Cloud { .. } => Some(vec![own]),
            Self::Grid(levels) => (levels.len() < LANES).then(|| levels.clone()),
            Self::ToOverturning { .. } | Self::HuntAndFill { .. } => None,
        }
    }
}
