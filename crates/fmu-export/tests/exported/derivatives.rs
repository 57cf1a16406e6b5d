//! Derivatives of inputs and outputs, and directional ones.

use crate::fmi2::*;
use crate::importer::Importer;
use crate::spring::{Integer, Real};
use fmu_export::ffi::types::{ERROR, OK, Status};

pub fn set_rate(importer: &Importer, reference: u32, order: i32, value: f64) -> Status {
    // SAFETY: the instance lives; one of each.
    unsafe { fmi2SetRealInputDerivatives(importer.component, &reference, 1, &order, &value) }
}

#[test]
fn an_input_derivative_holds_for_one_step_and_a_set_clears_it() {
    let importer = Importer::in_step_mode();
    assert_eq!(set_rate(&importer, Real::Force.reference(), 1, 2.0), OK);
    assert_eq!(importer.step(0.0, 0.5), OK);
    // Sums of eighths of 0.5: exact.
    assert_eq!(importer.get(Real::Force), 1.0);
    assert_eq!(importer.step(0.5, 0.5), OK);
    assert_eq!(importer.get(Real::Force), 1.0);
    assert_eq!(set_rate(&importer, Real::Force.reference(), 1, 2.0), OK);
    assert_eq!(importer.set(Real::Force, 3.0), OK);
    assert_eq!(importer.step(1.0, 0.5), OK);
    assert_eq!(importer.get(Real::Force), 3.0);
}

#[test]
fn other_input_derivatives_are_refused() {
    let force = Real::Force.reference();
    for (reference, order, value, part) in [
        (force, 0, 1.0, "order 0 of force"),
        (force, 2, 1.0, "order 2 of force"),
        (force, i32::MIN, 1.0, "only order 1"),
        (force, 1, f64::NAN, "derivative NaN of force"),
        (force, 1, f64::INFINITY, "derivative inf of force"),
        (Real::Push.reference(), 1, 1.0, "push takes no derivative"),
        (Real::Stiffness.reference(), 1, 1.0, "stiffness takes no derivative"),
        (Real::X.reference(), 1, 1.0, "x takes no derivative"),
        (Real::Bias.reference(), 1, 1.0, "bias takes no derivative"),
        (Integer::Fault.reference(), 1, 1.0, "reference 22"),
    ] {
        let importer = Importer::in_step_mode();
        assert_eq!(set_rate(&importer, reference, order, value), ERROR);
        importer.expect_error(&["fmi2SetRealInputDerivatives", part]);
    }
}

#[test]
fn outputs_have_derivatives_of_order_1() {
    let importer = Importer::swinging();
    let references = [Real::X.reference(), Real::V.reference()];
    let (c, mut rates) = (importer.component, [f64::NAN; 2]);
    // SAFETY: the instance lives; two of each.
    let status = unsafe {
        fmi2GetRealOutputDerivatives(c, references.as_ptr(), 2, [1, 1].as_ptr(), rates.as_mut_ptr())
    };
    assert_eq!((status, rates), (OK, [0.0, -4.0]));
    for (reference, order, part) in [
        (references[0], 2, "order 2 of x"),
        (Real::Energy.reference(), 1, "energy has no derivative"),
        (999, 1, "reference 999"),
    ] {
        let importer = Importer::swinging();
        // SAFETY: the instance lives; one of each.
        let status = unsafe {
            fmi2GetRealOutputDerivatives(importer.component, &reference, 1, &order, rates.as_mut_ptr())
        };
        assert_eq!(status, ERROR);
        importer.expect_error(&["fmi2GetRealOutputDerivatives", part]);
    }
}

fn directional(importer: &Importer, unknowns: &[u32], knowns: &[u32], seeds: &[f64]) -> Option<Vec<f64>> {
    let mut values = vec![f64::NAN; unknowns.len()];
    let (u, k) = (unknowns.as_ptr(), knowns.as_ptr());
    let (seeds, sums) = (seeds.as_ptr(), values.as_mut_ptr());
    // SAFETY: the instance lives; the arrays are as long as stated.
    let status = unsafe {
        fmi2GetDirectionalDerivative(importer.component, u, unknowns.len(), k, knowns.len(), seeds, sums)
    };
    (status == OK).then_some(values)
}

#[test]
fn directional_derivatives_are_summed_over_the_knowns() {
    let importer = Importer::in_step_mode();
    let [x, v, force] = [Real::X, Real::V, Real::Force].map(Real::reference);
    // ∂v/∂force = 1, ∂v/∂x = −4, ∂x/∂force = 0, ∂x/∂x = 3.
    assert_eq!(directional(&importer, &[v, x], &[force, x], &[2.0, 0.5]), Some(vec![0.0, 1.5]));
    assert_eq!(directional(&importer, &[v], &[x], &[-1.0]), Some(vec![4.0]));
    assert_eq!(directional(&importer, &[v], &[], &[]), Some(vec![0.0]));
    assert_eq!(directional(&importer, &[], &[x], &[1.0]), Some(vec![]));
    // some importers give all dependencies of an unknown, and 0 as the seed of those they do not mean
    let parameters = [Real::Stiffness.reference(), Integer::Law.reference()];
    let knowns = [parameters[0], force, parameters[1]];
    for importer in [&importer, &Importer::in_initialization_mode()] {
        assert_eq!(directional(importer, &[v], &knowns, &[0.0, 2.0, -0.0]), Some(vec![2.0]));
    }
    for (unknown, known, seed, part) in [
        (x, v, 1.0, "derivative of x by v"),
        (999, x, 1.0, "reference 999"),
        (x, 998, 1.0, "reference 998"),
        (x, x, f64::NAN, "seed NaN of x"),
    ] {
        let importer = Importer::in_step_mode();
        assert_eq!(directional(&importer, &[unknown], &[known], &[seed]), None);
        importer.expect_error(&["fmi2GetDirectionalDerivative", part]);
    }
}
