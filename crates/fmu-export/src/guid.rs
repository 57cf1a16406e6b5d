//! Checks that description, library and payload belong together.

use crate::model::{Failure, Model};
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

/// Fowler–Noll–Vo hash FNV-1a, 128 bits: a fingerprint, no protection against intent. The
/// guid of a model description and of a payload are such hashes.
pub fn fnv1a_128(bytes: impl Iterator<Item = u8>) -> u128 {
    const OFFSET_BASIS: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    bytes.fold(OFFSET_BASIS, |hash, byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME))
}

/// FNV-1a, 64 bits. Each step is a bijection of the hash, so every change of a single byte changes it.
pub(crate) fn fnv1a_64(bytes: &[u8]) -> u64 {
    const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01b3;
    bytes.iter().fold(OFFSET_BASIS, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hashes_agree_with_published_values() {
        assert_eq!(fnv1a_128(b"".iter().copied()), 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
        assert_eq!(fnv1a_128(b"a".iter().copied()), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
        assert_eq!(fnv1a_128(b"foobar".iter().copied()), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
        assert_eq!(fnv1a_64(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a_64(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a_64(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
