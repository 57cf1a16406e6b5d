//! Study files: read or refused.
#![no_main]

use libfuzzer_sys::fuzz_target;
use reliability::Codes;
use study::document::StudyFile;

fuzz_target!(|text: &str| {
    let _ = StudyFile::parse("study.toml", text, &Codes);
});
