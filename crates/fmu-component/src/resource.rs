//! An instance that a host has a handle of.

use crate::bindings::fmi::fmi3::callbacks::log_message;
use crate::bindings::fmi::fmi3::types::Status;
use fmu_export::boundary::{Call, Instance, Logger, Purpose, check_count};
use fmu_export::{Category, Failure, Model, ModelExchange};
use std::cell::RefCell;
use std::panic;

/// An instance of the model. One call at a time has it.
pub(super) struct Resource<M: Model>(RefCell<Instance<M>>);

impl<M: ModelExchange> Resource<M> {
    /// Makes an instance; `None`, after a log, if token, folder or model refuse.
    pub(super) fn new(
        function: &str,
        [name, token, resources]: [String; 3],
        logging_on: bool,
        purpose: Purpose<M>,
        warning: Option<&str>,
    ) -> Option<Self> {
        panic::set_hook(Box::new(|information| {
            let message = format!("internal error, please report it: {information}");
            log_message("", Status::Fatal, Category::Fatal.name(), &message);
        }));
        let logger = || {
            let name = name.clone();
            let sink = move |weight, category: Category, message: &str| {
                log_message(&name, status(weight), category.name(), message);
            };
            Logger::new(Some(Box::new(sink)), logging_on)
        };
        if let Some(warning) = warning {
            logger().log().warning(warning);
        }
        let resources = Some(resources.as_bytes()).filter(|path| !path.is_empty());
        match Instance::new(&name, &token, resources, purpose, logger()) {
            Ok(instance) => Some(Self(RefCell::new(instance))),
            Err(failure) => {
                logger().log().error(format_args!("{function}: {failure}"));
                None
            }
        }
    }
}

impl<M: Model> Resource<M> {
    /// Runs `body`, if `call` is allowed in the present phase.
    pub(super) fn run(
        &self,
        call: Call,
        body: impl FnOnce(&mut Instance<M>) -> Result<(), Failure>,
    ) -> Status {
        // a call from inside the log is refused, as in C
        self.0.try_borrow_mut().map_or(Status::Error, |mut instance| status(instance.call(call, body)))
    }

    /// Returns what `body` returns, if `call` is allowed in the present phase.
    pub(super) fn ask<T>(
        &self,
        call: Call,
        body: impl FnOnce(&mut Instance<M>) -> Result<T, Failure>,
    ) -> Result<T, Status> {
        let mut answer = None;
        let status = self.run(call, |instance| {
            answer = Some(body(instance)?);
            Ok(())
        });
        answer.ok_or(status)
    }

    /// Returns `count` values that `write` writes.
    pub(super) fn values<T: Copy + Default>(
        &self,
        call: Call,
        count: usize,
        write: impl FnOnce(&mut Instance<M>, &mut [T]) -> Result<(), Failure>,
    ) -> Result<Vec<T>, Status> {
        self.ask(call, |instance| {
            let mut values = vec![T::default(); count];
            write(instance, &mut values)?;
            Ok(values)
        })
    }

    /// Runs `set`, if `call` is allowed in the present phase and there are as many values as references.
    pub(super) fn set<T>(
        &self,
        call: Call,
        references: &[u32],
        values: &[T],
        set: impl FnOnce(&mut Instance<M>) -> Result<(), Failure>,
    ) -> Status {
        self.run(call, |instance| {
            check_count("nValues", values.len(), references.len())?;
            set(instance)
        })
    }
}

/// Value references and orders of derivatives.
pub(super) fn references_and_orders(requests: &[(u32, u32)]) -> (Vec<u32>, Vec<i32>) {
    let order = |order| i32::try_from(order).unwrap_or(i32::MAX);
    requests.iter().map(|&(reference, of)| (reference, order(of))).unzip()
}

/// A status as the draft has it.
fn status(status: fmu_export::Status) -> Status {
    match status {
        fmu_export::Status::Ok => Status::Ok,
        fmu_export::Status::Warning => Status::Warning,
        fmu_export::Status::Discard => Status::Discard,
        fmu_export::Status::Error => Status::Error,
        fmu_export::Status::Fatal => Status::Fatal,
    }
}
