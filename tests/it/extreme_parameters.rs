//! Every parameter at the ends of its limits and close to 0: the wall is refused by name, or it runs with
//! finite numbers and in bounded work.

use fmu_export::{Interface, Kind, Log, Model as _, Step, VariableId as _, check_real};
use proptest::prelude::*;
use proptest::sample::{Index, select};
use rocking_wall::unit::Unit;
use rocking_wall::variables::{
    DampingModel, ForceLaw, Impact, IntegerVariable, Mechanism, RealVariable as V, Rocking, Solver, TieSide,
};
use rocking_wall::wall::Parameters;

use crate::configuration::mostly;
use crate::instantiated;
use crate::yielding::by_hand;

/// Walls in which every parameter matters at least once.
fn walls() -> Vec<Parameters> {
    let parapet = Parameters { u_start: 0.02, ..Parameters::default() };
    let loaded = Parameters { overburden: 1e4, overburden_eccentricity: 0.03, ..parapet.clone() };
    let strip = Parameters { mechanism: Mechanism::VerticalSpanning, ..loaded.clone() };
    let rigid = Parameters {
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        ..parapet.clone()
    };
    let block = Parameters { damping_model: DampingModel::FreeStandingBlock, c_bar: 0.2, ..rigid.clone() };
    let trilinear = Parameters {
        force_law: ForceLaw::Trilinear,
        a3: 0.9,
        d1: 0.6,
        damping_model: DampingModel::StiffnessProportional,
        ..loaded.clone()
    };
    let ratio = Parameters { damping_model: DampingModel::ConstantRatio, xi: 0.05, ..loaded };
    let both = Parameters { tie_side: TieSide::Both, ..by_hand(0.05) };
    let elastic = Parameters { force_law: ForceLaw::Bilinear, tie_ultimate: -1.0, ..both.clone() };
    let secant = Parameters {
        tie_height: 2.0,
        tie_stiffness: 1e6,
        tie_strength: 3e3,
        tie_ultimate: 0.05,
        ..ratio.clone()
    };
    let mut walls = vec![parapet, strip, trilinear, ratio, both.clone(), elastic, secant];
    walls.push(Parameters { rocking: Rocking::OneSidedPositive, ..both });
    walls.push(Parameters { solver: Solver::Adaptive, ..rigid.clone() });
    walls.push(Parameters { solver: Solver::Newmark, ..rigid.clone() });
    walls.extend([block, rigid]);
    walls
}

fn real_parameters() -> impl Iterator<Item = V> {
    V::ALL.iter().copied().filter(|variable| Parameters::default().real(*variable).is_some())
}

/// The ends of the limits of a parameter and what is next to them, and numbers close to 0, all valid or
/// refused by name.
fn extremes(variable: V) -> Vec<f64> {
    let Kind::Real { min: Some(min), max: Some(max), .. } = variable.variable().kind else {
        panic!("{} has limits", variable.variable().name)
    };
    let tiny = [5e-324, f64::MIN_POSITIVE, 1e-200, 1e-100, 1e-50, 1e-30, 1e-15, 1e-9];
    let near = [min, min.next_up(), max, max.next_down(), min + 1e-9 * (max - min), 1e-6 * max, 0.0];
    near.into_iter().chain(tiny.into_iter().flat_map(|size| [size, -size])).collect()
}

/// What has become of a wall.
#[derive(Debug, PartialEq)]
enum Fate {
    Refused(String),
    Ran,
    GaveUp(String),
}

/// Runs a wall for 1 s as an importer does, which checks limits.
fn fate(parameters: &Parameters) -> Fate {
    let mut unit = instantiated(Interface::CoSimulation, None, &mut Log::silent());
    for &variable in V::ALL {
        if let Some(value) = parameters.real(variable) {
            if let Err(refusal) = check_real(variable.variable(), value) {
                return Fate::Refused(refusal.0);
            }
            unit.set_real(variable, value);
        }
    }
    for &variable in IntegerVariable::ALL {
        if let Some(value) = parameters.integer(variable) {
            unit.set_integer(variable, value);
        }
    }
    if let Err(refusal) = unit.initialize(&mut Log::silent()) {
        return Fate::Refused(refusal.0);
    }
    let finite = |unit: &Unit, time: f64| {
        for &variable in V::ALL {
            let value = unit.real(variable);
            assert!(value.is_finite(), "{} = {value} at {time} s: {parameters:?}", variable.variable().name);
        }
    };
    finite(&unit, 0.0);
    for step in 0..20 {
        let from = 0.05 * f64::from(step);
        unit.set_real(V::ABottom, if step % 4 < 2 { 2.0 } else { -2.0 });
        let step = Step { from, duration: 0.05, may_end_early: false };
        if let Err(error) = unit.do_step(step, &mut Log::silent()) {
            return Fate::GaveUp(error.0);
        }
        finite(&unit, from);
    }
    Fate::Ran
}

#[test]
fn each_parameter_may_be_extreme() {
    let (mut ran, mut refused) = (0, 0);
    for wall in walls() {
        assert_eq!(fate(&wall), Fate::Ran, "{wall:?}");
        for variable in real_parameters() {
            let name = variable.variable().name;
            for value in extremes(variable) {
                let mut parameters = wall.clone();
                assert!(parameters.set_real(variable, value));
                match fate(&parameters) {
                    Fate::Ran => ran += 1,
                    Fate::Refused(text) => {
                        let mut names = real_parameters().map(|variable| variable.variable().name);
                        assert!(names.any(|name| text.contains(name)), "{name} = {value:e}: {text}");
                        refused += 1;
                    }
                    Fate::GaveUp(text) => panic!("{name} = {value:e}: {text} {parameters:?}"),
                }
            }
        }
    }
    assert!(ran > 2000 && refused > 500, "{ran} ran, {refused} were refused");
}

#[test]
fn parameters_may_be_extreme_together() {
    let variables: Vec<_> = real_parameters().collect();
    let changes = proptest::collection::vec((select(variables), any::<Index>()), 2..4);
    mostly(0.1, (select(walls()), changes), |(mut parameters, changes)| {
        for (variable, index) in changes {
            let mut valid = extremes(variable);
            valid.retain(|value| check_real(variable.variable(), *value).is_ok());
            assert!(parameters.set_real(variable, *index.get(&valid)));
        }
        match fate(&parameters) {
            Fate::Ran => Ok([1, 1]),
            Fate::Refused(text) => {
                prop_assert!(!text.is_empty());
                Ok([0, 1])
            }
            Fate::GaveUp(text) => Err(TestCaseError::fail(format!("{text}: {parameters:?}"))),
        }
    });
}
