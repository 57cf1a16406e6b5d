//! `cargo xtask bench`: measures the cost of a step in time and in instructions; with `--peers`, error
//! against run time beside other tools in the same run.

use std::fmt::Write as _;
use std::path::Path;

use crate::command::{Result, cargo, output, program, read, remove_folder, root, succeed, target, write};
use crate::python::Environment;

/// The measurements of the peers.
pub(crate) const PEERS: &str = "fmu_out/peers.csv";
/// The tools, by their names in the table.
const TOOLS: [&str; 8] = [OURS, "ode_solvers", "diffsol", OPENSEES, "numba", "SciPy", "JAX", "diffrax"];
/// The locks that pin them.
const LOCKS: [&str; 3] = ["tests/peers/Cargo.lock", "xtask/locks/opensees.lock", "xtask/locks/peers.lock"];
const OURS: &str = "rocking-wall";
const OPENSEES: &str = "OpenSeesPy";
/// End of the settings of runs in a batch.
const AT_ONCE: &str = "64 at once";

/// Largest error over `u_ins` of a good setting.
const GOOD: f64 = 1e-4;
/// Largest error of the peak over `u_ins` that a study may allow, which needs no history.
const GOOD_PEAK: f64 = 1e-3;

/// An environment, and the tools that run in it by their names for the script and in the table.
type Peers = (&'static str, &'static [(&'static str, &'static str)]);

const PYTHON: [Peers; 2] = [
    ("opensees", &[("opensees", OPENSEES)]),
    ("peers", &[("numba", "numba"), ("scipy", "SciPy"), ("jax", "JAX"), ("diffrax", "diffrax")]),
];

/// The paths whose instructions are counted, by their names for the benchmark.
const PATHS: [&str; 9] = [
    "segments",
    "settling-segments",
    "demands",
    "record",
    "batch",
    "together",
    "adaptive",
    "adaptive-batch",
    "settling",
];

/// Numbers of runs; the difference of their instructions counts.
const FEW: u32 = 5;
const MANY: u32 = 15;

