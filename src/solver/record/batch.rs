//! Many runs of one wall through one record.
//!
//! Where processor, wall and step allow it, eight runs go side by side, each in one lane of a vector
//! (docs/record-path.md, §6): the response of the branches to the record is taken once for all runs (module
//! `responses`), plain steps go four at once and corners are passed several at once (`rounds`, `corners`).
//! Runs go one by one without AVX2, where that is measured to be faster, and where a step is long beside the
//! wall's shortest period, so that they reach corners too often.
//!
//! What becomes of a run never depends on the other runs. Side by side it gives the same bits with every
//! level of vectors, and agrees with [`RecordSolver::run`] to rounding; one by one it is that run.

mod corners;
mod curved;
mod lanes;
mod responses;
mod rounds;
mod table;
mod vector;

use fearless_simd::Simd;
#[cfg(target_arch = "x86_64")]
use fearless_simd::{Avx2, Avx512, Level};

use super::super::SolverError;
use super::forcing::{Blocks, Forcing};
use super::solver::{Outcome, RecordSolver, RunStart, unseen};
use super::step_map::StepMap;
use curved::CurvedLanes;
use lanes::Lanes;
use responses::Responses;

/// Runs that go side by side.
pub const LANES: usize = vector::WIDTH;

/// A record prepared for many runs.
#[derive(Debug)]
pub struct Batch<'a> {
    solver: &'a RecordSolver<'a>,
    record: Blocks<'a>,
    side_by_side: Option<(Vectors, SideBySide)>,
}

/// Vectors with which runs go faster side by side. Code for narrower ones would be slower than one by one,
/// and take long to build.
#[derive(Clone, Copy, Debug)]
enum Vectors {
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
}

impl Vectors {
    /// Returns the widest of this processor, if it has any.
    fn widest() -> Option<Self> {
        #[cfg(target_arch = "x86_64")]
        {
            let level = Level::new();
            level.as_avx512().map(Self::Avx512).or_else(|| level.as_avx2().map(Self::Avx2))
        }
        #[cfg(not(target_arch = "x86_64"))]
        None
    }
}

/// How runs go side by side.
#[derive(Debug)]
enum SideBySide {
    /// All branches have affine maps: four steps at once.
    Affine(Box<Responses>),
    /// Some have secant damping: there by Taylor series, elsewhere one by one.
    Curved { is_ratio: bool },
}

impl SideBySide {
    fn new(solver: &RecordSolver<'_>, forcing: Forcing<'_>) -> Option<Self> {
        let secants = || solver.maps.iter().flatten().filter_map(StepMap::secant);
        match secants().next() {
            Some(secant) => Some(Self::Curved { is_ratio: secant.is_ratio }),
            None => Some(Self::Affine(Box::new(Responses::new(solver, forcing)?))),
        }
    }
}

impl RecordSolver<'_> {
    /// Prepares a record for many runs.
    pub fn batch<'a>(&'a self, forcing: Forcing<'a>) -> Batch<'a> {
        self.batch_on(forcing, Vectors::widest())
    }

    /// Prepares a record for some vectors; `None` lets runs go one by one.
    fn batch_on<'a>(&'a self, forcing: Forcing<'a>, vectors: Option<Vectors>) -> Batch<'a> {
        let side_by_side = vectors.and_then(|vectors| Some((vectors, SideBySide::new(self, forcing)?)));
        Batch { solver: self, record: Blocks::new(forcing), side_by_side }
    }
}

