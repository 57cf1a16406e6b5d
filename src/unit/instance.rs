//! A wall between the FMI calls.

use std::cell::Cell;
use std::sync::Arc;

use fmu_export::{Experiment, Failure, Kind, Log, Step as CommunicationStep, VariableId};

use crate::choices::Mechanism;
use crate::simulation::{Excitation, Outputs, Simulation, segment_of};
use crate::solver::Segment;
use crate::variables::RealVariable;
use crate::wall::{Ends, Parameters, Support, Wall};

use super::exchange::Exchange;
use super::inputs::{Input, Inputs};

/// A wall between the FMI calls.
#[derive(Clone, Debug)]
pub struct Unit {
    pub(super) parameters: Parameters,
    pub(super) excitation: Option<Arc<Excitation>>,
    pub(super) inputs: Inputs,
    pub(super) experiment: Experiment,
    /// The wall. While parameters may change, it is at its start.
    pub(super) simulation: Simulation,
    /// Initialisation is over.
    pub(super) running: bool,
    pub(super) impulses: Ends,
    /// What Model Exchange adds; none in co-simulation.
    pub(super) exchange: Option<Exchange>,
    /// The outputs at the present state and inputs, once needed.
    outputs: Cell<Option<Outputs>>,
    pub(super) top_ignored_told: bool,
}

impl Unit {
    pub(super) fn new(
        parameters: Parameters,
        excitation: Option<Arc<Excitation>>,
        exchange: Option<Exchange>,
    ) -> Result<Self, Failure> {
        let simulation = start(&parameters, Experiment::default(), Support::default())?;
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
            top_ignored_told: false,
        };
        unit.prepare()?;
        Ok(unit)
    }

    /// Builds the wall at its start from the present parameters and inputs, unless initialisation is over.
    pub(super) fn prepare(&mut self) -> Result<(), Failure> {
        if self.running {
            return Ok(());
        }
        let own = segment_of(self.excitation.as_deref(), 0.0, 0.0).from;
        let support = self.inputs.support(own, 0.0);
        self.simulation = start(&self.parameters, self.experiment, support)?;
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
    pub(super) fn support(&self) -> Support {
        self.inputs.support(self.own_support(), 0.0)
    }

    pub(super) fn outputs(&self) -> Outputs {
        let outputs = self.outputs.get().unwrap_or_else(|| self.simulation.outputs(self.support()));
        self.outputs.set(Some(outputs));
        outputs
    }

    /// Forgets the outputs after a change of state or inputs.
    pub(super) fn refresh(&mut self) {
        self.outputs.set(None);
    }

    pub(super) fn wall(&self) -> &Wall {
        self.simulation.wall()
    }

    pub(super) fn input(&mut self, variable: RealVariable) -> Option<&mut Input> {
        match variable {
            RealVariable::ABottom => Some(&mut self.inputs.bottom),
            RealVariable::ATop => Some(&mut self.inputs.top),
            RealVariable::Drift => Some(&mut self.inputs.drift),
            _ => None,
        }
    }

    /// Makes one communication step, through the samples of the scene's own motion. On an error the unit is
    /// as it was.
    pub(super) fn advance(&mut self, step: CommunicationStep, log: &mut Log<'_>) -> Result<(), Failure> {
        let before = *self.simulation.progress();
        self.simulation.set_time(step.from);
        match self.follow(step, log) {
            Ok(impulses) => {
                self.impulses = impulses;
                self.simulation.set_time(step.from + step.duration);
                for input in [&mut self.inputs.bottom, &mut self.inputs.top, &mut self.inputs.drift] {
                    input.pass(step.duration);
                }
                self.refresh();
                Ok(())
            }
            Err(error) => {
                self.simulation.restore(before);
                Err(error)
            }
        }
    }

    /// Moves the wall through a step, and logs what happened.
    fn follow(&mut self, step: CommunicationStep, log: &mut Log<'_>) -> Result<Ends, Failure> {
        let (inputs, motion, start) = (self.inputs, self.excitation.as_deref(), self.experiment.start);
        let next = |time: f64, done: f64| {
            let remaining = step.duration - done;
            let own = segment_of(motion, time - start, remaining);
            let (from, to) = (inputs.support(own.from, done), inputs.support(own.to, done + own.duration));
            (Segment { duration: own.duration, from, to }, remaining)
        };
        let done = self.simulation.advance_through(next, None).map_err(|error| error.to_string())?;
        let end = step.from + step.duration;
        if done.put_to_rest {
            log.warning(format_args!("impacts accumulate: the wall was put to rest at u = 0 by t = {end} s"));
        }
        if done.overturned {
            let time = self.simulation.progress().overturn_time.unwrap_or(end);
            log.event(format_args!("overturned at t = {time} s: |u| exceeded u_ins"));
        }
        if done.departed {
            log.event(format_args!(
                "left the supports by t = {end} s: reactions and impulses are 0 from there on"
            ));
        }
        Ok(done.impulses)
    }

    /// Warns once where `a_top` is given to a wall without a top support.
    pub(super) fn warn_of_unused_top(&mut self, log: &mut Log<'_>) {
        let driven = self.inputs.top != Input::default();
        if driven && !self.top_ignored_told && self.parameters.mechanism == Mechanism::Parapet {
            self.top_ignored_told = true;
            log.warning(format_args!(
                "a_top is ignored: a parapet has no top support; give its base motion in a_bottom or a_g"
            ));
        }
    }
}

fn start(parameters: &Parameters, experiment: Experiment, support: Support) -> Result<Simulation, Failure> {
    // an importer may ask for less than rounding, which no step would reach
    let tolerance = experiment.tolerance.map(|given| match RealVariable::Tolerance.variable().kind {
        Kind::Real { min: Some(least), .. } => given.max(least),
        _ => given,
    });
    Simulation::new(parameters, tolerance, experiment.start, support)
        .map_err(|error| Failure::from(error.to_string()))
}
