//! A step allocates nothing: rocking through corners and impacts, at rest, overturning, with any solver.

#![allow(unsafe_code, reason = "a counting allocator")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use fmi2_export::{Environment, Log, Model, Step};
use rocking_wall::unit::Unit;
use rocking_wall::variables::{
    DampingModel, ForceLaw, Impact, IntegerVariable, Mechanism, RealVariable, Solver,
};

struct Counting;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: passes every call on to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's promises are passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Choices of a wall.
type Choices = [(IntegerVariable, i32)];

fn unit(choices: &Choices) -> Unit {
    let environment = Environment { instance_name: "wall", resources: None, payload: None };
    let mut unit = Unit::instantiate(environment, &mut Log::silent()).unwrap();
    for &(variable, value) in choices {
        unit.set_integer(variable, value);
    }
    unit.initialize(&mut Log::silent()).unwrap();
    unit
}

#[test]
fn a_step_allocates_nothing() {
    use IntegerVariable as V;
    let rigid = [
        (V::ForceLaw, ForceLaw::RigidLinear.value()),
        (V::DampingModel, DampingModel::None.value()),
        (V::Impact, Impact::Restitution.value()),
    ];
    let cases: [(&str, &Choices); 6] = [
        ("constant ratio", &[]),
        ("exact", &[(V::DampingModel, DampingModel::ConstantCoefficient.value())]),
        ("stiffness proportional", &[(V::DampingModel, DampingModel::StiffnessProportional.value())]),
        ("newmark", &[(V::Solver, Solver::Newmark.value())]),
        ("rigid with restitution", &rigid),
        ("vertical spanning", &[(V::Mechanism, Mechanism::VerticalSpanning.value())]),
    ];
    for (name, choices) in cases {
        let mut unit = unit(choices);
        let before = COUNT.with(Cell::get);
        for index in 0..4000_u32 {
            let time = 0.005 * f64::from(index);
            for input in [RealVariable::ABottom, RealVariable::ATop] {
                unit.set_real(input, 3.0 * (9.0 * time).sin());
                unit.set_input_derivative(input, 27.0 * (9.0 * time).cos());
            }
            unit.set_real(RealVariable::Drift, 1e-3 * (2.0 * time).sin());
            unit.do_step(Step { from: time, duration: 0.005 }, &mut Log::silent()).unwrap();
        }
        let allocations = COUNT.with(Cell::get) - before;
        assert!((unit.real(RealVariable::U) - 0.18).abs() > 1e-3, "{name}: the wall has moved");
        assert_eq!(allocations, 0, "{name}: 4000 steps allocated {allocations} times");
    }
}
