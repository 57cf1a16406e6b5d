//! Response spectra in files: periods in s and Sa in columns.

use std::path::Path;

use crate::columns::{Columns, Name};
use crate::error::{Fault, GroundMotionError};
use crate::file::{read_file, utf8_text};
use crate::options::RecordOptions;
use crate::quantity::Quantity;
use crate::unit::Unit;
use crate::warning::Warning;

/// Largest file that is read.
const MAX_FILE_BYTES: u64 = 1 << 20;

/// Longest period (s) that a spectrum may have without stating the unit.
const LONGEST_PERIOD: f64 = 20.0;

/// Range of the largest Sa (g) without a warning about the unit: demands on walls have 0.05 g to 5 g.
const CREDIBLE_LARGEST: [f64; 2] = [0.01, 10.0];

/// Largest percentage that is a damping ratio without a word that says so; 50 % and 84 % are fractiles.
const LARGEST_UNSAID: f64 = 0.3;

const FORMS: &str = "rows of periods in s and Sa, below a header line such as `T [s],Sa [g]`";

/// A response spectrum as read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumFile {
    /// Points (T, Sa) \[s, m/s²\], as the file has them.
    pub points: Vec<(f64, f64)>,
    /// The line of each point, from 1.
    pub lines: Vec<usize>,
    /// Unit of the file.
    pub unit: Unit,
    /// Damping ratio that the name of the column states, `Sa (5 %)` or `Sa (ξ = 5 %)`.
    pub damping: Option<f64>,
    /// Name of the column that Sa was read from, in a file with several beside the periods.
    pub column: Option<String>,
}

impl SpectrumFile {
    /// Reads a spectrum: the column of a name, or the only one beside the periods. `unit` is needed where the
    /// file states none, and must not contradict a file that does.
    ///
    /// # Errors
    /// [`GroundMotionError`], with file, line, what was expected, what was found and the remedy.
    pub fn read(path: &Path, unit: Option<Unit>, column: Option<&str>) -> Result<Self, GroundMotionError> {
        let name = path.display().to_string();
        let bytes = read_file(path, "a spectrum (CSV)", MAX_FILE_BYTES)
            .map_err(|reason| GroundMotionError::Io { file: name.clone(), reason })?;
        Self::parse(&name, bytes, unit, column)
    }

    /// Reads a spectrum from the bytes of a file; `name` stands for the file in messages.
    ///
    /// ```
    /// use ground_motion::{SpectrumFile, Unit};
    ///
    /// let text = "T [s];Sa [cm/s2];Sd [cm]\n0;196;0\n0,5;490;3,1\n";
    /// let spectrum = SpectrumFile::parse("s.csv", text.into(), None, None)?;
    /// assert_eq!(spectrum.points, [(0.0, 1.96), (0.5, 4.9)]);
    /// # Ok::<(), ground_motion::GroundMotionError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(
        name: &str,
        bytes: Vec<u8>,
        unit: Option<Unit>,
        column: Option<&str>,
    ) -> Result<Self, GroundMotionError> {
        let read = || {
            let text = utf8_text(bytes, "a spectrum (CSV)")?;
            Self::of_text(text.trim_start_matches('\u{feff}'), unit, column)
        };
        read().map_err(|fault| fault.in_file(name))
    }

    fn of_text(text: &str, given: Option<Unit>, wanted: Option<&str>) -> Result<Self, Fault> {
        let columns = Columns::of_numbers(text, is_abscissa, FORMS)?;
        if columns.width() < 2 {
            let remedy = "write the period and Sa on each line, between commas, semicolons, tabs or blanks";
            return Err(Fault::excerpt(columns.line(), FORMS, columns.heading(), remedy));
        }
        let column_number = columns.beside_the_first(wanted, "T");
        let is_spectral = |column: &usize| {
            columns.names().get(*column).is_some_and(|name| name.says() == Some(Quantity::Spectrum))
        };
        let may_be_time = column_number.as_ref().map_or(true, is_spectral);
        let may_be_period = |name: &Name| {
            // a comment may call the periods anything
            let is_unknown = columns.are_named_by_a_comment() && !is_abscissa(name);
            is_unknown || is_period(name) && (may_be_time || !is_time(name))
        };
        columns.seconds(may_be_period, false, ["periods in s", NAME_PERIODS])?;
        let column_number = column_number?;
        let name = columns.names().get(column_number);
        let options = RecordOptions { unit: given, ..RecordOptions::default() };
        let Some(unit) = columns.unit(column_number, &options)? else {
            let remedy =
                "the file states no unit: give --unit, or write it into a header line, `T [s],Sa [g]`";
            return Err(Fault::excerpt(columns.line(), "a unit of Sa", columns.heading(), remedy));
        };
        let (mut points, mut lines) = (Vec::new(), Vec::new());
        columns.read(column_number, |period, sa, line| {
            points.push((period, unit.to_si(sa)));
            lines.push(line);
            Ok(())
        })?;
        refuse_milliseconds(&columns, &points, &lines)?;
        let column = name.filter(|_| columns.width() > 2).map(|name| name.written().to_owned());
        let damping = name.and_then(|name| stated_damping(name.written()));
        Ok(Self { points, lines, unit, damping, column })
    }

    /// Warns about a largest Sa below 0.01 g or above 10 g: its unit may be wrong.
    ///
    /// ```
    /// use ground_motion::SpectrumFile;
    ///
    /// let spectrum = SpectrumFile::parse("s.csv", "T [s],Sa [g]\n0,1.9\n0.5,49\n".into(), None, None)?;
    /// assert!(spectrum.warning().unwrap().to_string().contains("49.00 g is not credible"));
    /// # Ok::<(), ground_motion::GroundMotionError>(())
    /// ```
    pub fn warning(&self) -> Option<Warning> {
        let largest = self.points.iter().fold(0.0, |largest, (_, sa)| sa.max(largest));
        Warning::of_unit(largest, self.unit, CREDIBLE_LARGEST)
    }
}

