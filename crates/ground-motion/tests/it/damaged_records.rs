//! Tests that damaged records of every format are refused with a clear message.

use ground_motion::{Format, RecordOptions, Unit, parse_channels};
use proptest::prelude::*;

use crate::configuration::mostly;
use crate::record_formats::assert_clear;
use crate::specimen::{self, ALL, SAMPLES, mutated};

/// Damaged files cause no panic and no endless loop, and give a clear message unless the damage leaves a
/// record.
#[test]
fn survives_damage() {
    let samples = prop::collection::vec(-900_i32..900, 2..40);
    mostly(0.85, (samples, specimen::edits(), any::<bool>()), |(samples, edits, printable)| {
        let samples: Vec<_> = samples.into_iter().map(f64::from).collect();
        let mut refused = 0;
        for (format, write) in ALL {
            let mut bytes = mutated(&write(&samples), &edits);
            if printable {
                // Printable bytes pass the check for text and reach the readers.
                let shown = |byte: &u8| matches!(byte, b'\n' | b' '..=b'~');
                bytes.iter_mut().filter(|byte| !shown(byte)).for_each(|byte| *byte = b'9');
            }
            for format in [None, Some(format)] {
                let unit = Some(Unit::CentimetrePerSecondSquared);
                let options = RecordOptions { format, unit, ..RecordOptions::default() };
                if let Err(error) = parse_channels("x", bytes.clone(), &options) {
                    assert_clear(&error.to_string(), "damaged");
                    refused += 1;
                }
            }
        }
        Ok([refused, 2 * ALL.len()])
    });
}

/// Random bytes, read as every format, cause no panic and no endless loop either.
#[test]
fn survives_any_bytes() {
    let cases = (prop::collection::vec(any::<u8>(), 0..2000), "[ -~\n\t]{0,2000}");
    mostly(0.99, cases, |(bytes, text)| {
        let mut refused = 0;
        for (format, write) in ALL {
            let options = RecordOptions {
                format: Some(format),
                unit: Some(Unit::CentimetrePerSecondSquared),
                step: Some(0.01),
                ..RecordOptions::default()
            };
            let head: String = write(&SAMPLES).lines().take(12).map(|line| line.to_owned() + "\n").collect();
            let spliced = [head.as_bytes(), text.as_bytes()].concat();
            for bytes in [bytes.clone(), text.clone().into_bytes(), spliced] {
                if let Err(error) = parse_channels("x", bytes, &options) {
                    assert_clear(&error.to_string(), "any bytes");
                    refused += 1;
                }
            }
        }
        Ok([refused, 3 * ALL.len()])
    });
}

/// Without a specimen nothing would test the reader of a format. Plain numbers are samples alone.
#[test]
fn every_format_has_a_specimen() {
    for format in Format::ALL.into_iter().filter(|format| *format != Format::Numbers) {
        let has_one = ALL.iter().any(|(own, _)| *own == format);
        assert!(has_one, "tests/it/specimen.rs: add a writer of {} to ALL", format.name());
    }
}
