//! `wall motion`: a ground motion as CSV, in the form FMPy reads with `--input-file`.

use std::fmt::Write;

use anyhow::{Result, bail};

use crate::args::MotionArguments;
use crate::output;

pub(crate) fn run(arguments: &MotionArguments) -> Result<()> {
    let Some((motion, note)) = arguments.record.load()? else {
        bail!("which motion? give --record FILE or --synthetic");
    };
    let mut csv = String::from("time,a_g\n");
    for (index, sample) in motion.samples().iter().enumerate() {
        #[allow(clippy::cast_precision_loss, reason = "far fewer than 2⁵³ samples")]
        let time = index as f64 * motion.step();
        // writing to a String cannot fail
        let _ = writeln!(csv, "{time:.9},{sample:?}");
    }
    output::to_file(&arguments.csv, csv.as_bytes())?;
    output::to_stdout(&format!(
        "{}: {note}, {} samples of {} s, peak {:.4} m/s²\n",
        arguments.csv.display(),
        motion.samples().len(),
        motion.step(),
        motion.peak()
    ))
}
