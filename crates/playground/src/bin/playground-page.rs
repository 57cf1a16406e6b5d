//! Packs the page that computes into one file: `playground-page LIBRARY.wasm PAGE.html`.
//!
//! The library is compressed and written as text; the browser unpacks it. The page loads nothing else.

use std::error::Error;
use std::io::Write;
use std::{env, fs};

use figures::escaped;
use flate2::Compression;
use flate2::write::GzEncoder;

const TEMPLATE: &str = include_str!("../page/page.html");
/// Marks of the template, and what takes their place.
const PARTS: [(&str, &str); 4] = [
    ("{{style}}", include_str!("../page/page.css")),
    ("{{fields}}", include_str!("../page/fields.js")),
    ("{{wall}}", include_str!("../page/wall.js")),
    ("{{script}}", include_str!("../page/page.js")),
];
/// The same for texts, which are not markup.
const TEXTS: [(&str, &str); 3] = [
    ("{{notices}}", include_str!("../page/notices.txt")),
    ("{{mit}}", include_str!("../../../../LICENSE-MIT")),
    ("{{apache}}", include_str!("../../../../LICENSE-APACHE")),
];
const LIBRARY: &str = "{{library}}";
const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

fn main() -> Result<(), Box<dyn Error>> {
    let [library, page] =
        env::args().skip(1).collect::<Vec<_>>().try_into().map_err(|_| "two files, please")?;
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(&fs::read(&library).map_err(|error| format!("{library}: {error}"))?)?;
    let mut html = TEMPLATE.to_owned();
    for (mark, text) in PARTS {
        html = html.replacen(mark, text, 1);
    }
    for (mark, text) in TEXTS {
        html = html.replacen(mark, &escaped(text), 1);
    }
    let html = html.replacen(LIBRARY, &base64(&encoder.finish()?), 1);
    fs::write(&page, &html).map_err(|error| format!("{page}: {error}"))?;
    Ok(())
}

/// Encodes bytes in base 64, RFC 4648 section 4.
fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |index: usize| u32::from(group.get(index).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for digit in 0..4 {
            let value = bits >> (18 - 6 * digit) & 63;
            text.push(if digit <= group.len() { char::from(DIGITS[value as usize]) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    #[test]
    fn base64_is_that_of_the_rfc() {
        for (bytes, text) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(super::base64(bytes.as_bytes()), text);
        }
    }
}
