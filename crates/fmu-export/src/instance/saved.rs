//! Saved states.

use super::{Instance, Purpose, Snapshot, check_experiment};
use crate::call::Phase;
use crate::failure::Failure;
use crate::log::Status;
use crate::model::Model;
use crate::state::{self, StateCodec};

/// A handle is the address of a state in `saved`.
impl<M: Model> Instance<M> {
    /// Saves the state under the handle `reuse`, or a new one if that is 0. Returns the handle.
    pub fn save(&mut self, reuse: usize) -> Result<usize, Failure> {
        if reuse == 0 {
            return Ok(self.keep(self.now.clone()));
        }
        let snapshot = self.now.clone();
        **self.saved.get_mut(&reuse).ok_or_else(unknown_state)? = snapshot;
        Ok(reuse)
    }

    /// Goes back to a saved state.
    pub fn restore(&mut self, handle: usize) -> Result<(), Failure> {
        self.now = Snapshot::clone(self.saved.get(&handle).ok_or_else(unknown_state)?);
        self.last_step = Status::Ok;
        Ok(())
    }

    /// Frees a saved state; 0 is none.
    pub fn forget(&mut self, handle: usize) -> Result<(), Failure> {
        self.saved.remove(&handle).map(drop).ok_or_else(unknown_state)
    }

    /// Returns a saved state as bytes.
    pub fn serialize(&mut self, handle: usize) -> Result<Vec<u8>, Failure> {
        let snapshot = self.saved.get_mut(&handle).ok_or_else(unknown_state)?;
        state::seal(&self.guid, M::STATE_VERSION, |codec| snapshot.transfer(codec, &self.purpose))
    }

    /// Takes up a state from bytes, and returns its handle.
    pub fn deserialize(&mut self, bytes: &[u8]) -> Result<usize, Failure> {
        let mut codec = state::open(&self.guid, M::STATE_VERSION, bytes)?;
        let mut snapshot = self.fresh.clone();
        snapshot.transfer(&mut codec, &self.purpose)?;
        codec.finish()?;
        Ok(self.keep(snapshot))
    }

    fn keep(&mut self, snapshot: Snapshot<M>) -> usize {
        let snapshot = Box::new(snapshot);
        let handle = std::ptr::from_ref(&*snapshot).addr();
        self.saved.insert(handle, snapshot);
        handle
    }
}

impl<M: Model> Snapshot<M> {
    fn transfer(&mut self, codec: &mut StateCodec<'_>, purpose: &Purpose<M>) -> Result<(), Failure> {
        // 0 for Model Exchange, 1 for co-simulation
        let kind_here = purpose.interface as u64;
        let (mut phase, mut kind) = (self.phase as u64, kind_here);
        codec.u64(&mut phase)?;
        codec.f64(&mut self.time)?;
        codec.bool(&mut self.stale)?;
        codec.u64(&mut kind)?;
        let saved = Phase::SAVED.into_iter().find(|saved| *saved as u64 == phase);
        self.phase = saved.ok_or("the state is of no known phase")?;
        if kind != kind_here || !purpose.has(self.phase) {
            return Err("the state is of another kind of instance, Model Exchange or co-simulation".into());
        }
        self.experiment.transfer(codec)?;
        check_experiment(self.experiment)?;
        self.model.transfer_state(codec)
    }
}

fn unknown_state() -> Failure {
    "this instance did not make the FMUstate, or has freed it; serialize a state to take it to another \
     instance"
        .into()
}
