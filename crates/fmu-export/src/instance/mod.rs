//! One instance of a model: what the C functions do, without C.

#![allow(clippy::missing_errors_doc, reason = "all fail where FMI or the model refuses, and say why")]

mod exchange;
mod saved;
mod step;
mod values;

use crate::call::{Call, Phase, Rule, Version};
use crate::failure::Failure;
use crate::guid;
use crate::log::{Category, Filter, Logger, Status};
use crate::model::{Environment, Experiment, Interface, Model, Step};
use crate::uri::path_from_location;
use std::collections::BTreeMap;
use std::ffi::CString;
use std::rc::Rc;

/// What a state saves, and a reset restores.
struct Snapshot<M> {
    model: M,
    phase: Phase,
    /// Where the last step ended, or the solver is [s].
    time: f64,
    experiment: Experiment,
    /// Values were set that [`Model::calculate`] has not seen.
    stale: bool,
}

impl<M: Model> Clone for Snapshot<M> {
    // once in the library, and not in each function that saves a state
    #[inline(never)]
    fn clone(&self) -> Self {
        let Self { model, phase, time, experiment, stale } = self;
        Self { model: model.clone(), phase: *phase, time: *time, experiment: *experiment, stale: *stale }
    }
}

/// What an instance is made for.
#[derive(Clone, Copy)]
pub struct Purpose<M: Model> {
    /// The version of FMI.
    pub version: Version,
    /// How the importer uses the instance.
    pub interface: Interface,
    /// The continuous states; none in co-simulation.
    pub states: &'static [M::Real],
    /// FMI 3.0 co-simulation uses Event Mode.
    pub event_mode: bool,
    /// FMI 3.0 co-simulation lets steps end early.
    pub early_return: bool,
}

impl<M: Model> Purpose<M> {
    /// What an instance of FMI 3.0 is made for, with Event Mode and without early returns.
    pub const fn fmi3(interface: Interface, states: &'static [M::Real]) -> Self {
        Self { version: Version::Fmi3, interface, states, event_mode: true, early_return: false }
    }

    /// Returns whether the instance can be in `phase`.
    fn has(&self, phase: Phase) -> bool {
        let steps = self.interface == Interface::CoSimulation;
        match phase {
            Phase::StepMode => steps,
            Phase::ContinuousTimeMode => !steps,
            Phase::EventMode => !steps || self.event_mode,
            _ => true,
        }
    }
}

/// One instance of the model `M`.
pub struct Instance<M: Model> {
    now: Snapshot<M>,
    fresh: Snapshot<M>,
    guid: String,
    logger: Logger,
    /// How the last step ended.
    pub(crate) last_step: Status,
    /// The saved states, by the address that is their handle. An address that is not a key here is never
    /// dereferenced.
    saved: BTreeMap<usize, Box<Snapshot<M>>>,
    /// Texts that the last get of strings returned pointers to.
    texts: Vec<CString>,
    /// What it is made for.
    pub purpose: Purpose<M>,
    /// The warning about a Boolean that is read as a Real has been logged.
    has_warned_of_boolean: bool,
    /// Asks the importer of FMI 3.0 for the inputs at a time [s].
    pub(crate) intermediate_update: Option<IntermediateUpdate>,
    /// The step under way, and its end [s].
    pending: Option<(Step, f64)>,
}

/// Lets the importer set inputs for a time [s].
pub(crate) type IntermediateUpdate = Rc<dyn Fn(f64)>;

impl<M: Model> Instance<M> {
    /// A new instance.
    ///
    /// # Errors
    /// When guid or model refuse.
    pub fn new(
        name: &str,
        guid: &str,
        location: Option<&[u8]>,
        purpose: Purpose<M>,
        mut logger: Logger,
    ) -> Result<Self, Failure> {
        let resources = location.and_then(|bytes| str::from_utf8(bytes).ok()).and_then(path_from_location);
        if let (Some(location), None) = (location, &resources) {
            logger.log().warning(format_args!(
                "the resource location {:?} is not a local folder in UTF-8: it is ignored",
                String::from_utf8_lossy(location)
            ));
        }
        let payload = guid::check::<M>(guid, resources.as_deref())?;
        let environment = Environment {
            interface: purpose.interface,
            instance_name: if name.is_empty() { M::IDENTIFIER } else { name },
            resources: resources.as_deref(),
            payload: payload.as_deref(),
        };
        let model = M::instantiate(environment, &mut logger.log())?;
        let fresh = Snapshot {
            model,
            phase: Phase::Instantiated,
            time: 0.0,
            experiment: Experiment::default(),
            stale: true,
        };
        Ok(Self {
            now: fresh.clone(),
            fresh,
            guid: guid.to_owned(),
            logger,
            last_step: Status::Ok,
            saved: BTreeMap::new(),
            texts: Vec::new(),
            purpose,
            has_warned_of_boolean: false,
            intermediate_update: None,
            pending: None,
        })
    }

