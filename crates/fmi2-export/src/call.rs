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

/// The functions that the call order is about: first those of both kinds, then of co-simulation, then of
/// Model Exchange.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Call {
    SetDebugLogging,
    SetupExperiment,
    EnterInitializationMode,
    ExitInitializationMode,
    Terminate,
    Reset,
    GetReal,
    GetInteger,
    GetBoolean,
    GetString,
    SetReal,
    SetInteger,
    SetBoolean,
    SetString,
    GetFmuState,
    SetFmuState,
    FreeFmuState,
    SerializedFmuStateSize,
    SerializeFmuState,
    DeSerializeFmuState,
    GetDirectionalDerivative,
    SetRealInputDerivatives,
    GetRealOutputDerivatives,
    DoStep,
    CancelStep,
    GetStatus,
    GetRealStatus,
    GetIntegerStatus,
    GetBooleanStatus,
    GetStringStatus,
    EnterEventMode,
    NewDiscreteStates,
    EnterContinuousTimeMode,
    CompletedIntegratorStep,
    SetTime,
    SetContinuousStates,
    GetDerivatives,
    GetEventIndicators,
    GetContinuousStates,
    GetNominalsOfContinuousStates,
}

struct Row {
    call: Call,
    name: &'static str,
    allowed: u8,
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

#[rustfmt::skip]
const TABLE: [Row; 40] = [
    row(Call::SetDebugLogging,               "fmi2SetDebugLogging",               ALIVE),
    row(Call::SetupExperiment,               "fmi2SetupExperiment",               INST),
    row(Call::EnterInitializationMode,       "fmi2EnterInitializationMode",       INST),
    row(Call::ExitInitializationMode,        "fmi2ExitInitializationMode",        INIT),
    row(Call::Terminate,                     "fmi2Terminate",                     RUN),
    row(Call::Reset,                         "fmi2Reset",                         ALIVE),
    row(Call::GetReal,                       "fmi2GetReal",                       INIT | RUN | END),
    row(Call::GetInteger,                    "fmi2GetInteger",                    INIT | RUN | END),
    row(Call::GetBoolean,                    "fmi2GetBoolean",                    INIT | RUN | END),
    row(Call::GetString,                     "fmi2GetString",                     INIT | RUN | END),
    row(Call::SetReal,                       "fmi2SetReal",                       INST | INIT | RUN),
    row(Call::SetInteger,                    "fmi2SetInteger",                    INST | INIT | STEP | EVENT),
    row(Call::SetBoolean,                    "fmi2SetBoolean",                    INST | INIT | STEP | EVENT),
    row(Call::SetString,                     "fmi2SetString",                     INST | INIT | STEP | EVENT),
    row(Call::GetFmuState,                   "fmi2GetFMUstate",                   ALIVE),
    row(Call::SetFmuState,                   "fmi2SetFMUstate",                   ALIVE),
    row(Call::FreeFmuState,                  "fmi2FreeFMUstate",                  ALIVE),
    row(Call::SerializedFmuStateSize,        "fmi2SerializedFMUstateSize",        ALIVE),
    row(Call::SerializeFmuState,             "fmi2SerializeFMUstate",             ALIVE),
    row(Call::DeSerializeFmuState,           "fmi2DeSerializeFMUstate",           ALIVE),
    row(Call::GetDirectionalDerivative,      "fmi2GetDirectionalDerivative",      INIT | RUN | END),
    row(Call::SetRealInputDerivatives,       "fmi2SetRealInputDerivatives",       INIT | STEP),
    row(Call::GetRealOutputDerivatives,      "fmi2GetRealOutputDerivatives",      STEP | END),
    row(Call::DoStep,                        "fmi2DoStep",                        STEP),
    // Steps are computed while the importer waits: there is never one to cancel.
    row(Call::CancelStep,                    "fmi2CancelStep",                    NEVER),
    row(Call::GetStatus,                     "fmi2GetStatus",                     STEP | END),
    row(Call::GetRealStatus,                 "fmi2GetRealStatus",                 STEP | END),
    row(Call::GetIntegerStatus,              "fmi2GetIntegerStatus",              STEP | END),
    row(Call::GetBooleanStatus,              "fmi2GetBooleanStatus",              STEP | END),
    row(Call::GetStringStatus,               "fmi2GetStringStatus",               STEP | END),
    row(Call::EnterEventMode,                "fmi2EnterEventMode",                EVENT | TIME),
    row(Call::NewDiscreteStates,             "fmi2NewDiscreteStates",             EVENT),
    row(Call::EnterContinuousTimeMode,       "fmi2EnterContinuousTimeMode",       EVENT),
    row(Call::CompletedIntegratorStep,       "fmi2CompletedIntegratorStep",       TIME),
    row(Call::SetTime,                       "fmi2SetTime",                       EVENT | TIME),
    row(Call::SetContinuousStates,           "fmi2SetContinuousStates",           TIME),
    row(Call::GetDerivatives,                "fmi2GetDerivatives",                EVENT | TIME | END),
    row(Call::GetEventIndicators,            "fmi2GetEventIndicators",            INIT | EVENT | TIME | END),
    row(Call::GetContinuousStates,           "fmi2GetContinuousStates",           INIT | EVENT | TIME | END),
    row(Call::GetNominalsOfContinuousStates, "fmi2GetNominalsOfContinuousStates", INST | EVENT | TIME | END),
];

const fn row(call: Call, name: &'static str, allowed: u8) -> Row {
    Row { call, name, allowed }
}

// The table is indexed by call, so its rows stand in the order of the enum.
const _: () = {
    let mut index = 0;
    while index < TABLE.len() {
        assert!(TABLE[index].call as usize == index);
        index += 1;
    }
};

impl Call {
    /// The name of the C function.
    pub(crate) const fn name(self) -> &'static str {
        TABLE[self as usize].name
    }

    pub(crate) const fn is_allowed(self, phase: Phase) -> bool {
        TABLE[self as usize].allowed & phase.bit() != 0
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
