//! Saved states as bytes.
//!
//! ```text
//! magic       8 bytes
//! version     u64, of this format
//! guid        u64 length, bytes
//! version     u64, of what the model writes
//! payload     u64 length, bytes: phase, time, kind, experiment and what the model wrote
//! checksum    u64, FNV-1a of all before
//! ```
//!
//! Numbers are little-endian and f64 go bit by bit, so that the same state gives the same bytes everywhere.

use crate::failure::Failure;
use crate::hash::fnv1a_64;
use crate::limits;
use crate::variable::VariableId;

const MAGIC: &[u8; 8] = b"FMI2stat";
/// Version of the format: of the envelope and of what the layer writes into the payload.
const VERSION: u64 = 3;

/// Goes through the values of a state: writes each, or replaces it by the value that was written.
///
/// One list of the values serves both directions, so that writer and reader cannot get out of step.
#[derive(Debug)]
pub struct StateCodec<'a> {
    bytes: Bytes<'a>,
}

#[derive(Debug)]
enum Bytes<'a> {
    Write(&'a mut Vec<u8>),
    /// What has not been read yet.
    Read(&'a [u8]),
}

/// Each method writes or reads one value, or several of a kind.
///
/// # Errors
/// When the bytes to read end before, or are not a value of the type that the state can have.
#[allow(clippy::missing_errors_doc, reason = "the errors of all are above")]
impl<'a> StateCodec<'a> {
    /// Returns a codec that appends each value to `bytes`. The layer makes the codecs of an instance; this
    /// and [`reading`](Self::reading) are for the tests of a model.
    ///
    /// ```
    /// use fmu_export::StateCodec;
    ///
    /// let mut bytes = Vec::new();
    /// StateCodec::writing(&mut bytes).f64(&mut 2.5)?;
    /// let (mut codec, mut value) = (StateCodec::reading(&bytes), 0.0);
    /// codec.f64(&mut value)?;
    /// codec.finish()?;
    /// assert_eq!(value, 2.5);
    /// # Ok::<(), fmu_export::Failure>(())
    /// ```
    pub fn writing(bytes: &'a mut Vec<u8>) -> Self {
        Self { bytes: Bytes::Write(bytes) }
    }

    /// Returns a codec that reads values back in the order in which a [`writing`](Self::writing) one wrote
    /// them.
    pub fn reading(bytes: &'a [u8]) -> Self {
        Self { bytes: Bytes::Read(bytes) }
    }

    /// Returns whether values are being read. The values that depend on them must then be computed.
    pub fn is_reading(&self) -> bool {
        matches!(self.bytes, Bytes::Read(_))
    }

    /// A number bit by bit. NaN and infinity are not read.
    pub fn f64(&mut self, value: &mut f64) -> Result<(), Failure> {
        let mut bits = value.to_bits();
        self.u64(&mut bits)?;
        *value = f64::from_bits(bits);
        if self.is_reading() && !value.is_finite() {
            return Err(Failure(format!("the saved state holds {value:?} instead of a finite number")));
        }
        Ok(())
    }

    /// A Real parameter. It is read as it would be set: within its limits.
    pub fn real(&mut self, variable: impl VariableId, value: &mut f64) -> Result<(), Failure> {
        self.f64(value)?;
        if self.is_reading() { limits::check_real(variable.variable(), *value) } else { Ok(()) }
    }

    /// An Integer parameter. It is read as it would be set: within its limits.
    pub fn integer(&mut self, variable: impl VariableId, value: &mut i32) -> Result<(), Failure> {
        self.i32(value)?;
        if self.is_reading() {
            limits::check_integer(variable.variable(), (*value).into()).map(drop)
        } else {
            Ok(())
        }
    }

    /// Several numbers.
    pub fn f64s<'v>(&mut self, values: impl IntoIterator<Item = &'v mut f64>) -> Result<(), Failure> {
        values.into_iter().try_for_each(|value| self.f64(value))
    }

    /// A number that may be missing.
    pub fn option(&mut self, value: &mut Option<f64>) -> Result<(), Failure> {
        let (mut is_some, mut number) = (value.is_some(), value.unwrap_or(0.0));
        self.bool(&mut is_some)?;
        self.f64(&mut number)?;
        *value = is_some.then_some(number);
        Ok(())
    }

    /// A natural number.
    pub fn u64(&mut self, value: &mut u64) -> Result<(), Failure> {
        *value = u64::from_le_bytes(self.array(value.to_le_bytes())?);
        Ok(())
    }

    /// A count or an index.
    pub fn usize(&mut self, value: &mut usize) -> Result<(), Failure> {
        let mut number = *value as u64;
        self.u64(&mut number)?;
        *value =
            usize::try_from(number).map_err(|_| Failure(format!("the state has a count of {number}")))?;
        Ok(())
    }

    /// An integer.
    pub fn i32(&mut self, value: &mut i32) -> Result<(), Failure> {
        *value = i32::from_le_bytes(self.array(value.to_le_bytes())?);
        Ok(())
    }

    /// A truth value.
    pub fn bool(&mut self, value: &mut bool) -> Result<(), Failure> {
        *value = match self.array([u8::from(*value)])? {
            [0] => false,
            [1] => true,
            [other] => {
                return Err(Failure(format!(
                    "the saved state holds {other} instead of a truth value, 0 or 1"
                )));
            }
        };
        Ok(())
    }

    /// One of the items of `all`, as its position there.
    pub fn item<T: Copy + PartialEq>(&mut self, value: &mut T, all: &[T]) -> Result<(), Failure> {
        let mut index = all.iter().position(|item| item == value).unwrap_or(all.len());
        self.usize(&mut index)?;
        let item = all.get(index);
        *value = *item.ok_or_else(|| Failure(format!("the state has item {index} of {}", all.len())))?;
        Ok(())
    }

    /// A text with its length.
    pub fn text(&mut self, value: &mut String) -> Result<(), Failure> {
        let mut bytes = value.as_bytes().to_vec();
        self.bytes(&mut bytes)?;
        *value = String::from_utf8(bytes).map_err(|_| "the state has a text that is not UTF-8")?;
        Ok(())
    }

    /// Bytes with their count.
    pub fn bytes(&mut self, value: &mut Vec<u8>) -> Result<(), Failure> {
        match &mut self.bytes {
            Bytes::Write(bytes) => add_counted(bytes, value),
            Bytes::Read(rest) => *value = take_counted(rest)?.to_vec(),
        }
        Ok(())
    }

    fn array<const N: usize>(&mut self, value: [u8; N]) -> Result<[u8; N], Failure> {
        match &mut self.bytes {
            Bytes::Write(bytes) => bytes.extend(value),
            Bytes::Read(rest) => return take_array(rest),
        }
        Ok(value)
    }

    /// Ends the reading.
    ///
    /// # Errors
    /// When something was left over.
    pub fn finish(self) -> Result<(), Failure> {
        match self.bytes {
            Bytes::Read(rest) if !rest.is_empty() => {
                Err(Failure(format!("the state has {} bytes more than this model reads", rest.len())))
            }
            _ => Ok(()),
        }
    }
}

