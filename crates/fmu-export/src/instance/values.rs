//! Getting and setting values and derivatives.

use super::Instance;
use crate::access;
use crate::call::{Call, Phase};
use crate::failure::Failure;
use crate::limits;
use crate::model::Model;
use crate::variable::{Causality, Kind, Variability, Variable, VariableId};
use std::ffi::{CStr, CString};

/// Values.
impl<M: Model> Instance<M> {
    pub(crate) fn get_real(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), Failure> {
        self.calculate()?;
        for (&reference, value) in references.iter().zip(values) {
            *value = self.number(reference)?.ok_or_else(|| access::unknown::<M>(reference))?;
        }
        Ok(())
    }

    /// The value of a Real variable, or of a Boolean as 0 or 1: some importers read all outputs as Reals.
    /// None if the reference is of neither.
    pub(super) fn number(&mut self, reference: u32) -> Result<Option<f64>, Failure> {
        if let Some(id) = M::Real::from_reference(reference) {
            return limits::finite(id.variable(), self.now.model.real(id)).map(Some);
        }
        let Some(id) = M::Boolean::from_reference(reference) else { return Ok(None) };
        self.warn_of_boolean(id.variable());
        Ok(Some(f64::from(self.now.model.boolean(id))))
    }

    /// Warns of the first Boolean that is read as a Real.
    fn warn_of_boolean(&mut self, variable: &Variable) {
        let mut log = self.logger.log();
        if self.has_warned_of_boolean || !log.wants_warnings() {
            return;
        }
        self.has_warned_of_boolean = true;
        let [real, boolean] = [Call::GetReal, Call::GetBoolean].map(|call| call.name(self.purpose.version));
        log.warning(format_args!(
            "{real}: {} is a Boolean, read as 0 or 1; its own getter is {boolean}",
            variable.name
        ));
    }

    /// Values of those Integer and Enumeration variables that the function `serves`.
    pub fn get_integer<T: From<i32>>(
        &mut self,
        references: &[u32],
        values: &mut [T],
        serves: fn(&Kind) -> bool,
    ) -> Result<(), Failure> {
        self.calculate()?;
        for (&reference, value) in references.iter().zip(values) {
            let id = Self::find_served(reference, serves)?;
            *value = self.now.model.integer(id).into();
        }
        Ok(())
    }

    /// Writes the values of Boolean variables.
    pub fn get_boolean<T: From<bool>>(
        &mut self,
        references: &[u32],
        values: &mut [T],
    ) -> Result<(), Failure> {
        self.calculate()?;
        for (&reference, value) in references.iter().zip(values) {
            *value = self.now.model.boolean(access::find::<M, _>(reference)?).into();
        }
        Ok(())
    }

    /// The texts, which live until the next call of this.
    pub fn get_string(&mut self, references: &[u32]) -> Result<impl Iterator<Item = &CStr>, Failure> {
        self.calculate()?;
        self.texts.clear();
        for &reference in references {
            let text = self.now.model.text(access::find::<M, _>(reference)?);
            self.texts.push(c_string(text));
        }
        Ok(self.texts.iter().map(CString::as_c_str))
    }

