"""An FMU gives the references of `wall verify formulas`, where its variables show them."""

import csv
import tomllib
from itertools import groupby
from pathlib import Path

from unit import Unit

ROOT = Path(__file__).parents[2]
FORMULAS = ROOT / "crates/evidence/src/verification"
# full rotations, multilinear laws and parts, which this FMU does not have; test_bodies.py packages parts
ABSENT = {"kinematics", "points", "part"}


def scenes():
    """Name, parameters and motion of each scene that is no reference case; `test_cases.py` has those."""
    for formula in tomllib.loads((FORMULAS / "formulas.toml").read_text())["formula"]:
        for name, text in formula.get("scenes", {}).items():
            groups = [group for group in tomllib.loads(text).values() if isinstance(group, dict)]
            values = {key: value for group in groups for key, value in group.items()}
            if not ABSENT & set(values) and not (ROOT / f"tests/data/cases/{name}.toml").exists():
                yield name, values, formula.get("motion")


def inputs(motion, sample):
    """The inputs at a sample of the motion."""
    bottom = motion["bottom"][sample]
    top, drift = motion.get("top"), motion.get("drift")
    return {
        "a_bottom": bottom,
        "a_top": top[sample] if top else bottom,
        "drift": drift[sample] if drift else 0.0,
    }


def start(unit, values, motion):
    """Starts a scene; its motion has two samples."""
    if motion is None:
        return unit.start(**values)
    first, last = inputs(motion, 0), inputs(motion, 1)
    unit.start(**values, **first)
    unit.rates(**{name: (last[name] - first[name]) / motion["step"] for name in first})
    return unit


def test_the_fmu_gives_the_references(either):
    with (FORMULAS / "references.csv").open() as file:
        rows = {name: list(rows) for name, rows in groupby(csv.DictReader(file), lambda row: row["scene"])}
    compared = 0
    for name, values, motion in scenes():
        with Unit(either) as unit:
            start(unit, values, motion)
            # the energy of a wall is no variable
            for row in (row for row in rows[name] if row["variable"] != "energy"):
                if (time := float(row["time"])) > unit.time:
                    unit.step(time - unit.time)
                error = abs(unit.get(row["variable"]) - float(row["reference"]))
                assert error <= float(row["bound"]) * float(row["scale"]), (row, error)
                compared += 1
    assert compared > 60
