//! The call order as a table, for both versions of FMI: FMI 2.0.5, sections 3.2.3 (Model Exchange) and 4.2.4
//! (co-simulation); FMI 3.0.2, sections 2.3, 3.2 and 4.2.

use crate::model::Interface;
use std::fmt;

/// The version of FMI that an importer speaks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Version {
    /// FMI 2.0.
    Fmi2,
    /// FMI 3.0.
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
#[allow(missing_docs, reason = "the names are those of FMI")]
pub enum Phase {
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
    /// The phases of saved states. A lost instance saves none.
    pub(crate) const SAVED: [Self; 7] = [
        Self::Instantiated,
        Self::InitializationMode,
        Self::StepMode,
        Self::Terminated,
        Self::Error,
        Self::EventMode,
        Self::ContinuousTimeMode,
    ];

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
pub(crate) struct Rule {
    /// The one kind of instance that the call is for; none if it is for both.
    pub(crate) only_for: Option<Interface>,
    /// The phases in which it is allowed.
    phases: u16,
    /// Why it is never served; none for the others.
    pub(crate) why_never: Option<&'static str>,
}

impl Rule {
    pub(crate) const fn allows(&self, phase: Phase) -> bool {
        self.phases & phase.bit() != 0
    }
}

/// A call for both kinds of instance.
const fn any(phases: u16) -> Rule {
    Rule { only_for: None, phases, why_never: None }
}

/// A call of co-simulation.
const fn cs(phases: u16) -> Rule {
    Rule { only_for: Some(Interface::CoSimulation), ..any(phases) }
}

/// A call of Model Exchange.
const fn me(phases: u16) -> Rule {
    Rule { only_for: Some(Interface::ModelExchange), ..any(phases) }
}

/// A call that no FMU of this layer supports.
const fn never(why_never: &'static str) -> Rule {
    Rule { why_never: Some(why_never), ..any(NEVER) }
}

/// There is no such call in this version.
const NONE: Rule = any(NEVER);

const NO_STEP: &str = "there is no step to cancel: fmi2DoStep returns when the step is done";
const NO_CONFIGURATION: &str = "there are no structural parameters to configure";
const IN_DESCRIPTION: &str =
    "dependencies are in modelDescription.xml: providesPerElementDependencies is false";
const UPDATE_INSTEAD: &str = "use fmi3UpdateDiscreteStates: providesEvaluateDiscreteStates is false";
const NO_CLOCKS: &str = "there are no clocks";

/// Declares the calls: those with the same rules, then their rule in FMI 2.0 and in FMI 3.0.
macro_rules! calls {
    ($($($call:ident)+: $fmi2:expr, $fmi3:expr;)*) => {
        /// The functions whose order is checked, each with its counterpart in the other version, by their
        /// names in FMI 2.0 or else in FMI 3.0.
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        #[allow(missing_docs, reason = "the names are those of FMI")]
        pub enum Call { $($($call),+),* }

        impl Call {
            const ALL: &[Self] = &[$($(Self::$call),+),*];

            /// The names in FMI 2.0 and in FMI 3.0, where they are alike.
            const NAMES: &[[&str; 2]] =
                &[$($([concat!("fmi2", stringify!($call)), concat!("fmi3", stringify!($call))]),+),*];

            /// The rules in FMI 2.0 and in FMI 3.0.
            const TABLE: &[[Rule; 2]] = &[$($({ let _ = Self::$call; [$fmi2, $fmi3] }),+),*];
        }
    };
}

#[rustfmt::skip]
calls! {
    SetDebugLogging Reset: any(ALIVE), any(ALIVE);
    GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate:
        any(ALIVE), any(ALIVE);
    SetupExperiment: any(INST), NONE;
    EnterInitializationMode: any(INST), any(INST);
    ExitInitializationMode: any(INIT), any(INIT);
    Terminate: any(RUN), any(RUN);
    GetReal GetInteger GetBoolean GetString: any(GET), any(GET_3);
    SetReal: any(SET), any(SET | UPDATE);
    SetInteger SetBoolean SetString: any(SET_DISCRETE), any(SET_DISCRETE);
    GetDirectionalDerivative: any(GET), any(GET);
    GetAdjointDerivative: NONE, any(GET);
    // Values of types of FMI 3.0 alone. Enumerations are 64-bit integers there; the other types have none.
    GetInt64 GetFloat32 GetInt8 GetUInt8 GetInt16 GetUInt16 GetUInt32 GetUInt64 GetBinary: NONE, any(GET_3);
    SetInt64 SetInt8 SetUInt8 SetInt16 SetUInt16 SetUInt32 SetUInt64 SetBinary: NONE, any(SET_DISCRETE);
    SetFloat32: NONE, any(SET);
    EnterConfigurationMode ExitConfigurationMode: NONE, never(NO_CONFIGURATION);
    GetNumberOfVariableDependencies GetVariableDependencies: NONE, never(IN_DESCRIPTION);
    EvaluateDiscreteStates: NONE, never(UPDATE_INSTEAD);
    GetClock GetIntervalDecimal GetIntervalFraction GetShiftDecimal GetShiftFraction
    SetClock SetIntervalDecimal SetIntervalFraction SetShiftDecimal SetShiftFraction
    ActivateModelPartition: NONE, never(NO_CLOCKS);
    EnterEventMode: me(EVENT | TIME), any(TIME | STEP);
    NewDiscreteStates: me(EVENT), any(EVENT);
    SetRealInputDerivatives: cs(INIT | STEP), cs(INIT | STEP);
    GetRealOutputDerivatives: cs(STEP | END), cs(STEP | END);
    EnterStepMode: NONE, cs(EVENT);
    DoStep: cs(STEP), cs(STEP);
    FinishStep: NONE, cs(STEP | UPDATE);
    CancelStep: Rule { why_never: Some(NO_STEP), ..cs(NEVER) }, NONE;
    GetStatus GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus: cs(STEP | END), NONE;
    EnterContinuousTimeMode: me(EVENT), me(EVENT);
    CompletedIntegratorStep SetContinuousStates: me(TIME), me(TIME);
    SetTime: me(EVENT | TIME), me(EVENT | TIME);
    GetDerivatives: me(EVENT | TIME | END), me(GET_CONTINUOUS);
    GetEventIndicators GetContinuousStates: me(GET_CONTINUOUS), me(GET_CONTINUOUS);
    GetNominalsOfContinuousStates: me(INST | EVENT | TIME | END), me(INST | EVENT | TIME | END);
    GetNumberOfEventIndicators GetNumberOfContinuousStates: NONE, me(ALIVE);
}

impl Call {
    pub(crate) const fn rule(self, version: Version) -> &'static Rule {
        &Self::TABLE[self as usize][version as usize]
    }

