//! Which blocks are searched for extremes.

use rocking_wall::choices::DampingModel;
use rocking_wall::solver::Motion;
use rocking_wall::wall::{Parameters, Support};

use super::*;
use crate::forcing::Forcing;
use crate::run::{NoObserver, RunStart};

/// A block is searched for extremes where one may lie A h²/8 beyond the ends of its steps. A is that of plain
/// steps or of curved branches, whichever is larger (docs/record-path.md, §5 and §7).
#[test]
fn blocks_are_searched_where_their_margin_exceeds_the_peaks() {
    let (step, forcing, force) = (5e-3, 0.7, 0.9);
    for (model, fastest) in [(DampingModel::ConstantCoefficient, 3.0), (DampingModel::ConstantRatio, 1e3)] {
        let wall = Parameters {
            height: 6.0,
            thickness: 0.6,
            a1: 0.018,
            damping_model: model,
            ..Parameters::default()
        };
        let motion = Motion::of(&wall, 1e-8).expect("a valid wall");
        let (solver, still) = (RecordSolver::new(&motion, step), Blocks::new(Forcing::Still(2)));
        let state = motion.start(0.0, 0.0, Support::default());
        let given = [BatchRun { solver: &solver, record: &still, start: RunStart { state, factor: 1.0 } }];
        let lanes = Lanes::new(&given, RunEnd::OfRecord, NoObserver);
        let table = &solver.table;
        let plain = table.most_growth * 1.25 * (forcing + force);
        let curved = table.curved_growth * (forcing + force + table.curved_damping * fastest);
        assert_eq!(plain > curved, model == DampingModel::ConstantCoefficient);
        let margin = plain.max(curved) * step * step / 8.0;
        let block = Block { highest: 0.04, lowest: -0.03, fastest, forcing, ..Block::new(0, 1.0, state) };
        let exceeds = |positive: f64, negative: f64| {
            lanes.may_exceed(&block, &Peaks { positive: 0.04 + positive, negative: 0.03 + negative }, force)
        };
        // by far more than rounding, and far less than the parts of A
        let (less, more) = (margin * (1.0 - 1e-6), margin * (1.0 + 1e-6));
        assert!(exceeds(less, more) && exceeds(more, less) && !exceeds(more, more), "{model:?}");
    }
}
