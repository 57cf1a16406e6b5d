//! Random calls of one instance, and what came of them.

use crate::arguments::{Arguments, MOST};
use crate::importer::Importer;
use crate::random::Random;
use fmu_export::ffi::types::{
    CO_SIMULATION, Component, DISCARD, ERROR, FmuState, MODEL_EXCHANGE, OK, Status,
};
use fmu_export::ffi::{Kinds, co_simulation as cs, common, fmi3, states, values};
use fmu_export::{ModelExchange, TIME_REFERENCE};
use std::fmt;
use std::ptr;
use std::time::Duration;

/// A call that takes more processor time is a fault. A segment may have 200,000 pieces of motion, which take
/// half a second; the segments of a step have fewer than twice as many. A busy computer takes twice as long.
const LONGEST: Duration = Duration::from_secs(2);
/// Draws of parameters until an instance starts; after them it starts with the defaults.
const DRAWS: u64 = 10;
/// Least shares of starts with drawn parameters and of calls that succeed: below, little is tried.
const LEAST_STARTED: f64 = 0.9;
const LEAST_SUCCEEDED: f64 = 0.5;

/// What calls came to.
#[derive(Debug, Default)]
pub struct Figures {
    calls: u64,
    errors: u64,
    starts: u64,
    /// Starts with drawn parameters.
    started: u64,
    longest: Duration,
    slow: u64,
    faults: Vec<String>,
}

impl Figures {
    /// Adds those of another instance.
    pub fn and(mut self, other: Self) -> Self {
        self.calls += other.calls;
        self.errors += other.errors;
        self.starts += other.starts;
        self.started += other.started;
        self.longest = self.longest.max(other.longest);
        self.slow += other.slow;
        self.faults.extend(other.faults);
        self
    }

    /// Whether there was no fault, and enough was tried.
    pub fn is_sound(&self) -> bool {
        let is_enough = self.share_started() >= LEAST_STARTED && self.share_succeeded() >= LEAST_SUCCEEDED;
        self.faults.is_empty() && is_enough && (self.slow == 0 || cfg!(debug_assertions))
    }

    fn share_started(&self) -> f64 {
        self.started as f64 / self.starts as f64
    }

    fn share_succeeded(&self) -> f64 {
        1.0 - self.errors as f64 / self.calls as f64
    }
}

impl fmt::Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { calls, starts, longest, slow, faults, .. } = self;
        let [started, succeeded] = [self.share_started(), self.share_succeeded()].map(|share| 100.0 * share);
        write!(f, "{calls} calls, {succeeded:.1} % succeeded (least {:.0} %); ", 100.0 * LEAST_SUCCEEDED)?;
        write!(f, "{starts} starts, {started:.1} % with drawn parameters (least ")?;
        write!(f, "{:.0} %); {} faults; the longest call took ", 100.0 * LEAST_STARTED, faults.len())?;
        write!(f, "{longest:.3?}, {slow} over {LONGEST:?}")?;
        faults.iter().take(10).try_for_each(|fault| write!(f, "\n  {fault}"))
    }
}

/// One instance after the other, with the states saved from the present one.
#[derive(Debug)]
pub struct Instance<M: ModelExchange> {
    scene: Option<(String, String)>,
    importer: Option<Importer<M>>,
    /// The instance is one for Model Exchange, and one of FMI 3.0.
    exchanges: bool,
    third: bool,
    arguments: Arguments,
    saved: Vec<FmuState>,
    bytes: Vec<u8>,
    figures: Figures,
}

// SAFETY: an instance and its states may be used by any thread, by one at a time.
unsafe impl<M: ModelExchange> Send for Instance<M> {}

impl<M: ModelExchange> Instance<M> {
    /// Prepares calls; `scene` holds the guid and the resources of a scene's FMU.
    pub fn new(scene: Option<(&str, &str)>, seed: u64) -> Self {
        let scene = scene.map(|(guid, folder)| (guid.to_owned(), folder.to_owned()));
        let arguments = Arguments { random: Random::new(seed), time: 0.0 };
        let (saved, bytes) = (Vec::new(), Vec::new());
        let (importer, figures) = (None, Figures::default());
        Self { scene, importer, exchanges: false, third: false, arguments, saved, bytes, figures }
    }

    /// Makes `count` calls.
    pub fn call(&mut self, count: u64) {
        for _ in 0..count {
            let start = processor_time();
            let status = self.call_once();
            let took = processor_time().saturating_sub(start);
            self.figures.calls += 1;
            self.figures.longest = self.figures.longest.max(took);
            self.figures.slow += u64::from(took > LONGEST);
            if status == ERROR {
                self.figures.errors += 1;
                // most calls after an error are refused: start again, mostly
                if !self.arguments.random.once_in(4) {
                    self.restart();
                }
            } else if status != OK && status != DISCARD {
                self.figures.faults.push(format!("status {status}"));
            }
            if let Some(importer) = &self.importer {
                self.figures.faults.append(&mut importer.journal.faults.borrow_mut());
            }
        }
    }

    /// Frees the instance, and returns the figures.
    pub fn end(mut self) -> Figures {
        self.importer = None;
        self.figures
    }

