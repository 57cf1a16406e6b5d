//! Checks that description, library and payload belong together.

use crate::failure::Failure;
use crate::hash::fnv1a_128;
use crate::model::Model;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

/// A payload larger than this [bytes] is refused instead of filling the memory.
const MAX_PAYLOAD: u64 = 1 << 28;

/// Compares the importer's guid with the model's, and returns the payload if the guid states one.
///
/// The guid is the model's own, `{base}`, or `{base-payload}`, where the second half is the hash of the file
/// [`Model::PAYLOAD`] in 32 hexadecimal digits.
pub(crate) fn check<M: Model>(guid: &str, resources: Option<&Path>) -> Result<Option<Vec<u8>>, Failure> {
    if guid == M::GUID {
        return Ok(None);
    }
    let base = M::GUID.trim_end_matches('}');
    let payload_hash = guid
        .strip_prefix(base)
        .and_then(|rest| rest.strip_prefix('-')?.strip_suffix('}'))
        .filter(|digits| digits.len() == 32 && digits.bytes().all(|digit| digit.is_ascii_hexdigit()))
        .and_then(|digits| u128::from_str_radix(digits, 16).ok());
    let Some(payload_hash) = payload_hash else {
        return Err(Failure(format!(
            "the guid {guid:?} is not that of this library, {:?}: take modelDescription.xml and library from \
             the same FMU",
            M::GUID
        )));
    };
    let Some(resources) = resources else {
        return Err(Failure(format!(
            "the guid {guid:?} needs resources/{}, but the importer gave no usable resource location",
            M::PAYLOAD
        )));
    };
    let payload = read(&resources.join(M::PAYLOAD))?;
    let found = fnv1a_128(payload.iter().copied());
    if found != payload_hash {
        return Err(Failure(format!(
            "resources/{} has the fingerprint {found:032x}, but the guid {guid:?} states \
             {payload_hash:032x}: package the FMU again instead of changing its files",
            M::PAYLOAD
        )));
    }
    Ok(Some(payload))
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = fs::metadata(path).and_then(|found| {
        // Opening a pipe would block until something writes to it.
        if !found.is_file() {
            return Err(std::io::Error::other("it is not a regular file"));
        }
        File::open(path)?.take(MAX_PAYLOAD + 1).read_to_end(&mut bytes)
    });
    match read {
        Err(error) => {
            Err(Failure(format!("the guid needs {}, which cannot be read: {error}", path.display())))
        }
        Ok(length) if length as u64 > MAX_PAYLOAD => {
            Err(Failure(format!("{} is longer than {MAX_PAYLOAD} bytes", path.display())))
        }
        Ok(_) => Ok(bytes),
    }
}
