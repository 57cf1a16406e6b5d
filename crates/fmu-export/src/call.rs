//! The call order of FMI 2.0 as a table: Model Exchange (FMI 2.0.5, section 3.2.3) and co-simulation (section
//! 4.2.4).

use crate::model::Interface;
use std::fmt;

/// Where an instance is in its life.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Phase {
    Instantiated,
    InitializationMode,
    StepMode,
    Terminated,
    /// A call returned `fmi2Error`.
    Error,
    /// The instance could not even be reset.
    Fatal,
    /// Of Model Exchange.
    EventMode,
    /// Of Model Exchange.
    ContinuousTimeMode,
}

impl Phase {
    /// The number that stands for it in a saved state.
    pub(crate) const fn number(self) -> u64 {
        self as u64
    }

    /// The phase of a saved state. A lost instance saves none.
    pub(crate) fn from_number(number: u64) -> Option<Self> {
        let saved = [
            Self::Instantiated,
            Self::InitializationMode,
            Self::StepMode,
            Self::Terminated,
            Self::Error,
            Self::EventMode,
            Self::ContinuousTimeMode,
        ];
        saved.into_iter().find(|phase| phase.number() == number)
    }

    /// Whether an instance of `interface` can be there.
    pub(crate) const fn belongs_to(self, interface: Interface) -> bool {
        match self {
            Self::StepMode => matches!(interface, Interface::CoSimulation),
            Self::EventMode | Self::ContinuousTimeMode => matches!(interface, Interface::ModelExchange),
            _ => true,
        }
    }

    /// Whether parameters may still change, and values follow from them.
    pub(crate) const fn is_before_the_start(self) -> bool {
        matches!(self, Self::Instantiated | Self::InitializationMode)
    }

    const fn bit(self) -> u8 {
        1 << self as u8
    }
}

impl fmt::Display for Phase {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Instantiated => "before fmi2EnterInitializationMode",
            Self::InitializationMode => "in Initialization Mode",
            Self::StepMode => "in step mode",
            Self::Terminated => "after fmi2Terminate",
            Self::Error => "after an error: reset it, restore a state or free it",
            Self::Fatal => "after a fatal error: free it",
            Self::EventMode => "in Event Mode",
            Self::ContinuousTimeMode => "in Continuous-Time Mode",
        })
    }
}

const NEVER: u8 = 0;
const INST: u8 = Phase::Instantiated.bit();
const INIT: u8 = Phase::InitializationMode.bit();
const STEP: u8 = Phase::StepMode.bit();
const TERM: u8 = Phase::Terminated.bit();
const ERR: u8 = Phase::Error.bit();
const EVENT: u8 = Phase::EventMode.bit();
const TIME: u8 = Phase::ContinuousTimeMode.bit();
/// After the end, or an error: values can still be read.
const END: u8 = TERM | ERR;
/// Between initialisation and end, in either kind.
const RUN: u8 = STEP | EVENT | TIME;
/// All but a lost instance.
const ALIVE: u8 = INST | INIT | RUN | END;