    /// Sets Real variables.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Result<(), Failure> {
        let phase = self.now.phase;
        if phase == Phase::IntermediateUpdateMode {
            return self.set_at_end(references, values);
        }
        for (&reference, &value) in references.iter().zip(values) {
            if self.has_number(reference, value) {
                continue;
            }
            let id: M::Real = access::find::<M, _>(reference)?;
            let variable = id.variable();
            if phase.is_before_the_start() || !self.purpose.states.contains(&id) {
                self.check_settable(variable, |model| model.real(id) == value)?;
            }
            limits::check_real(variable, value)?;
        }
        self.set(references, values, |model, variable, &value| model.set_real(variable, value));
        Ok(())
    }

    /// Returns whether a parameter or input of another type than Real has the value `number`: some importers
    /// set all of them as Reals, and none to another value.
    fn has_number(&self, reference: u32, number: f64) -> bool {
        let model = &self.now.model;
        let integer =
            M::Integer::from_reference(reference).map(|id| (id.variable(), model.integer(id).into()));
        let boolean = || {
            let id = M::Boolean::from_reference(reference)?;
            Some((id.variable(), f64::from(model.boolean(id))))
        };
        integer.or_else(boolean).is_some_and(|(variable, value): (_, f64)| {
            matches!(variable.causality, Causality::Input | Causality::Parameter) && value == number
        })
    }

    /// Sets those Integer and Enumeration variables that the function `serves`.
    pub fn set_integer<T: Into<i64> + Copy>(
        &mut self,
        references: &[u32],
        values: &[T],
        serves: fn(&Kind) -> bool,
    ) -> Result<(), Failure> {
        for (&reference, &value) in references.iter().zip(values) {
            let id = Self::find_served(reference, serves)?;
            self.check_settable(id.variable(), |model| i64::from(model.integer(id)) == value.into())?;
            limits::check_integer(id.variable(), value.into())?;
        }
        self.set(references, values, |model, variable, &value| {
            if let Ok(value) = i32::try_from(value.into()) {
                model.set_integer(variable, value);
            }
        });
        Ok(())
    }

    /// 0 is false, anything else true.
    pub fn set_boolean<T: From<bool> + PartialEq>(
        &mut self,
        references: &[u32],
        values: &[T],
    ) -> Result<(), Failure> {
        for (&reference, value) in references.iter().zip(values) {
            let id: M::Boolean = access::find::<M, _>(reference)?;
            self.check_settable(id.variable(), |model| model.boolean(id) == (*value != false.into()))?;
        }
        self.set(references, values, |model, id, value| model.set_boolean(id, *value != false.into()));
        Ok(())
    }

    /// Sets String variables.
    pub fn set_string(&mut self, references: &[u32], values: &[&str]) -> Result<(), Failure> {
        for (&reference, value) in references.iter().zip(values) {
            let id: M::Text = access::find::<M, _>(reference)?;
            self.check_settable(id.variable(), |model| model.text(id) == *value)?;
        }
        self.set(references, values, |model, variable, value| model.set_text(variable, value));
        Ok(())
    }

    /// Returns the Integer or Enumeration with this value reference, if it is of a kind that is served.
    fn find_served(reference: u32, serves: fn(&Kind) -> bool) -> Result<M::Integer, Failure> {
        let found: M::Integer = access::find::<M, _>(reference)?;
        if serves(&found.variable().kind) { Ok(found) } else { Err(access::unknown::<M>(reference)) }
    }

    /// Checks that `variable` may be set now. An input or a parameter may always be set to the value that it
    /// already has (`is_same`), because some importers set all of them before each step.
    fn check_settable(&self, variable: &Variable, is_same: impl Fn(&M) -> bool) -> Result<(), Failure> {
        let phase = self.now.phase;
        if access::is_settable(variable, phase, self.purpose.event_mode)
            || (self.keeps_its_value(variable) && is_same(&self.now.model))
        {
            return Ok(());
        }
        Err(access::not_settable(variable, &phase.describe(self.purpose.version)))
    }

    /// Returns whether `variable` is an input or a parameter that may not change now.
    fn keeps_its_value(&self, variable: &Variable) -> bool {
        matches!(variable.causality, Causality::Input | Causality::Parameter)
            && variable.variability != Variability::Constant
            && !access::is_settable(variable, self.now.phase, self.purpose.event_mode)
    }

    /// Sets values after all of them have been checked. If one is refused, none is set. A variable that may
    /// not change now keeps the value that it has.
    fn set<V: VariableId, T>(&mut self, references: &[u32], values: &[T], set: impl Fn(&mut M, V, &T)) {
        for (&reference, value) in references.iter().zip(values) {
            // none for a variable of another type, which has this value
            let id = V::from_reference(reference).filter(|id| !self.keeps_its_value(id.variable()));
            if let Some(id) = id {
                set(&mut self.now.model, id, value);
            }
        }
        // After initialisation `calculate` is not called: a model applies a tunable parameter in `set_*`.
        self.now.stale |= self.now.phase.is_before_the_start();
    }
}

/// Derivatives.
impl<M: Model> Instance<M> {
    /// Sets the first derivatives of inputs.
    pub fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), Failure> {
        for ((&reference, &order), &value) in references.iter().zip(orders).zip(values) {
            let variable = access::find::<M, M::Real>(reference)?.variable();
            access::check_derivable_input(variable)?;
            access::check_order(variable, order)?;
            finite_slope(variable, value)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            let variable: M::Real = access::find::<M, _>(reference)?;
            if !self.now.model.set_input_derivative(variable, value) {
                return Err(Failure(format!("{} takes no derivative", variable.variable().name)));
            }
        }
        Ok(())
    }

    /// Writes the first derivatives of outputs.
    pub fn output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Result<(), Failure> {
        for ((&reference, &order), value) in references.iter().zip(orders).zip(values) {
            let variable: M::Real = access::find::<M, _>(reference)?;
            access::check_order(variable.variable(), order)?;
            let found = self.now.model.output_derivative(variable);
            let variable = variable.variable();
            let found = found.ok_or_else(|| Failure(format!("{} has no derivative", variable.name)))?;
            *value = finite_slope(variable, found)?;
        }
        Ok(())
    }

    /// Σ ∂unknown/∂known · seed over the knowns, for each unknown: the `seeded` are the knowns, and the
    /// unknowns are `wanted`. If `adjoint`, the seeded are the unknowns. Those with seed 0 are not looked at,
    /// so that importers may list parameters among them.
    pub fn derivatives_along(
        &mut self,
        [seeded, wanted]: [&[u32]; 2],
        seeds: &[f64],
        values: &mut [f64],
        adjoint: bool,
    ) -> Result<(), Failure> {
        self.calculate()?;
        for (&wanted, value) in wanted.iter().zip(values) {
            let wanted: M::Real = access::find::<M, _>(wanted)?;
            let mut sum = 0.0;
            for (&seeded, &seed) in seeded.iter().zip(seeds).filter(|&(_, &seed)| seed != 0.0) {
                let seeded: M::Real = access::find::<M, _>(seeded)?;
                if !seed.is_finite() {
                    let name = seeded.variable().name;
                    return Err(Failure(format!("the seed {seed:?} of {name} is not a finite number")));
                }
                let (unknown, known) = if adjoint { (seeded, wanted) } else { (wanted, seeded) };
                let partial = self.now.model.directional_derivative(unknown, known).ok_or_else(|| {
                    let (unknown, known) = (unknown.variable().name, known.variable().name);
                    Failure(format!("there is no derivative of {unknown} by {known}"))
                })?;
                sum += partial * seed;
            }
            *value = finite_slope(wanted.variable(), sum)?;
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
