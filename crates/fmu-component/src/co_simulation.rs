//! `co-simulation` (FMI 3.0.2, section 4.2).

use crate::Component;
use crate::bindings::exports::fmi::fmi3::co_simulation::{
    CoSimulationInstance, DiscreteStatesInfo, DoStepResult, Guest, GuestCoSimulationInstance,
    IntervalFraction, IntervalQualifier, Status, VariableDependency,
};
use crate::methods::common_methods;
use crate::resource::{Resource, references_and_orders};
use fmu_export::boundary::{Call, Phase, Purpose};
use fmu_export::{Interface, ModelExchange};

impl<M: ModelExchange> Guest for Component<M> {
    type CoSimulationInstance = CoSimulation<M>;
}

/// An instance for Co-Simulation.
pub struct CoSimulation<M: ModelExchange>(Resource<M>);

impl<M: ModelExchange> GuestCoSimulationInstance for CoSimulation<M> {
    common_methods!();

    fn instantiate_co_simulation(
        name: String,
        token: String,
        resources: String,
        _visible: bool,
        logging_on: bool,
        event_mode: bool,
        early_return: bool,
        intermediate_variables: Vec<u32>,
    ) -> Option<CoSimulationInstance> {
        let purpose = Purpose { event_mode, early_return, ..Purpose::fmi3(Interface::CoSimulation, &[]) };
        let warning = "required-intermediate-variables: a component cannot ask for inputs inside a step; use \
                       set-input-derivatives";
        let warning = (!intermediate_variables.is_empty()).then_some(warning);
        let texts = [name, token, resources];
        Resource::<M>::new("instantiate-co-simulation", texts, logging_on, purpose, warning)
            .map(|resource| CoSimulationInstance::new(Self(resource)))
    }

    fn set_input_derivatives(&self, requests: Vec<(u32, u32)>, values: Vec<f64>) -> Status {
        let (references, orders) = references_and_orders(&requests);
        self.0.set(Call::SetRealInputDerivatives, &references, &values, |instance| {
            instance.set_input_derivatives(&references, &orders, &values)
        })
    }

    fn do_step(&self, point: f64, size: f64, _no_set: bool) -> Result<DoStepResult, Status> {
        self.0.ask(Call::DoStep, |instance| {
            let early_return = instance.do_step(point, size)?;
            Ok(DoStepResult {
                last_successful_time: instance.time(),
                event_handling_needed: early_return && instance.purpose.event_mode,
                terminate_simulation: false,
                early_return,
            })
        })
    }
}
