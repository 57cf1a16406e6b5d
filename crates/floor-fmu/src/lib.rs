//! The library of `floor.fmu`: the C functions of FMI 2.0 and 3.0, or on `wasm32-wasip2` the exports of the
//! component.

#[cfg(not(target_family = "wasm"))]
fmu_export::export_fmu!(rocking_floor::unit::Unit, co_simulation + model_exchange);

#[cfg(target_family = "wasm")]
fmu_component::export_component!(rocking_floor::unit::Unit);
