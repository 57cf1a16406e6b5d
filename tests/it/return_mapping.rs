//! Ties that yield and break, beside a program that knows neither branches nor events of a tie.
//!
//! It takes fixed Runge–Kutta steps. After each it asks whether the force of a tie exceeds its strength, and
//! if so lets the tie get longer by what is too much: the return mapping of plasticity. Where a tie yields,
//! unloads or breaks inside a step it errs by up to the step, so it converges to the exact motion with the
//! first power of its step.

use std::sync::Arc;

use proptest::prelude::*;
use rocking_wall::solver::Segment;
use rocking_wall::variables::{ForceLaw, Impact, TieSide};
use rocking_wall::wall::{Parameters, Support, TieNumbers, Wall};

use crate::configuration::mostly_of;
use crate::properties::{motions, onset};
use crate::several_ties::several;
use crate::ties::tied;

/// A wall whose ties yield at a share of the force at 0.4 `u_ins`, and break after some more elongation.
pub(crate) fn yielding() -> impl Strategy<Value = Parameters> {
    let ultimate = prop_oneof![Just(0.0), 1e-3_f64..0.5, Just(10.0)];
    (tied(), 0.01_f64..1.0, ultimate).prop_map(|(parameters, strength, ultimate)| {
        let wall = Wall::new(&parameters).unwrap();
        let (tie, u_ins) = (wall.ties().first().unwrap(), wall.body().instability.positive);
        Parameters {
            tie_strength: strength * tie.stiffness * tie.lever * 0.4 * u_ins,
            tie_ultimate: ultimate * tie.lever * u_ins,
            ..parameters
        }
    })
}

/// A tie of one side, with its plastic elongation.
struct Spring {
    of: TieNumbers,
    sign: f64,
    lever: f64,
    elongation: f64,
    broken: bool,
}

impl Spring {
    /// K (e − g₀ − p), without a limit.
    fn pull(&self, u: f64) -> f64 {
        let stretch = self.sign * self.lever * u - self.of.slack - self.elongation;
        if self.broken { 0.0 } else { self.of.stiffness * stretch.max(0.0) }
    }

    /// The force that it resists: one without an ultimate elongation stays elastic.
    fn strength(&self) -> f64 {
        if self.of.ultimate < 0.0 { f64::INFINITY } else { self.of.strength }
    }
}

/// A wall by Runge–Kutta steps, with its ties.
struct Mapping {
    /// The wall without ties.
    alone: Wall,
    springs: Vec<Spring>,
    motion: [f64; 2],
}

const SIGNS: [f64; 2] = [1.0, -1.0];

impl Mapping {
    fn new(parameters: &Parameters) -> Self {
        let untied = Parameters { tie_stiffness: 0.0, further_ties: Arc::default(), ..parameters.clone() };
        let alone = Wall::new(&untied).unwrap();
        let springs = parameters.ties().flat_map(|of| {
            let lever = 2.0 * of.height / parameters.height;
            let sides = SIGNS.into_iter().filter(move |sign| match of.side {
                TieSide::Positive => *sign > 0.0,
                TieSide::Negative => *sign < 0.0,
                TieSide::Both => true,
            });
            sides.map(move |sign| Spring { of, sign, lever, elongation: 0.0, broken: false })
        });
        Self { alone, springs: springs.collect(), motion: [0.0; 2] }
    }

    fn rates(&self, [u, v]: [f64; 2], forcing: f64) -> [f64; 2] {
        let own = self.alone.acceleration(self.alone.branch_of(u, v), u, v, forcing);
        let force = |tie: &Spring| tie.sign * tie.lever * tie.pull(u).min(tie.strength());
        let pull: f64 = self.springs.iter().map(force).sum();
        [v, own - pull / self.alone.body().effective_mass]
    }

