//! Model descriptions: read or refused.
#![no_main]

use fmu_export_build::Description;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(description) = Description::parse(text) {
        let _ = description.guid();
    }
});
