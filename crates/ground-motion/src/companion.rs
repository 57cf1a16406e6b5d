//! Times beside a record: `dts_3.csv` for `acc_3.csv`, as in the folders of OQ-VMTK.

use std::path::{Path, PathBuf};

use crate::error::{Fault, GroundMotionError};
use crate::fields::{lines, real};
use crate::options::RecordOptions;
use crate::record::read_bounded;

/// Largest deviation of a time from a uniform step, relative to it.
const TOLERANCE: f64 = 0.01;

/// Returns whether a file has the times of a record beside it, as `dts_3.csv` of `acc_3.csv`; it is no
/// record.
///
/// ```
/// assert!(!ground_motion::is_companion("records/acc_3.csv".as_ref()));
/// ```
pub fn is_companion(path: &Path) -> bool {
    beside(path, "dts", "acc").is_some_and(|record| record.is_file())
}

/// Returns whether a list of records has a file of a folder: a regular file that is neither hidden nor a
/// [companion](is_companion).
///
/// ```
/// assert!(!ground_motion::is_listed("records/.hidden".as_ref()));
/// ```
pub fn is_listed(path: &Path) -> bool {
    let is_hidden = path.file_name().is_none_or(|name| name.to_string_lossy().starts_with('.'));
    path.is_file() && !is_hidden && !is_companion(path)
}

/// Adds the step of the times beside a record, if there are any and no step is stated.
pub(crate) fn completed(path: &Path, options: &RecordOptions) -> Result<RecordOptions, GroundMotionError> {
    let times = beside(path, "acc", "dts").filter(|times| options.step.is_none() && times.is_file());
    let step = match times {
        Some(times) => {
            let name = times.display().to_string();
            let bytes = read_bounded(&times, &name)?;
            Some(step(&String::from_utf8_lossy(&bytes)).map_err(|fault| fault.in_file(&name))?)
        }
        None => options.step,
    };
    Ok(RecordOptions { step, ..options.clone() })
}

/// Finds `to_3.csv` of `from_3.csv` in the same folder, or in the folder `to` beside the folder `from`.
fn beside(path: &Path, from: &str, to: &str) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?;
    let number = name.strip_prefix(from)?.strip_prefix('_')?.strip_suffix(".csv")?;
    if number.is_empty() || !number.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let name = format!("{to}_{number}.csv");
    let folder = path.parent()?;
    let sibling = folder.file_name().is_some_and(|folder| folder == from);
    let same = folder.join(&name);
    if sibling && !same.is_file() { Some(folder.with_file_name(to).join(name)) } else { Some(same) }
}

/// Finds the uniform step of times, one a line, or the one number that is the step itself.
fn step(text: &str) -> Result<f64, Fault> {
    let remedy = "correct the times, or state the step as `step` (on the command line --record-step)";
    let mut times = Vec::new();
    for (number, line) in lines(text) {
        let time = real(line).filter(|time| time.is_finite());
        times.push(time.ok_or_else(|| Fault::excerpt(number, "one time in s", line, remedy))?);
    }
    let step = match times[..] {
        [step] => step,
        [first, .., last] => (last - first) / (times.len() - 1) as f64,
        [] => f64::NAN,
    };
    let due = |index: usize| times[0] + index as f64 * step;
    let off = |&(index, time): &(usize, &f64)| (*time - due(index)).abs() > TOLERANCE * step;
    match times.iter().enumerate().find(off) {
        // decimal fractions are quotients of their sums only up to rounding
        None if step > 0.0 => Ok(format!("{step:.9e}").parse().unwrap_or(step)),
        None => Err(Fault::new(1, "times in s that rise, one a line", format!("a step of {step} s"), remedy)),
        Some((index, time)) => {
            let expected = format!("uniform times, here {} s", due(index));
            Err(Fault::new(index + 1, expected, format!("{time} s"), remedy))
        }
    }
}
