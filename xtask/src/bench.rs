//! `cargo xtask bench`: measures the cost of a step in time and in instructions; with `--peers`, error
//! against run time beside other tools in the same run.

use std::fmt::Write as _;
use std::path::Path;

use crate::command::{Result, cargo, output, program, root, succeed, target};
use crate::python::Environment;

/// Names in the table.
const OURS: &str = "rocking-wall";
const OPENSEES: &str = "OpenSeesPy";
const BATCH: &str = "exact 64 at once";

/// Error over `u_ins` that a setting must reach to be called good.
const GOOD: f64 = 1e-4;

/// An environment, its lock, and the tools that run in it by their names for the script and in the table.
type Peers = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

const PYTHON: [Peers; 2] = [
    ("opensees", "xtask/locks/opensees.lock", &[("opensees", OPENSEES)]),
    ("peers", "xtask/locks/peers.lock", &[("numba", "numba"), ("scipy", "SciPy")]),
];

/// Numbers of runs; the difference of their instructions counts.
const FEW: u32 = 5;
const MANY: u32 = 15;

/// Measures the time of each path beside a bare oscillator, then counts instructions by valgrind, which do
/// not depend on the machine's load.
///
/// # Errors
/// If a benchmark fails.
pub(crate) fn paths(record: Option<&str>) -> Result<()> {
    let remedy = "see its message above";
    succeed(cargo().args(["bench", "--locked", "--bench", "step"]), remedy)?;
    let mut bench = cargo();
    bench.args(["bench", "--locked", "--bench", "record", "--"]);
    if let Some(record) = record {
        bench.arg(std::path::absolute(record).map_err(|error| format!("{record}: {error}"))?);
    }
    succeed(&mut bench, remedy)?;
    if output(program("valgrind").arg("--version"), "").is_err() {
        println!("valgrind is not installed: instructions are not counted");
        return Ok(());
    }
    let built = output(
        cargo().args(["bench", "--locked", "--bench", "record", "--no-run", "--message-format", "json"]),
        remedy,
    )?;
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
    let text = std::fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")).unwrap_or_default();
    let total = total.trim().parse().map_err(|error| format!("{}: totals: {error}", file.display()))?;
    let samples = samples.trim().parse().map_err(|error| format!("samples `{samples}`: {error}"))?;
    Ok((total, samples))
}

/// Compares with the peers on walls 2, 5 and 6 of the paper's Table 5, under a record or the project's own
/// motion.
///
/// Returns the table it prints.
///
/// # Errors
/// If the Rust part fails. A peer that cannot be installed or fails is named in the table.
pub(crate) fn peers(record: Option<&str>) -> Result<String> {
    let folder = target().join("peers");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
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
    for (name, lock, tools) in PYTHON {
        if let Err(message) = in_python(name, lock, tools, &folder) {
            missing.extend(tools.iter().map(|(_, tool)| format!("{tool}: {}", message.replace('\n', " "))));
        }
    }
    let path = folder.join("rows.csv");
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let rows: Vec<Row> = text.lines().skip(1).filter_map(Row::parse).collect();
    let table = report(&rows, &missing);
    print!("{table}");
    let output = root().join("fmu_out/peers.csv");
    std::fs::write(&output, with_missing(text, &missing))
        .map_err(|error| format!("{}: {error}", output.display()))?;
    println!("written {}", output.display());
    Ok(table)
}

fn in_python(name: &str, lock: &str, tools: &[(&str, &str)], folder: &Path) -> Result<()> {
    let environment = Environment::of(name, lock)?;
    let mut script = environment.program("python");
    script.arg("xtask/peers/peers.py").arg(folder).args(tools.iter().map(|(tool, _)| tool));
    succeed(&mut script, "see its message above")
}

/// Returns the table as a file, with the peers that did not run.
fn with_missing(mut text: String, missing: &[String]) -> String {
    for line in missing {
        let (tool, reason) = line.split_once(": ").unwrap_or((line, ""));
        // writing to a string does not fail
        let _ = writeln!(text, "all,{tool},missing: {},,,,,", reason.replace(',', ";"));
    }
    text
}

/// A line of the table.
struct Row<'a> {
    scene: &'a str,
    tool: &'a str,
    setting: &'a str,
    /// `None` for a tool that is missing, fails or does not offer the model: the setting says which.
    figures: Option<Figures>,
}

#[derive(Clone, Copy)]
struct Figures {
    seconds: f64,
    /// Largest error over `u_ins`.
    error: f64,
}

