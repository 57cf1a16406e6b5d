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
    /// Event Mode of Model Exchange, and of co-simulation in FMI 3.0.
    EventMode,
    /// Continuous-Time Mode of Model Exchange.
    ContinuousTimeMode,
    /// Intermediate Update Mode of co-simulation in FMI 3.0: inside a step, while the importer sets the
    /// inputs at its end.
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

    /// Returns whether parameters may still change, and with them the values that depend on them.
    pub(crate) const fn is_before_the_start(self) -> bool {
        matches!(self, Self::Instantiated | Self::InitializationMode)
    }

    /// Describes where an instance is, for messages; `version` names the functions.
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
/// FMI 3.0 reads values from instantiation on (section 2.3.2, as of June 2026).
const GET_3: u16 = INST | GET;
/// The continuous-time values of FMI 3.0 can be read from Initialization Mode on.
const GET_CONTINUOUS: u16 = INIT | EVENT | TIME | END;

/// What one version of FMI says about a call.
struct Rule {
    /// The C function.
    name: &'static str,
    /// The one kind of instance that the call is for; none if it is for both.
    only_for: Option<Interface>,
    /// The phases in which it is allowed.
    phases: u16,
    /// Why it is never served; none for the others.
    why_never: Option<&'static str>,
}

/// A call for both kinds of instance.
const fn any(name: &'static str, phases: u16) -> Rule {
    Rule { name, only_for: None, phases, why_never: None }
}

/// A call of co-simulation.
const fn cs(name: &'static str, phases: u16) -> Rule {
    Rule { only_for: Some(Interface::CoSimulation), ..any(name, phases) }
}

/// A call of Model Exchange.
const fn me(name: &'static str, phases: u16) -> Rule {
    Rule { only_for: Some(Interface::ModelExchange), ..any(name, phases) }
}

/// A call that no FMU of this layer supports.
const fn never(name: &'static str, why_never: Option<&'static str>) -> Rule {
    Rule { why_never, ..any(name, NEVER) }
}

/// There is no such call in this version.
const NONE: Rule = any("", NEVER);

const NO_STEP: Option<&str> = Some("there is no step to cancel: fmi2DoStep returns when the step is done");
const NO_CONFIGURATION: Option<&str> = Some("there are no structural parameters to configure");
const IN_DESCRIPTION: Option<&str> =
    Some("dependencies are in modelDescription.xml: providesPerElementDependencies is false");
const UPDATE_INSTEAD: Option<&str> =
    Some("use fmi3UpdateDiscreteStates: providesEvaluateDiscreteStates is false");
const NO_CLOCKS: Option<&str> = Some("there are no clocks");

/// Declares the calls, each with its rule in FMI 2.0 and in FMI 3.0.
macro_rules! calls {
    ($($call:ident: $fmi2:expr, $fmi3:expr;)*) => {
        /// The functions whose order is checked, each with its counterpart in the other version.
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub(crate) enum Call { $($call),* }

        /// The rules of each call in FMI 2.0 and in FMI 3.0.
        const TABLE: &[[Rule; 2]] = &[$([$fmi2, $fmi3]),*];
    };
}

