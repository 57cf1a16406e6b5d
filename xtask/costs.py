"""What the project's commands cost from nothing, and which crates take it.

    cargo xtask costs [JOB ...] [--against COMMIT]   measure; write docs/costs.csv and docs/costs.md
    cargo xtask costs --check JOB=SECONDS ...        fail where a job costs 10 % more than in the last month

A cost is the CPU time of all processes, user and system, of a job in a clone with an empty registry, empty
caches, an empty home and nothing built. Machines differ, so each cost is also stated as a multiple of the
*clock*: the CPU time in which this machine's rustc optimises a fixed file. Only figures of one kind of
machine are compared.
"""

import argparse
import csv
import datetime
import json
import os
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[1]
FIGURES = ROOT / "docs/costs.csv"
DOCUMENT = ROOT / "docs/costs.md"
FIELDS = ["date", "commit", "machine", "job", "cpu_s", "elapsed_s", "clock_s"]
JOBS = {
    "demo": "cargo xtask demo",
    "test": "cargo xtask test",
    "install": "cargo install --locked --path crates/wall-cli --timings --root installed",
    "wheel": "python3 -m venv venv && venv/bin/pip install --quiet ./crates/python",
}
LIMIT = 1.10  # of the median of the last month
DAYS = 31
SHARE = 0.01  # of a job, below which a crate has no row of its own


