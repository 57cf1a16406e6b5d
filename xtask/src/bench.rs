//! `cargo xtask bench`: measures the cost of a step in time and in instructions; with `--peers`, error
//! against run time beside other tools in the same run.

use std::fmt::Write as _;
use std::path::Path;

use crate::command::{Result, cargo, output, program, read, remove_folder, root, succeed, target, write};
use crate::python::Environment;

/// The measurements of the peers.
pub(crate) const PEERS: &str = "fmu_out/peers.csv";
/// Names in the table.
const OURS: &str = "rocking-wall";
const OPENSEES: &str = "OpenSeesPy";
const BATCH: &str = "exact 64 at once";
/// End of the settings of runs in a batch.
const AT_ONCE: &str = "64 at once";

/// Largest error over `u_ins` of a good setting.
const GOOD: f64 = 1e-4;
/// Largest error of the peak over `u_ins` that a study may allow, which needs no history.
const GOOD_PEAK: f64 = 1e-3;

/// An environment, and the tools that run in it by their names for the script and in the table.
type Peers = (&'static str, &'static [(&'static str, &'static str)]);

const PYTHON: [Peers; 2] =
    [("opensees", &[("opensees", OPENSEES)]), ("peers", &[("numba", "numba"), ("scipy", "SciPy")])];

/// Numbers of runs; the difference of their instructions counts.
const FEW: u32 = 5;
const MANY: u32 = 15;

/// Measures the time of each path beside a bare oscillator, then counts instructions by valgrind, which do
/// not depend on the machine's load.
pub(crate) fn paths(record: Option<&str>) -> Result<()> {
    let remedy = "see its message above";
    succeed(cargo().args(["bench", "--locked", "--bench", "step"]), remedy)?;
    let mut bench = cargo();
    bench.args(["bench", "--locked", "--package", "rocking-record", "--bench", "record", "--"]);
    if let Some(record) = record {
        bench.arg(std::path::absolute(record).map_err(|error| format!("{record}: {error}"))?);
    }
    succeed(&mut bench, remedy)?;
    if output(program("valgrind").arg("--version"), "").is_err() {
        println!("valgrind is not installed: instructions are not counted");
        return Ok(());
    }
    let no_run = "bench --locked --package rocking-record --bench record --no-run --message-format json";
    let built = output(cargo().args(no_run.split(' ')), remedy)?;
    let binary = executable(&built).ok_or("cargo names no benchmark in its messages")?;
    println!("\ninstructions a sample, walls of Table 5 under the embedded motion");
    for path in ["segments", "record", "batch", "adaptive"] {
        let [few, many] = [FEW, MANY].map(|runs| instructions(&binary, path, runs));
        let (few, many) = (few?, many?);
        println!(
            "{path:<12}{:>10.1}",
            (many.0 - few.0) as f64 / many.1 * f64::from(MANY) / f64::from(MANY - FEW)
        );
    }
    Ok(())
}

/// Finds the benchmark's program in cargo's messages.
fn executable(messages: &str) -> Option<String> {
    let marked = messages.lines().filter_map(|line| line.split_once("\"executable\":\"")).next_back()?;
    marked.1.split('"').next().map(str::to_owned)
}

/// Counts the instructions of `runs` runs of a path, and the samples in them.
fn instructions(binary: &str, path: &str, runs: u32) -> Result<(u64, f64)> {
    let file = target().join("callgrind.out");
    let mut valgrind = program("valgrind");
    valgrind.args(["--tool=callgrind", "--quiet"]).arg(format!("--callgrind-out-file={}", file.display()));
    let samples = output(valgrind.args([binary, "--count", path, &runs.to_string()]), "")?;
    let text = read(&file)?;
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")).unwrap_or_default();
    let total = total.trim().parse().map_err(|error| format!("{}: totals: {error}", file.display()))?;
    let samples = samples.trim().parse().map_err(|error| format!("samples `{samples}`: {error}"))?;
    Ok((total, samples))
}

