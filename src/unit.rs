//! The wall as an FMI model: a wall between the FMI calls.

mod model;
mod model_exchange;
mod scene;
mod state;

use std::cell::Cell;
use std::sync::Arc;

use fmu_export::{Experiment, Failure, Input, Kind, Log, Step as CommunicationStep, VariableId, check_real};

use crate::simulation::{Excitation, Outputs, Progress, Simulation, Step, segment_of};
use crate::solver::{Demands, Segment};
use crate::variables::{RealVariable, real_calculated, real_local, real_output, real_parameter};
use crate::wall::{Ends, Parameters, Support, Wall};

use model_exchange::Exchange;

pub use scene::UnitScene;

/// A wall between the FMI calls.
#[derive(Clone, Debug)]
pub struct Unit {
    parameters: Parameters,
    excitation: Option<Arc<Excitation>>,
    inputs: Inputs,
    experiment: Experiment,
    /// The simulation of the wall. While parameters may change, it is at its start.
    simulation: Simulation,
    /// Initialisation is over.
    running: bool,
    impulses: Ends,
    /// What only Model Exchange stores; `None` in co-simulation.
    exchange: Option<Exchange>,
    /// The outputs at the present state and inputs, once needed.
    outputs: Cell<Option<Outputs>>,
    /// Whether the warnings about an unused `a_top` and about a forgotten start are given or ruled out.
    warned: [bool; 2],
    /// The scene of the unit states where the wall starts.
    has_scene: bool,
}

impl Unit {
    fn new(
        parameters: Parameters,
        excitation: Option<Arc<Excitation>>,
        exchange: Option<Exchange>,
    ) -> Result<Self, Failure> {
        let simulation = start_simulation(&parameters, Experiment::default(), Support::default())?;
        let mut unit = Self {
            parameters,
            excitation,
            inputs: Inputs::default(),
            experiment: Experiment::default(),
            simulation,
            running: false,
            impulses: Ends::default(),
            exchange,
            outputs: Cell::new(None),
            warned: [false; 2],
            has_scene: false,
        };
        unit.prepare()?;
        Ok(unit)
    }

    /// Builds the wall at its start from the present parameters and inputs, unless initialisation is over.
    fn prepare(&mut self) -> Result<(), Failure> {
        if self.running {
            return Ok(());
        }
        let own = segment_of(self.excitation.as_deref(), 0.0, 0.0).from;
        let support = self.inputs.support(own, 0.0);
        self.simulation = start_simulation(&self.parameters, self.experiment, support)?;
        self.refresh();
        Ok(())
    }

    /// Returns the scene's own motion at the present time.
    fn own_support(&self) -> Support {
        let elapsed = self.simulation.progress().time - self.experiment.start;
        if let (Some(exchange), true) = (&self.exchange, self.running) {
            return exchange.own_motion.at(elapsed);
        }
        segment_of(self.excitation.as_deref(), elapsed, 0.0).from
    }

    /// Returns the present motion of the supports.
    fn support(&self) -> Support {
        self.inputs.support(self.own_support(), 0.0)
    }

    fn outputs(&self) -> Outputs {
        let outputs = self.outputs.get().unwrap_or_else(|| self.simulation.outputs(self.support()));
        self.outputs.set(Some(outputs));
        outputs
    }

    /// Forgets the outputs after a change of state or inputs.
    fn refresh(&mut self) {
        self.outputs.set(None);
    }

    fn wall(&self) -> &Wall {
        self.simulation.wall()
    }

    fn input(&mut self, variable: RealVariable) -> Option<&mut Input> {
        match variable {
            RealVariable::ABottom => Some(&mut self.inputs.bottom),
            RealVariable::ATop => Some(&mut self.inputs.top),
            RealVariable::Drift => Some(&mut self.inputs.drift),
            // a_g is held over a step
            RealVariable::AG | real_output!() | real_local!() | real_parameter!() | real_calculated!() => {
                None
            }
        }
    }

    /// Makes one communication step, through the samples of the scene's own motion. A step that may end early
    /// ends just after its first overturning or fracture; the time of its end is then returned. On an error
    /// the unit is as it was.
    fn advance(&mut self, mut step: CommunicationStep, log: &mut Log<'_>) -> Result<Option<f64>, Failure> {
        use RealVariable as V;
        let Inputs { bottom, top, drift, .. } = &self.inputs;
        for (of, Input { value, rate, .. }) in [(V::ABottom, bottom), (V::ATop, top), (V::Drift, drift)] {
            // a value without a rate was checked when it was set
            if *rate != 0.0 {
                check_real(of.variable(), value + rate * step.duration)?;
            }
        }
        // a step in one segment that fails leaves the wall as it was, and needs no copy
        let may_go_back = step.may_end_early || self.excitation.is_some();
        let before = may_go_back.then(|| *self.simulation.progress());
        let mut done = self.move_wall(step);
        let mut event = None;
        if step.may_end_early
            && let Some(before) = before
            && let Some(duration) = self.duration_to_event(&before, step)
        {
            self.simulation.restore(before);
            let early = self.move_wall(CommunicationStep { duration, ..step });
            if early.as_ref().is_ok_and(|done| done.overturned || done.fractures != [false; 2]) {
                (step.duration, event) = (duration, Some(step.from + duration));
                done = early;
            } else {
                self.simulation.restore(before);
                done = self.move_wall(step);
            }
        }
        if let (Err(_), Some(before)) = (&done, before) {
            self.simulation.restore(before);
        }
        let done = done?;
        self.impulses = done.impulses;
        let end = step.from + step.duration;
        self.simulation.set_time(end);
        for input in [&mut self.inputs.bottom, &mut self.inputs.top, &mut self.inputs.drift] {
            input.extrapolate(step.duration);
        }
        self.refresh();
        self.log_events(&done, [step.from, end], log);
        Ok(event)
    }