fn add_counted(bytes: &mut Vec<u8>, value: &[u8]) {
    bytes.extend((value.len() as u64).to_le_bytes());
    bytes.extend(value);
}

fn take_array<const N: usize>(rest: &mut &[u8]) -> Result<[u8; N], Failure> {
    let (array, behind) = rest.split_first_chunk().ok_or_else(too_short)?;
    *rest = behind;
    Ok(*array)
}

fn take_counted<'a>(rest: &mut &'a [u8]) -> Result<&'a [u8], Failure> {
    let count = u64::from_le_bytes(take_array(rest)?);
    let taken = usize::try_from(count).ok().and_then(|count| rest.split_at_checked(count));
    let (taken, behind) = taken.ok_or_else(too_short)?;
    *rest = behind;
    Ok(taken)
}

fn too_short() -> Failure {
    Failure::from("the state is too short: bytes are missing")
}

/// Returns what `write` writes, in its envelope with the guid of the instance and the version of what the
/// model writes ([`STATE_VERSION`](crate::Model::STATE_VERSION)).
pub(crate) fn seal(
    guid: &str,
    version: u64,
    write: impl FnOnce(&mut StateCodec<'_>) -> Result<(), Failure>,
) -> Result<Vec<u8>, Failure> {
    let mut payload = Vec::new();
    write(&mut StateCodec::writing(&mut payload))?;
    let mut bytes = MAGIC.to_vec();
    bytes.extend(VERSION.to_le_bytes());
    add_counted(&mut bytes, guid.as_bytes());
    bytes.extend(version.to_le_bytes());
    add_counted(&mut bytes, &payload);
    bytes.extend(fnv1a_64(&bytes).to_le_bytes());
    Ok(bytes)
}

/// Returns a reader of the payload in `bytes`, after the envelope has been checked against both.
pub(crate) fn open<'a>(guid: &str, version: u64, bytes: &'a [u8]) -> Result<StateCodec<'a>, Failure> {
    let mut rest = bytes;
    if &take_array(&mut rest)? != MAGIC {
        return Err("the bytes are not a state of an instance of this library".into());
    }
    check_version("format", u64::from_le_bytes(take_array(&mut rest)?), VERSION)?;
    let found = take_counted(&mut rest)?;
    if found != guid.as_bytes() {
        return Err(Failure(format!(
            "the state is of another version of this unit, or of another unit: its guid is {:?}, this \
             instance has {guid:?}; go on with the FMU that saved it",
            String::from_utf8_lossy(found)
        )));
    }
    check_version("model's state", u64::from_le_bytes(take_array(&mut rest)?), version)?;
    let payload = take_counted(&mut rest)?;
    let checked = &bytes[..bytes.len() - rest.len()];
    let checksum = u64::from_le_bytes(take_array(&mut rest)?);
    StateCodec::reading(rest).finish()?;
    if checksum != fnv1a_64(checked) {
        return Err("the state is damaged: its checksum does not agree with its bytes".into());
    }
    Ok(StateCodec::reading(payload))
}

