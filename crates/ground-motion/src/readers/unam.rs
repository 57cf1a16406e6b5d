//! Records of UNAM and its partners, Mexico: `ARCHIVO ESTANDAR DE ACELERACION`, version 2.0.
//!
//! Header lines `KEY : value`, in which the values of up to twelve channels stand behind slashes, then the
//! channels side by side below the second of two rulers:
//!
//! ```text
//! ARCHIVO ESTANDAR DE ACELERACION:
//! ORIENTACION C1-C6 (rumbo;orientacion)  : /V/N00E/N90E
//! INTERVALO DE MUESTREO, C1-C6 (s)       : /0.005/0.005/0.005
//! NUM. TOTAL DE MUESTRAS, C1-C6          : /35600/35600/35600
//! ACEL. MAX.(Gal), C1-C6                 : /25.6114/58.7394/-42.3377
//! UNIDADES DE LOS DATOS                  : Gal (cm/s/s)
//! FORMATO DATOS (FORTRAN,10 campos/dato) : 3F10.4
//! ---------+---------+---------+
//!    CANAL-1   CANAL-2   CANAL-3
//! ---------+---------+---------+
//!    -0.0083   -0.0214    0.0000
//! ```

use super::components::{MOST, components, push_row};
use super::header::value;
use crate::error::{DAMAGED, Fault};
use crate::fields::{Layout, Numbered, check_count, find, positive, untrimmed_lines};
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::warning::Warning;

/// Longest header; files have 109 lines, blank ones included.
const HEADER_LINES: usize = 300;

const RULER: &str = "---------+---------+";
const FORMAT: &str = "FORMATO DATOS (FORTRAN,10 campos/dato)";
const STEP: &str = "INTERVALO DE MUESTREO";
const COUNT: &str = "NUM. TOTAL DE MUESTRAS";

/// Returns whether one of the first lines is the title of such a file.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.iter().take(20).any(|line| find(line.trim(), "ARCHIVO ESTANDAR DE ACELERACION") == Some(0))
}

/// Reads the channels of a UNAM file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let is_ruler = |line: &&str| line.trim_start().starts_with(RULER);
    let mut rows = untrimmed_lines(text);
    let (mut header, mut rulers): (Vec<Numbered<'_>>, usize) = (Vec::new(), 0);
    for (number, line) in rows.by_ref().take(HEADER_LINES) {
        rulers += usize::from(is_ruler(&line));
        header.push((number, line));
        if rulers == 2 {
            break;
        }
    }
    let last = header.last().map_or(1, |(number, _)| *number);
    if rulers < 2 {
        let expected = format!("two rulers `{RULER}` above the samples");
        return Err(Fault::new(last, expected, rulers.to_string(), "check that this is a UNAM file"));
    }
    let (unit_line, unit) = value(&header, "UNIDADES DE LOS DATOS")?;
    let unit = options.unit_of(unit.split_whitespace().next().unwrap_or_default(), unit_line)?;
    let (format_line, format) = value(&header, FORMAT)?;
    let layout =
        Layout::of(format).ok_or_else(|| Fault::in_header(format_line, "a format `3F10.4`", format))?;
    let (steps_line, steps) = of_channels(&header, STEP)?;
    let (_, names) = of_channels(&header, "ORIENTACION")?;
    let step = steps.first().and_then(|step| positive(step));
    let Some(step) = step.filter(|_| steps.iter().all(|other| Some(*other) == steps.first().copied())) else {
        let expected = format!("one step for all channels as {STEP}");
        return Err(Fault::in_header(steps_line, expected, &steps.join("/")));
    };
    options.check_step(step, steps_line)?;
    let (counts_line, counts) = of_channels(&header, COUNT)?;
    if counts.len() != names.len() || names.len() != layout.per_line {
        let expected = format!("{} channels, as line {format_line} says", layout.per_line);
        let found = format!("{} orientations and {} counts", names.len(), counts.len());
        return Err(Fault::new(counts_line, expected, found, "correct the header"));
    }
    let mut channels = components([step, 0.0], unit, names.iter().copied(), last)?;
    if let Ok((_, peaks)) = of_channels(&header, "ACEL. MAX.(Gal)") {
        channels.iter_mut().zip(peaks).for_each(|(channel, peak)| channel.state_peak(peak));
    }
    for (number, row) in rows {
        push_row(&mut channels, layout.fields(row), number)?;
    }
    for (channel, count) in channels.iter_mut().zip(counts) {
        let stated =
            count.parse().map_err(|_| Fault::excerpt(counts_line, "a whole number", count, DAMAGED))?;
        let found = channel.samples.len();
        if found > stated {
            channel.samples.truncate(stated);
            channel.warnings.push(Warning::Surplus { found, stated });
        }
        check_count(channel.samples.len(), stated, &format!("line {counts_line}"), channel.last_line)?;
        let described = ["NOMBRE DE LA ESTACION", "FECHA DEL SISMO [GMT]", "MAGNITUD(ES)"];
        channel.keep_header(described.iter().filter_map(|key| Some(value(&header, key).ok()?.1)));
    }
    Ok(channels)
}

/// Finds the values of all channels for a key, and the line of the first of them.
fn of_channels<'a>(header: &[Numbered<'a>], key: &str) -> Result<(usize, Vec<&'a str>), Fault> {
    let (mut first, mut values) = (None, Vec::new());
    for &(number, line) in header {
        let Some((name, listed)) = line.split_once(':') else { continue };
        if name.trim_start().starts_with(key) && ["C1-C6", "C7-C12"].iter().any(|of| name.contains(of)) {
            first = first.or(Some(number));
            values.extend(listed.split('/').skip(1).take(MOST + 1).map(str::trim));
        }
    }
    match first {
        Some(first) if !values.is_empty() => Ok((first, values)),
        _ => {
            let line = header.last().map_or(1, |(number, _)| *number);
            let expected = format!("`{key}, C1-C6` with a value for each channel, `/1/2/3`");
            Err(Fault::missing(first.unwrap_or(line), expected))
        }
    }
}
