//! The call order as a table, for both versions of FMI: FMI 2.0.5, sections 3.2.3 (Model Exchange) and 4.2.4
//! (co-simulation); FMI 3.0.2, sections 2.3, 3.2 and 4.2.

use crate::model::Interface;
use std::fmt;

/// The version of FMI that an importer speaks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Version {
    Fmi2,
    Fmi3,
}

impl fmt::Display for Version {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Fmi2 => "fmi2",
            Self::Fmi3 => "fmi3",
        })
    }
}

/// Where an instance is in its life.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Phase {
    Instantiated,
    InitializationMode,
    StepMode,
    Terminated,
    /// A call returned an error.
    Error,
    /// The instance could not even be reset.
    Fatal,
    /// Of Model Exchange, and of co-simulation in FMI 3.0.
    EventMode,
    /// Of Model Exchange.
    ContinuousTimeMode,
    /// Of co-simulation in FMI 3.0: inside a step, while the importer sets the inputs at its end.
    IntermediateUpdateMode,
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

    /// Whether parameters may still change, and values follow from them.
    pub(crate) const fn is_before_the_start(self) -> bool {
        matches!(self, Self::Instantiated | Self::InitializationMode)
    }

    /// Where an instance is, for messages; `version` names the functions.
    pub(crate) fn describe(self, version: Version) -> String {
        match self {
            Self::Instantiated => format!("before {version}EnterInitializationMode"),
            Self::InitializationMode => "in Initialization Mode".to_owned(),
            Self::StepMode => "in step mode".to_owned(),
            Self::Terminated => format!("after {version}Terminate"),
            Self::Error => "after an error: reset it, restore a state or free it".to_owned(),
            Self::Fatal => "after a fatal error: free it".to_owned(),
            Self::EventMode => "in Event Mode".to_owned(),
            Self::ContinuousTimeMode => "in Continuous-Time Mode".to_owned(),
            Self::IntermediateUpdateMode => "in Intermediate Update Mode".to_owned(),
        }
    }

    const fn bit(self) -> u16 {
        1 << self as u8
    }
}

const NEVER: u16 = 0;
const INST: u16 = Phase::Instantiated.bit();
const INIT: u16 = Phase::InitializationMode.bit();
const STEP: u16 = Phase::StepMode.bit();
const TERM: u16 = Phase::Terminated.bit();
const ERR: u16 = Phase::Error.bit();
const EVENT: u16 = Phase::EventMode.bit();
const TIME: u16 = Phase::ContinuousTimeMode.bit();
const UPDATE: u16 = Phase::IntermediateUpdateMode.bit();
/// After the end, or an error: values can still be read.
const END: u16 = TERM | ERR;
/// Between initialisation and end, in either kind.
const RUN: u16 = STEP | EVENT | TIME;
/// All but a lost instance.
const ALIVE: u16 = INST | INIT | RUN | END;

/// When values can be set: all of them, and those that are not continuous.
const SET: u16 = INST | INIT | RUN;
const SET_DISCRETE: u16 = INST | INIT | STEP | EVENT;
/// When values can be read.
const GET: u16 = INIT | RUN | END;
/// The continuous-time values of FMI 3.0 can be read from Initialization Mode on.
const GET_CONTINUOUS: u16 = INIT | EVENT | TIME | END;

/// Declares the calls, each with the names of its C functions and the phases in which these are allowed.
macro_rules! calls {
    ($($call:ident $fmi2:literal $phases2:expr, $fmi3:literal $phases3:expr;)*) => {
        /// The functions that the call order is about, with their like in the other version.
        ///
        /// Their order tells which kind of instance they are for: see [`Call::only_for`].
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub(crate) enum Call { $($call),* }

        /// Name and phases of each call in FMI 2.0 and in FMI 3.0; without a name where there is none.
        const TABLE: &[[(&str, u16); 2]] = &[$([($fmi2, $phases2), ($fmi3, $phases3)]),*];
    };
}