fn check_version(of: &str, found: u64, expected: u64) -> Result<(), Failure> {
    if found == expected {
        return Ok(());
    }
    Err(Failure(format!(
        "the state has version {found} of the {of}, this library reads version {expected}; go on with the \
         FMU that saved it"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GUID: &str = "{0123}";

    #[derive(Clone, PartialEq, Debug, Default)]
    struct Sample(f64, u64, i32, bool, Vec<u8>);

    impl Sample {
        fn transfer(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
            codec.f64(&mut self.0)?;
            codec.u64(&mut self.1)?;
            codec.i32(&mut self.2)?;
            codec.bool(&mut self.3)?;
            codec.bytes(&mut self.4)
        }
    }

    fn sample() -> Vec<u8> {
        seal(GUID, 7, |codec| Sample(-0.0, u64::MAX, -7, true, b"abc".to_vec()).transfer(codec)).unwrap()
    }

    #[test]
    fn what_was_written_is_read() {
        let bytes = sample();
        let (mut reader, mut read) = (open(GUID, 7, &bytes).unwrap(), Sample::default());
        read.transfer(&mut reader).unwrap();
        assert_eq!(read.0.to_bits(), (-0.0_f64).to_bits());
        assert_eq!(read, Sample(-0.0, u64::MAX, -7, true, b"abc".to_vec()));
        assert!(reader.finish().is_ok());
    }

    #[test]
    fn every_damage_is_seen() {
        let bytes = sample();
        for at in 0..bytes.len() {
            assert!(open(GUID, 7, &bytes[..at]).is_err(), "cut at {at}");
            for flip in 1..=u8::MAX {
                let mut damaged = bytes.clone();
                damaged[at] ^= flip;
                assert!(open(GUID, 7, &damaged).is_err(), "byte {at} flipped by {flip}");
            }
        }
        assert!(open(GUID, 7, &[&bytes[..], &[0]].concat()).is_err());
    }

    #[test]
    fn a_state_of_another_version_is_refused_with_that_word() {
        let bytes = sample();
        let mut of_old_format = bytes.clone();
        of_old_format[MAGIC.len()] -= 1;
        let refused = |guid, version, bytes: &[u8], why: &str| {
            let Failure(message) = open(guid, version, bytes).unwrap_err();
            assert!(message.contains(why), "{message}");
        };
        refused(GUID, 7, &of_old_format, "version 2 of the format, this library reads version 3");
        refused("{0124}", 7, &bytes, "of another version of this unit");
        refused(GUID, 8, &bytes, "version 7 of the model's state, this library reads");
    }

    #[test]
    fn a_length_beyond_the_end_is_refused() {
        let bytes = seal(GUID, 7, |codec| codec.u64(&mut u64::MAX.clone())).unwrap();
        assert!(open(GUID, 7, &bytes).unwrap().bytes(&mut Vec::new()).is_err());
    }

    #[test]
    fn what_is_left_over_is_refused() {
        let bytes = sample();
        assert!(open(GUID, 7, &bytes).unwrap().finish().is_err());
    }

    #[test]
    fn a_truth_value_is_0_or_1() {
        let bytes = seal(GUID, 7, |codec| codec.array([2]).map(drop)).unwrap();
        assert!(open(GUID, 7, &bytes).unwrap().bool(&mut false).is_err());
    }
}
