//! Curves of several records of one wall and model, whose runs go together.

use std::ops::Range;

use record::{LANES, Outcome, RecordSolver};
use rocking_wall::solver::{Motion, SolverError};
use run::shaking::{Shaken, Shaking, together};

use super::levels::Trace;
use super::polarity::worse;
use super::{Case, Curve, IdaError, Levels, Run, Study};

/// Most curves of many levels that advance together: enough to fill the lanes of most rounds, and few enough
/// that threads share a study of few walls.
const MOST_CURVES: usize = 2 * LANES;

impl Study {
    /// Splits some combinations into those that [`curves`](Self::curves) takes together: some records of one
    /// wall and model, at few levels all of them.
    pub fn groups(&self, cases: Range<usize>) -> impl Iterator<Item = Range<usize>> {
        let records = self.records.len();
        let size = if self.levels.are_few() { records } else { MOST_CURVES };
        let Range { start: mut first, end } = cases;
        std::iter::from_fn(move || {
            let place = first % records;
            let next = (place / size + 1) * size;
            let group = first..end.min(first - place + next.min(records));
            first = group.end;
            (!group.is_empty()).then_some(group)
        })
    }

    /// Computes the curves of a group of combinations, in the order of their numbers. A curve does not depend
    /// on the others. They advance in rounds: the levels that each wants next are run together.
    ///
    /// # Errors
    /// That of the first combination whose run fails.
    pub fn curves(&self, group: Range<usize>) -> Result<Vec<Curve>, IdaError> {
        let cases: Vec<_> = group.map(|index| self.case(index)).collect();
        let Some(&Case { wall, model, .. }) = cases.first() else { return Ok(Vec::new()) };
        let motion = self.motion(wall, model);
        let supports = cases.iter().map(|case| self.support_motion(*case)).collect::<Result<Vec<_>, _>>()?;
        let mut steps: Vec<f64> = supports.iter().map(|support| support.step()).collect();
        steps.sort_by(f64::total_cmp);
        steps.dedup();
        let solvers: Vec<_> = steps.iter().map(|step| RecordSolver::new(&motion, *step)).collect();
        let mut shakings = Vec::with_capacity(cases.len());
        for support in &supports {
            let solver = &solvers[steps.partition_point(|step| *step < support.step())];
            shakings.push(Shaking::new(solver, support, self.tail));
        }
        if !self.levels.are_few() {
            for shaking in &shakings {
                shaking.prepare();
            }
        }
        let trace = |case: &Case| Trace::new(&self.levels, self.own_level(case.record));
        let mut traces: Vec<Result<Trace<'_>, IdaError>> = cases.iter().map(|case| Ok(trace(case))).collect();
        while self.advance(&motion, &cases, &shakings, &mut traces) {}
        traces.into_iter().map(|trace| Ok(Curve::new(trace?.finish()))).collect()
    }

    /// Runs the levels that curves want next, all together; returns whether there were any. A curve whose run
    /// fails wants no more.
    fn advance(
        &self,
        motion: &Motion,
        cases: &[Case],
        shakings: &[Shaking<'_>],
        traces: &mut [Result<Trace<'_>, IdaError>],
    ) -> bool {
        // each level once, or with both signs
        let signs: &[f64] = if self.takes_the_worse(motion) { &[1.0, -1.0] } else { &[1.0] };
        let (mut wanted, mut shaken) = (Vec::new(), Vec::new());
        for ((case, shaking), trace) in cases.iter().zip(shakings).zip(traces.iter_mut()) {
            let levels = trace.as_mut().map_or_else(|_| Vec::new(), Trace::wanted);
            for level in &levels {
                let factor = self.factor(*case, *level);
                let with = |sign| Shaken { shaking, start: [0.0, 0.0], factor: sign * factor };
                shaken.extend(signs.iter().map(with));
            }
            wanted.push(levels);
        }
        let outcomes = together(&shaken, self.collapse.end());
        let mut of_levels = outcomes.chunks(signs.len());
        for ((case, levels), trace) in cases.iter().zip(wanted).zip(traces) {
            let run = |(level, outcomes): (f64, &[Result<Outcome, SolverError>])| {
                let run = |outcome: &Result<Outcome, SolverError>| match outcome {
                    Ok(outcome) => Ok(Run::of(motion, level, outcome)),
                    Err(source) => Err(self.failed(*case, level, *source)),
                };
                let first = run(&outcomes[0])?;
                outcomes[1..].iter().try_fold(first, |one, other| Ok(worse(one, run(other)?)))
            };
            let runs: Vec<_> = levels.into_iter().zip(of_levels.by_ref()).map(run).collect();
            match (runs.into_iter().collect::<Result<Vec<_>, _>>(), &mut *trace) {
                (Ok(runs), Ok(trace)) => trace.add(runs),
                (Err(error), _) => *trace = Err(error),
                (Ok(_), Err(_)) => {}
            }
        }
        !shaken.is_empty()
    }
}

impl Levels {
    /// Returns whether the levels of a curve are too few to fill the lanes of a batch.
    fn are_few(&self) -> bool {
        match self {
            Self::Cloud { .. } => true,
            Self::Grid(levels) => levels.len() < LANES,
            Self::ToOverturning { .. } | Self::HuntAndFill { .. } => false,
        }
    }
}
