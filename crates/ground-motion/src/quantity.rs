//! The quantity that a unit measures: an acceleration, or what files state in its place.

use std::str::FromStr;

use crate::error::{Fault, GroundMotionError};
use crate::unit::Unit;

/// The quantity of a unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Quantity {
    /// An acceleration in a unit that is read.
    Acceleration(Unit),
    /// An acceleration in another unit: how much it is in one that is read.
    OtherAcceleration(f64, Unit),
    Velocity,
    Displacement,
    /// A time: how many seconds the unit has.
    Time(f64),
    Frequency,
    /// A response spectrum, which names say and units do not.
    Spectrum,
    /// What an instrument records: counts and volts.
    Signal,
    /// Anything else that is a unit, or a unit times a factor.
    Other,
}

/// Units of length: names, and their lengths in m.
const LENGTHS: [(&[&str], f64); 9] = [
    (&["m"], 1.0),
    (&["dm"], 0.1),
    (&["cm"], 0.01),
    (&["mm"], 0.001),
    (&["µm", "μm", "um"], 1e-6),
    (&["nm"], 1e-9),
    (&["km"], 1000.0),
    (&["ft", "feet", "foot"], 0.3048),
    (&["in", "inch", "inches"], 0.0254),
];

/// Parts of g: names, and their sizes in g.
const PARTS_OF_G: [(&[&str], f64); 3] = [
    (&["%g", "g%", "pctg"], 0.01),
    (&["mg", "milli-g", "millig"], 0.001),
    (&["µg", "μg", "ug", "micro-g", "microg"], 1e-6),
];

const TIMES: [(&[&str], f64); 6] = [
    (&["s", "sec", "secs", "second", "seconds"], 1.0),
    (&["ms", "msec", "msecs", "millisecond", "milliseconds"], 1e-3),
    (&["µs", "μs", "us", "microsecond", "microseconds"], 1e-6),
    (&["min", "mins", "minute", "minutes"], 60.0),
    (&["hr", "hrs", "hour", "hours"], 3600.0),
    (&["day", "days"], 86_400.0),
];

const FREQUENCIES: [&str; 8] = ["hz", "khz", "1/s", "s-1", "rad/s", "rads-1", "r/s", "cps"];

/// Units of signals without prefixes and plurals, also above a `/`: V/g.
const SIGNALS: [&str; 7] = ["v", "volt", "count", "cnt", "ct", "digit", "lsb"];

/// Units of force: names, and their sizes in N.
const FORCES: [(&[&str], f64); 3] = [(&["n"], 1.0), (&["kn"], 1e3), (&["mn"], 1e6)];

/// What a capacity curve states in a column, with the SI value of its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measured {
    /// A length: how many m the unit has.
    Length(f64),
    /// A force: how many N the unit has.
    Force(f64),
    /// An acceleration: how many m/s² the unit has.
    Acceleration(f64),
}

impl Measured {
    /// Finds the quantity of a unit; `None` for others.
    pub(crate) fn of(unit: &str) -> Option<Self> {
        let word = unit.trim().to_ascii_lowercase();
        // mN is no MN
        let force = size_of(&word, &FORCES).filter(|_| unit.trim() != "mN");
        match Quantity::of(unit) {
            Some(Quantity::Displacement) => size_of(&plain(unit), &LENGTHS).map(Self::Length),
            Some(Quantity::Acceleration(unit)) => Some(Self::Acceleration(unit.to_si(1.0))),
            Some(Quantity::OtherAcceleration(size, unit)) => Some(Self::Acceleration(unit.to_si(size))),
            _ => force.map(Self::Force),
        }
    }
}

/// Finds the size of a unit by one of its names.
fn size_of(word: &str, units: &[(&[&str], f64)]) -> Option<f64> {
    units.iter().find(|(names, _)| names.contains(&word)).map(|(_, size)| *size)
}

/// Longest unit \[bytes\].
const LONGEST: usize = 64;

impl Quantity {
    /// Finds the quantity of a unit; `None` if the text is no unit.
    pub(crate) fn of(text: &str) -> Option<Self> {
        // no unit is as long, but a line without columns may be
        if text.len() > LONGEST {
            return None;
        }
        if let Some(seconds) = size_of(text.trim_matches(['.', ' ']).to_ascii_lowercase().as_str(), &TIMES) {
            return Some(Self::Time(seconds));
        }
        let plain = plain(text);
        let word = plain.as_str();
        if FREQUENCIES.contains(&word) {
            return Some(Self::Frequency);
        }
        match word {
            "g" | "g's" | "standard_gravity" => return Some(Self::Acceleration(Unit::StandardGravity)),
            "gal" | "gals" | "galileo" => return Some(Self::Acceleration(Unit::CentimetrePerSecondSquared)),
            "mgal" | "milligal" => {
                return Some(Self::OtherAcceleration(1e-3, Unit::CentimetrePerSecondSquared));
            }
            "kine" | "kines" => return Some(Self::Velocity),
            _ => {}
        }
        let above = word.split('/').next().unwrap_or_default().trim_end_matches('s');
        if [above, above.trim_start_matches(['m', 'µ', 'μ', 'u', 'n'])].iter().any(|of| SIGNALS.contains(of))
        {
            return Some(Self::Signal);
        }
        if let Some((length, time)) = parts(word) {
            return Some(match (time, length) {
                (0, _) => Self::Displacement,
                (1, _) => Self::Velocity,
                (_, "m") => Self::Acceleration(Unit::MetrePerSecondSquared),
                (_, "cm") => Self::Acceleration(Unit::CentimetrePerSecondSquared),
                (_, "mm") => Self::Acceleration(Unit::MillimetrePerSecondSquared),
                _ => Self::OtherAcceleration(size_of(length, &LENGTHS)?, Unit::MetrePerSecondSquared),
            });
        }
        let part =
            word.strip_prefix("g/").and_then(|parts| parts.parse::<f64>().ok()).map(|parts| 1.0 / parts);
        let part = part.or_else(|| word.strip_suffix('g')?.parse::<f64>().ok());
        if let Some(part) = part.or_else(|| size_of(word, &PARTS_OF_G)) {
            return Some(Self::OtherAcceleration(part, Unit::StandardGravity));
        }
        is_other_unit(word).then_some(Self::Other)
    }

