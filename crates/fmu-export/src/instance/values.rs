//! Getting and setting values and derivatives.

use super::Instance;
use crate::access;
use crate::failure::Failure;
use crate::limits;
use crate::model::Model;
use crate::variable::{Variable, VariableId};
use std::ffi::{CStr, CString};
use std::mem::MaybeUninit;

/// Values.
impl<M: Model> Instance<M> {
    pub(crate) fn get_real(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<f64>],
    ) -> Result<(), Failure> {
        self.get(references, values, |model, id: M::Real| limits::finite(id.variable(), model.real(id)))
    }

    pub(crate) fn get_integer(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<i32>],
    ) -> Result<(), Failure> {
        self.get(references, values, |model, id| Ok(model.integer(id)))
    }

    pub(crate) fn get_boolean(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<i32>],
    ) -> Result<(), Failure> {
        self.get(references, values, |model, id| Ok(i32::from(model.boolean(id))))
    }

    /// The texts, which live until the next call of this.
    pub(crate) fn get_string(&mut self, references: &[u32]) -> Result<impl Iterator<Item = &CStr>, Failure> {
        self.calculate()?;
        self.texts.clear();
        for &reference in references {
            let text = self.now.model.text(access::find::<M::Text>(reference)?);
            self.texts.push(c_string(text));
        }
        Ok(self.texts.iter().map(CString::as_c_str))
    }

    fn get<V: VariableId, T>(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<T>],
        value: impl Fn(&M, V) -> Result<T, Failure>,
    ) -> Result<(), Failure> {
        self.calculate()?;
        for (&reference, slot) in references.iter().zip(values) {
            slot.write(value(&self.now.model, access::find(reference)?)?);
        }
        Ok(())
    }

    pub(crate) fn set_real(&mut self, references: &[u32], values: &[f64]) -> Result<(), Failure> {
        let phase = self.now.phase;
        for (&reference, &value) in references.iter().zip(values) {
            let id = access::find::<M::Real>(reference)?;
            let variable = id.variable();
            if phase.is_before_the_start() || !self.states.contains(&id) {
                access::check_settable(variable, phase)?;
            }
            limits::check_real(variable, value)?;
        }
        self.set(references, values, |model, variable, &value| model.set_real(variable, value))
    }

    pub(crate) fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Result<(), Failure> {
        let phase = self.now.phase;
        for (&reference, &value) in references.iter().zip(values) {
            let variable = access::find::<M::Integer>(reference)?.variable();
            access::check_settable(variable, phase)?;
            limits::check_integer(variable, value)?;
        }
        self.set(references, values, |model, variable, &value| model.set_integer(variable, value))
    }

    pub(crate) fn set_boolean(&mut self, references: &[u32], values: &[i32]) -> Result<(), Failure> {
        for &reference in references {
            access::check_settable(access::find::<M::Boolean>(reference)?.variable(), self.now.phase)?;
        }
        self.set(references, values, |model, variable, &value| model.set_boolean(variable, value != 0))
    }

    pub(crate) fn set_string(&mut self, references: &[u32], values: &[&str]) -> Result<(), Failure> {
        for &reference in references {
            access::check_settable(access::find::<M::Text>(reference)?.variable(), self.now.phase)?;
        }
        self.set(references, values, |model, variable, value| model.set_text(variable, value))
    }

    /// Sets what has been checked as a whole: a refused value leaves all as they were.
    fn set<V: VariableId, T>(
        &mut self,
        references: &[u32],
        values: &[T],
        set: impl Fn(&mut M, V, &T),
    ) -> Result<(), Failure> {
        for (&reference, value) in references.iter().zip(values) {
            set(&mut self.now.model, access::find(reference)?, value);
        }
        // Later only inputs and states are set, and no calculated value follows from them.
        self.now.stale |= self.now.phase.is_before_the_start();
        Ok(())
    }
}

/// Derivatives.
impl<M: Model> Instance<M> {
    pub(crate) fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), Failure> {
        for ((&reference, &order), &value) in references.iter().zip(orders).zip(values) {
            let variable = access::find::<M::Real>(reference)?.variable();
            access::check_derivable_input(variable)?;
            access::check_order(variable, order)?;
            finite_slope(variable, value)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            let variable = access::find::<M::Real>(reference)?;
            if !self.now.model.set_input_derivative(variable, value) {
                return Err(Failure(format!("{} takes no derivative", variable.variable().name)));
            }
        }
        Ok(())
    }

    pub(crate) fn output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [MaybeUninit<f64>],
    ) -> Result<(), Failure> {
        for ((&reference, &order), slot) in references.iter().zip(orders).zip(values) {
            let variable = access::find::<M::Real>(reference)?;
            access::check_order(variable.variable(), order)?;
            let found = self.now.model.output_derivative(variable);
            let variable = variable.variable();
            let found = found.ok_or_else(|| Failure(format!("{} has no derivative", variable.name)))?;
            slot.write(finite_slope(variable, found)?);
        }
        Ok(())
    }

    /// Σ ∂unknown/∂known · seed over the knowns, for each unknown. Knowns with seed 0 are not looked at, so
    /// that importers may list parameters among them.
    pub(crate) fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seeds: &[f64],
        values: &mut [MaybeUninit<f64>],
    ) -> Result<(), Failure> {
        self.calculate()?;
        for (&unknown, slot) in unknowns.iter().zip(values) {
            let unknown = access::find::<M::Real>(unknown)?;
            let mut sum = 0.0;
            for (&known, &seed) in knowns.iter().zip(seeds).filter(|&(_, &seed)| seed != 0.0) {
                let known = access::find::<M::Real>(known)?;
                if !seed.is_finite() {
                    return Err(Failure(format!(
                        "the seed {seed:?} of {} is not a finite number",
                        known.variable().name
                    )));
                }
                let partial = self.now.model.directional_derivative(unknown, known).ok_or_else(|| {
                    let (unknown, known) = (unknown.variable().name, known.variable().name);
                    Failure(format!("there is no derivative of {unknown} by {known}"))
                })?;
                sum += partial * seed;
            }
            slot.write(finite_slope(unknown.variable(), sum)?);
        }
        Ok(())
    }
}

fn finite_slope(variable: &Variable, value: f64) -> Result<f64, Failure> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(Failure(format!("the derivative {value:?} of {} is not a finite number", variable.name)))
}

/// `text` for C, which ends at the first NUL.
fn c_string(text: &str) -> CString {
    let end = text.find('\0').unwrap_or(text.len());
    CString::new(&text[..end]).unwrap_or_default()
}