    /// The call of the function of FMI 3.0 with this name.
    pub(crate) fn of_fmi3(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|call| call.name(Version::Fmi3) == name)
    }

    /// The name of the C function.
    pub(crate) const fn name(self, version: Version) -> &'static str {
        match (version, self) {
            (Version::Fmi3, Self::GetReal) => "fmi3GetFloat64",
            (Version::Fmi3, Self::SetReal) => "fmi3SetFloat64",
            (Version::Fmi3, Self::GetInteger) => "fmi3GetInt32",
            (Version::Fmi3, Self::SetInteger) => "fmi3SetInt32",
            (Version::Fmi3, Self::GetFMUstate) => "fmi3GetFMUState",
            (Version::Fmi3, Self::SetFMUstate) => "fmi3SetFMUState",
            (Version::Fmi3, Self::FreeFMUstate) => "fmi3FreeFMUState",
            (Version::Fmi3, Self::SerializedFMUstateSize) => "fmi3SerializedFMUStateSize",
            (Version::Fmi3, Self::SerializeFMUstate) => "fmi3SerializeFMUState",
            (Version::Fmi3, Self::DeSerializeFMUstate) => "fmi3DeserializeFMUState",
            (Version::Fmi3, Self::NewDiscreteStates) => "fmi3UpdateDiscreteStates",
            (Version::Fmi3, Self::GetRealOutputDerivatives) => "fmi3GetOutputDerivatives",
            (Version::Fmi3, Self::GetDerivatives) => "fmi3GetContinuousStateDerivatives",
            (Version::Fmi3, Self::FinishStep) => "fmi3DoStep",
            // FMI 3.0 has none: the name is that of fmi-ls-wasm.
            (Version::Fmi3, Self::SetRealInputDerivatives) => "set-input-derivatives",
            _ => Self::NAMES[self as usize][version as usize],
        }
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
                Self::SetFMUstate
                    | Self::FreeFMUstate
                    | Self::SerializedFMUstateSize
                    | Self::SerializeFMUstate
                    | Self::DeSerializeFMUstate
            ))
    }
}
