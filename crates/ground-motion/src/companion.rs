//! Times beside a record: `dts_3.csv` for `acc_3.csv`, as in the folders of OQ-VMTK.

use std::path::{Path, PathBuf};

use crate::error::{Fault, GroundMotionError};
use crate::fields::{lines, real};
use crate::file::read_bounded;
use crate::options::RecordOptions;
use crate::times::Times;

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

/// The times beside a record.
pub(crate) struct Companion {
    name: String,
    /// Time between samples (s).
    pub(crate) step: f64,
    /// How many there are; 1 where the file has the step alone.
    count: usize,
    last_line: usize,
}

impl Companion {
    /// Reads the times beside a record, if there are any and no step is stated.
    pub(crate) fn beside(path: &Path, options: &RecordOptions) -> Result<Option<Self>, GroundMotionError> {
        let times = beside(path, "acc", "dts").filter(|times| options.step.is_none() && times.is_file());
        let Some(times) = times else { return Ok(None) };
        let name = times.display().to_string();
        let bytes = read_bounded(&times, &name)?;
        match parsed(&String::from_utf8_lossy(&bytes)) {
            Ok((step, count, last_line)) => Ok(Some(Self { name, step, count, last_line })),
            Err(fault) => Err(fault.in_file(&name)),
        }
    }

    /// Refuses a record with another number of samples.
    pub(crate) fn check_count(&self, samples: usize) -> Result<(), GroundMotionError> {
        if [1, samples].contains(&self.count) {
            return Ok(());
        }
        let expected = format!("{samples} times, one for each sample of the record");
        Err(Fault::new(self.last_line, expected, format!("{} up to the end", self.count), REMEDY)
            .in_file(&self.name))
    }
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

const REMEDY: &str = "correct the times, or state the step as `step` (on the command line --record-step)";

/// Finds the uniform step of times, one a line, or the one number that is the step itself; how many there
/// are, and the last line.
fn parsed(text: &str) -> Result<(f64, usize, usize), Fault> {
    let mut times = Times::default();
    let uneven = |fault: Fault| Fault { remedy: REMEDY.to_owned(), ..fault };
    for (line, text) in lines(text) {
        let time = real(text).filter(|time| time.is_finite());
        let time = time.ok_or_else(|| Fault::excerpt(line, "one time in s", text, REMEDY))?;
        times.push(time, line).map_err(uneven)?;
    }
    let Some(&(last_line, last)) = times.0.last() else {
        return Err(Fault::new(1, "times in s, one a line", "an empty file", REMEDY));
    };
    match times.uniform().map_err(uneven)? {
        Some((_, step)) => Ok((step, times.0.len(), last_line)),
        None if last > 0.0 => Ok((last, 1, last_line)),
        None => Err(Fault::new(last_line, "a step above 0 s", format!("{last} s"), REMEDY)),
    }
}
