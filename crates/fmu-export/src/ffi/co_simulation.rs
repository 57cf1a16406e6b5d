//! The functions of co-simulation alone, in FMI 2.0.5 (section 4.2).

use super::arguments::{array, place, to_get, to_set};
use super::guard::{self, functions};
use super::types::{
    Boolean, Component, DISCARD, DO_STEP_STATUS, Integer, LAST_SUCCESSFUL_TIME, OK, Real, Status, StatusKind,
    TERMINATED, Text, ValueReference, status,
};
use crate::call::Call;
use crate::instance::Instance;
use crate::model::Model;

functions! {
    /// `fmi2SetRealInputDerivatives`
    ///
    /// Sets the derivatives of order 1 of continuous inputs for the next step. If the description does not
    /// allow one of them, none is set.
    set_real_input_derivatives<Model>(
        references: *const ValueReference, count: usize, orders: *const Integer, values: *const Real
    ): SetRealInputDerivatives, |instance| {
        // SAFETY: `references`, `orders` and `values` are NULL or point to `count` elements that stay as
        // they are during the call.
        let (orders, (references, values)) =
            unsafe { (array("order", orders, count)?, to_set(references, values, count)?) };
        instance.set_input_derivatives(references, orders, values)
    };
    /// `fmi2GetRealOutputDerivatives`
    get_real_output_derivatives<Model>(
        references: *const ValueReference, count: usize, orders: *const Integer, values: *mut Real
    ): GetRealOutputDerivatives, |instance| {
        // SAFETY: `references`, `orders` and `values` are NULL or point to `count` elements that nobody else
        // changes during the call.
        let (orders, (references, values)) =
            unsafe { (array("order", orders, count)?, to_get(references, values, count, 0.0)?) };
        instance.output_derivatives(references, orders, values)
    };
    /// `fmi2DoStep`
    ///
    /// Never returns `fmi2Discard`: some importers would try again for ever. A step of length 0 does nothing.
    do_step<Model>(
        communication_point: Real, step_size: Real, _no_set_fmu_state_prior_to_current_point: Boolean
    ): DoStep, |instance| instance.do_step(communication_point, step_size).map(drop);
    /// `fmi2CancelStep`
    ///
    /// Always an error: no step is asynchronous.
    cancel_step<Model>(): CancelStep, |_| Ok(());
}

macro_rules! status_functions {
    ($($type:ty: $c_name:literal $name:ident $call:ident, $found:expr;)*) => { $(
        #[doc = concat!("`", $c_name, "`")]
        ///
        /// Returns `fmi2Discard`, after a log, for a kind of status that does not have this type, as FMI
        /// 2.0.5, section 4.2.3, asks.
        ///
        /// # Safety
        /// `component` is NULL or an instance; `value` is NULL or points to room for one value.
        pub unsafe fn $name<M: Model>(component: Component, kind: StatusKind, value: *mut $type) -> Status {
            let mut discarded = false;
            // SAFETY: `component` is NULL or an instance of this model that the importer has not freed.
            let instance = unsafe { guard::instance::<M>(component) };
            let status = guard::run(instance, Call::$call, |instance| {
                // SAFETY: `value` is NULL or points to room for one value that nobody else uses during the
                // call.
                let value = unsafe { place("value", value) }?;
                let found: fn(&Instance<M>, StatusKind) -> Option<$type> = $found;
                if let Some(found) = found(instance, kind) {
                    value.write(found);
                } else {
                    discarded = true;
                    instance.no_status(Call::$call, kind);
                }
                Ok(())
            });
            if discarded && status == OK { DISCARD } else { status }
        }
    )* };
}

status_functions! {
    Status: "fmi2GetStatus" get_status GetStatus, |instance, kind| {
        (kind == DO_STEP_STATUS).then(|| status(instance.last_step))
    };
    Real: "fmi2GetRealStatus" get_real_status GetRealStatus, |instance, kind| {
        (kind == LAST_SUCCESSFUL_TIME).then(|| instance.time())
    };
    Integer: "fmi2GetIntegerStatus" get_integer_status GetIntegerStatus, |_, _| None;
    // The model never ends the simulation by itself.
    Boolean: "fmi2GetBooleanStatus" get_boolean_status GetBooleanStatus, |_, kind| {
        (kind == TERMINATED).then_some(0)
    };
    Text: "fmi2GetStringStatus" get_string_status GetStringStatus, |_, _| None;
}