/// Measures the time of each path beside a bare oscillator, then counts instructions by valgrind, which do
/// not depend on the machine's load.
pub(crate) fn paths(record: Option<&str>) -> Result<()> {
    let remedy = "see its message above";
    succeed(cargo().args(["bench", "--profile", "dist", "--locked", "--bench", "step"]), remedy)?;
    let mut bench = cargo();
    bench.args([
        "bench",
        "--profile",
        "dist",
        "--locked",
        "--package",
        "rocking-record",
        "--bench",
        "record",
        "--",
    ]);
    if let Some(record) = record {
        bench.arg(std::path::absolute(record).map_err(|error| format!("{record}: {error}"))?);
    }
    succeed(&mut bench, remedy)?;
    if output(program("valgrind").arg("--version"), "").is_err() {
        println!("valgrind is not installed: instructions are not counted");
        return Ok(());
    }
    let bench = "bench --profile dist --locked --package rocking-record --bench record";
    let no_run = ["--no-run", "--message-format", "json"];
    let built = output(cargo().args(bench.split(' ')).args(no_run), remedy)?;
    let binary = executable(&built).ok_or("cargo names no benchmark in its messages")?;
    println!("\ninstructions a sample, walls of Table 5 under the embedded motion");
    for path in PATHS {
        let [few, many] = [FEW, MANY].map(|runs| instructions(&binary, path, runs));
        let (few, many) = (few?, many?);
        println!(
            "{path:<20}{:>10.1}",
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
/// Returns the machine, the versions and a table: of each scene `OpenSeesPy` at the record's step and each
/// tool's fastest good setting. Prints it with those whose peak alone is good. It names a peer that cannot be
/// installed or fails.
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
    let mut rows: Vec<Measured> = text.lines().skip(1).filter_map(Measured::parse).collect();
    rows.sort_by_key(|row| row.scene);
    let conditions = conditions()?;
    let [table, printed] =
        [false, true].map(|with_peaks| conditions.clone() + &report(&rows, &missing, with_peaks));
    print!("{printed}");
    for (tool, reason) in &missing {
        // writing to a string does not fail
        let _ = writeln!(text, "all,{tool},missing: {},,,,,", reason.replace(',', ";"));
    }
    write(PEERS, text)?;
    println!("written {}", root().join(PEERS).display());
    Ok(table)
}

/// Names the processor, its threads, and the tools with the versions that their locks pin.
fn conditions() -> Result<String> {
    let processors = read("/proc/cpuinfo").unwrap_or_default();
    let processor = processors.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let processor = processor.map_or(std::env::consts::ARCH, |(_, name)| name);
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let locks = LOCKS.map(read).into_iter().collect::<Result<Vec<_>>>()?.join("\n");
    let versions = TOOLS.map(|tool| {
        let name = tool.to_lowercase();
        let pins = [format!("name = \"{name}\"\nversion = \""), format!("\n{name}==")];
        let pinned = pins.iter().find_map(|pin| locks.split_once(pin)?.1.split(['"', ' ']).next());
        format!("{tool} {}", pinned.unwrap_or("of unknown version"))
    });
    let (first, others) = versions.split_at(TOOLS.len() / 2);
    Ok(format!("{processor}, {threads} threads\n{},\n{}\n", first.join(", "), others.join(", ")))
}

fn in_python(name: &str, tools: &[(&str, &str)], folder: &Path) -> Result<()> {
    let environment = Environment::of(name)?;
    let mut script = environment.program("python");
    script.arg("tests/peers/peers.py").arg(folder).args(tools.iter().map(|(tool, _)| tool));
    succeed(&mut script, "see its message above")
}

/// A line of the table.
struct Measured<'a> {
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

impl<'a> Measured<'a> {
    fn parse(line: &'a str) -> Option<Self> {
        let mut words = line.split(',');
        let (scene, tool, setting) = (words.next()?, words.next()?, words.next()?);
        let mut number = || Some(words.next()?.parse().unwrap_or(f64::NAN));
        let (seconds, error, _rms, peak) = (number()?, number()?, number()?, number()?);
        Some(Self { scene, tool, setting, seconds, error, peak })
    }
}

fn report(rows: &[Measured<'_>], missing: &[(&str, String)], with_peaks: bool) -> String {
    let mut text = String::new();
    for rows in rows.chunk_by(|one, other| one.scene == other.scene) {
        // writing to a string does not fail
        let _ = write_scene(&mut text, rows, with_peaks);
    }
    for (tool, reason) in missing {
        let _ = writeln!(text, "missing: {tool}: {reason}");
    }
    text
}

fn write_scene(text: &mut String, rows: &[Measured<'_>], with_peaks: bool) -> std::fmt::Result {
    let of = |tool| rows.iter().filter(move |row| row.tool == tool);
    // the time of a run in a batch is a share
    let in_batch = |row: &Measured<'_>| row.setting.ends_with(AT_ONCE);
    let good = |row: &Measured<'_>| row.error <= GOOD && !in_batch(row);
    let scene = rows[0].scene;
    // without a closed form, the fastest good one
    let own = of(OURS).find(|row| row.setting == "exact" && !row.error.is_nan());
    let Some(own) = own.or_else(|| fastest(of(OURS), good)) else {
        return writeln!(text, "\n{scene}: rocking-wall has no row");
    };
    writeln!(text, "\n{scene}; times relative to {OURS} {}, {:.3} ms", own.setting, own.seconds * 1e3)?;
    writeln!(
        text,
        "{:<14}{:<26}{:>12}{:>18}{:>12}",
        "tool", "setting", "time [ms]", "error/u_ins [-]", "time ratio"
    )?;
    // its first row is at the record's step
    let opensees = of(OPENSEES).next().filter(|row| !row.error.is_nan());
    if let Some(opensees) = opensees {
        write_row(text, opensees, own.seconds, opensees.error)?;
    }
    writeln!(text, "fastest setting with an error of at most {GOOD:.0e} u_ins:")?;
    for tool in TOOLS {
        match (fastest(of(tool), good), of(tool).find(|row| row.error.is_nan())) {
            (Some(row), _) => write_row(text, row, own.seconds, row.error)?,
            (None, why) => writeln!(text, "{tool:<14}{}", why.map_or("none", |row| row.setting))?,
        }
    }
    let batch = of(OURS).find(|row| row.setting == "exact 64 at once" && !row.error.is_nan());
    if let Some((opensees, batch)) = opensees.zip(batch) {
        writeln!(
            text,
            "{OPENSEES} at the record's step takes {:.0} times a run of {OURS} exact in a batch of 64, \
             {:.4} ms",
            opensees.seconds / batch.seconds,
            batch.seconds * 1e3
        )?;
    }
    let good = |row: &Measured<'_>| row.peak <= GOOD_PEAK;
    let Some(own) = fastest(of(OURS), |row| good(row) && in_batch(row)).filter(|_| with_peaks) else {
        return Ok(());
    };
    // what a study with peaks of that accuracy costs
    writeln!(
        text,
        "peaks to {GOOD_PEAK:.0e} u_ins; times relative to {OURS} {}, errors of peaks:",
        own.setting
    )?;
    TOOLS
        .iter()
        .filter_map(|tool| fastest(of(tool), good))
        .try_for_each(|row| write_row(text, row, own.seconds, row.peak))
}

fn fastest<'a>(
    rows: impl Iterator<Item = &'a Measured<'a>>,
    good: impl Fn(&Measured<'a>) -> bool,
) -> Option<&'a Measured<'a>> {
    rows.filter(|row| good(row)).min_by(|one, other| one.seconds.total_cmp(&other.seconds))
}

fn write_row(text: &mut String, row: &Measured<'_>, base: f64, error: f64) -> std::fmt::Result {
    let Measured { tool, setting, seconds, .. } = row;
    let (milliseconds, ratio) = (seconds * 1e3, seconds / base);
    writeln!(text, "{tool:<14}{setting:<26}{milliseconds:>12.3}{error:>18.1e}{ratio:>12.2}")
}