#[rustfmt::skip]
calls! {
    SetDebugLogging "fmi2SetDebugLogging" ALIVE, "fmi3SetDebugLogging" ALIVE;
    SetupExperiment "fmi2SetupExperiment" INST, "" NEVER;
    EnterInitializationMode "fmi2EnterInitializationMode" INST, "fmi3EnterInitializationMode" INST;
    ExitInitializationMode "fmi2ExitInitializationMode" INIT, "fmi3ExitInitializationMode" INIT;
    Terminate "fmi2Terminate" RUN, "fmi3Terminate" RUN;
    Reset "fmi2Reset" ALIVE, "fmi3Reset" ALIVE;
    GetReal "fmi2GetReal" GET, "fmi3GetFloat64" GET;
    GetInteger "fmi2GetInteger" GET, "fmi3GetInt32" GET;
    GetBoolean "fmi2GetBoolean" GET, "fmi3GetBoolean" GET;
    GetString "fmi2GetString" GET, "fmi3GetString" GET;
    SetReal "fmi2SetReal" SET, "fmi3SetFloat64" SET | UPDATE;
    SetInteger "fmi2SetInteger" SET_DISCRETE, "fmi3SetInt32" SET_DISCRETE;
    SetBoolean "fmi2SetBoolean" SET_DISCRETE, "fmi3SetBoolean" SET_DISCRETE;
    SetString "fmi2SetString" SET_DISCRETE, "fmi3SetString" SET_DISCRETE;
    GetFmuState "fmi2GetFMUstate" ALIVE, "fmi3GetFMUState" ALIVE;
    SetFmuState "fmi2SetFMUstate" ALIVE, "fmi3SetFMUState" ALIVE;
    FreeFmuState "fmi2FreeFMUstate" ALIVE, "fmi3FreeFMUState" ALIVE;
    SerializedFmuStateSize "fmi2SerializedFMUstateSize" ALIVE, "fmi3SerializedFMUStateSize" ALIVE;
    SerializeFmuState "fmi2SerializeFMUstate" ALIVE, "fmi3SerializeFMUState" ALIVE;
    DeSerializeFmuState "fmi2DeSerializeFMUstate" ALIVE, "fmi3DeserializeFMUState" ALIVE;
    GetDirectionalDerivative "fmi2GetDirectionalDerivative" GET, "fmi3GetDirectionalDerivative" GET;
    // Values of types of FMI 3.0 alone. Enumerations are 64-bit integers there; the other types have none.
    GetInt64 "" NEVER, "fmi3GetInt64" GET;
    GetFloat32 "" NEVER, "fmi3GetFloat32" GET;
    GetInt8 "" NEVER, "fmi3GetInt8" GET;
    GetUInt8 "" NEVER, "fmi3GetUInt8" GET;
    GetInt16 "" NEVER, "fmi3GetInt16" GET;
    GetUInt16 "" NEVER, "fmi3GetUInt16" GET;
    GetUInt32 "" NEVER, "fmi3GetUInt32" GET;
    GetUInt64 "" NEVER, "fmi3GetUInt64" GET;
    GetBinary "" NEVER, "fmi3GetBinary" GET;
    SetInt64 "" NEVER, "fmi3SetInt64" SET_DISCRETE;
    SetFloat32 "" NEVER, "fmi3SetFloat32" SET;
    SetInt8 "" NEVER, "fmi3SetInt8" SET_DISCRETE;
    SetUInt8 "" NEVER, "fmi3SetUInt8" SET_DISCRETE;
    SetInt16 "" NEVER, "fmi3SetInt16" SET_DISCRETE;
    SetUInt16 "" NEVER, "fmi3SetUInt16" SET_DISCRETE;
    SetUInt32 "" NEVER, "fmi3SetUInt32" SET_DISCRETE;
    SetUInt64 "" NEVER, "fmi3SetUInt64" SET_DISCRETE;
    SetBinary "" NEVER, "fmi3SetBinary" SET_DISCRETE;
    GetAdjointDerivative "" NEVER, "fmi3GetAdjointDerivative" GET;
    // What no FMU of this layer supports.
    EnterConfigurationMode "" NEVER, "fmi3EnterConfigurationMode" NEVER;
    ExitConfigurationMode "" NEVER, "fmi3ExitConfigurationMode" NEVER;
    GetNumberOfVariableDependencies "" NEVER, "fmi3GetNumberOfVariableDependencies" NEVER;
    GetVariableDependencies "" NEVER, "fmi3GetVariableDependencies" NEVER;
    EvaluateDiscreteStates "" NEVER, "fmi3EvaluateDiscreteStates" NEVER;
    GetClock "" NEVER, "fmi3GetClock" NEVER;
    SetClock "" NEVER, "fmi3SetClock" NEVER;
    GetIntervalDecimal "" NEVER, "fmi3GetIntervalDecimal" NEVER;
    GetIntervalFraction "" NEVER, "fmi3GetIntervalFraction" NEVER;
    GetShiftDecimal "" NEVER, "fmi3GetShiftDecimal" NEVER;
    GetShiftFraction "" NEVER, "fmi3GetShiftFraction" NEVER;
    SetIntervalDecimal "" NEVER, "fmi3SetIntervalDecimal" NEVER;
    SetIntervalFraction "" NEVER, "fmi3SetIntervalFraction" NEVER;
    SetShiftDecimal "" NEVER, "fmi3SetShiftDecimal" NEVER;
    SetShiftFraction "" NEVER, "fmi3SetShiftFraction" NEVER;
    ActivateModelPartition "" NEVER, "fmi3ActivateModelPartition" NEVER;
    // Of Model Exchange in FMI 2.0, of both kinds in FMI 3.0.
    EnterEventMode "fmi2EnterEventMode" EVENT | TIME, "fmi3EnterEventMode" TIME | STEP;
    NewDiscreteStates "fmi2NewDiscreteStates" EVENT, "fmi3UpdateDiscreteStates" EVENT;
    // Of co-simulation.
    SetRealInputDerivatives "fmi2SetRealInputDerivatives" INIT | STEP, "" NEVER;
    GetRealOutputDerivatives "fmi2GetRealOutputDerivatives" STEP | END, "fmi3GetOutputDerivatives" STEP | END;
    EnterStepMode "" NEVER, "fmi3EnterStepMode" EVENT;
    DoStep "fmi2DoStep" STEP, "fmi3DoStep" STEP;
    FinishStep "" NEVER, "fmi3DoStep" STEP | UPDATE;
    CancelStep "fmi2CancelStep" NEVER, "" NEVER;
    GetStatus "fmi2GetStatus" STEP | END, "" NEVER;
    GetRealStatus "fmi2GetRealStatus" STEP | END, "" NEVER;
    GetIntegerStatus "fmi2GetIntegerStatus" STEP | END, "" NEVER;
    GetBooleanStatus "fmi2GetBooleanStatus" STEP | END, "" NEVER;
    GetStringStatus "fmi2GetStringStatus" STEP | END, "" NEVER;
    // Of Model Exchange.
    EnterContinuousTimeMode "fmi2EnterContinuousTimeMode" EVENT, "fmi3EnterContinuousTimeMode" EVENT;
    CompletedIntegratorStep "fmi2CompletedIntegratorStep" TIME, "fmi3CompletedIntegratorStep" TIME;
    SetTime "fmi2SetTime" EVENT | TIME, "fmi3SetTime" EVENT | TIME;
    SetContinuousStates "fmi2SetContinuousStates" TIME, "fmi3SetContinuousStates" TIME;
    GetDerivatives "fmi2GetDerivatives" EVENT | TIME | END,
        "fmi3GetContinuousStateDerivatives" GET_CONTINUOUS;
    GetEventIndicators "fmi2GetEventIndicators" GET_CONTINUOUS, "fmi3GetEventIndicators" GET_CONTINUOUS;
    GetContinuousStates "fmi2GetContinuousStates" GET_CONTINUOUS, "fmi3GetContinuousStates" GET_CONTINUOUS;
    GetNominalsOfContinuousStates "fmi2GetNominalsOfContinuousStates" INST | EVENT | TIME | END,
        "fmi3GetNominalsOfContinuousStates" INST | EVENT | TIME | END;
    GetNumberOfEventIndicators "" NEVER, "fmi3GetNumberOfEventIndicators" ALIVE;
    GetNumberOfContinuousStates "" NEVER, "fmi3GetNumberOfContinuousStates" ALIVE;
}