def cpu():
    """The CPU time of the processes that have ended (s)."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measured(command, **keys):
    """Runs a command; returns its CPU time and the time that passed (s)."""
    before, start = cpu(), datetime.datetime.now()
    subprocess.run(command, check=True, **keys)
    return cpu() - before, (datetime.datetime.now() - start).total_seconds()


def clock():
    """The CPU time in which rustc optimises a file of twenty functions, the least of three (s)."""
    body = "let mut v: Vec<[f64; {0}]> = (0..n).map(|i| [i as f64; {0}]).collect();"
    body += "v.sort_by(|a, b| b[{0} - 1].total_cmp(&a[0])); v.iter().map(|a| a[0] * {0}.0).sum()"
    lines = (f"pub fn f{k}(n: usize) -> f64 {{ {body.replace('{0}', str(k))} }}" for k in range(1, 21))
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "clock.rs").write_text("\n".join(lines))
        command = [
            "rustc",
            "--crate-type=lib",
            "--emit=obj",
            "--edition=2024",
            "-O",
            "-Ccodegen-units=1",
            "clock.rs",
        ]
        return min(measured(command, cwd=folder)[0] for _ in range(3))


def machine():
    """The processor, the number of its threads, and what makes the tests longer where it is installed."""
    names = re.findall(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    folder = ["rustc", "--print", "target-libdir", "--target", "wasm32-unknown-unknown"]
    has = {
        "WebAssembly": Path(subprocess.check_output(folder, text=True).strip()).is_dir(),
        "browser": shutil.which("chromedriver"),
    }
    kind = f"{names[0] if names else os.uname().machine} × {os.cpu_count()}"
    return " + ".join([kind, *(name for name in has if has[name])])


def run(job, commit):
    """Measures a job at a commit; returns its row, and the seconds by crate where cargo tells them."""
    with tempfile.TemporaryDirectory() as folder:
        clone = Path(folder, "clone")
        subprocess.run(["git", "clone", "--quiet", ROOT, clone], check=True)
        subprocess.run(["git", "checkout", "--quiet", commit], cwd=clone, check=True)
        of_clock = clock()
        bare = f". {ROOT}/.ci/bare {folder}/bare && {JOBS[job]}"
        seconds, elapsed = measured(
            ["bash", "-ec", bare], cwd=clone, env={**os.environ, "CARGO_INCREMENTAL": "0"}
        )
        page = next(Path(folder, "bare/target/cargo-timings").glob("cargo-timing.html"), None)
        crates = by_crate(page.read_text()) if page else Counter()
    values = [
        datetime.date.today(),
        commit,
        machine(),
        job,
        f"{seconds:.0f}",
        f"{elapsed:.0f}",
        f"{of_clock:.2f}",
    ]
    return dict(zip(FIELDS, map(str, values), strict=True)), crates


def by_crate(page):
    """The seconds of each crate, with its version, from the page that `--timings` writes."""
    units = json.loads(re.search(r"const UNIT_DATA = (\[.*?\]);\n", page, re.DOTALL)[1])
    seconds = Counter()
    for unit in units:
        seconds[f"{unit['name']} {unit['version']}"] += unit["duration"]
    return seconds


def ratio(row):
    """The cost of a row as a multiple of the clock."""
    return float(row["cpu_s"]) / float(row["clock_s"])


def figures():
    """The rows of the file of figures."""
    return list(csv.DictReader(FIGURES.read_text().splitlines())) if FIGURES.is_file() else []


def keep(rows):
    """Adds rows to the file of figures."""
    rows = [*figures(), *rows]
    with FIGURES.open("w", newline="") as file:
        table = csv.DictWriter(file, FIELDS, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def write(mark, lines):
    """Replaces what stands between two marks of the document."""
    text = DOCUMENT.read_text()
    begin, end = f"<!-- {mark} -->\n", f"<!-- end of {mark} -->\n"
    before, rest = text.split(begin)
    DOCUMENT.write_text(before + begin + "\n".join(lines) + "\n" + end + rest.split(end)[1])


def measure(jobs, against):
    """Measures jobs at the last commit and, if one is named, at another; writes figures and tables."""
    head = subprocess.check_output(["git", "rev-parse", "--short=8", "HEAD"], cwd=ROOT, text=True).strip()
    table = [
        "| job | commit | CPU (s) | elapsed (s) | of the clock | of the other commit |",
        "|---|---|---|---|---|---|",
    ]
    for job in jobs:
        other, _ = run(job, against) if against else (None, None)
        row, crates = run(job, head)
        keep([row] if other is None else [other, row])
        for one in filter(None, [other, row]):
            of_other = f"{float(row['cpu_s']) / float(other['cpu_s']):.2f}" if other and one is row else ""
            cells = [one["commit"], one["cpu_s"], one["elapsed_s"], f"{ratio(one):.0f}", of_other]
            table.append(f"| `{JOBS[job].split(' --timings')[0]}` | {' | '.join(cells)} |")
        if crates:
            total = sum(crates.values())
            heavy = [(name, own) for name, own in crates.most_common() if own > SHARE * total]
            shares = [f"| {name} | {own:.1f} | {100 * own / total:.0f} % |" for name, own in heavy]
            write("crates", ["| crate | seconds | share |", "|---|---|---|", *shares])
    write("jobs", table)
    print("\n".join(table))


def check(costs):
    """Returns what is wrong with costs, `JOB=SECONDS`, beside those of the last month on such a machine."""
    of_clock, since = clock(), str(datetime.date.today() - datetime.timedelta(DAYS))
    here = [row for row in figures() if row["machine"] == machine() and row["date"] > since]
    faults = []
    for job, seconds in (cost.split("=") for cost in costs):
        own = float(seconds) / of_clock
        known = [ratio(row) for row in here if row["job"] == job]
        if not known:
            print(f"{job}: {own:.0f} times the clock ({seconds} s); no earlier figure of this machine")
            continue
        usual = statistics.median(known)
        print(f"{job}: {own:.0f} times the clock ({seconds} s), {own / usual:.2f} of the last month's median")
        if own > LIMIT * usual:
            faults.append(
                f"{job} costs {own / usual:.2f} times what it did in the last month; at most {LIMIT}"
            )
    return faults


def main():
    parser = argparse.ArgumentParser("cargo xtask costs", description=__doc__.split("\n")[0])
    parser.add_argument("jobs", nargs="*", help=f"some of {', '.join(JOBS)}; without any, all")
    parser.add_argument("--against", metavar="COMMIT", help="measure this commit too, and state the ratio")
    parser.add_argument("--check", nargs="+", metavar="JOB=SECONDS", help="compare with docs/costs.csv")
    given = parser.parse_args()
    if unknown := [job for job in given.jobs if job not in JOBS]:
        parser.error(f"`{unknown[0]}` is not one of {', '.join(JOBS)}")
    if given.check:
        sys.exit("\n".join(check(given.check)) or None)
    measure(given.jobs or list(JOBS), given.against)


main()
