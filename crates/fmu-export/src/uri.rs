//! The resource location that importers pass, as a path.

use std::path::PathBuf;

/// The folder a resource location means, without a trailing slash.
///
/// Importers pass `file:///p`, `file:/p`, `file://localhost/p` or a plain path; percent escapes count in URIs
/// only. None if it is empty, of another scheme, on another host, wrongly escaped, not UTF-8, or contains a
/// NUL.
pub fn path_from_location(location: &str) -> Option<PathBuf> {
    let text = match scheme(location) {
        None => location.to_owned(),
        Some(scheme) if scheme.eq_ignore_ascii_case("file") => {
            decode(local_part(&location[scheme.len() + 1..])?)?
        }
        Some(_) => return None,
    };
    if text.is_empty() || text.contains('\0') {
        return None;
    }
    let trimmed = text.trim_end_matches('/');
    Some(PathBuf::from(if trimmed.is_empty() { "/" } else { trimmed }))
}

/// The scheme of a URI (RFC 3986, section 3.1). One letter before the colon is a Windows drive.
fn scheme(location: &str) -> Option<&str> {
    let (scheme, _) = location.split_once(':')?;
    let letters = scheme.starts_with(|c: char| c.is_ascii_alphabetic())
        && scheme.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.'));
    (letters && scheme.len() > 1).then_some(scheme)
}

/// The path of a file URI without its scheme (RFC 8089), still escaped.
fn local_part(rest: &str) -> Option<&str> {
    let path = match rest.strip_prefix("//") {
        None => rest,
        Some(authority_and_path) => {
            let slash = authority_and_path.find('/')?;
            let (host, path) = authority_and_path.split_at(slash);
            // An importer that only puts "file://" before a Windows path makes its drive the host.
            let drive = host.len() == 2 && host.ends_with(':');
            if drive {
                return Some(authority_and_path);
            }
            (host.is_empty() || host.eq_ignore_ascii_case("localhost")).then_some(path)?
        }
    };
    // "/C:/folder" is a Windows path behind the slash that every URI has.
    let bytes = path.as_bytes();
    let drive = bytes.len() > 2 && bytes[0] == b'/' && bytes[1].is_ascii_alphabetic() && bytes[2] == b':';
    Some(if drive && cfg!(windows) { &path[1..] } else { path })
}

/// `text` with its percent escapes resolved.
fn decode(text: &str) -> Option<String> {
    let mut decoded = Vec::with_capacity(text.len());
    let mut bytes = text.bytes();
    while let Some(byte) = bytes.next() {
        decoded.push(match byte {
            b'%' => 16 * digit(bytes.next()?)? + digit(bytes.next()?)?,
            _ => byte,
        });
    }
    String::from_utf8(decoded).ok()
}

fn digit(byte: u8) -> Option<u8> {
    char::from(byte).to_digit(16).and_then(|digit| u8::try_from(digit).ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn check(location: &str, expected: Option<&str>) {
        assert_eq!(path_from_location(location).as_deref(), expected.map(Path::new), "{location:?}");
    }

    #[test]
    fn every_way_importers_write_a_folder_is_understood() {
        for location in
            ["file:///tmp/fmu/resources", "file:/tmp/fmu/resources", "file://localhost/tmp/fmu/resources"]
        {
            check(location, Some("/tmp/fmu/resources"));
        }
        check("FILE:///tmp/fmu/resources", Some("/tmp/fmu/resources"));
        check("/tmp/fmu/resources", Some("/tmp/fmu/resources"));
        check("/tmp/fmu/resources/", Some("/tmp/fmu/resources"));
        check("file:///tmp/fmu/resources//", Some("/tmp/fmu/resources"));
        check("file:///", Some("/"));
        check("relative/resources", Some("relative/resources"));
        check("file:///with%20blank/%C3%BCmlaut", Some("/with blank/ümlaut"));
        check("file:///with blank/ümlaut", Some("/with blank/ümlaut"));
        check("/plain/100%25/ü", Some("/plain/100%25/ü"));
        check("C:\\fmu\\resources", Some("C:\\fmu\\resources"));
        check("file://C:/fmu/resources", Some("C:/fmu/resources"));
        check("file:///C:/fmu", Some(if cfg!(windows) { "C:/fmu" } else { "/C:/fmu" }));
    }

    #[test]
    fn what_is_no_local_folder_is_refused() {
        for location in [
            "",
            "file:",
            "file://",
            "file://host",
            "file://host/share",
            "http://host/p",
            "jar:file:/p",
            "file:///p%",
            "file:///p%4",
            "file:///p%zz",
            "file:///p%+1",
            "file:///p%ff",
            "file:///p%00",
            "a\0b",
        ] {
            check(location, None);
        }
    }
}
