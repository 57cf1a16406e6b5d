//! Saved states.

use super::{Instance, Snapshot};
use crate::call::Phase;
use crate::log::Status;
use crate::model::{Experiment, Failure, Interface, Model};
use crate::state::{self, StateReader, StateWriter};

/// A handle is the address of a state in `saved`.
impl<M: Model> Instance<M> {
    /// Saves the state under the handle `reuse`, or a new one if that is 0. Returns the handle.
    pub(crate) fn save(&mut self, reuse: usize) -> Result<usize, Failure> {
        if reuse == 0 {
            return Ok(self.keep(self.now.clone()));
        }
        let snapshot = self.now.clone();
        **self.saved.get_mut(&reuse).ok_or_else(unknown_state)? = snapshot;
        Ok(reuse)
    }

    pub(crate) fn restore(&mut self, handle: usize) -> Result<(), Failure> {
        let snapshot = Snapshot::clone(self.find_saved(handle)?);
        self.now = snapshot;
        self.last_step = Status::Ok;
        Ok(())
    }

    pub(crate) fn forget(&mut self, handle: usize) -> Result<(), Failure> {
        self.saved.remove(&handle).map(drop).ok_or_else(unknown_state)
    }

    pub(crate) fn serialize(&self, handle: usize) -> Result<Vec<u8>, Failure> {
        let snapshot = self.find_saved(handle)?;
        Ok(state::seal(&self.guid, |writer| snapshot.write(writer)))
    }

    pub(crate) fn deserialize(&mut self, bytes: &[u8]) -> Result<usize, Failure> {
        let mut reader = state::open(&self.guid, bytes)?;
        let mut snapshot = self.fresh.clone();
        snapshot.read(&mut reader)?;
        reader.finish()?;
        Ok(self.keep(snapshot))
    }

    fn keep(&mut self, snapshot: Snapshot<M>) -> usize {
        let snapshot = Box::new(snapshot);
        let handle = std::ptr::from_ref(&*snapshot).addr();
        self.saved.insert(handle, snapshot);
        handle
    }

    fn find_saved(&self, handle: usize) -> Result<&Snapshot<M>, Failure> {
        self.saved.get(&handle).map(Box::as_ref).ok_or_else(unknown_state)
    }
}

impl<M: Model> Snapshot<M> {
    fn write(&self, writer: &mut StateWriter) {
        writer.u64(self.phase.number());
        writer.f64(self.time);
        writer.bool(self.stale);
        writer.u64(interface_number(self.interface));
        let Experiment { tolerance, start, stop } = self.experiment;
        writer.f64(start);
        for bound in [tolerance, stop] {
            writer.bool(bound.is_some());
            writer.f64(bound.unwrap_or(0.0));
        }
        self.model.write_state(writer);
    }

    fn read(&mut self, reader: &mut StateReader<'_>) -> Result<(), Failure> {
        self.phase = Phase::from_number(reader.u64()?).ok_or("the state is of no known phase")?;
        self.time = reader.f64()?;
        self.stale = reader.bool()?;
        if reader.u64()? != interface_number(self.interface) || !self.phase.belongs_to(self.interface) {
            return Err("the state is of another kind of instance, Model Exchange or co-simulation".into());
        }
        let start = reader.f64()?;
        let mut bound = || Ok::<_, Failure>((reader.bool()?, reader.f64()?));
        let tolerance = bound().map(|(is_some, value)| is_some.then_some(value))?;
        let stop = bound().map(|(is_some, value)| is_some.then_some(value))?;
        self.experiment = Experiment { tolerance, start, stop };
        if !(self.time.is_finite() && start.is_finite()) {
            return Err("the state has a time that is not finite".into());
        }
        self.model.read_state(reader)
    }
}

fn interface_number(interface: Interface) -> u64 {
    match interface {
        Interface::ModelExchange => 0,
        Interface::CoSimulation => 1,
    }
}

fn unknown_state() -> Failure {
    "the FMUstate is none that this instance made, or was freed; serialize a state to take it to another instance".into()
}