impl Call {
    /// The name of the C function.
    pub(crate) const fn name(self, version: Version) -> &'static str {
        TABLE[self as usize][version as usize].0
    }

    pub(crate) const fn is_allowed(self, version: Version, phase: Phase) -> bool {
        TABLE[self as usize][version as usize].1 & phase.bit() != 0
    }

    /// The one kind of instance that this call is for; none if it is for both.
    pub(crate) const fn only_for(self, version: Version) -> Option<Interface> {
        match self as usize {
            call if call >= Self::EnterContinuousTimeMode as usize => Some(Interface::ModelExchange),
            call if call >= Self::SetRealInputDerivatives as usize => Some(Interface::CoSimulation),
            call if call >= Self::EnterEventMode as usize => match version {
                Version::Fmi2 => Some(Interface::ModelExchange),
                Version::Fmi3 => None,
            },
            _ => None,
        }
    }

    /// Why this call is never served; none for the others.
    pub(crate) const fn why_never(self) -> Option<&'static str> {
        match self {
            Self::CancelStep => Some("there is no step to cancel: fmi2DoStep returns when the step is done"),
            Self::EnterConfigurationMode | Self::ExitConfigurationMode => {
                Some("there are no structural parameters to configure")
            }
            Self::GetNumberOfVariableDependencies | Self::GetVariableDependencies => {
                Some("dependencies are in modelDescription.xml: providesPerElementDependencies is false")
            }
            Self::EvaluateDiscreteStates => {
                Some("use fmi3UpdateDiscreteStates: providesEvaluateDiscreteStates is false")
            }
            call if call as usize >= Self::GetClock as usize
                && call as usize <= Self::ActivateModelPartition as usize =>
            {
                Some("there are no clocks")
            }
            _ => None,
        }
    }

    /// Whether a failure of this call ends the simulation.
    ///
    /// A value that cannot be read or a state that is refused does not: the instance is as it was.
    pub(crate) fn failure_is_final(self, version: Version) -> bool {
        // the standard calls fmi2Get… and fmi3Get… what only reads
        let reads = self.name(version).get(4..).is_some_and(|name| name.starts_with("Get"));
        !(reads
            || matches!(
                self,
                Self::SetFmuState
                    | Self::FreeFmuState
                    | Self::SerializedFmuStateSize
                    | Self::SerializeFmuState
                    | Self::DeSerializeFmuState
            ))
    }
}
