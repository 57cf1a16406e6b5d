//! Files broken in many ways, one line at a time, and what their messages may not say. Crates that read such
//! files use this one, too.

/// Words of the readers of TOML and of Rust that say nothing to a user.
const FOREIGN: [&str; 25] = [
    "unknown field",
    "unknown variant",
    "missing field",
    "duplicate key",
    "invalid type",
    "invalid value",
    "invalid length",
    "expected newline",
    "trailing characters",
    "struct ",
    "a map",
    "a sequence",
    "a tuple",
    "path string",
    "f64",
    "u32",
    "u64",
    "usize",
    "untagged",
    "enum",
    "variant",
    "literal",
    "string values",
    "unquoted",
    "TOML parse error",
];

/// What people write in place of a value.
const VALUES: [&str; 26] = [
    "0,30",
    "1.500,0",
    ".3",
    "3.",
    "1.2 m",
    "\"1.2 m\"",
    "\"0,3\"",
    "30cm",
    "True",
    "true",
    "bilinear",
    "\"word",
    "“word”",
    "\"C:\\new\"",
    "",
    "[",
    "[1, \"a\"]",
    "[[1, 2, 3]]",
    "{ a = 1 }",
    "{ xi = 0,1",
    "-1",
    "1e999",
    "3;",
    "99999999999999999999",
    "2027-03-03",
    "\"word\"",
];

/// Returns the text with each of its lines broken in each way.
fn broken(text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().collect();
    let mut texts = vec![text.replace('\n', "\r"), text.replacen('\n', "\n// a comment\n", 1)];
    for (index, line) in lines.iter().enumerate() {
        let with = |line: &str| {
            let mut lines = lines.clone();
            lines[index] = line;
            lines.join("\n")
        };
        texts.extend([with(""), with(&line.replacen('[', "", 1)), with(&line.replacen(']', "", 1))]);
        texts.extend([
            with(&format!("{line}\n{line}")),
            with(&line.replace('"', "")),
            with(&line.replace('e', "a")),
        ]);
        let Some((key, value)) = line.split_once('=') else { continue };
        texts.extend([with(&format!("{key} {value}")), with(&format!("{key}: {value}")), with(key)]);
        texts.extend(VALUES.map(|value| with(&format!("{key} = {value}"))));
        // the values of a table on one line
        let inner = value.split_once('=').map(|(before, _)| before);
        texts.extend(
            inner.iter().flat_map(|inner| VALUES.map(|value| with(&format!("{key} ={inner}= {value} }}")))),
        );
    }
    texts
}

/// Checks that a message names its line and has no word of a reader.
fn assert_plain(message: &str, text: &str) {
    let foreign = FOREIGN.iter().find(|word| message.contains(**word));
    assert_eq!(foreign, None, "{message}\n\n{text}");
    let has_no_line = ["is missing", "at least one"].iter().any(|words| message.contains(words));
    assert!(message.contains(", line ") || has_no_line, "{message}\n\n{text}");
}

/// Breaks every line of a text in every way: most are refused, in plain words.
pub(crate) fn walk<T, E: std::fmt::Display>(text: &str, read: impl Fn(&str) -> Result<T, E>) {
    assert!(read(text).is_ok(), "{text}");
    let texts = broken(text);
    let mut refusals = 0;
    for text in &texts {
        if let Err(error) = read(text) {
            assert_plain(&error.to_string(), text);
            refusals += 1;
        }
    }
    // a few changes leave a text that reads, and some values are checked later
    assert!(2 * refusals > texts.len(), "{refusals} of {}", texts.len());
}
