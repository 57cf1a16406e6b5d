//! Tests the static capacity curve: closed forms of its secant periods, its corners, and the output of
//! `wall describe`.

use std::f64::consts::TAU;

use rocking_wall::variables::{DampingModel, ForceLaw, Mechanism, TieSide};
use rocking_wall::wall::{Parameters, Wall};

fn made(parameters: &Parameters) -> Wall {
    Wall::new(parameters).unwrap()
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    // a dozen roundings
    assert!((found - expected).abs() <= 1e-14 * expected.abs(), "{found} for {expected}");
}

fn rigid() -> Wall {
    made(&Parameters {
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        ..Parameters::default()
    })
}

/// On the softening line k_sec = k₀ (1 − f)/f; on the elastic branch the period is T₁.
#[test]
fn secant_periods_have_their_closed_form() {
    let wall = made(&Parameters::default());
    for fraction in [0.05, 0.1, 0.4, 0.6, 0.95] {
        let point = wall.capacity_at(1.0, fraction);
        let expected = TAU / wall.rocking_rate() * (fraction / (1.0 - fraction)).sqrt();
        assert_near(point.secant_period.unwrap(), expected);
        assert_near(point.force_ratio, 1.0 - fraction);
        assert_near(point.secant_stiffness.unwrap(), point.force / point.displacement);
        // T = 2π √(d*/a*) is the same period
        let period = TAU * (point.spectral_displacement / point.spectral_acceleration).sqrt();
        assert_near(point.secant_period.unwrap(), period);
    }
    let elastic = wall.capacity_at(1.0, 0.01);
    assert_near(elastic.secant_period.unwrap(), TAU / wall.omega1());
    let end = wall.capacity_at(1.0, 1.0);
    assert_eq!((end.force, end.secant_period), (0.0, None));
    assert_eq!(wall.capacity_at(1.0, 0.0).secant_stiffness, None);
}

/// a* of a rigid parapet at u = 0 is the acceleration at which it begins to rock, g tan α.
#[test]
fn the_rigid_curve_starts_at_the_onset_of_rocking() {
    let corners = rigid().capacity_corners(1.0);
    assert_eq!(corners.len(), 2);
    assert_near(corners[0].spectral_acceleration, 9.81 * 0.1);
    assert_eq!((corners[0].displacement, corners[0].force_ratio), (0.0, 1.0));
    assert_eq!((corners[0].secant_stiffness, corners[0].secant_period), (None, None));
    assert_eq!((corners[1].displacement_ratio, corners[1].force), (1.0, 0.0));
}

/// Rocking starts at the largest force of the law, on the weaker side, not at that of the rigid wall.
#[test]
fn the_onset_of_rocking_is_that_of_the_law() {
    let with = |parameters: Parameters| made(&parameters).rocking_onset();
    let onset = 9.81 * 0.1;
    assert_near(rigid().rocking_onset(), onset);
    assert_near(with(Parameters::default()), 0.97 * onset);
    let trilinear = Parameters { force_law: ForceLaw::Trilinear, d1: 0.6, ..Parameters::default() };
    assert_near(with(trilinear), 0.6 * onset);
    let loaded = Parameters { overburden: 3000.0, overburden_eccentricity: 0.05, ..Parameters::default() };
    let wall = made(&loaded);
    let weaker = wall.body().strength.positive.min(wall.body().strength.negative);
    assert_near(wall.rocking_onset(), 0.97 * weaker / wall.body().mass);
}

/// Each corner of the law appears once, on both sides of an eccentric load, and the curve passes through
/// them.
#[test]
fn corners_are_those_of_the_law() {
    for (law, count) in [(ForceLaw::Bilinear, 4), (ForceLaw::Trilinear, 5)] {
        for mechanism in [Mechanism::Parapet, Mechanism::VerticalSpanning] {
            let parameters = Parameters {
                mechanism,
                force_law: law,
                a3: 0.9,
                d1: 0.6,
                overburden: 3000.0,
                overburden_eccentricity: 0.05,
                ..Parameters::default()
            };
            let wall = made(&parameters);
            for sign in [1.0, -1.0] {
                let corners = wall.capacity_corners(sign);
                assert_eq!(corners.len(), count, "{corners:?}");
                assert_near(corners[1].displacement_ratio, 0.03);
                assert_near(corners[count - 2].displacement_ratio, 0.9);
                assert_eq!(corners[count - 2].force, 0.0);
                assert!(corners[count - 1].force < 0.0 && corners[count - 1].displacement_ratio == 1.0);
                assert_eq!(corners[1].displacement, wall.statics().elastic_end(sign));
                // the softening line goes through the last corner before u₃, and through u₃
                let softening =
                    |place: usize| wall.statics().softening_force(sign, corners[place].displacement);
                assert_near(softening(count - 3) / corners[count - 3].force, 1.0);
                assert_eq!(softening(count - 2), 0.0);
                let m = wall.body().effective_mass;
                for corner in &corners[1..count - 1] {
                    let u = sign * corner.displacement;
                    let force = sign * m * wall.branches()[wall.branch_of(u, -sign)].restoring(u);
                    assert!((force - corner.force).abs() < 1e-9 * wall.body().strength.of(sign));
                }
            }
        }
    }
}

