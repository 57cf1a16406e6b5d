//! The guid of a description: a hash of its text, the same on every machine.

use fmu_export::fnv1a_128;

/// The guid of the description `xml`: 32 hexadecimal digits in braces.
///
/// Line ends count as `\n`, the guid's own value as empty and annotations of variables as not there, so that
/// writing the text into an FMU, or checking it out elsewhere, does not change it.
pub fn fingerprint(xml: &str) -> String {
    let text = without_annotations(&xml.replace("\r\n", "\n"));
    format!("{{{:032x}}}", fnv1a_128(with_guid(&text, "").bytes()))
}

/// The text `xml` without the annotations of its variables: the build alone needs them, and some importers
/// refuse them.
pub(crate) fn without_annotations(xml: &str) -> String {
    const END: &str = "</Annotations>";
    let mut text = String::with_capacity(xml.len());
    let mut rest = xml;
    while let Some((before, annotation)) = rest.split_once("<Annotations>") {
        let Some((_, after)) = annotation.split_once(END) else { break };
        text.push_str(before.trim_end());
        rest = after;
    }
    text + rest
}

/// The text `xml` with `guid` as the value of its first guid attribute; the rest stays as it is.
pub(crate) fn with_guid(xml: &str, guid: &str) -> String {
    match guid_range(xml) {
        Some(range) => format!("{}{guid}{}", &xml[..range.start], &xml[range.end..]),
        None => xml.to_owned(),
    }
}

/// Where the value of the guid attribute of the root element is.
fn guid_range(xml: &str) -> Option<std::ops::Range<usize>> {
    let root = xml.find("<fmiModelDescription")?;
    // A description may mention the guid in a text: only a name after white space counts.
    let mut from = root;
    let name = loop {
        let at = from + xml[from..].find("guid")?;
        from = at + "guid".len();
        let before = xml[..at].ends_with(|c: char| c.is_ascii_whitespace());
        if before && xml[from..].trim_start().starts_with('=') {
            break from;
        }
    };
    let open = name + xml[name..].find(['"', '\''])?;
    let quote = char::from(xml.as_bytes()[open]);
    let start = open + 1;
    let end = start + xml[start..].find(quote)?;
    Some(start..end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fingerprint_ignores_the_guid_and_the_line_ends_alone() {
        let source = "<?xml version=\"1.0\"?>\n<!-- guid=\"x\" -->\n\
            <fmiModelDescription description='guid' guid=\"{fingerprint}\">\n</fmiModelDescription>\n";
        let guid = fingerprint(source);
        assert_eq!(guid.len(), 34);
        let packaged = with_guid(source, &guid);
        assert!(packaged.contains(&format!("description='guid' guid=\"{guid}\"")));
        assert_eq!(fingerprint(&packaged), guid);
        assert_eq!(fingerprint(&packaged.replace('\n', "\r\n")), guid);
        assert_ne!(fingerprint(&packaged.replace("description", "descriptiom")), guid);
    }

    #[test]
    fn annotations_change_no_guid_and_reach_no_importer() {
        let plain = "<fmiModelDescription guid=\"\"><A>\n  <Real/>\n</A></fmiModelDescription>";
        let note = "<Real/>\n  <Annotations><Tool name=\"t\"/></Annotations>";
        let annotated = plain.replace("<Real/>", note);
        assert_eq!(without_annotations(&annotated), plain);
        assert_eq!(fingerprint(&annotated), fingerprint(plain));
    }
}
