//! `wall motion`: a ground motion as CSV, in the form FMPy reads with `--input-file` and `wall` with
//! `--record`.

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;

use ground_motion::CSV_HEADER;
use report::counted;

use crate::args::RecordArguments;
use crate::output::Console;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    record: RecordArguments,
    /// The CSV file to write, with the columns time (s) and `a_g` (m/s2)
    #[arg(long, value_name = "FILE")]
    csv: PathBuf,
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let Some((motion, note)) = arguments.record.load(console)? else {
        bail!("no motion is given; give --record FILE or --synthetic");
    };
    console.check_distinct(&arguments.record.record, [&arguments.csv])?;
    let mut csv = format!("{CSV_HEADER}\n");
    for (index, sample) in motion.samples().iter().enumerate() {
        #[allow(clippy::cast_precision_loss, reason = "far fewer than 2⁵³ samples")]
        let time = index as f64 * motion.step();
        // writing to a String cannot fail
        let _ = writeln!(csv, "{time:.9},{sample:?}");
    }
    console.write(&arguments.csv, csv.as_bytes())?;
    console.print(&format!(
        "{}: {note}, {} of {} s, peak {:.4} m/s²\n",
        arguments.csv.display(),
        counted(motion.samples().len(), "sample"),
        report::number(motion.step(), 6),
        motion.peak()
    ))
}