impl Batch<'_> {
    /// Tells whether runs go side by side, not one by one.
    pub fn is_side_by_side(&self) -> bool {
        self.side_by_side.is_some()
    }

    /// Moves walls through the record, each as if it were alone; `until_overturning` stops those that
    /// overturn.
    ///
    /// # Errors
    /// [`SolverError`] of the first run that could not be followed.
    pub fn run(&self, starts: &[RunStart], until_overturning: bool) -> Result<Vec<Outcome>, SolverError> {
        let Self { solver, record, .. } = self;
        match &self.side_by_side {
            #[cfg(target_arch = "x86_64")]
            Some((Vectors::Avx2(simd), way)) => self.follow(*simd, way, starts, until_overturning),
            #[cfg(target_arch = "x86_64")]
            Some((Vectors::Avx512(simd), way)) => self.follow(*simd, way, starts, until_overturning),
            _ => {
                let run = |&start| solver.run_through(start, record, until_overturning, &mut unseen);
                starts.iter().map(run).collect()
            }
        }
    }

    /// Follows runs side by side.
    fn follow(
        &self,
        simd: impl Simd,
        way: &SideBySide,
        starts: &[RunStart],
        until_overturning: bool,
    ) -> Result<Vec<Outcome>, SolverError> {
        let Self { solver, record, .. } = self;
        let curved = || CurvedLanes::new(solver, record, starts, until_overturning);
        match way {
            SideBySide::Affine(responses) => {
                let mut lanes = Lanes::new(solver, record, responses, starts, until_overturning);
                simd.vectorize(
                    #[inline(always)]
                    || lanes.follow(simd),
                );
                lanes.outcomes()
            }
            SideBySide::Curved { is_ratio: true } => simd.vectorize(
                #[inline(always)]
                || curved().follow::<_, true>(simd),
            ),
            SideBySide::Curved { is_ratio: false } => simd.vectorize(
                #[inline(always)]
                || curved().follow::<_, false>(simd),
            ),
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices::{DampingModel, Impact};
    use crate::solver::Motion;
    use crate::wall::{Parameters, Support};

    /// Two sines of 30 s in steps of 5 ms, under which some of the walls overturn.
    fn shaking() -> Vec<f64> {
        let at = |n: i32| {
            let t = 5e-3 * f64::from(n);
            (t / 5.0).min(1.0) * (2.2 * (5.1 * t).sin() + 1.1 * (17.0 * t).cos() + 0.4 * (90.0 * t).sin())
        };
        (0..6000).map(at).collect()
    }

    /// A wall of 6 m, its first corner at a share a₁ of its instability.
    fn motion(a1: f64) -> Motion {
        losing(a1, DampingModel::ConstantCoefficient, Impact::None)
    }

    /// The same with other ways of losing energy.
    fn losing(a1: f64, damping_model: DampingModel, impact: Impact) -> Motion {
        let wall = Parameters { height: 6.0, thickness: 0.6, ..Parameters::default() };
        Motion::of(&Parameters { a1, damping_model, impact, ..wall }, 1e-8).expect("a valid wall")
    }

    /// Moves walls side by side with the vectors that every processor has.
    fn narrow(solver: &RecordSolver<'_>, forcing: Forcing<'_>, starts: &[RunStart]) -> Vec<Outcome> {
        let Level::Sse2(simd) = Level::baseline() else { unreachable!("the processors tested here") };
        let way = SideBySide::new(solver, forcing).expect("a wall for lanes");
        solver.batch_on(forcing, None).follow(simd, &way, starts, false).expect("bounded motions")
    }

    /// Factors of the forcing, more than there are lanes.
    fn starts(motion: &Motion) -> Vec<RunStart> {
        let state = motion.start(0.0, 0.0, Support::default());
        (0..21).map(|i| RunStart { state, factor: 1.3 - 0.06 * f64::from(i) }).collect()
    }

    /// Side by side, with many corners passed, and the same bits with all vectors that the processor has.
    #[test]
    fn runs_do_not_depend_on_the_processor() {
        let motion = motion(0.018);
        let samples = shaking();
        let (solver, samples) = (RecordSolver::new(&motion, 5e-3), Forcing::Samples(&samples));
        let starts = starts(&motion);
        let portable = narrow(&solver, samples, &starts);
        let level = Level::new();
        let wide = [level.as_avx2().map(Vectors::Avx2), level.as_avx512().map(Vectors::Avx512)];
        for vectors in wide.into_iter().flatten() {
            let batch = solver.batch_on(samples, Some(vectors));
            assert!(batch.is_side_by_side());
            assert_eq!(batch.run(&starts, false).expect("bounded motions"), portable);
        }
        let corners: u64 = portable.iter().map(|outcome| outcome.work.corners).sum();
        let overturned = portable.iter().filter(|outcome| outcome.overturning.is_some()).count();
        assert!(corners > 500 && (1..20).contains(&overturned), "{corners} corners, {overturned} overturned");
    }

    /// Walls whose elastic branch is narrower than their way in a step, with impacts: a step may pass three
    /// corners. Beside each other they do what they do alone.
    #[test]
    fn steps_with_several_corners_are_those_of_single_runs() {
        let bouncing = |a1| losing(a1, DampingModel::None, Impact::Restitution);
        for motion in [bouncing(1.2e-3), bouncing(2.4e-3), motion(8e-4)] {
            let samples = &shaking()[..2000];
            let (solver, samples) = (RecordSolver::new(&motion, 5e-3), Forcing::Samples(samples));
            let starts = starts(&motion);
            let scale = motion.wall().displacement_scale();
            for (start, lane) in starts.iter().zip(narrow(&solver, samples, &starts)) {
                let single = solver.run(*start, samples, false).expect("a bounded motion");
                assert_eq!(lane.work, single.work);
                let apart = lane.state.displacement - single.state.displacement;
                // roundings, amplified over 10 s
                assert!(apart.abs() <= 1e-9 * scale, "{apart:e} m");
            }
        }
    }

    /// Walls that turn shortly before a corner, within what four steps keep away from it but not one: the
    /// turning point is found, alone as beside others.
    #[test]
    fn extremes_before_a_corner_are_found() {
        let (motion, step) = (motion(0.018), 5e-3);
        let wall = motion.wall();
        let corner =
            wall.corners().iter().map(|corner| corner.displacement).find(|u| *u > 0.0).expect("a corner");
        let pull = wall.branches()[wall.branch_of(0.5 * corner, 0.0)].restoring(corner);
        let start = |u: f64, v: f64| {
            let mut state = motion.start(u, v, Support::default());
            // it has been further out on the other side: nothing there asks for a second look
            state.peaks.negative = corner;
            RunStart { state, factor: 1.0 }
        };
        let (still, solver) = ([0.0; 300], RecordSolver::new(&motion, step));
        let still = Forcing::Samples(&still);
        let others = (1..8).map(|i| start(0.05 * corner * f64::from(i), 0.0));
        for distance in (1..40).map(|i| 0.25 * f64::from(i)) {
            for speed in
                (0..12).map(|i| 0.25 * f64::from(i)).take_while(|speed| 0.5 * speed * speed < distance)
            {
                let turning = start(corner - distance * pull * step * step, speed * pull * step);
                let starts: Vec<_> = std::iter::once(turning).chain(others.clone()).collect();
                let alone = narrow(&solver, still, &[turning])[0];
                assert_eq!(alone, narrow(&solver, still, &starts)[0]);
                let single = solver.run(turning, still, false).expect("a bounded motion");
                let missed = single.state.peaks.positive - alone.state.peaks.positive;
                // a few roundings of u
                assert!(missed.abs() <= 8.0 * f64::EPSILON * corner, "{distance} {speed}: {missed:e} m");
            }
        }
    }

    /// Steps that are long beside the wall's period, and few samples, make no lanes.
    #[test]
    fn what_does_not_suit_goes_one_by_one() {
        let samples = shaking();
        let all = Forcing::Samples(&samples);
        let (soft, stiff) = (motion(0.018), motion(1e-4));
        let side_by_side = |motion: &Motion, samples, vectors| {
            RecordSolver::new(motion, 5e-3).batch_on(samples, vectors).is_side_by_side()
        };
        let widest = Vectors::widest();
        assert_eq!(side_by_side(&soft, all, widest), widest.is_some());
        assert!(!side_by_side(&soft, all, None));
        assert!(!side_by_side(&stiff, all, widest));
        assert!(!side_by_side(&soft, Forcing::Samples(&samples[..15]), widest));
        let solver = RecordSolver::new(&stiff, 5e-3);
        let starts = starts(&stiff);
        let together = solver.batch(all).run(&starts, false).expect("bounded motions");
        for (start, outcome) in starts.iter().zip(together) {
            assert_eq!(solver.run(*start, all, false).expect("a bounded motion"), outcome);
        }
        assert_eq!(
            solver.batch(Forcing::Samples(&[])).run(&starts, false).expect("no motion").len(),
            starts.len()
        );
    }
}
