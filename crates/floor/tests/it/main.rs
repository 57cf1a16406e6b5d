//! The floor against closed forms, its coupling and its description.

mod coupling;
mod description;
#[path = "../../../../tests/it/edited_states.rs"]
mod edited_states;
mod hysteresis;
mod linear;
#[path = "../../../../tests/it/page.rs"]
mod page;
mod work;

use fmu_export::{Experiment, Log, Model, Step, VariableId};
use rocking_floor::unit::Unit;
use rocking_floor::variables::{BooleanVariable, Coupling, Hysteresis, IntegerVariable, RealVariable};

/// A floor driven as an importer does, by the names of its variables.
struct Driven {
    unit: Unit,
    time: f64,
}

impl Driven {
    /// Initialised with these parameters and inputs.
    fn new(settings: &[(&str, f64)], hysteresis: Hysteresis, coupling: Coupling) -> Self {
        let mut driven = Self { unit: Unit::new().expect("the start values make a floor"), time: 0.0 };
        for &(name, value) in settings {
            driven.set(name, value);
        }
        driven.unit.set_integer(IntegerVariable::Hysteresis, hysteresis.value());
        driven.unit.set_integer(IntegerVariable::Coupling, coupling.value());
        driven.unit.setup_experiment(Experiment::default());
        driven.unit.initialize(&mut Log::silent()).expect("the settings make a floor");
        driven
    }

    fn linear(settings: &[(&str, f64)]) -> Self {
        Self::new(settings, Hysteresis::None, Coupling::Reactions)
    }

    fn set(&mut self, name: &str, value: f64) {
        self.unit.set_real(real(name), value);
    }

    fn rate(&mut self, name: &str, value: f64) {
        assert!(self.unit.set_input_derivative(real(name), value), "{name} takes a derivative");
    }

    fn get(&self, name: &str) -> f64 {
        self.unit.real(real(name))
    }

    fn yielding(&self) -> bool {
        self.unit.boolean(BooleanVariable::Yielding)
    }

    fn step(&mut self, duration: f64) {
        self.unit
            .do_step(Step { from: self.time, duration, may_end_early: false }, &mut Log::silent())
            .expect("the step can be computed");
        self.time += duration;
    }
}

fn real(name: &str) -> RealVariable {
    RealVariable::from_name(name).unwrap_or_else(|| panic!("{name} is a variable"))
}

#[track_caller]
fn assert_close(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance, "{found} is not {wanted} within {tolerance}");
}