/// Compares with the peers on walls 2, 5 and 6 of the paper's Table 5, under a record or the project's own
/// motion.
///
/// Returns an outline of the table it prints: of each scene the run of rocking-wall, `OpenSeesPy` at the
/// record's step, and each tool's cheapest good settings. It names a peer that cannot be installed or fails.
pub(crate) fn peers(record: Option<&str>) -> Result<String> {
    let folder = target().join("peers");
    remove_folder(&folder)?;
    let mut rust = cargo();
    rust.args(["run", "--release", "--locked", "--quiet", "--manifest-path", "tests/peers/Cargo.toml", "--"]);
    rust.arg(&folder);
    rust.env("CARGO_TARGET_DIR", target().join("peers-build"));
    if let Some(record) = record {
        // cargo runs in the root folder, but the path is relative to the user's folder
        rust.arg(std::path::absolute(record).map_err(|error| format!("{record}: {error}"))?);
    }
    succeed(&mut rust, "see its message above")?;
    let mut missing = Vec::new();
    for (name, tools) in PYTHON {
        if let Err(message) = in_python(name, tools, &folder) {
            missing.extend(tools.iter().map(|(_, tool)| (*tool, message.replace('\n', " "))));
        }
    }
    let mut text = read(folder.join("rows.csv"))?;
    let rows: Vec<Row> = text.lines().skip(1).filter_map(Row::parse).collect();
    let [table, outline] = [false, true].map(|is_outline| report(&rows, &missing, is_outline));
    print!("{table}");
    for (tool, reason) in &missing {
        // writing to a string does not fail
        let _ = writeln!(text, "all,{tool},missing: {},,,,,", reason.replace(',', ";"));
    }
    write(PEERS, text)?;
    println!("written {}", root().join(PEERS).display());
    Ok(outline)
}

fn in_python(name: &str, tools: &[(&str, &str)], folder: &Path) -> Result<()> {
    let environment = Environment::of(name)?;
    let mut script = environment.program("python");
    script.arg("tests/peers/peers.py").arg(folder).args(tools.iter().map(|(tool, _)| tool));
    succeed(&mut script, "see its message above")
}

/// A line of the table.
struct Row<'a> {
    scene: &'a str,
    tool: &'a str,
    /// Of a tool that is missing, fails or does not offer the model: the reason.
    setting: &'a str,
    /// Run time; NaN where the tool did not run.
    seconds: f64,
    /// Largest error over `u_ins`; NaN where the tool did not run.
    error: f64,
    /// Error of the largest |u| over `u_ins`; NaN likewise.
    peak: f64,
}

impl<'a> Row<'a> {
    fn parse(line: &'a str) -> Option<Self> {
        let mut words = line.split(',');
        let (scene, tool, setting) = (words.next()?, words.next()?, words.next()?);
        let mut number = || Some(words.next()?.parse().unwrap_or(f64::NAN));
        let (seconds, error, _rms, peak) = (number()?, number()?, number()?, number()?);
        Some(Self { scene, tool, setting, seconds, error, peak })
    }
}

