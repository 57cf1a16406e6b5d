//! Curves of several records of one wall and model, whose runs go together.

use std::ops::Range;

use record::{LANES, Outcome, RecordSolver, RunEnd};
use rocking_wall::solver::{Motion, SolverError};
use run::sample::sorted;
use run::shaking::{Shaken, Shaking, together};

use super::levels::Trace;
use super::outcome::{difference, run_of};
use super::polarity::worse;
use super::{Case, Curve, IdaError, Levels, MOST_LISTED, Run, Study};

/// Most curves of many levels that advance together: enough to fill the lanes of nearly all rounds. The
/// records of each are in memory, prepared for its wall.
const MOST_CURVES: usize = 4 * LANES;
/// Relative change of the record by which the sensitivity of a collapse is measured: well above the roundings
/// of a run, and small enough to tell a sensitivity of 1e11 from a larger one.
const PROBE: f64 = 1e-12;

impl Study {
    /// Splits some combinations into those that [`curves`](Self::curves) takes together: some records of one
    /// wall and model, at few levels all of them. There is work for each of some threads.
    pub fn groups(&self, cases: Range<usize>, threads: usize) -> impl Iterator<Item = Range<usize>> {
        let records = self.records.len();
        let most = if self.levels.are_few() { records } else { MOST_CURVES };
        let size = most.min(cases.len().div_ceil(threads.max(1))).max(1);
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
        let mut steps = sorted(supports.iter().map(|support| support.step()));
        steps.dedup();
        let solvers: Vec<_> = steps.iter().map(|step| RecordSolver::new(&motion, *step)).collect();
        let mut shakings = Vec::with_capacity(cases.len());
        let mut states = Vec::with_capacity(cases.len());
        for (case, support) in cases.iter().zip(&supports) {
            let solver = &solvers[steps.partition_point(|step| *step < support.step())];
            let mut shaking = Shaking::new(solver, support, self.tail);
            states.push(self.run_before(*case, solver, &mut shaking)?);
            shakings.push(shaking);
        }
        if !self.levels.are_few() {
            for shaking in &shakings {
                shaking.prepare();
            }
        }
        let signs: &[f64] = if self.takes_the_worse(&motion) { &[1.0, -1.0] } else { &[1.0] };
        let group = Group { motion: &motion, cases: &cases, shakings: &shakings, signs };
        let trace = |case: &Case| Trace::new(&self.levels, self.own_level(case.record));
        let mut traces: Vec<Result<Trace<'_>, IdaError>> = cases.iter().map(|case| Ok(trace(case))).collect();
        while self.advance(&group, &mut traces) {}
        let curves = traces.into_iter().map(|trace| Ok(trace?.finish()));
        let mut curves = curves.collect::<Result<Vec<_>, IdaError>>()?;
        if self.count() <= MOST_LISTED {
            self.probe(&group, &mut curves);
        }
        let curves = curves.into_iter().zip(states);
        Ok(curves.map(|(runs, before)| Curve::new(before.into_iter().chain(runs).collect())).collect())
    }

    /// Runs the levels that curves want next, all together; returns whether there were any. A curve whose run
    /// fails wants no more.
    fn advance(&self, group: &Group<'_>, traces: &mut [Result<Trace<'_>, IdaError>]) -> bool {
        let mut wanted = Vec::new();
        for (place, trace) in traces.iter_mut().enumerate() {
            let levels = trace.as_mut().map_or_else(|_| Vec::new(), Trace::wanted);
            wanted.extend(levels.into_iter().map(|level| (place, level)));
        }
        let factors = wanted.iter().map(|&(place, level)| (place, self.factor(group.cases[place], level)));
        let outcomes = group.outcomes(factors, self.collapse.end());
        for (&(place, level), outcomes) in wanted.iter().zip(outcomes.chunks(group.signs.len())) {
            let run = |outcome: &Result<Outcome, SolverError>| match outcome {
                Ok(outcome) => Ok(run_of(group.motion, level, outcome)),
                Err(source) => Err(self.failed(group.cases[place], level, *source)),
            };
            let run = outcomes.iter().map(run).reduce(|one, other| Ok(worse(one?, other?)));
            match (run, &mut traces[place]) {
                (Some(Ok(run)), Ok(trace)) => trace.add(run),
                (Some(Err(error)), trace @ Ok(_)) => *trace = Err(error),
                // a run before this one failed
                (_, Err(_)) | (None, _) => {}
            }
        }
        !wanted.is_empty()
    }

    /// Finds the sensitivity of each collapse above a level at which the wall stands: runs both levels again,
    /// with the record changed. `curves` are the runs of each case, by their levels. A collapse of which such
    /// a run fails has none.
    fn probe(&self, group: &Group<'_>, curves: &mut [Vec<Run>]) {
        let collapse = |(place, runs): (usize, &Vec<Run>)| {
            let first = runs.iter().position(|run| run.overturning.is_some()).filter(|first| *first > 0)?;
            Some((place, first))
        };
        let collapses: Vec<(usize, usize)> = curves.iter().enumerate().filter_map(collapse).collect();
        let changes = |below: usize, end: RunEnd| {
            let run = |(place, first): (usize, usize)| curves[place][first - below];
            let factor = |place: usize, level| (1.0 + PROBE) * self.factor(group.cases[place], level);
            let changed = |&at: &(usize, usize)| (at.0, factor(at.0, run(at).intensity));
            let outcomes = group.outcomes(collapses.iter().map(changed), end);
            let change = |(at, outcomes): (&(usize, usize), &[Result<Outcome, SolverError>])| {
                let run = run(*at);
                let of = |outcome: &Outcome| run_of(group.motion, run.intensity, outcome);
                let worst = outcomes.iter().flatten().reduce(|one, other| {
                    let first = of(one);
                    if worse(first, of(other)) == first { one } else { other }
                })?;
                Some(difference(&run, group.motion, worst))
            };
            collapses.iter().zip(outcomes.chunks(group.signs.len())).map(change).collect::<Vec<_>>()
        };
        // u̇ at overturning is known of runs that end there
        let (below, at) = (changes(1, self.collapse.end()), changes(0, RunEnd::AtPeaks));
        for ((&(place, first), below), at) in collapses.iter().zip(below).zip(at) {
            let larger = below.zip(at).map(|(below, at)| below.max(at).min(1.0));
            curves[place][first].sensitivity = larger.map(|change| change / PROBE);
        }
    }
}

/// The curves of a group while they are run.
struct Group<'a> {
    motion: &'a Motion,
    cases: &'a [Case],
    shakings: &'a [Shaking<'a>],
    /// Signs with which each level is run.
    signs: &'a [f64],
}

impl Group<'_> {
    /// Runs some curves, given by their places, with a factor on the record each, all together: each factor
    /// with every sign.
    fn outcomes(
        &self,
        factors: impl Iterator<Item = (usize, f64)>,
        end: RunEnd,
    ) -> Vec<Result<Outcome, SolverError>> {
        let with_signs = |(place, factor): (usize, f64)| {
            let shaking = &self.shakings[place];
            self.signs.iter().map(move |sign| Shaken { shaking, start: [0.0, 0.0], factor: sign * factor })
        };
        together(&factors.flat_map(with_signs).collect::<Vec<_>>(), end)
    }
}

impl Levels {
    /// Returns whether the levels of a curve are too few to fill the lanes of a batch.
    fn are_few(&self) -> bool {
        match self {
            Self::Cloud { .. } | Self::Stripes(_) => true,
            Self::Grid(levels) => levels.len() < LANES,
            Self::ToOverturning { .. } | Self::HuntAndFill { .. } => false,
        }
    }
}