    /// Makes the fault of a unit other than one that is read, which `word` states on a line.
    pub(crate) fn refused(self, word: &str, line: usize) -> Fault {
        let remedy = match self {
            Self::OtherAcceleration(size, unit) => format!("convert the samples: 1 {word} is {size} {unit}"),
            Self::Velocity | Self::Displacement => {
                "convert it to an acceleration, or use the file or column of the acceleration".to_owned()
            }
            Self::Signal => "counts and volts need the response of the instrument: convert them to an \
                             acceleration by it (ObsPy: remove_response)"
                .to_owned(),
            _ => "correct the unit, or use another column".to_owned(),
        };
        let remedy = format!(
            "{remedy}; m/s2, cm/s2, mm/s2 and g are read, and a unit that you state does not override that \
             of the file"
        );
        Fault::excerpt(line, "a unit of acceleration", word, remedy)
    }
}

/// Units that are neither of motion nor of time, in small letters; also above a `/`: rad/s2.
const OTHERS: &str = "- kg kn pa kpa mpa rad deg ° °c m2 m3 bar psi db % strain microstrain µstrain µε με";

/// Returns whether a plain text is another unit, such as `kg` and `m/s3`, or a factor and a unit, such as
/// `10^-3 m/s2`. Directions, such as `N/S`, and words, such as `corrected`, are none.
fn is_other_unit(word: &str) -> bool {
    let may_have_exponent = word.starts_with(|c: char| c.is_ascii_digit());
    let is_factor = |c: char| {
        c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | 'x' | '×') || c == 'e' && may_have_exponent
    };
    let is_motion =
        |unit: &str| unit.len() < word.len() && (parts(unit).is_some() || ["g", "gal"].contains(&unit));
    let has_factor = [word.trim_start_matches(is_factor), word.trim_end_matches(is_factor)];
    let above = word.split('/').next().filter(|above| above.len() < word.len());
    let above = above.or_else(|| word.split_once("s-").map(|(above, _)| above));
    let is_other = |unit: &str| OTHERS.split(' ').any(|other| other == unit);
    let is_ratio = |above: &str| size_of(above, &LENGTHS).is_some() || above == "g" || is_other(above);
    has_factor.into_iter().any(is_motion) || above.is_some_and(is_ratio) || is_other(word)
}

/// Writes a unit in small letters and without blanks, brackets, and marks of powers and products.
fn plain(text: &str) -> String {
    let text = text.to_ascii_lowercase().replace("percent", "%").replace("per", "/").replace("squared", "2");
    let text = text.replace("second", "s").replace("sec", "s").replace("metre", "meter");
    let text = text.replace("centimeter", "cm").replace("millimeter", "mm").replace("meter", "m");
    let text = text.replace('²', "2").replace(['−', '–', '⁻'], "-");
    let text = text.replace('¹', "1").replace('⁄', "/");
    let is_mark = |c: char| c.is_whitespace() || matches!(c, '^' | '*' | '·' | '⋅' | '(' | ')');
    let text: String = text.chars().filter(|c| !is_mark(*c)).collect();
    // m.s-2, but not 0.1g
    match text.split_once('.') {
        Some((before, after)) if !after.starts_with(|c: char| c.is_ascii_digit()) => {
            format!("{before}{after}")
        }
        _ => text,
    }
}

/// Splits a plain unit such as `cm/s2` into its length and the power of the time below it. Names of columns
/// have `cm_s2` and `cms2`.
fn parts(plain: &str) -> Option<(&str, u8)> {
    const SQUARED: [&str; 11] =
        ["/s2", "/s/s", "/ss", "s-2", "_s2", "_s_2", "_s_s", "_s-2", "ps2", "s2", "ss"];
    const PLAIN: [&str; 4] = ["/s", "s-1", "_s", "s"];
    let without = |times: &[&str]| times.iter().find_map(|time| plain.strip_suffix(time));
    let squared = without(&SQUARED).map(|length| (length, 2));
    let (length, power) = squared.or(without(&PLAIN).map(|length| (length, 1))).unwrap_or((plain, 0));
    size_of(length, &LENGTHS).map(|_| (length, power))
}

/// Reads the usual spellings, in any case: `m/s2`, `m/s^2`, `m/s²`, `m/s**2`, `m/s/s`, `m/sec2`, `m/sec/sec`,
/// `m s-2`, `m.s⁻²`, each of them with `cm` or `mm` too, `centimeter / second ** 2`, and `gal` and `g`.
impl FromStr for Unit {
    type Err = GroundMotionError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match Quantity::of(text) {
            Some(Quantity::Acceleration(unit)) => Ok(unit),
            _ => Err(GroundMotionError::Unit { found: text.chars().take(40).collect() }),
        }
    }
}

impl TryFrom<String> for Unit {
    type Error = GroundMotionError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}