#[rustfmt::skip]
calls! {
    SetDebugLogging: any("fmi2SetDebugLogging", ALIVE), any("fmi3SetDebugLogging", ALIVE);
    SetupExperiment: any("fmi2SetupExperiment", INST), NONE;
    EnterInitializationMode: any("fmi2EnterInitializationMode", INST),
        any("fmi3EnterInitializationMode", INST);
    ExitInitializationMode: any("fmi2ExitInitializationMode", INIT), any("fmi3ExitInitializationMode", INIT);
    Terminate: any("fmi2Terminate", RUN), any("fmi3Terminate", RUN);
    Reset: any("fmi2Reset", ALIVE), any("fmi3Reset", ALIVE);
    GetReal: any("fmi2GetReal", GET), any("fmi3GetFloat64", GET_3);
    GetInteger: any("fmi2GetInteger", GET), any("fmi3GetInt32", GET_3);
    GetBoolean: any("fmi2GetBoolean", GET), any("fmi3GetBoolean", GET_3);
    GetString: any("fmi2GetString", GET), any("fmi3GetString", GET_3);
    SetReal: any("fmi2SetReal", SET), any("fmi3SetFloat64", SET | UPDATE);
    SetInteger: any("fmi2SetInteger", SET_DISCRETE), any("fmi3SetInt32", SET_DISCRETE);
    SetBoolean: any("fmi2SetBoolean", SET_DISCRETE), any("fmi3SetBoolean", SET_DISCRETE);
    SetString: any("fmi2SetString", SET_DISCRETE), any("fmi3SetString", SET_DISCRETE);
    GetFmuState: any("fmi2GetFMUstate", ALIVE), any("fmi3GetFMUState", ALIVE);
    SetFmuState: any("fmi2SetFMUstate", ALIVE), any("fmi3SetFMUState", ALIVE);
    FreeFmuState: any("fmi2FreeFMUstate", ALIVE), any("fmi3FreeFMUState", ALIVE);
    SerializedFmuStateSize: any("fmi2SerializedFMUstateSize", ALIVE),
        any("fmi3SerializedFMUStateSize", ALIVE);
    SerializeFmuState: any("fmi2SerializeFMUstate", ALIVE), any("fmi3SerializeFMUState", ALIVE);
    DeSerializeFmuState: any("fmi2DeSerializeFMUstate", ALIVE), any("fmi3DeserializeFMUState", ALIVE);
    GetDirectionalDerivative: any("fmi2GetDirectionalDerivative", GET),
        any("fmi3GetDirectionalDerivative", GET);
    // Values of types of FMI 3.0 alone. Enumerations are 64-bit integers there; the other types have none.
    GetInt64: NONE, any("fmi3GetInt64", GET_3);
    GetFloat32: NONE, any("fmi3GetFloat32", GET_3);
    GetInt8: NONE, any("fmi3GetInt8", GET_3);
    GetUInt8: NONE, any("fmi3GetUInt8", GET_3);
    GetInt16: NONE, any("fmi3GetInt16", GET_3);
    GetUInt16: NONE, any("fmi3GetUInt16", GET_3);
    GetUInt32: NONE, any("fmi3GetUInt32", GET_3);
    GetUInt64: NONE, any("fmi3GetUInt64", GET_3);
    GetBinary: NONE, any("fmi3GetBinary", GET_3);
    SetInt64: NONE, any("fmi3SetInt64", SET_DISCRETE);
    SetFloat32: NONE, any("fmi3SetFloat32", SET);
    SetInt8: NONE, any("fmi3SetInt8", SET_DISCRETE);
    SetUInt8: NONE, any("fmi3SetUInt8", SET_DISCRETE);
    SetInt16: NONE, any("fmi3SetInt16", SET_DISCRETE);
    SetUInt16: NONE, any("fmi3SetUInt16", SET_DISCRETE);
    SetUInt32: NONE, any("fmi3SetUInt32", SET_DISCRETE);
    SetUInt64: NONE, any("fmi3SetUInt64", SET_DISCRETE);
    SetBinary: NONE, any("fmi3SetBinary", SET_DISCRETE);
    GetAdjointDerivative: NONE, any("fmi3GetAdjointDerivative", GET);
    EnterConfigurationMode: NONE, never("fmi3EnterConfigurationMode", NO_CONFIGURATION);
    ExitConfigurationMode: NONE, never("fmi3ExitConfigurationMode", NO_CONFIGURATION);
    GetNumberOfVariableDependencies: NONE, never("fmi3GetNumberOfVariableDependencies", IN_DESCRIPTION);
    GetVariableDependencies: NONE, never("fmi3GetVariableDependencies", IN_DESCRIPTION);
    EvaluateDiscreteStates: NONE, never("fmi3EvaluateDiscreteStates", UPDATE_INSTEAD);
    GetClock: NONE, never("fmi3GetClock", NO_CLOCKS);
    SetClock: NONE, never("fmi3SetClock", NO_CLOCKS);
    GetIntervalDecimal: NONE, never("fmi3GetIntervalDecimal", NO_CLOCKS);
    GetIntervalFraction: NONE, never("fmi3GetIntervalFraction", NO_CLOCKS);
    GetShiftDecimal: NONE, never("fmi3GetShiftDecimal", NO_CLOCKS);
    GetShiftFraction: NONE, never("fmi3GetShiftFraction", NO_CLOCKS);
    SetIntervalDecimal: NONE, never("fmi3SetIntervalDecimal", NO_CLOCKS);
    SetIntervalFraction: NONE, never("fmi3SetIntervalFraction", NO_CLOCKS);
    SetShiftDecimal: NONE, never("fmi3SetShiftDecimal", NO_CLOCKS);
    SetShiftFraction: NONE, never("fmi3SetShiftFraction", NO_CLOCKS);
    ActivateModelPartition: NONE, never("fmi3ActivateModelPartition", NO_CLOCKS);
    EnterEventMode: me("fmi2EnterEventMode", EVENT | TIME), any("fmi3EnterEventMode", TIME | STEP);
    NewDiscreteStates: me("fmi2NewDiscreteStates", EVENT), any("fmi3UpdateDiscreteStates", EVENT);
    // FMI 3.0 has none: the name is that of fmi-ls-wasm.
    SetRealInputDerivatives: cs("fmi2SetRealInputDerivatives", INIT | STEP),
        cs("set-input-derivatives", INIT | STEP);
    GetRealOutputDerivatives: cs("fmi2GetRealOutputDerivatives", STEP | END),
        cs("fmi3GetOutputDerivatives", STEP | END);
    EnterStepMode: NONE, cs("fmi3EnterStepMode", EVENT);
    DoStep: cs("fmi2DoStep", STEP), cs("fmi3DoStep", STEP);
    FinishStep: NONE, cs("fmi3DoStep", STEP | UPDATE);
    CancelStep: Rule { why_never: NO_STEP, ..cs("fmi2CancelStep", NEVER) }, NONE;
    GetStatus: cs("fmi2GetStatus", STEP | END), NONE;
    GetRealStatus: cs("fmi2GetRealStatus", STEP | END), NONE;
    GetIntegerStatus: cs("fmi2GetIntegerStatus", STEP | END), NONE;
    GetBooleanStatus: cs("fmi2GetBooleanStatus", STEP | END), NONE;
    GetStringStatus: cs("fmi2GetStringStatus", STEP | END), NONE;
    EnterContinuousTimeMode: me("fmi2EnterContinuousTimeMode", EVENT),
        me("fmi3EnterContinuousTimeMode", EVENT);
    CompletedIntegratorStep: me("fmi2CompletedIntegratorStep", TIME), me("fmi3CompletedIntegratorStep", TIME);
    SetTime: me("fmi2SetTime", EVENT | TIME), me("fmi3SetTime", EVENT | TIME);
    SetContinuousStates: me("fmi2SetContinuousStates", TIME), me("fmi3SetContinuousStates", TIME);
    GetDerivatives: me("fmi2GetDerivatives", EVENT | TIME | END),
        me("fmi3GetContinuousStateDerivatives", GET_CONTINUOUS);
    GetEventIndicators: me("fmi2GetEventIndicators", GET_CONTINUOUS),
        me("fmi3GetEventIndicators", GET_CONTINUOUS);
    GetContinuousStates: me("fmi2GetContinuousStates", GET_CONTINUOUS),
        me("fmi3GetContinuousStates", GET_CONTINUOUS);
    GetNominalsOfContinuousStates: me("fmi2GetNominalsOfContinuousStates", INST | EVENT | TIME | END),
        me("fmi3GetNominalsOfContinuousStates", INST | EVENT | TIME | END);
    GetNumberOfEventIndicators: NONE, me("fmi3GetNumberOfEventIndicators", ALIVE);
    GetNumberOfContinuousStates: NONE, me("fmi3GetNumberOfContinuousStates", ALIVE);
}

impl Call {
    const fn rule(self, version: Version) -> &'static Rule {
        &TABLE[self as usize][version as usize]
    }

    /// The name of the C function.
    pub(crate) const fn name(self, version: Version) -> &'static str {
        self.rule(version).name
    }

    pub(crate) const fn is_allowed(self, version: Version, phase: Phase) -> bool {
        self.rule(version).phases & phase.bit() != 0
    }

    /// The one kind of instance that this call is for; none if it is for both.
    pub(crate) const fn only_for(self, version: Version) -> Option<Interface> {
        self.rule(version).only_for
    }

    /// Returns why this call is never served; `None` for the others.
    pub(crate) const fn why_never(self, version: Version) -> Option<&'static str> {
        self.rule(version).why_never
    }

    /// Returns whether a failure of this call ends the simulation.
    ///
    /// A value that cannot be read or a state that is refused does not: the instance is as it was.
    pub(crate) fn failure_is_final(self, version: Version) -> bool {
        // the standard names functions that only read fmi2Get… and fmi3Get…
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