/// The curve that is drawn goes through the corners on both sides.
#[test]
fn the_backbone_goes_through_the_corners() {
    for &model in DampingModel::ALL {
        let parameters = Parameters { damping_model: model, overburden: 3000.0, ..Parameters::default() };
        let wall = made(&parameters);
        let points = wall.backbone();
        assert!(points.windows(2).all(|ends| ends[0].0 <= ends[1].0), "{points:?}");
        for sign in [1.0, -1.0] {
            for corner in wall.capacity_corners(sign).iter().filter(|corner| corner.displacement > 0.0) {
                let (u, force) = (sign * corner.displacement, sign * corner.force);
                let near = |point: &&(f64, f64)| (point.0 - u).abs() <= 1e-12;
                let (_, found) = points.iter().find(near).unwrap_or_else(|| panic!("{u} in {points:?}"));
                assert!(
                    (found - force).abs() <= 1e-12 * wall.body().strength.of(sign),
                    "{found} for {force}"
                );
            }
        }
    }
}

/// A tie adds (2y/h) N to the curve.
#[test]
fn a_tie_adds_its_force_times_its_lever() {
    let tie_side = TieSide::Both;
    let tied = Parameters {
        tie_height: 3.0,
        tie_stiffness: 2e5,
        tie_slack: 0.02,
        tie_side,
        ..Parameters::default()
    };
    let (alone, wall) = (made(&Parameters { tie_stiffness: 0.0, ..tied.clone() }), made(&tied));
    let lever = 2.0 * 3.0 / tied.height;
    for (sign, fraction) in [1.0, -1.0].into_iter().flat_map(|sign| [0.01, 0.3, 0.9].map(|f| (sign, f))) {
        let [with, without] = [&wall, &alone].map(|wall| wall.capacity_at(sign, fraction));
        let force = lever * (2e5 * (lever * with.displacement - 0.02)).max(0.0);
        let rounding = 1e-14 * (with.force.abs() + without.force.abs());
        assert!((with.force - without.force - force).abs() <= rounding, "{sign}, {fraction}: {force}");
    }
}

#[test]
fn an_error_names_its_point() {
    let cases: [(&[[f64; 2]], usize, &str); 8] = [
        (&[], 1, "at least two points"),
        (&[[0.05, 0.8]], 1, "at least two points"),
        (&[[0.05, 0.8], [0.2, f64::NAN], [1.0, 0.0]], 2, "must be finite"),
        (&[[0.0, 0.8], [1.0, 0.0]], 1, "must rise"),
        (&[[0.05, 0.8], [0.2, 1.0], [0.2, 0.9], [1.0, 0.0]], 3, "must rise"),
        (&[[0.05, 0.8], [0.2, 0.0], [1.0, 0.0]], 2, "must be positive"),
        (&[[0.05, 0.8], [1.0, -0.1]], 2, "must be positive"),
        (&[[0.05, 0.8], [0.2, 0.9], [1.0, 0.9]], 3, "the last line must fall"),
    ];
    for (points, number, reason) in cases {
        let error = Wall::new(&Parameters { multilinear: Some(points.into()), ..Parameters::default() });
        let error = error.unwrap_err().to_string();
        assert!(error.contains(&format!("point {number} ")) && error.contains(reason), "{points:?}: {error}");
    }
}

/// a₁ must be below a₃.
#[test]
fn the_elastic_branch_ends_before_the_force() {
    for (a1, fits) in [(0.79, true), (0.8, false), (0.81, false)] {
        let wall = Wall::new(&Parameters { a1, a3: 0.8, ..Parameters::default() });
        assert_eq!(wall.is_ok(), fits, "{a1}");
        let message = wall.map_or_else(|error| error.to_string(), |_| String::new());
        assert_eq!(message.contains("must be smaller than a3 = 0.8"), !fits, "{message}");
    }
}

/// A law of points goes through each of them, also where a falling line ends above zero.
#[test]
fn a_law_of_points_goes_through_them() {
    let points = vec![[0.05, 0.8], [0.2, 1.0], [0.3, 1.0], [0.5, 0.9], [0.7, 0.3], [1.0, 0.0]];
    let wall = made(&Parameters {
        multilinear: Some(points.clone().into()),
        damping_model: DampingModel::None,
        ..Parameters::default()
    });
    for (sign, ends) in
        [1.0, -1.0].into_iter().flat_map(|sign| points.windows(2).map(move |ends| (sign, ends)))
    {
        for share in [0.0, 0.3, 0.9] {
            let [fraction, force] = [0, 1].map(|i| ends[0][i] + (ends[1][i] - ends[0][i]) * share);
            assert_near(wall.capacity_at(sign, fraction).force_ratio, force);
        }
    }
}
