//! A model of [`fmu_export`] as a WebAssembly component, after Modelica's draft of the layered standard
//! fmi-ls-wasm.
//!
//! The folder `wit` of this crate has the draft's interfaces, WIT package `fmi:fmi3@3.0.0`, unchanged. One
//! component serves Co-Simulation and Model Exchange. [`export_component!`] gives it its exports.
//!
//! - Hosts of Model Exchange do not provide the draft's `intermediate-update`, and not every runtime enters a
//!   component that calls out, as would be necessary to set inputs there: it is not imported. Continuous
//!   inputs change inside a step by the draft's `set-input-derivatives`, as in FMI 2.0.
//! - Saved states are bytes at once, those of `fmi3SerializeFMUState`: a state goes from a library to a
//!   component and back.
//! - A panic cannot be caught. It is logged as a fatal error, then the component traps.
//!
//! ```
//! // the version of FMI, as the component answers
//! use fmu_component::bindings::exports::fmi::fmi3::common::Guest;
//! # use fmu_component::Component;
//! # fn check<M: fmu_export::ModelExchange>() { assert_eq!(Component::<M>::get_version(), "3.0"); }
//! ```

mod co_simulation;
mod methods;
mod model_exchange;
mod resource;

use fmu_export::ModelExchange;
use std::marker::PhantomData;

pub use co_simulation::CoSimulation;
pub use model_exchange::Exchange;

/// The traits and types of the draft, by wit-bindgen.
#[allow(missing_docs, unreachable_pub, unsafe_code, clippy::all, clippy::pedantic, reason = "generated")]
pub mod bindings {
    wit_bindgen::generate!({
        path: "wit",
        inline: "
            package model:unit;
            world unit {
                include fmi:fmi3/co-simulation-fmu@3.0.0;
                include fmi:fmi3/model-exchange-fmu@3.0.0;
            }
        ",
        world: "model:unit/unit",
        generate_all,
        pub_export_macro: true,
        export_macro_name: "__export_component",
        default_bindings_module: "fmu_component::bindings",
    });
}

/// What the component of the model `M` exports.
#[derive(Debug)]
pub struct Component<M>(PhantomData<M>);

impl<M: ModelExchange> bindings::exports::fmi::fmi3::common::Guest for Component<M> {
    fn get_version() -> String {
        "3.0".to_owned()
    }
}

/// Makes the model `$model`, a [`ModelExchange`], a WebAssembly component of FMI 3.0
/// for Co-Simulation and Model Exchange.
///
/// It belongs into a `cdylib` for the target `wasm32-wasip2`, once, instead of the C functions:
///
/// ```text
/// #[cfg(target_family = "wasm")]
/// fmu_component::export_component!(spring::Spring);
/// ```
#[macro_export]
macro_rules! export_component {
    ($model:ty) => {
        #[doc(hidden)]
        type ExportedComponent = $crate::Component<$model>;
        $crate::bindings::__export_component! {
            ExportedComponent with_types_in $crate::bindings
        }
    };
}