/// Declares the calls, each with the name of its C function and the phases in which it is allowed.
macro_rules! calls {
    ($($(#[$doc:meta])* $call:ident $name:literal $allowed:expr;)*) => {
        /// The functions that the call order is about: first those of both kinds, then of co-simulation,
        /// then of Model Exchange.
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub(crate) enum Call { $($(#[$doc])* $call),* }

        /// Name and phases of each call, in their order.
        const TABLE: &[(&str, u8)] = &[$(($name, $allowed)),*];
    };
}

calls! {
    SetDebugLogging                "fmi2SetDebugLogging"                ALIVE;
    SetupExperiment                "fmi2SetupExperiment"                INST;
    EnterInitializationMode        "fmi2EnterInitializationMode"        INST;
    ExitInitializationMode         "fmi2ExitInitializationMode"         INIT;
    Terminate                      "fmi2Terminate"                      RUN;
    Reset                          "fmi2Reset"                          ALIVE;
    GetReal                        "fmi2GetReal"                        INIT | RUN | END;
    GetInteger                     "fmi2GetInteger"                     INIT | RUN | END;
    GetBoolean                     "fmi2GetBoolean"                     INIT | RUN | END;
    GetString                      "fmi2GetString"                      INIT | RUN | END;
    SetReal                        "fmi2SetReal"                        INST | INIT | RUN;
    SetInteger                     "fmi2SetInteger"                     INST | INIT | STEP | EVENT;
    SetBoolean                     "fmi2SetBoolean"                     INST | INIT | STEP | EVENT;
    SetString                      "fmi2SetString"                      INST | INIT | STEP | EVENT;
    GetFmuState                    "fmi2GetFMUstate"                    ALIVE;
    SetFmuState                    "fmi2SetFMUstate"                    ALIVE;
    FreeFmuState                   "fmi2FreeFMUstate"                   ALIVE;
    SerializedFmuStateSize         "fmi2SerializedFMUstateSize"         ALIVE;
    SerializeFmuState              "fmi2SerializeFMUstate"              ALIVE;
    DeSerializeFmuState            "fmi2DeSerializeFMUstate"            ALIVE;
    GetDirectionalDerivative       "fmi2GetDirectionalDerivative"       INIT | RUN | END;
    SetRealInputDerivatives        "fmi2SetRealInputDerivatives"        INIT | STEP;
    GetRealOutputDerivatives       "fmi2GetRealOutputDerivatives"       STEP | END;
    DoStep                         "fmi2DoStep"                         STEP;
    /// Steps are computed while the importer waits: there is never one to cancel.
    CancelStep                     "fmi2CancelStep"                     NEVER;
    GetStatus                      "fmi2GetStatus"                      STEP | END;
    GetRealStatus                  "fmi2GetRealStatus"                  STEP | END;
    GetIntegerStatus               "fmi2GetIntegerStatus"               STEP | END;
    GetBooleanStatus               "fmi2GetBooleanStatus"               STEP | END;
    GetStringStatus                "fmi2GetStringStatus"                STEP | END;
    EnterEventMode                 "fmi2EnterEventMode"                 EVENT | TIME;
    NewDiscreteStates              "fmi2NewDiscreteStates"              EVENT;
    EnterContinuousTimeMode        "fmi2EnterContinuousTimeMode"        EVENT;
    CompletedIntegratorStep        "fmi2CompletedIntegratorStep"        TIME;
    SetTime                        "fmi2SetTime"                        EVENT | TIME;
    SetContinuousStates            "fmi2SetContinuousStates"            TIME;
    GetDerivatives                 "fmi2GetDerivatives"                 EVENT | TIME | END;
    GetEventIndicators             "fmi2GetEventIndicators"             INIT | EVENT | TIME | END;
    GetContinuousStates            "fmi2GetContinuousStates"            INIT | EVENT | TIME | END;
    GetNominalsOfContinuousStates  "fmi2GetNominalsOfContinuousStates"  INST | EVENT | TIME | END;
}

impl Call {
    /// The name of the C function.
    pub(crate) const fn name(self) -> &'static str {
        TABLE[self as usize].0
    }

    pub(crate) const fn is_allowed(self, phase: Phase) -> bool {
        TABLE[self as usize].1 & phase.bit() != 0
    }

    /// The one kind of instance that this call is for; none if it is for both.
    pub(crate) const fn only_for(self) -> Option<Interface> {
        match self as usize {
            call if call >= Self::EnterEventMode as usize => Some(Interface::ModelExchange),
            call if call >= Self::SetRealInputDerivatives as usize => Some(Interface::CoSimulation),
            _ => None,
        }
    }

    /// Whether a failure of this call ends the simulation.
    ///
    /// A state that is refused does not: nothing of the instance took part in it.
    pub(crate) const fn failure_is_final(self) -> bool {
        !matches!(
            self,
            Self::GetFmuState
                | Self::SetFmuState
                | Self::FreeFmuState
                | Self::SerializedFmuStateSize
                | Self::SerializeFmuState
                | Self::DeSerializeFmuState
        )
    }
}
