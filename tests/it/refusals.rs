//! Tests which parameters and starts are refused, and that others near their limits are not.

use rocking_wall::solver::Motion;
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Mechanism, Rocking, Solver};
use rocking_wall::wall::{COMPUTED, Parameters, Wall};
use scene::Scene;
use scene::response::Response;

/// Makes the wall of the start values with a change.
fn made(change: impl Fn(&mut Parameters)) -> Result<Wall, String> {
    let mut parameters = Parameters { u_start: 0.0, ..Parameters::default() };
    change(&mut parameters);
    Wall::new(&parameters).map_err(|error| error.to_string())
}

#[test]
fn invalid_parameters_are_refused() {
    type Change = fn(&mut Parameters);
    let rigid: Change = |wall| wall.force_law = ForceLaw::RigidLinear;
    let cases: [(Change, &str); 10] = [
        (rigid, "damping_model = constant_ratio does not go with force_law = rigid_linear; set force_law"),
        (|wall| (wall.xi, wall.restitution) = (COMPUTED, 0.0), "xi = -1 asks for damping computed from"),
        (|wall| wall.xi = -0.5, "xi = -0.5 must be 0 or more, or -1"),
        (
            |wall| (wall.damping_model, wall.c_bar) = (DampingModel::FreeStandingBlock, -2.0),
            "c_bar = -2 must be 0 or more, or -1",
        ),
        (|wall| wall.restitution = -0.1, "restitution = -0.1 must be 0 or more, or -1"),
        (
            |wall| {
                (wall.mechanism, wall.tie_stiffness) = (Mechanism::VerticalSpanning, 1e5);
                wall.tie_height = wall.height;
            },
            "tie_height = 4 m is at the top support of a strip, where the wall does not move",
        ),
        (
            |wall| (wall.tie_stiffness, wall.tie_height) = (1e5, 0.0),
            "tie_height = 0 m must be above 0 and at most height = 4 m",
        ),
        (
            |wall| (wall.tie_stiffness, wall.tie_height) = (1e5, 4.01),
            "tie_height = 4.01 m must be above 0 and at most height = 4 m",
        ),
        (|wall| wall.height = 0.2, "restitution_source = calibrated gives e = -"),
        (
            |wall| (wall.overburden, wall.overburden_eccentricity) = (1e6, 0.25),
            "no rocking strength for u > 0: F0 = -",
        ),
    ];
    for (change, words) in cases {
        let error = made(change).unwrap_err();
        assert!(error.contains(words), "{words}: {error}");
    }
    let within: [Change; 7] = [
        |wall| {
            (wall.force_law, wall.damping_model) = (ForceLaw::RigidLinear, DampingModel::FreeStandingBlock);
        },
        |wall| (wall.xi, wall.restitution) = (COMPUTED, 0.01),
        |wall| wall.xi = 0.0,
        |wall| (wall.xi, wall.restitution) = (0.05, 0.0),
        |wall| (wall.tie_stiffness, wall.tie_height) = (1e5, 4.0),
        |wall| (wall.height, wall.restitution) = (0.2, 0.5),
        |wall| (wall.overburden, wall.overburden_eccentricity) = (1e6, 0.19),
    ];
    for (number, change) in within.into_iter().enumerate() {
        assert!(made(change).is_ok(), "{number}: {:?}", made(change).err());
    }
}

/// A thickness in centimetres is the cause, not the restitution that cannot be computed from it.
#[test]
fn a_refusal_begins_with_the_numbers_that_may_be_its_cause() {
    let error = made(|wall| (wall.height, wall.thickness) = (1.2, 30.0)).unwrap_err();
    assert!(
        error.starts_with(
            "thickness = 30 m is unusual: 0.03 to 3 m is usual; if it is in cm, give 0.3 m; as given, \
             restitution_source = calibrated gives e = -"
        ),
        "{error}"
    );
    let error = made(|wall| (wall.force_law, wall.density) = (ForceLaw::RigidLinear, 1.8)).unwrap_err();
    assert!(error.contains("if it is in t/m3, give 1800 kg/m3; as given, damping_model = "), "{error}");
    // without such a number nothing is added
    let error = made(|wall| wall.force_law = ForceLaw::RigidLinear).unwrap_err();
    assert!(error.starts_with("damping_model = "), "{error}");
}

/// A thin wall without a motion is not released at a displacement that nobody gave.
#[test]
fn a_missing_motion_is_named() {
    let mut scene = Scene::default();
    scene.set("thickness", "0.2").unwrap();
    let error = Response::of(&scene).unwrap_err().to_string();
    assert_eq!(
        error,
        "u_start = 0.18 m is beyond u_ins = 0.100000 m: set u_start = 0 for a wall that is at rest until a \
         motion ([motion], --record) or the inputs of an FMU move it"
    );
}

/// The closed form needs damping that is constant on each branch.
#[test]
fn walls_without_a_closed_form_are_refused_by_the_exact_solver() {
    for &damping_model in DampingModel::ALL {
        let fits = match damping_model {
            DampingModel::None | DampingModel::ConstantCoefficient | DampingModel::FreeStandingBlock => true,
            DampingModel::ConstantRatio | DampingModel::StiffnessProportional => false,
        };
        let wall = Parameters { solver: Solver::Exact, damping_model, ..Parameters::default() };
        let motion = Motion::of(&wall, 1e-8).map_err(|error| error.to_string());
        assert_eq!(motion.is_ok(), fits, "{damping_model:?}");
        if let Err(error) = motion {
            assert!(error.starts_with("solver = exact does not go with damping_model = "), "{error}");
        }
    }
}

/// A run starts up to the instability, and in front of transverse walls.
#[test]
fn starts_beyond_u_ins_or_behind_walls_are_refused() {
    let both = made(|_| {}).unwrap();
    let u_ins = both.body().instability.positive;
    for side in [1.0, -1.0] {
        assert!(both.check_start(side * u_ins).is_ok());
        let error = both.check_start(1.01 * side * u_ins).unwrap_err().to_string();
        assert!(error.contains("is beyond u_ins = 0.200000 m"), "{error}");
        let rocking = if side > 0.0 { Rocking::OneSidedPositive } else { Rocking::OneSidedNegative };
        let one = made(|wall| {
            (wall.rocking, wall.impact) = (rocking, Impact::Restitution);
            (wall.damping_model, wall.restitution) = (DampingModel::None, 0.5);
        });
        let one = one.unwrap();
        assert!(one.check_start(0.0).is_ok() && one.check_start(0.1 * side).is_ok());
        let error = one.check_start(-0.001 * side).unwrap_err().to_string();
        assert!(error.contains("is behind the transverse walls"), "{error}");
    }
}
