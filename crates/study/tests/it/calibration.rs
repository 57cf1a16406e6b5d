//! Section 5 of the paper, refitted: `study::calibration`.

use std::num::NonZeroUsize;

use rocking_wall::variables::{DampingModel, ForceLaw, Mechanism};
use rocking_wall::wall::Parameters;
use study::calibration::{Calibration, CalibrationError, Grid, PowerLaw, calibrate};

const TWO: NonZeroUsize = NonZeroUsize::MIN.saturating_add(1);

const MODELS: [DampingModel; 3] =
    [DampingModel::ConstantCoefficient, DampingModel::ConstantRatio, DampingModel::StiffnessProportional];

fn of(parameters: &Parameters, model: DampingModel, grid: &Grid) -> Calibration {
    calibrate(parameters, model, grid, TWO).unwrap()
}

/// For the free-standing block an independent refit gave c̄ = −1.38 ln e; the paper prints 1.55. The
/// tolerance is 2 %, as for the others.
#[test]
fn a_free_standing_block_needs_a_c_bar_of_1_38() {
    let rigid = Parameters { force_law: ForceLaw::RigidLinear, ..Parameters::default() };
    let found = of(&rigid, DampingModel::FreeStandingBlock, &Grid::default());
    assert!(found.laws.is_empty(), "a rigid wall has no a1 to vary");
    assert!((found.coefficients[0].x / 1.38 - 1.0).abs() < 0.02, "{:?}", found.coefficients);
}

/// Figure 9: with normalised displacements the shape matters only through the sampling. Samples of 0.01 s are
/// up to 1 % of a period, and they shift the minimum of Eq. (18) by about as much.
#[test]
fn neither_shape_nor_mechanism_nor_overburden_matter() {
    let grid = Grid { restitution: vec![0.84, 0.92], a1: vec![0.03], ..Grid::default() };
    let strip =
        Parameters { mechanism: Mechanism::VerticalSpanning, thickness: 0.2, ..Parameters::default() };
    for model in MODELS {
        let x = |parameters: &Parameters| of(parameters, model, &grid).coefficients[0].x;
        let reference = x(&Parameters::default());
        for other in [
            Parameters { height: 2.0, ..Parameters::default() },
            Parameters { height: 8.0, ..Parameters::default() },
            Parameters { overburden: 20e3, ..Parameters::default() },
            strip.clone(),
        ] {
            let ratio = x(&other) / reference;
            assert!((ratio - 1.0).abs() < 0.01, "{model:?}: {ratio}");
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let grid = Grid { restitution: vec![0.82, 0.9], a1: vec![0.02, 0.05], ..Grid::default() };
    let one =
        calibrate(&Parameters::default(), DampingModel::ConstantRatio, &grid, NonZeroUsize::MIN).unwrap();
    assert_eq!(one, of(&Parameters::default(), DampingModel::ConstantRatio, &grid));
}

/// A multilinear law equal to a bilinear one gives the same results, at the same a₁.
#[test]
fn a_multilinear_law_has_its_own_a1() {
    let grid = Grid { restitution: vec![0.85], a1: vec![0.03], ..Grid::default() };
    let points = [[0.03, 0.97], [1.0, 0.0]];
    let multilinear = Parameters { multilinear: Some(points.into()), ..Parameters::default() };
    let elsewhere = Grid { a1: vec![0.07], ..grid.clone() };
    let [a, b] = [(&Parameters::default(), &grid), (&multilinear, &elsewhere)]
        .map(|(parameters, grid)| of(parameters, DampingModel::ConstantRatio, grid).coefficients[0]);
    assert_eq!(b.a1, 0.03);
    // both minimisations stop within 3e-5
    assert!((a.x / b.x - 1.0).abs() < 6e-5, "{a:?} {b:?}");
}

#[test]
fn a_power_law_comes_back() {
    let law = PowerLaw { q: 0.4, r: -0.3 };
    let points = [0.01, 0.03, 0.1].map(|a1| (a1, law.at(a1)));
    let found = PowerLaw::fit(&points).unwrap();
    // a minimum is accurate to the square root of the rounding of its function
    assert!((found.r - law.r).abs() < 1e-6 && (found.q - law.q).abs() < 1e-6, "{found:?}");
    assert!(PowerLaw::fit(&points[..1]).is_none() && PowerLaw::fit(&[(0.1, 1.0), (0.2, -1.0)]).is_none());
}

#[test]
fn what_cannot_be_calibrated_is_refused() {
    let default = Parameters::default();
    let refused = |model, grid: &Grid, words: &[&str]| {
        let message = calibrate(&default, model, grid, TWO).unwrap_err().to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    };
    let grid = Grid { restitution: vec![0.9], a1: vec![0.03], ..Grid::default() };
    refused(DampingModel::None, &grid, &["none", "constant_ratio"]);
    let cdr = DampingModel::ConstantRatio;
    refused(cdr, &Grid { restitution: vec![], ..grid.clone() }, &["no value of e"]);
    refused(cdr, &Grid { restitution: vec![1.0], ..grid.clone() }, &["e = 1", "below 1"]);
    refused(cdr, &Grid { start: vec![f64::NAN], ..grid.clone() }, &["u0/u_ins = NaN"]);
    refused(cdr, &Grid { step: 0.0, ..grid.clone() }, &["step = 0"]);
    refused(
        cdr,
        &Grid { restitution: vec![0.999_999], ..grid.clone() },
        &["0.999999", "not decayed", "longer step"],
    );
    let rigid = Parameters { force_law: ForceLaw::RigidLinear, ..default.clone() };
    let error = calibrate(&rigid, cdr, &grid, TWO).unwrap_err();
    assert!(matches!(error, CalibrationError::Parameters(_)), "{error}");
}