fn report(rows: &[Row<'_>], missing: &[(&str, String)], is_outline: bool) -> String {
    let mut text = String::new();
    let all: Vec<&Row<'_>> = rows.iter().collect();
    for scene in distinct(&all, |row| row.scene) {
        let rows: Vec<&Row<'_>> = all.iter().copied().filter(|row| row.scene == scene).collect();
        let _ = write_scene(&mut text, scene, &rows, is_outline);
    }
    for (tool, reason) in missing {
        let _ = writeln!(text, "missing: {tool}: {reason}");
    }
    text
}

fn write_scene(text: &mut String, scene: &str, rows: &[&Row<'_>], is_outline: bool) -> std::fmt::Result {
    let Some(base) = own_run(rows) else {
        return writeln!(text, "\n{scene}: rocking-wall has no row");
    };
    let own = format!("{OURS} {}", base.setting);
    writeln!(text, "\n{scene}; times relative to {own}, {:.3} ms", base.seconds * 1e3)?;
    writeln!(
        text,
        "{:<14}{:<26}{:>12}{:>18}{:>12}",
        "tool", "setting", "time [ms]", "error/u_ins [-]", "time ratio"
    )?;
    let first = |tool| rows.iter().position(|row| row.tool == tool);
    let outline = [first(OURS), first(OPENSEES)];
    for (place, row) in rows.iter().enumerate() {
        if !is_outline || outline.contains(&Some(place)) {
            write_row(text, row, base.seconds, row.error)?;
        }
    }
    writeln!(text, "cheapest setting with an error of at most {GOOD:.0e} u_ins:")?;
    for tool in distinct(rows, |row| row.tool) {
        let mut of_tool = rows.iter().copied().filter(|row| row.tool == tool);
        match cheapest(of_tool.clone()) {
            Some(row) => write_row(text, row, base.seconds, row.error)?,
            None if of_tool.clone().any(|row| !row.error.is_nan()) => writeln!(text, "{tool:<14}none")?,
            None => {
                of_tool.next().map_or(Ok(()), |row| write_row(text, row, base.seconds, row.error))?;
            }
        }
    }
    write_peaks(text, rows)?;
    // its first row is at the record's step
    let Some(opensees) = rows.iter().find(|row| row.tool == OPENSEES && !row.error.is_nan()) else {
        return Ok(());
    };
    writeln!(
        text,
        "{OPENSEES}'s step loop at the record's step: {:.2} ms, {:.1} times {own}; error {:.1e} u_ins",
        opensees.seconds * 1e3,
        opensees.seconds / base.seconds,
        opensees.error
    )?;
    let batch = rows.iter().find(|row| row.tool == OURS && row.setting == BATCH && !row.error.is_nan());
    let Some(batch) = batch else { return Ok(()) };
    writeln!(
        text,
        "and {:.0} times a run of rocking-wall exact in a batch of 64, {:.4} ms",
        opensees.seconds / batch.seconds,
        batch.seconds * 1e3
    )
}

/// Writes the fastest run of each tool whose peak is good, beside a run of rocking-wall in a batch: what a
/// study with peaks of that accuracy costs.
fn write_peaks(text: &mut String, rows: &[&Row<'_>]) -> std::fmt::Result {
    let good = |row: &&&Row<'_>| row.peak <= GOOD_PEAK;
    let fastest = |one: &&&Row<'_>, other: &&&Row<'_>| one.seconds.total_cmp(&other.seconds);
    let own = rows.iter().filter(|row| row.tool == OURS && row.setting.ends_with(AT_ONCE));
    let Some(own) = own.filter(good).min_by(fastest) else { return Ok(()) };
    writeln!(
        text,
        "peaks to {GOOD_PEAK:.0e} u_ins; times relative to {OURS} {}, errors of peaks:",
        own.setting
    )?;
    for tool in distinct(rows, |row| row.tool) {
        let of_tool = rows.iter().filter(|row| row.tool == tool);
        if let Some(row) = of_tool.filter(good).min_by(fastest) {
            write_row(text, row, own.seconds, row.peak)?;
        }
    }
    Ok(())
}

/// Finds rocking-wall's exact run or, without a closed form, its cheapest good one.
fn own_run<'a>(rows: &[&'a Row<'a>]) -> Option<&'a Row<'a>> {
    let mut own = rows.iter().copied().filter(|row| row.tool == OURS && !row.error.is_nan());
    let exact = own.clone().find(|row| row.setting == "exact");
    exact.or_else(|| cheapest(own.by_ref().filter(|row| row.setting.starts_with("adaptive"))))
}

/// Returns the fastest single run with a good error. Runs in a batch are left out: their time is a share.
fn cheapest<'a>(rows: impl Iterator<Item = &'a Row<'a>>) -> Option<&'a Row<'a>> {
    let good = rows.filter(|row| row.error <= GOOD && !row.setting.ends_with(AT_ONCE));
    good.min_by(|one, other| one.seconds.total_cmp(&other.seconds))
}

fn write_row(text: &mut String, row: &Row<'_>, base: f64, error: f64) -> std::fmt::Result {
    let Row { tool, setting, seconds, .. } = row;
    if error.is_nan() {
        return writeln!(text, "{tool:<14}{setting}");
    }
    let (milliseconds, ratio) = (seconds * 1e3, seconds / base);
    writeln!(text, "{tool:<14}{setting:<26}{milliseconds:>12.3}{error:>18.1e}{ratio:>12.2}")
}

/// Returns the values of a column in order of appearance.
fn distinct<'a>(rows: &[&Row<'a>], column: impl Fn(&Row<'a>) -> &'a str) -> Vec<&'a str> {
    let mut values = Vec::new();
    for row in rows {
        let value = column(row);
        if !values.contains(&value) {
            values.push(value);
        }
    }
    values
}
