//! Records of the Central Weather Administration, Taiwan (CWA, formerly CWB; `.dat`, `.txt`).
//!
//! Header lines that start with `#`, then times and components in columns of ten characters:
//!
//! ```text
//! #StationCode: EAS
//! #RecordLength(sec): 120
//! #SampleRate(Hz): 50
//! #AmplitudeUnit:  gal. DCoffset(corr)
//! #AmplitudeMAX. U:    0.658~   -0.837
//! #DataSequence: Time U(+); N(+); E(+)
//! #Data: 4F10.3
//!      0.000     0.000     0.000     0.000
//! ```

use super::components::{components, finish, push_timed_row};
use super::header::{number, step, value};
use crate::error::Fault;
use crate::fields::{Layout, Numbered, leading_real, real, untrimmed_lines};
use crate::motion::floor_index;
use crate::options::RecordOptions;
use crate::parsed::Parsed;

/// Longest header.
const HEADER_LINES: usize = 60;

const LENGTH: &str = "RecordLength(sec)";
const SEQUENCE: &str = "DataSequence";

/// Returns whether the first lines are such a header.
pub(super) fn recognises(head: &[&str]) -> bool {
    let starts = |key: &str| head.iter().any(|line| line.starts_with(key));
    starts("#SampleRate(Hz):") && starts("#DataSequence:")
}

/// Reads the components of a CWA file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let lines = untrimmed_lines(text).take(HEADER_LINES);
    let header: Vec<Numbered<'_>> = lines.take_while(|(_, line)| line.starts_with('#')).collect();
    let step = step(&header, "SampleRate(Hz)", |rate| 1.0 / rate, options)?;
    let (unit_line, unit) = value(&header, "AmplitudeUnit")?;
    let unit = unit.split_whitespace().next().unwrap_or_default().trim_end_matches('.');
    let unit = options.unit_of(unit, unit_line)?;
    let (sequence_line, sequence) = value(&header, SEQUENCE)?;
    // the sign of a direction follows in brackets: U(+)
    let names = || {
        let words = sequence.split(|c: char| c.is_whitespace() || c == ';').filter(|word| !word.is_empty());
        words.map(|word| word.split('(').next().unwrap_or_default())
    };
    if !names().next().is_some_and(|name| name.eq_ignore_ascii_case("time")) || names().count() < 2 {
        let expected = format!("{SEQUENCE}: Time and the components");
        return Err(Fault::in_header(sequence_line, expected, sequence));
    }
    let (layout_line, layout) = value(&header, "Data")?;
    let layout = Layout::of(layout).filter(|layout| layout.per_line == names().count());
    let Some(layout) = layout else {
        let expected = format!("a format of {} columns, `#Data: 4F10.3`", names().count());
        return Err(Fault::new(layout_line, expected, "another", "correct the header"));
    };
    let mut rows = untrimmed_lines(text).skip(header.len()).peekable();
    let first = rows.peek().and_then(|(_, line)| real(layout.fields(line).next()?));
    let start = first.filter(|time| time.is_finite()).unwrap_or(0.0);
    let mut channels = components([step, start], unit, names().skip(1), sequence_line)?;
    for (channel, name) in channels.iter_mut().zip(names().skip(1)) {
        if let Ok((_, extremes)) = value(&header, &format!("AmplitudeMAX. {name}")) {
            let size = |text: &str| leading_real(text).map_or(0.0, f64::abs);
            let larger = extremes.split('~').max_by(|a, b| size(a).total_cmp(&size(b)));
            channel.state_peak(larger.unwrap_or_default());
        }
    }
    for (index, (line, row)) in rows.enumerate() {
        push_timed_row(&mut channels, layout.fields(row), line, start + index as f64 * step)?;
    }
    let (length_line, length) = number(value(&header, LENGTH)?, LENGTH)?;
    let stated_by = format!("{LENGTH} on line {length_line}, {length} s at {step} s,");
    let stated = floor_index((length / step).round());
    finish(channels, stated, &stated_by, &header.iter().map(|(_, line)| line.trim_start_matches('#').trim()))
}
