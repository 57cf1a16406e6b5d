//! Tests the errors of the solvers on the problems of `evidence::accuracy`.

use evidence::accuracy::{Setting, defaults, measure_at};
use rocking_wall::wall::Wall;

/// For mild to very stiff walls and any step, the exact solver agrees with the adaptive one at 1e-13 to
/// max(1e-10, 100 ε S). With secant damping the adaptive solver keeps its tolerance of 1e-8, or ten times its
/// local share of it (1e-12), amplified.
#[test]
fn default_problems_stay_within_rounding() {
    let mut compared = 0;
    for problem in defaults(None).unwrap() {
        let exact = Wall::new(&problem.parameters).unwrap().has_constant_damping();
        let settings: &[Setting] =
            if exact { &[Setting::Exact(1), Setting::Exact(4)] } else { &[Setting::Adaptive(1e-8)] };
        let study = measure_at(&problem, settings, 0.0).unwrap();
        // beyond 1e6 histories cannot be compared
        if study.amplification > 1e6 {
            continue;
        }
        compared += 1;
        let floor = if exact { 1e-10 } else { 1e-8_f64.max(1e-11 * study.amplification) };
        for row in &study.measurements {
            let (error, allowed) = (row.error_max, study.rounding().max(floor));
            assert!(error <= allowed, "{}, {:?}: {error:e} of {allowed:e}", study.name, row.setting);
        }
    }
    assert!(compared >= 10, "only {compared} of the problems could be compared");
}
