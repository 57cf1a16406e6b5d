//! Saved states as bytes.
//!
//! ```text
//! magic       8 bytes
//! version     u64
//! guid        u64 length, bytes
//! payload     u64 length, bytes: phase, time, kind, experiment and what the model wrote
//! checksum    u64, FNV-1a of all before
//! ```
//!
//! Numbers are little-endian and f64 go bit by bit, so that the same state gives the same bytes everywhere.

use crate::hash::fnv1a_64;
use crate::model::Failure;

const MAGIC: &[u8; 8] = b"FMI2stat";
/// Changes with the format of the envelope and of what the layer writes into the payload.
const VERSION: u64 = 2;
const CHECKSUM_LENGTH: usize = 8;

/// Takes the values of a state.
#[derive(Default, Debug)]
pub struct StateWriter {
    bytes: Vec<u8>,
}

impl StateWriter {
    /// Writes a number bit by bit, NaN and infinity included.
    pub fn f64(&mut self, value: f64) {
        self.u64(value.to_bits());
    }

    /// Writes a natural number.
    pub fn u64(&mut self, value: u64) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    /// Writes an integer.
    pub fn i32(&mut self, value: i32) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    /// Writes a truth value.
    pub fn bool(&mut self, value: bool) {
        self.bytes.push(u8::from(value));
    }

    /// Writes bytes with their count.
    pub fn bytes(&mut self, value: &[u8]) {
        self.u64(value.len() as u64);
        self.bytes.extend_from_slice(value);
    }
}

/// Gives back the values of a state in the order they were written.
#[derive(Debug)]
pub struct StateReader<'a> {
    rest: &'a [u8],
}

impl<'a> StateReader<'a> {
    /// The next number, bit by bit: it may be NaN or infinite.
    ///
    /// # Errors
    /// When the bytes end before.
    pub fn f64(&mut self) -> Result<f64, Failure> {
        self.u64().map(f64::from_bits)
    }

    /// The next natural number.
    ///
    /// # Errors
    /// When the bytes end before.
    pub fn u64(&mut self) -> Result<u64, Failure> {
        self.array().map(u64::from_le_bytes)
    }

    /// The next integer.
    ///
    /// # Errors
    /// When the bytes end before.
    pub fn i32(&mut self) -> Result<i32, Failure> {
        self.array().map(i32::from_le_bytes)
    }

    /// The next truth value.
    ///
    /// # Errors
    /// When the bytes end before, or are no truth value.
    pub fn bool(&mut self) -> Result<bool, Failure> {
        match self.array()? {
            [0] => Ok(false),
            [1] => Ok(true),
            [other] => Err(Failure(format!("the state has {other} where a truth value, 0 or 1, belongs"))),
        }
    }

    /// The next bytes that were written together.
    ///
    /// # Errors
    /// When the bytes end before.
    pub fn bytes(&mut self) -> Result<&'a [u8], Failure> {
        let length = self.u64()?;
        usize::try_from(length).map_err(|_| too_short()).and_then(|length| self.take(length))
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Failure> {
        let (array, rest) = self.rest.split_first_chunk().ok_or_else(too_short)?;
        self.rest = rest;
        Ok(*array)
    }

    fn take(&mut self, length: usize) -> Result<&'a [u8], Failure> {
        let (taken, rest) = self.rest.split_at_checked(length).ok_or_else(too_short)?;
        self.rest = rest;
        Ok(taken)
    }

    /// Ends the reading.
    ///
    /// # Errors
    /// When something was left over.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        if self.rest.is_empty() {
            Ok(())
        } else {
            Err(Failure(format!("the state has {} bytes more than this model reads", self.rest.len())))
        }
    }
}

fn too_short() -> Failure {
    Failure::from("the state is too short: bytes are missing")
}

/// What `write` writes, in its envelope.
pub(crate) fn seal(guid: &str, write: impl FnOnce(&mut StateWriter)) -> Vec<u8> {
    let mut payload = StateWriter::default();
    write(&mut payload);
    let mut writer = StateWriter { bytes: Vec::with_capacity(payload.bytes.len() + guid.len() + 40) };
    writer.bytes.extend_from_slice(MAGIC);
    writer.u64(VERSION);
    writer.bytes(guid.as_bytes());
    writer.bytes(&payload.bytes);
    writer.u64(fnv1a_64(&writer.bytes));
    writer.bytes
}

/// A reader of the payload in `bytes`, after the envelope has been checked against `guid`.
pub(crate) fn open<'a>(guid: &str, bytes: &'a [u8]) -> Result<StateReader<'a>, Failure> {
    let mut reader = StateReader { rest: bytes };
    if &reader.array()? != MAGIC {
        return Err("the bytes are no state of an instance of this library".into());
    }
    let version = reader.u64()?;
    if version != VERSION {
        return Err(Failure(format!("the state has format {version}, this library reads format {VERSION}")));
    }
    let state_guid = reader.bytes()?;
    if state_guid != guid.as_bytes() {
        let state_guid = String::from_utf8_lossy(state_guid);
        return Err(Failure(format!("the state is of guid {state_guid:?}, this instance has {guid:?}")));
    }
    let payload = reader.bytes()?;
    let checksum = reader.u64()?;
    reader.finish()?;
    let checked = &bytes[..bytes.len() - CHECKSUM_LENGTH];
    if checksum != fnv1a_64(checked) {
        return Err("the state is damaged: its checksum does not agree with its bytes".into());
    }
    Ok(StateReader { rest: payload })
}

#[cfg(test)]
mod tests {
    use super::*;

    const GUID: &str = "{0123}";

    fn sample() -> Vec<u8> {
        seal(GUID, |writer| {
            writer.f64(-0.0);
            writer.u64(u64::MAX);
            writer.i32(-7);
            writer.bool(true);
            writer.bytes(b"abc");
        })
    }

    #[test]
    fn what_was_written_is_read() {
        let bytes = sample();
        let mut reader = open(GUID, &bytes).unwrap();
        assert_eq!(reader.f64().unwrap().to_bits(), (-0.0_f64).to_bits());
        assert_eq!(reader.u64().unwrap(), u64::MAX);
        assert_eq!(reader.i32().unwrap(), -7);
        assert!(reader.bool().unwrap());
        assert_eq!(reader.bytes().unwrap(), b"abc");
        assert!(reader.finish().is_ok());
    }

    #[test]
    fn every_damage_is_seen() {
        let bytes = sample();
        for at in 0..bytes.len() {
            assert!(open(GUID, &bytes[..at]).is_err(), "cut at {at}");
            for flip in 1..=u8::MAX {
                let mut damaged = bytes.clone();
                damaged[at] ^= flip;
                assert!(open(GUID, &damaged).is_err(), "byte {at} flipped by {flip}");
            }
        }
        assert!(open(GUID, &[&bytes[..], &[0]].concat()).is_err());
        assert!(open("{0124}", &bytes).is_err());
    }

    #[test]
    fn a_length_beyond_the_end_is_refused() {
        let bytes = seal(GUID, |writer| writer.u64(u64::MAX));
        assert!(open(GUID, &bytes).unwrap().bytes().is_err());
    }

    #[test]
    fn what_is_left_over_is_refused() {
        let bytes = sample();
        assert!(open(GUID, &bytes).unwrap().finish().is_err());
    }

    #[test]
    fn a_truth_value_is_0_or_1() {
        let bytes = seal(GUID, |writer| writer.bytes.push(2));
        assert!(open(GUID, &bytes).unwrap().bool().is_err());
    }
}