    fn step(&mut self, length: f64, forcing: [f64; 2]) {
        let after = |[u, v]: [f64; 2], [du, dv]: [f64; 2], time: f64| [u + time * du, v + time * dv];
        let (now, middle) = (self.motion, 0.5 * (forcing[0] + forcing[1]));
        let first = self.rates(now, forcing[0]);
        let second = self.rates(after(now, first, 0.5 * length), middle);
        let third = self.rates(after(now, second, 0.5 * length), middle);
        let last = self.rates(after(now, third, length), forcing[1]);
        for part in [0, 1] {
            let sum = first[part] + 2.0 * (second[part] + third[part]) + last[part];
            self.motion[part] += length / 6.0 * sum;
        }
        for tie in &mut self.springs {
            let excess = tie.pull(self.motion[0]) - tie.strength();
            if excess > 0.0 {
                tie.elongation += excess / tie.of.stiffness;
                tie.broken |= tie.elongation >= tie.of.ultimate;
            }
        }
    }

    /// Returns u and the largest elongation of each side at each sample.
    fn history(mut self, accelerations: &[f64], step: f64, parts: u32) -> Vec<[f64; 3]> {
        let forcing = |a: f64| self.alone.body().forcing(Support::rigid(a));
        let forcings: Vec<f64> = accelerations.iter().map(|a| forcing(*a)).collect();
        let mut history = vec![[0.0; 3]];
        for pair in forcings.windows(2) {
            let at = |part: u32| pair[0] + (pair[1] - pair[0]) * f64::from(part) / f64::from(parts);
            for part in 0..parts {
                self.step(step / f64::from(parts), [at(part), at(part + 1)]);
            }
            let [positive, negative] = SIGNS.map(|sign| {
                let of_side = self.springs.iter().filter(|tie| tie.sign == sign);
                of_side.map(|tie| tie.elongation.min(tie.of.ultimate.max(0.0))).fold(0.0, f64::max)
            });
            history.push([self.motion[0], positive, negative]);
        }
        history
    }
}

/// The motion is that of the mapping, within 1e-4 `u_ins` and ten times what halving its step has changed so
/// far: a stiff tie is passed in a few of its steps. Once that exceeds 1e-4 `u_ins`, or the wall has
/// overturned, nothing is compared. Another law of unloading is off by hundredths of `u_ins`.
#[test]
fn ties_yield_and_break_as_by_a_return_mapping() {
    let walls = prop_oneof![yielding().boxed(), several(yielding()).boxed()];
    mostly_of(2, 0.8, (walls, motions()), |(parameters, motion)| {
        let force_law = ForceLaw::Bilinear;
        let impact = Impact::None;
        let parameters = Parameters { force_law, impact, a1: parameters.a1.max(1e-3), ..parameters };
        let mut simulation = crate::start(&parameters);
        let wall = simulation.wall().clone();
        let (u_ins, step) = (wall.displacement_scale(), 0.3 / wall.rocking_rate());
        let accelerations: Vec<f64> =
            std::iter::once(0.0).chain(motion.iter().map(|a| 0.5 * a * onset(&wall))).collect();
        let [coarse, fine] =
            [1000, 2000].map(|parts| Mapping::new(&parameters).history(&accelerations, step, parts));
        let mut largest = 0.0_f64;
        for (index, pair) in accelerations.windows(2).enumerate() {
            let [from, to] = [pair[0], pair[1]].map(Support::rigid);
            simulation.advance(&Segment { duration: step, from, to }).unwrap();
            let (coarse, fine) = (coarse[index + 1], fine[index + 1]);
            let elongation = simulation.outputs(Support::default()).tie_elongation;
            let found = [simulation.progress().state.displacement, elongation.positive, elongation.negative];
            let scales = [
                u_ins,
                wall.ties().first().unwrap().lever * u_ins,
                wall.ties().first().unwrap().lever * u_ins,
            ];
            let changes = [0, 1, 2].map(|n| (fine[n] - coarse[n]).abs() / scales[n]);
            largest = changes.into_iter().fold(largest, f64::max);
            if largest > 1e-4 || simulation.progress().state.overturned {
                return Ok([index, accelerations.len() - 1]);
            }
            for n in [0, 1, 2] {
                let error = (found[n] - fine[n]).abs() / scales[n];
                prop_assert!(error <= 10.0 * largest + 1e-4, "{n} at {index}: {error:e} of {largest:e}");
            }
        }
        Ok([accelerations.len() - 1; 2])
    });
}
