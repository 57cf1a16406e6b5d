//! Records in any format: read or refused, and what is read can be checked.
#![no_main]

use ground_motion::{RecordOptions, parse, parse_channels};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let options = RecordOptions::default();
    if let Ok(record) = parse("record", bytes.to_vec(), &options) {
        assert!(record.motion.samples().iter().all(|sample| sample.is_finite()));
        let _ = record.check();
    }
    let _ = parse_channels("record", bytes.to_vec(), &options);
});