    /// Moves the wall through a step.
    fn move_wall(&mut self, step: CommunicationStep) -> Result<Step, Failure> {
        let Self { simulation, inputs, excitation, experiment, .. } = self;
        simulation.set_time(step.from);
        let (motion, start) = (excitation.as_deref(), experiment.start);
        let next = |simulation: &mut Simulation, _: Option<&mut Demands>, done: f64| {
            let remaining = step.duration - done;
            let own = segment_of(motion, simulation.progress().time - start, remaining);
            let (from, to) = (inputs.support(own.from, done), inputs.support(own.to, done + own.duration));
            (Segment { duration: own.duration, from, to }, remaining)
        };
        simulation.advance_through(next, None).map_err(|error| error.to_string().into())
    }

    /// Returns the length of the step up to just after its first overturning or fracture \[s\]; `None` where
    /// there is none inside the step. `before` is the progress at its start.
    fn duration_to_event(&self, before: &Progress, step: CommunicationStep) -> Option<f64> {
        let times = |progress: &Progress| {
            let [positive, negative] = progress.tie_breaks;
            [progress.overturn_time, positive, negative]
        };
        let happened = times(self.simulation.progress()).into_iter().zip(times(before));
        let new = happened.filter_map(|(now, before)| now.filter(|_| before.is_none()));
        let event = new.reduce(f64::min)?;
        let margin = HAPPENED_SINCE.max(4.0 * f64::EPSILON * event.abs());
        Some(event - step.from + margin).filter(|&duration| duration < step.duration)
    }

    #[cold]
    fn log_fractures(&self, done: &Step, [from, end]: [f64; 2], log: &mut Log<'_>) {
        let firsts = self.simulation.progress().tie_breaks;
        for (_, first) in done.fractures.into_iter().zip(firsts).filter(|(has_broken, _)| *has_broken) {
            match first.filter(|time| *time >= from - HAPPENED_SINCE) {
                Some(time) => log.event(format_args!("a tie broke at t = {time} s")),
                None => log.event(format_args!("another tie broke by t = {end} s")),
            }
        }
    }

    /// Logs what happened in a step between two times \[s\].
    fn log_events(&self, done: &Step, [from, end]: [f64; 2], log: &mut Log<'_>) {
        if done.put_to_rest {
            log.warning(format_args!("impacts accumulate: the wall was put to rest at u = 0 by t = {end} s"));
        }
        if done.overturned {
            let time = self.simulation.progress().overturn_time.unwrap_or(end);
            log.event(format_args!("overturned at t = {time} s: |u| exceeded u_ins"));
        }
        if done.fractures != [false; 2] {
            self.log_fractures(done, [from, end], log);
        }
        if done.departed {
            log.event(format_args!(
                "left the supports by t = {end} s: reactions and impulses are 0 from there on"
            ));
        }
    }

    /// Marks warnings that do not apply to these parameters and scene as given.
    fn choose_warnings(&mut self) {
        let is_strip = self.wall().body().is_strip();
        let is_start_value = self.parameters.u_start == Parameters::default().u_start;
        self.warned = [is_strip, self.has_scene || !is_start_value];
    }

    /// Warns once where `a_top` is given to a wall without a top support, and once where an input shakes a
    /// wall that the start value of `u_start` has displaced.
    fn warn_of_inputs(&mut self, log: &mut Log<'_>) {
        let [top_warned, start_warned] = &mut self.warned;
        if !*top_warned && self.inputs.top != Input::default() {
            *top_warned = true;
            log.warning(format_args!(
                "a_top is ignored: a {} has no top support; give its base motion in a_bottom or a_g",
                self.parameters.mechanism.name()
            ));
        }
        if !*start_warned && self.inputs != Inputs::default() {
            *start_warned = true;
            log.warning(format_args!(
                "the wall is shaken and was released from u_start = {start} m, the start value: for a wall \
                 that is at rest until then, set u_start = 0",
                start = self.parameters.u_start
            ));
        }
    }
}

/// Time from an event to the end of a step that ends early \[s\]: long enough that rounding cannot hide the
/// event.
const HAPPENED_SINCE: f64 = 1e-10;

fn start_simulation(
    parameters: &Parameters,
    experiment: Experiment,
    support: Support,
) -> Result<Simulation, Failure> {
    // an importer may ask for a tolerance below rounding, which no step would meet
    let tolerance = experiment.tolerance.map(|given| match RealVariable::Tolerance.variable().kind {
        Kind::Real { min: Some(least), .. } => given.max(least),
        _ => given,
    });
    Simulation::new(parameters, tolerance, experiment.start, support)
        .map_err(|error| Failure::from(error.to_string()))
}

/// The present inputs, and their rates for the next step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Inputs {
    /// Ground acceleration, held over a step \[m/s²\].
    ground: f64,
    bottom: Input,
    top: Input,
    drift: Input,
}

impl Inputs {
    /// Returns the supports' motion `ahead` seconds after the present, on top of the scene's `own`.
    fn support(&self, own: Support, ahead: f64) -> Support {
        let at = |input: &Input| input.value + input.rate * ahead;
        Support {
            bottom: own.bottom + self.ground + at(&self.bottom),
            top: own.top + self.ground + at(&self.top),
            drift: own.drift + at(&self.drift),
        }
    }

    fn rate(&self, pick: fn(&Input) -> f64) -> Support {
        Support { bottom: pick(&self.bottom), top: pick(&self.top), drift: pick(&self.drift) }
    }
}
