//! Records in any format, and spectra: read or refused, and what is read can be checked.
#![no_main]

use ground_motion::{RecordOptions, SpectrumFile, Unit, parse, parse_channels};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // most text tables state no unit, and a single column has no step
    let (unit, step) = (Some(Unit::CentimetrePerSecondSquared), Some(0.01));
    let for_text = RecordOptions { unit, step, ..RecordOptions::default() };
    let for_table = RecordOptions { unit, ..RecordOptions::default() };
    for options in [RecordOptions::default(), for_table, for_text] {
        if let Ok(record) = parse("record", bytes.to_vec(), &options) {
            assert!(record.motion.samples().iter().all(|sample| sample.is_finite()));
            let _ = record.check();
        }
        let _ = parse_channels("record", bytes.to_vec(), &options);
    }
    if let Ok(spectrum) = SpectrumFile::parse("spectrum", bytes.to_vec(), unit, None) {
        assert!(spectrum.points.len() == spectrum.lines.len());
    }
});
