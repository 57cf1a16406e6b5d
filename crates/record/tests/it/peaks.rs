//! Runs that end where the rest of the record cannot raise their peaks, beside whole ones.

use rocking_wall::choices::Rocking;

use super::*;

/// Peaks and times of overturning have the bits of whole runs, side by side and one by one. Where the shaking
/// dies away runs of each wall end early.
#[test]
fn runs_to_the_peaks_have_those_of_whole_ones() {
    let mut samples = shaking();
    // a weak and long end, and in it a push that may be the peak of weak runs
    let weak =
        |n: i32| 0.004 * (0.05 * f64::from(n)).sin() + if (5000..5040).contains(&n) { 0.6 } else { 0.0 };
    samples.extend((0..9000).map(weak));
    let one_sided = Parameters {
        rocking: Rocking::OneSidedPositive,
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        restitution: 0.5,
        u_start: 0.0,
        ..Parameters::default()
    };
    let (ratio, coefficient) = (DampingModel::ConstantRatio, DampingModel::ConstantCoefficient);
    let (mut whole, mut fallen) = (0, 0);
    for motion in [
        motion(0.05),
        losing(0.05, ratio, Impact::None),
        losing(0.02, coefficient, Impact::Restitution),
        rigid(),
        Motion::of(&one_sided, 1e-8).expect("a valid wall"),
    ] {
        let solver = RecordSolver::new(&motion, 5e-3);
        let mut starts = starts(&motion);
        starts
            .extend(starts.clone().into_iter().map(|start| RunStart { factor: 0.1 * start.factor, ..start }));
        for vectors in [Vectors::widest(), None] {
            let mut ended = 0;
            let batch = solver.batch_on(Forcing::Samples(&samples), vectors);
            let all = batch.run(&starts, RunEnd::AtOverturning).expect("bounded motions");
            let short = batch.run(&starts, RunEnd::AtPeaks).expect("bounded motions");
            for (a, b) in all.iter().zip(&short) {
                assert_eq!((a.state.peaks, a.overturning), (b.state.peaks, b.overturning));
                let (pieces, is_short) = (a.work.pieces, b.work.pieces < a.work.pieces);
                assert!(is_short || b.work.pieces == pieces);
                ended += usize::from(is_short);
                whole += usize::from(!is_short && a.overturning.is_none());
                fallen += usize::from(a.overturning.is_some());
            }
            assert!(ended > 0, "{ended} runs of {motion:?}");
        }
    }
    assert!(whole > 10 && fallen > 10, "{whole} {fallen}");
}