/// Returns the quantity that a word of a name says of the first column.
fn abscissa(name: &Name) -> Option<Quantity> {
    name.words().iter().find_map(|word| match word.as_str() {
        "t" | "tn" => Some(Quantity::Time(1.0)),
        "f" | "freq" | "frequency" | "frequencies" | "omega" | "ω" | "w" | "hz" => Some(Quantity::Frequency),
        word if word.starts_with("period") => Some(Quantity::Time(1.0)),
        _ => None,
    })
}

/// Returns whether a column may be meant as the first of a spectrum.
fn is_abscissa(name: &Name) -> bool {
    matches!(name.quantity().or(abscissa(name)), Some(Quantity::Time(_) | Quantity::Frequency))
}

/// Returns whether a column may have periods, not frequencies.
fn is_period(name: &Name) -> bool {
    is_abscissa(name) && abscissa(name) != Some(Quantity::Frequency)
}

/// Returns whether a column is called as the times of a record are. Beside `Sa` it has periods.
fn is_time(name: &Name) -> bool {
    name.text() == "t" || name.words().first().is_some_and(|word| word == "time")
}

const NAME_PERIODS: &str = "make the periods in s the first column, and name it `T [s]`: times are those \
                            of a record, and frequencies are T = 1/f and T = 2π/ω";

/// Finds the damping ratio that a name states: a percentage beside a word that means damping, `Sa (ξ = 5 %)`,
/// or one alone in its brackets or behind Sa, `Sa (5 %)` and `Sa_2.5%`. That of `10 % in 50 years` is none.
fn stated_damping(name: &str) -> Option<f64> {
    name.split(['(', ')', '[', ']']).find_map(|part| {
        let (before, after) = part.split_once('%')?;
        let before = before.trim_end();
        let number = before.trim_end_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | ','));
        let ratio = before[number.len()..].replace(',', ".").parse::<f64>().ok()? / 100.0;
        let words = part.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty());
        let mut words = words.map(str::to_lowercase);
        let means_damping = |word: String| {
            ["damp", "smorz"].iter().any(|start| word.starts_with(start))
                || ["ξ", "xi", "ζ", "zeta"].contains(&word.as_str())
        };
        let is_alone = words.clone().all(|word| ["sa", "psa", "se"].contains(&word.as_str()));
        let is_damping = is_alone && ratio <= LARGEST_UNSAID || words.any(means_damping);
        (is_damping && !after.contains('%')).then_some(ratio)
    })
}

/// Refuses long periods under a name without a unit.
fn refuse_milliseconds(columns: &Columns<'_>, points: &[(f64, f64)], lines: &[usize]) -> Result<(), Fault> {
    if matches!(columns.names().first().and_then(Name::stated), Some((_, Quantity::Time(1.0)))) {
        return Ok(());
    }
    let Some(at) = points.iter().position(|(period, _)| *period > LONGEST_PERIOD) else { return Ok(()) };
    let expected = format!("periods of at most {LONGEST_PERIOD} s");
    let remedy =
        "they may be in milliseconds: write seconds; if they are in s, name the first column `T [s]`";
    Err(Fault::new(lines[at], expected, format!("{} s", points[at].0), remedy))
}
