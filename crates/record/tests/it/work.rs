//! Pins the work of batches. Most errors of a bound or a guess are mended by a step of another kind, at the
//! price of speed: only the work shows them.

use record::testing::{Rounds, counted};

use super::*;

/// What a batch takes.
#[derive(Debug, PartialEq)]
struct Counts {
    rounds: Rounds,
    pieces: u64,
    corners: u64,
    overturned: usize,
}

/// Follows a wall under 21 factors side by side.
fn counts(model: DampingModel, impact: Impact) -> Counts {
    let motion = losing(0.018, model, impact);
    // rounded, so that another library of sines changes no count
    let samples: Vec<f64> = shaking().iter().map(|p| (p * 1_048_576.0).round() / 1_048_576.0).collect();
    let (solver, forcing) = (RecordSolver::new(&motion, 5e-3), Forcing::Samples(&samples));
    let widest = Vectors::widest().expect("a processor with AVX2: rounds are of runs side by side");
    let (outcomes, rounds) = counted(&solver, forcing, &starts(&motion), widest).expect("bounded motions");
    let sum = |of: fn(&Outcome) -> u64| outcomes.iter().map(of).sum();
    Counts {
        rounds,
        pieces: sum(|outcome| outcome.work.pieces),
        corners: sum(|outcome| outcome.work.corners),
        overturned: outcomes.iter().filter(|outcome| outcome.overturning.is_some()).count(),
    }
}

#[test]
fn the_work_of_batches_is_known() {
    let [none, restitution] = [Impact::None, Impact::Restitution];
    for (model, impact, [rounds, to_resolve], [pieces, corners], overturned) in [
        (DampingModel::ConstantCoefficient, none, [319, 231], [126_805, 838], 12),
        (DampingModel::None, restitution, [492, 247], [127_541, 1572], 10),
        (DampingModel::ConstantRatio, none, [412, 616], [127_017, 852], 12),
        (DampingModel::StiffnessProportional, none, [413, 620], [127_058, 867], 11),
    ] {
        let rounds = Rounds { rounds, to_resolve };
        let known = Counts { rounds, pieces, corners, overturned };
        assert_eq!(counts(model, impact), known, "{model:?}");
    }
}