impl<'a> Row<'a> {
    fn parse(line: &'a str) -> Option<Self> {
        let mut words = line.split(',');
        let (scene, tool, setting) = (words.next()?, words.next()?, words.next()?);
        let (seconds, error) = (words.next()?, words.next()?);
        let figures = seconds.parse().ok().zip(error.parse().ok());
        Some(Self {
            scene,
            tool,
            setting,
            figures: figures.map(|(seconds, error)| Figures { seconds, error }),
        })
    }
}

fn report(rows: &[Row<'_>], missing: &[String]) -> String {
    let mut text = String::new();
    let all: Vec<&Row<'_>> = rows.iter().collect();
    for scene in distinct(&all, |row| row.scene) {
        let rows: Vec<&Row<'_>> = all.iter().copied().filter(|row| row.scene == scene).collect();
        let _ = write_scene(&mut text, scene, &rows);
    }
    for line in missing {
        let _ = writeln!(text, "missing: {line}");
    }
    text
}

fn write_scene(text: &mut String, scene: &str, rows: &[&Row<'_>]) -> std::fmt::Result {
    let Some((own, base)) = own_run(rows) else {
        return writeln!(text, "\n{scene}: rocking-wall has no row");
    };
    writeln!(text, "\n{scene}; times relative to {own}, {:.3} ms", base.seconds * 1e3)?;
    writeln!(
        text,
        "{:<14}{:<26}{:>12}{:>18}{:>12}",
        "tool", "setting", "time [ms]", "error/u_ins [-]", "time ratio"
    )?;
    for row in rows {
        match row.figures {
            Some(figures) => write_row(text, row.tool, row.setting, figures, base)?,
            None => writeln!(text, "{:<14}{}", row.tool, row.setting)?,
        }
    }
    writeln!(text, "cheapest setting with an error of at most {GOOD:.0e} u_ins:")?;
    for tool in distinct(rows, |row| row.tool) {
        let good = rows
            .iter()
            .filter(|row| row.tool == tool)
            .filter_map(|row| row.figures.map(|figures| (row.setting, figures)))
            .filter(|(setting, figures)| figures.error <= GOOD && is_single(setting))
            .min_by(|(_, one), (_, other)| one.seconds.total_cmp(&other.seconds));
        if let Some((setting, figures)) = good {
            write_row(text, tool, setting, figures, base)?;
        } else {
            // a tool without figures states the reason
            let mut of_tool = rows.iter().filter(|row| row.tool == tool);
            let reason = of_tool.clone().all(|row| row.figures.is_none()).then(|| of_tool.next()).flatten();
            writeln!(text, "{tool:<14}{}", reason.map_or("none", |row| row.setting))?;
        }
    }
    // its first row is at the record's step
    let opensees = rows.iter().find(|row| row.tool == OPENSEES).and_then(|row| row.figures);
    if let Some(figures) = opensees {
        let (seconds, error) = (figures.seconds, figures.error);
        writeln!(
            text,
            "{OPENSEES}'s step loop at the record's step: {:.2} ms, {:.1} times {own}; error \
             {error:.1e} u_ins",
            seconds * 1e3,
            seconds / base.seconds
        )?;
        let batch = rows.iter().find(|row| row.tool == OURS && row.setting == BATCH);
        if let Some(batch) = batch.and_then(|row| row.figures) {
            let ratio = seconds / batch.seconds;
            writeln!(
                text,
                "and {ratio:.0} times a run of rocking-wall exact in a batch of 64, {:.4} ms",
                batch.seconds * 1e3
            )?;
        }
    }
    Ok(())
}

/// Finds rocking-wall's exact run or, without a closed form, its cheapest good one.
fn own_run(rows: &[&Row<'_>]) -> Option<(String, Figures)> {
    let own = rows.iter().filter(|row| row.tool == OURS);
    let own = own.filter_map(|row| row.figures.map(|figures| (row.setting, figures)));
    let exact = own.clone().find(|(setting, _)| *setting == "exact");
    let cheapest = || {
        own.filter(|(setting, figures)| {
            setting.starts_with("adaptive") && figures.error <= GOOD && is_single(setting)
        })
        .min_by(|(_, one), (_, other)| one.seconds.total_cmp(&other.seconds))
    };
    exact.or_else(cheapest).map(|(setting, figures)| (format!("{OURS} {setting}"), figures))
}

/// Tells whether the time is that of a single run, not the share of a batch.
fn is_single(setting: &str) -> bool {
    !setting.ends_with("at once")
}

fn write_row(
    text: &mut String,
    tool: &str,
    setting: &str,
    figures: Figures,
    base: Figures,
) -> std::fmt::Result {
    let (milliseconds, ratio) = (figures.seconds * 1e3, figures.seconds / base.seconds);
    writeln!(text, "{tool:<14}{setting:<26}{milliseconds:>12.3}{:>18.1e}{ratio:>12.2}", figures.error)
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
