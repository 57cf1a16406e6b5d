//! Vertical components, by the direction that a file or its name states.

use std::path::Path;

use crate::format::Format;
use crate::options::RecordOptions;

/// Returns whether one of the words of a direction, as files state it, means vertical.
pub(crate) fn is_vertical(direction: &str) -> bool {
    const VERTICAL: [&str; 11] =
        ["UP", "DOWN", "DN", "DWN", "UD", "U-D", "V", "VER", "VERT", "VERTICAL", "Z"];
    let mut words = direction.split(|c: char| !(c.is_alphanumeric() || c == '-'));
    words.any(|word| VERTICAL.iter().any(|vertical| word.eq_ignore_ascii_case(vertical)))
}

/// Returns whether the code of a channel is vertical: `HNZ` and any other of three letters that ends in Z, by
/// the rules of FDSN, or a word such as `UP`.
///
/// ```
/// use ground_motion::is_vertical_channel;
///
/// assert!(is_vertical_channel("HNZ") && is_vertical_channel("U-D") && !is_vertical_channel("HNE"));
/// ```
pub fn is_vertical_channel(code: &str) -> bool {
    is_vertical(code) || (code.len() == 3 && code.ends_with(['Z', 'z']))
}

/// Returns whether a file is vertical by its name or by that of the column that is read, where its format
/// states no direction: `…-UP.AT2`, `X.ABC..HNZ.csv`, the column `U-D`.
pub(crate) fn by_name(name: &str, format: Format, options: &RecordOptions) -> bool {
    if format.states_direction() {
        return false;
    }
    if let Some(column) = &options.column {
        return is_vertical(column) || is_channel(column);
    }
    let stem =
        Path::new(name).file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    // `V` of a table may be a velocity, and `up` a scale
    let is_direction = |word: &str| match format {
        Format::At2 => is_vertical(word),
        _ => is_vertical(word) && word.len() > 1 && !word.eq_ignore_ascii_case("UP"),
    };
    let last = stem.rsplit(['-', '_', '.', ' ']).next().unwrap_or_default();
    is_direction(last)
        || ["U-D", "DWN"].iter().any(|end| stem.to_ascii_uppercase().ends_with(end))
        || stem.split(['-', '_', '.', ' ']).any(is_channel)
}

/// Returns whether a word is a vertical channel of an accelerometer by the rules of FDSN, such as `HNZ`.
fn is_channel(word: &str) -> bool {
    let letters: [u8; 3] = word.to_ascii_uppercase().into_bytes().try_into().unwrap_or_default();
    matches!(letters, [b'B' | b'C' | b'E' | b'H' | b'S', b'L' | b'N' | b'G', b'Z'])
}