    fn replace(&mut self) -> Status {
        let random = &mut self.arguments.random;
        (self.exchanges, self.third) = (random.once_in(3), random.once_in(2));
        let kind = if self.exchanges { MODEL_EXCHANGE } else { CO_SIMULATION };
        let (guid, resources) = match &self.scene {
            Some((guid, folder)) => (guid.as_str(), Some(folder.as_str())),
            None => (M::GUID, None),
        };
        self.saved.clear();
        let [log, event_mode, early_return, updates] = [0; 4].map(|_| random.once_in(2));
        self.importer = if self.third {
            Importer::fmi3(guid, resources, [self.exchanges, log, event_mode, early_return, updates])
        } else {
            Importer::new(&Kinds::<M>::BOTH, kind, guid, resources, log)
        };
        self.arguments.time = 0.0;
        if self.importer.is_none() {
            self.figures.faults.push("there is no instance".into());
        }
        OK
    }

    /// Brings the instance back, mostly as far as it can step.
    fn restart(&mut self) {
        let Some(importer) = &self.importer else { return };
        let c = importer.component();
        self.arguments.time = 0.0;
        // SAFETY: the instance lives.
        unsafe { common::reset::<M>(c) };
        if self.arguments.random.once_in(3) {
            return;
        }
        self.figures.starts += 1;
        if (0..DRAWS).any(|_| self.starts(c, true)) {
            self.figures.started += 1;
        } else if !self.starts(c, false) {
            self.figures.faults.push("the defaults do not start".into());
        }
        if self.third && !self.exchanges && self.arguments.random.once_in(2) {
            // SAFETY: the instance lives.
            unsafe { fmi3::enter_step_mode::<M>(c) };
        }
    }

    /// Initializes an instance from its reset, with drawn parameters or as it is, and returns whether it took
    /// them.
    fn starts(&mut self, c: Component, with_drawn: bool) -> bool {
        // SAFETY: the instance lives.
        unsafe {
            common::reset::<M>(c);
            if with_drawn && self.arguments.parameters::<M>(c) != OK {
                return false;
            }
            if self.third {
                fmi3::start_initialization::<M>(c, false, 0.0, 0.0, false, 0.0);
            } else {
                common::enter_initialization_mode::<M>(c);
            }
            common::exit_initialization_mode::<M>(c) == OK
        }
    }

    fn call_once(&mut self) -> Status {
        let Some(importer) = self.importer.as_ref().filter(|_| !self.arguments.random.once_in(2000)) else {
            return self.replace();
        };
        let c = importer.component();
        let arguments = &mut self.arguments;
        // functions of the other kind are refused: few of them
        let other = arguments.random.once_in(200);
        match arguments.random.below(100) {
            0..8 => self.state(c),
            8..14 if self.third => arguments.modes3::<M>(c),
            8..14 => arguments.modes::<M>(c),
            14..64 if self.exchanges == other && self.third => arguments.step3::<M>(c),
            14..64 if self.exchanges == other => arguments.step::<M>(c),
            14..64 if self.third && arguments.random.once_in(4) => arguments.update3::<M>(c),
            14..64 => arguments.exchange::<M>(c),
            64..76 => arguments.set_real::<M>(c),
            76..80 if self.third => arguments.other_values3::<M>(c),
            76..80 => arguments.other_values::<M>(c),
            _ if self.third => {
                let (status, fault) = arguments.read3::<M>(c);
                self.figures.faults.extend(fault);
                status
            }
            80..90 => {
                let (status, fault) = arguments.get_real::<M>(c);
                self.figures.faults.extend(fault);
                status
            }
            _ => {
                let (status, fault) = arguments.derivatives::<M>(c);
                self.figures.faults.extend(fault);
                status
            }
        }
    }

    /// Saves, restores, frees, writes and reads a state.
    fn state(&mut self, c: Component) -> Status {
        let random = &mut self.arguments.random;
        let mut state = match self.saved.len() {
            0 => ptr::null_mut(),
            count => self.saved[random.below(count)],
        };
        let mut size = 0;
        // SAFETY: the instance lives; arrays are as long as stated; states are never followed.
        unsafe {
            match random.below(6) {
                0 if self.saved.len() < MOST => {
                    state = ptr::null_mut();
                    let status = states::get_fmu_state::<M>(c, &mut state);
                    self.saved.push(state);
                    status
                }
                1 => states::get_fmu_state::<M>(c, &mut state),
                2 => {
                    let status = states::set_fmu_state::<M>(c, state);
                    let time = &mut self.arguments.time;
                    if self.third {
                        values::get_float64::<M>(c, &TIME_REFERENCE, 1, time, 1);
                    } else {
                        cs::get_real_status::<M>(c, 2, time);
                    }
                    status
                }
                3 => {
                    self.saved.retain(|&other| other != state);
                    states::free_fmu_state::<M>(c, &mut state)
                }
                4 => {
                    let status = states::serialized_fmu_state_size::<M>(c, state, &mut size);
                    self.bytes.resize(size, 0);
                    let bytes = self.bytes.as_mut_ptr();
                    if status == OK {
                        states::serialize_fmu_state::<M>(c, state, bytes, size)
                    } else {
                        status
                    }
                }
                _ => {
                    if random.once_in(4) && !self.bytes.is_empty() {
                        let at = random.below(self.bytes.len());
                        self.bytes[at] ^= 1 << random.below(8);
                    }
                    let bytes = self.bytes.as_ptr();
                    let status = states::de_serialize_fmu_state::<M>(c, bytes, self.bytes.len(), &mut state);
                    if status == OK && self.saved.len() < MOST {
                        self.saved.push(state);
                    }
                    status
                }
            }
        }
    }
}

/// Processor time of this thread, which other programs do not delay.
fn processor_time() -> Duration {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the clock writes one time.
    unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut time) };
    Duration::new(time.tv_sec.unsigned_abs(), time.tv_nsec as u32)
}