    /// Carries out `call`, if it is allowed in the present phase. A failure is logged, and ends the
    /// simulation where `Call::failure_is_final`.
    pub fn call(&mut self, call: Call, body: impl FnOnce(&mut Self) -> Result<(), Failure>) -> Status {
        let rule = call.rule(self.purpose.version);
        let suits = rule.only_for.is_none_or(|only| only == self.purpose.interface);
        let in_turn = suits && rule.allows(self.now.phase);
        let done = if in_turn { body(self) } else { Err(self.out_of_turn(rule, suits)) };
        match done {
            Ok(()) => Status::Ok,
            Err(failure) => self.failed(call, &failure),
        }
    }

    /// Handles a panic in `call`. The model may be inconsistent, but a reset replaces it.
    #[cold]
    pub(crate) fn panicked(&mut self, call: Call, message: &str) -> Status {
        let (phase, status, category) = match call {
            Call::Reset => (Phase::Fatal, Status::Fatal, Category::Fatal),
            _ => (Phase::Error, Status::Error, Category::Error),
        };
        self.now.phase = phase;
        let name = call.name(self.purpose.version);
        let text = format_args!("{name}: internal error, please report it: {message}");
        self.logger.log().write(status, category, text);
        status
    }

    #[cold]
    fn out_of_turn(&self, rule: &Rule, suits: bool) -> Failure {
        let Purpose { version, interface, .. } = self.purpose;
        Failure(match rule.why_never {
            _ if !suits => format!("not for an instance of {interface}"),
            Some(why_never) => why_never.to_owned(),
            None => format!("not allowed now: the instance is {}", self.now.phase.describe(version)),
        })
    }

    #[cold]
    fn failed(&mut self, call: Call, failure: &Failure) -> Status {
        if call.failure_is_final(self.purpose.version) && self.now.phase != Phase::Fatal {
            self.now.phase = Phase::Error;
        }
        self.logger.log().error(format_args!("{}: {failure}", call.name(self.purpose.version)));
        Status::Error
    }

    /// Chooses what is logged: all, or some categories.
    pub fn set_debug_logging<'a>(
        &mut self,
        on: bool,
        categories: impl Iterator<Item = Result<&'a str, Failure>>,
    ) -> Result<(), Failure> {
        let (mut filter, mut unknown) = (None, Vec::new());
        for name in categories {
            let name = name?;
            let wanted = filter.unwrap_or(Filter::ERRORS);
            let category = Category::from_name(name);
            unknown.extend(category.is_none().then_some(name));
            filter = Some(category.map_or(wanted, |category| wanted.with(category)));
        }
        if on && !unknown.is_empty() {
            // whoever asks for categories is told of a wrong one, whatever the others are
            self.logger.filter = Filter::EVERYTHING;
            let known: Vec<_> = Category::ALL.iter().map(|category| category.name()).collect();
            self.logger.log().warning(format_args!(
                "{}: unknown log categories {unknown:?} are left out; the categories are {}",
                Call::SetDebugLogging.name(self.purpose.version),
                known.join(", ")
            ));
        }
        self.logger.filter = if on { filter.unwrap_or(Filter::EVERYTHING) } else { Filter::ERRORS };
        Ok(())
    }

    /// Takes start, stop and tolerance of the simulation.
    pub fn setup_experiment(&mut self, experiment: Experiment) -> Result<(), Failure> {
        check_experiment(experiment)?;
        self.now.time = experiment.start;
        self.now.experiment = experiment;
        self.now.model.setup_experiment(experiment);
        self.now.stale = true;
        Ok(())
    }

    /// Ends Initialization Mode: the model computes its start.
    pub fn exit_initialization_mode(&mut self) -> Result<(), Failure> {
        self.calculate()?;
        self.now.model.initialize(&mut self.logger.log())?;
        self.now.phase = if self.purpose.has(Phase::EventMode) { Phase::EventMode } else { Phase::StepMode };
        Ok(())
    }

    /// Goes to a phase. It can only be out of reach if it is Event Mode: [`call`](Self::call) has refused
    /// the functions for the other kind of instance.
    pub fn enter(&mut self, phase: Phase) -> Result<(), Failure> {
        if !self.purpose.has(phase) {
            return Err("the instance was made with eventModeUsed = fmi3False".into());
        }
        self.now.phase = phase;
        Ok(())
    }

    /// Resets everything to its state after instantiation, except the log categories and the saved states.
    pub fn reset(&mut self) {
        self.now = self.fresh.clone();
        self.last_step = Status::Ok;
    }

    /// Computes what depends on values set before the start, before values are read.
    fn calculate(&mut self) -> Result<(), Failure> {
        if self.now.stale && self.now.phase.is_before_the_start() {
            self.now.model.calculate()?;
            self.now.stale = false;
        }
        Ok(())
    }
}

fn check_experiment(Experiment { tolerance, start, stop }: Experiment) -> Result<(), Failure> {
    if let Some(tolerance) = tolerance.filter(|tolerance| !(tolerance.is_finite() && *tolerance > 0.0)) {
        return Err(Failure(format!("tolerance = {tolerance:?} is not finite and above 0")));
    }
    if !start.is_finite() {
        return Err(Failure(format!("startTime = {start:?} s is not finite")));
    }
    match stop.filter(|stop| !(stop.is_finite() && *stop >= start)) {
        Some(stop) => Err(Failure(format!(
            "stopTime = {stop:?} s is not finite and at or after startTime = {start:?} s"
        ))),
        None => Ok(()),
    }
}
