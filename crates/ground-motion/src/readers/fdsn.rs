//! Text of the data centres of the FDSN: SLIST and TSPAIR, which `ObsPy` also writes, and `GeoCSV`.
//!
//! ```text
//! TIMESERIES XX_STA1__HNE_D, 401 samples, 100 sps, 2016-08-24T01:36:32.000000, TSPAIR, FLOAT, M/S**2
//! 2016-08-24T01:36:32.000000  -8.3692499636e-04
//! ```
//!
//! SLIST has the samples alone, several a line. `GeoCSV` states the same by keys, `# sample_count: 401`, and
//! has a line of names above pairs.

use super::header::{number, step, value};
use crate::error::{DAMAGED, Fault};
use crate::fields::{Numbered, check_count, find, lines, real};
use crate::motion::floor_index;
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::vertical::is_vertical_channel;

/// Longest header.
const HEADER_LINES: usize = 60;

/// What the fields of a header in one line state, by the keys of `GeoCSV`.
const KEYS: [&str; 7] =
    ["SID", "sample_count", "sample_rate_hz", "start_time", "form", "field_type", "field_unit"];

/// Returns whether the first line is that of such a file.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.first()
        .is_some_and(|line| is_series(line) || line.starts_with('#') && find(line, "GeoCSV").is_some())
}

fn is_series(line: &str) -> bool {
    find(line, "TIMESERIES ") == Some(0) && line.split(',').count() > 4
}

/// Seconds of a day.
const DAY: f64 = 86_400.0;

/// Reads the time of day (s) of `2020-01-01T00:00:01.5Z`.
fn seconds(time: &str) -> Option<f64> {
    let mut parts = time.trim_end_matches('Z').split_once('T')?.1.split(':').map(real);
    Some(3600.0 * parts.next()?? + 60.0 * parts.next()?? + parts.next()??)
}

/// Reads the text of such a file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let is_header = |line: &str| line.starts_with(|c: char| c == '#' || c.is_ascii_alphabetic());
    let header = lines(text).take(HEADER_LINES).take_while(|(_, line)| is_header(line));
    let mut header: Vec<Numbered<'_>> = header.collect();
    let rows = lines(text).skip(header.len());
    let (first_line, first) = header.first().copied().unwrap_or((1, ""));
    let keyed: Vec<String> =
        KEYS.iter().zip(first.split(',')).map(|(key, field)| format!("{key}:{field}")).collect();
    if is_series(first) {
        header = keyed.iter().map(|line| (first_line, line.as_str())).collect();
    }
    let (count_line, count) = number(value(&header, "sample_count")?, "sample_count")?;
    let step = step(&header, "sample_rate_hz", |rate| 1.0 / rate, options)?;
    let (unit_line, units) = value(&header, "field_unit").unwrap_or((first_line, ""));
    let unit = options.unit_of(units.rsplit([',', '|']).next().unwrap_or_default().trim(), unit_line)?;
    let is_list = value(&header, "form").is_ok_and(|(_, form)| form.eq_ignore_ascii_case("SLIST"));
    let mut parsed = Parsed::new(step, unit, first_line);
    let mut first_time = None;
    for (number, line) in rows {
        let is_edge = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '|');
        let words = line.split(is_edge).filter(|word| !word.is_empty());
        if !is_list && words.clone().count() != 2 {
            return Err(Fault::excerpt(number, "a time and a sample", line, DAMAGED));
        }
        if let Some(time) = words.clone().next().filter(|_| !is_list).and_then(seconds) {
            let due = parsed.samples.len() as f64 * step;
            // clocks begin anew at midnight
            let late = time - *first_time.get_or_insert(time) - due + DAY / 2.0;
            if (late.rem_euclid(DAY) - DAY / 2.0).abs() > step / 2.0 {
                let expected = format!("a sample {due:.3} s after the first");
                let remedy = "the series has a gap, or another step than its header: fill it, or use a part";
                return Err(Fault::excerpt(number, expected, line, remedy));
            }
        }
        for word in words.skip(usize::from(!is_list)) {
            parsed.push(real(word), number, || Fault::no_number(number, "a finite number", word, DAMAGED))?;
        }
    }
    let stated_by = format!("line {count_line}");
    check_count(parsed.samples.len(), floor_index(count), &stated_by, parsed.last_line)?;
    let name = value(&header, "SID").map_or("", |(_, name)| name);
    parsed.is_vertical = name.split('_').skip(2).any(is_vertical_channel);
    parsed.keep_header(header.iter().map(|(_, line)| line.trim_start_matches('#').trim_start()));
    Ok(vec![parsed])
}
