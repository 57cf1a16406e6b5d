//! `model-exchange` (FMI 3.0.2, section 3.2).

use crate::Component;
use crate::bindings::exports::fmi::fmi3::model_exchange::{
    CompletedStepResult, DiscreteStatesInfo, Guest, GuestModelExchangeInstance, IntervalFraction,
    IntervalQualifier, ModelExchangeInstance, Status, VariableDependency,
};
use crate::methods::common_methods;
use crate::resource::Resource;
use fmu_export::boundary::{Call, Instance, Phase, Purpose};
use fmu_export::{Interface, ModelExchange};

impl<M: ModelExchange> Guest for Component<M> {
    type ModelExchangeInstance = Exchange<M>;
}

/// An instance for Model Exchange.
pub struct Exchange<M: ModelExchange>(Resource<M>);

impl<M: ModelExchange> GuestModelExchangeInstance for Exchange<M> {
    common_methods!();

    fn instantiate_model_exchange(
        name: String,
        token: String,
        resources: String,
        _visible: bool,
        logging_on: bool,
    ) -> Option<ModelExchangeInstance> {
        let purpose = Purpose::fmi3(Interface::ModelExchange, M::STATES);
        let texts = [name, token, resources];
        Resource::<M>::new("instantiate-model-exchange", texts, logging_on, purpose, None)
            .map(|resource| ModelExchangeInstance::new(Self(resource)))
    }

    fn enter_continuous_time_mode(&self) -> Status {
        self.0.run(Call::EnterContinuousTimeMode, |instance| instance.enter(Phase::ContinuousTimeMode))
    }

    fn set_time(&self, time: f64) -> Status {
        self.0.run(Call::SetTime, |instance| instance.set_time(time))
    }

    fn set_continuous_states(&self, states: Vec<f64>) -> Status {
        self.0.run(Call::SetContinuousStates, |instance| instance.set_states(&states))
    }

    fn get_continuous_state_derivatives(&self) -> Result<Vec<f64>, Status> {
        self.0.values(Call::GetDerivatives, M::STATES.len(), Instance::derivatives)
    }

    fn get_event_indicators(&self) -> Result<Vec<f64>, Status> {
        let count = M::EVENT_INDICATORS;
        self.0.values(Call::GetEventIndicators, count, Instance::event_indicators)
    }

    fn get_continuous_states(&self) -> Result<Vec<f64>, Status> {
        self.0.values(Call::GetContinuousStates, M::STATES.len(), Instance::states)
    }

    fn get_nominals_of_continuous_states(&self) -> Result<Vec<f64>, Status> {
        let call = Call::GetNominalsOfContinuousStates;
        self.0.values(call, M::STATES.len(), Instance::nominals)
    }

    fn get_number_of_event_indicators(&self) -> Result<u64, Status> {
        self.0.ask(Call::GetNumberOfEventIndicators, |_| Ok(M::EVENT_INDICATORS as u64))
    }

    fn get_number_of_continuous_states(&self) -> Result<u64, Status> {
        self.0.ask(Call::GetNumberOfContinuousStates, |_| Ok(M::STATES.len() as u64))
    }

    fn completed_integrator_step(&self, _no_set: bool) -> Result<CompletedStepResult, Status> {
        self.0.ask(Call::CompletedIntegratorStep, |instance| {
            Ok(CompletedStepResult {
                enter_event_mode: instance.complete_step()?,
                terminate_simulation: false,
            })
        })
    }
}
