"""Times Python peers on the problems that rocking-wall-peers wrote, and appends their rows to its table.

Usage: peers.py FOLDER TOOL...   with the tools opensees, scipy, numba, jax, diffrax

Each tool solves u'' = -participation a_g - c(u) u' - F(u)/m with a_g linear between samples, from rest, and
returns u at the samples. Times are the least of several runs after a warm-up, without setting up the model. A
tool that is not installed has one row per scene that says so.
"""

import csv
import importlib
import sys
from pathlib import Path

from measuring import Problem, one_line

TOOLS = {
    "opensees": "OpenSeesPy",
    "scipy": "SciPy",
    "numba": "numba",
    "jax": "JAX",
    "diffrax": "diffrax",
}


def main():
    folder, names = Path(sys.argv[1]), sys.argv[2:]
    problems = [Problem(path) for path in sorted(folder.glob("wall_*.json"))]
    with (folder / "rows.csv").open("a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        for name in names:
            tool = TOOLS[name]
            for problem in problems:
                print(f"{problem.scene}: {tool}", flush=True)
                try:
                    importlib.import_module(f"tools.{name}").run(writer, problem)
                except (ImportError, OSError, RuntimeError) as error:
                    writer.writerow([problem.scene, tool, f"missing: {one_line(error)}", "", "", "", "", ""])


main()
