//! The layer through the C functions that a model exports.

#![allow(unsafe_code, reason = "these tests stand where C stands")]
#![allow(
    missing_docs,
    unreachable_pub,
    clippy::borrow_as_ptr,
    clippy::unwrap_used,
    reason = "of no use in tests"
)]

mod allocator;
mod derivatives;
mod exchange;
mod fmi3_order;
mod fmi3_values;
mod importer;
mod instantiation;
mod logs;
mod not_announced;
mod nulls;
mod order;
mod panics;
mod reentry;
mod resources;
mod spring;
mod states;
mod steps;
mod tolerated;
mod values;

#[global_allocator]
static ALLOCATOR: allocator::Counting = allocator::Counting;

fmu_export::export_fmu!(crate::spring::Spring, co_simulation + model_exchange);
