"""How safe a wall is that just passes a check: from the tables of `wall study ida` and `wall check --json`.

    python examples/python/reliability.py WALL STUDY.toml RESULTS

WALL is the program, STUDY.toml a study with a table `[check]` and `measure = "code"`, RESULTS the folder of
`wall study ida STUDY.toml -o RESULTS`. It prints what `wall study reliability` computes too.
"""

import csv
import json
import subprocess
import sys
from math import erfc, log, sqrt
from pathlib import Path

# a check states a_g in units of 9.81 m/s² (NTC 3.2.3.2.1), a study in those of 9.80665 m/s²
CODE_GRAVITY, STUDY_GRAVITY = 9.81, 9.80665
CHECKS = {"SLV with q": "SLV_q", "SLV": "SLV", "SLC": "SLC"}


def ground(verdict: dict, check: str) -> float | None:
    """Returns the a_g of records with which a wall just passes a check, on its less favourable side (g)."""
    sides = (side for side in (verdict.get("sides") or {}).values() if side and check in side)
    least = min((side[check]["ag"] for side in sides), default=None)
    return None if least is None else least * CODE_GRAVITY / STUDY_GRAVITY


def main(program: str, study: str, results: str) -> list[dict]:
    """Returns margin and probability of the fall for each wall, model and check."""
    printed = subprocess.run([program, "check", study, "--json"], check=True, capture_output=True, text=True)
    verdicts = {one["name"]: one["verdict"] for one in json.loads(printed.stdout)}
    rows = []
    with (Path(results) / "fragilities.csv").open(encoding="utf-8") as file:
        # the limit state 1 is the fall
        falls = [row for row in csv.DictReader(file) if float(row["u_max_over_u_ins"]) == 1.0]
    for row in falls:
        theta, beta = float(row["theta_g"]), float(row["beta"])
        for name, check in CHECKS.items():
            code = ground(verdicts[row["wall"]], check)
            if code is not None:
                probability = 0.5 * erfc(log(theta / code) / (beta * sqrt(2.0)))
                rows.append(
                    {
                        "wall": row["wall"],
                        "model": row["model"],
                        "check": name,
                        "ag_code_g": code,
                        "margin": theta / code,
                        "probability": probability,
                    }
                )
    return rows


if __name__ == "__main__":
    if len(sys.argv) != 4:
        print(__doc__)
        sys.exit()
    for found in main(*sys.argv[1:4]):
        print(
            f"{found['wall']:<10} {found['model']:<5} {found['check']:<10} "
            f"a_g,code {found['ag_code_g']:.4f} g, margin {found['margin']:.3f}, "
            f"P(fall) {found['probability']:.4f}"
        )
