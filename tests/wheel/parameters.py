"""Writes the parameters of a wall, and what follows from them, from the model description.

`cargo xtask generate python` runs it; with --check it says what is stale.
"""

import json
import sys
import textwrap
from pathlib import Path

from rocking_wall import _native

FOLDER = Path(__file__).parents[2] / "crates/python/python/rocking_wall"
FILE = FOLDER / "_parameters.py"
GIVEN = FOLDER / "_given.py"
GIVEN_HEAD = "    _native: _native.Wall\n"
"""After this line the file of the attributes is written."""

HEAD = '''"""The parameters of a wall.

Written by `cargo xtask generate python` from the model description.
"""

from collections.abc import Sequence
from typing import Literal, TypedDict


class Parameters(TypedDict, total=False):
    """The parameters of a wall, by the names of the FMU's variables; in SI units."""
'''
TAIL = '''
    kinematics: Literal["linear", "trigonometric"]
    """Small rotations, or full ones (rigid-linear walls with restitution)."""
    points: Sequence[Sequence[float]]
    """Corners [[u/u_ins, F/F0], ...] of the force law "multilinear"."""
    bar_diameter: float
    """Diameter of the bar of the tie [m]; a bar stands for tie_stiffness, tie_strength and tie_ultimate."""
    bar_length: float
    """Free length of the bar between its anchors [m]."""
    bar_young_modulus: float
    """Young's modulus of the bar [Pa]; default 210e9."""
    bar_yield_stress: float
    """Stress at which the bar yields [Pa]."""
    bar_ultimate_strain: float
    """Strain at which the bar tears; where none is given, the tie stays elastic."""
    bar_anchor_capacity: float
    """Force at which an anchor fails, without warning [N]; by default it is stronger than the bar."""
    bar_spacing: float
    """Distance between bars along the wall [m]; by default one bar holds its width."""
'''

GIVEN_TAIL = '''\
    points = Attribute[list[list[float]] | None](
        'Corners [[u/u_ins, F/F0], ...] of the force law "multilinear"; None for another law.'
    )
'''


def text() -> str:
    """Returns the text of the file."""
    lines = []
    for variable in _native.variables():
        # a scene has one law more than the FMU
        more = ["multilinear"] if variable["name"] == "force_law" else []
        choices = ", ".join(f'"{choice}"' for choice in variable["choices"] + more)
        kind = f"Literal[{choices}]" if choices else "float"
        low, high = variable["limits"]
        limits = (f", at least {low:g}" if low is not None else "") + (
            f", at most {high:g}" if high is not None else ""
        )
        told = f"{limited(variable['description'], variable['unit'], limits)}; default {variable['default']}."
        lines.append("")
        if len(f"    {variable['name']}: {kind}") <= 110:
            lines.append(f"    {variable['name']}: {kind}")
        else:
            lines.append(f"    {variable['name']}: Literal[")
            lines += textwrap.wrap(choices, 110, initial_indent=" " * 8, subsequent_indent=" " * 8)
            lines.append("    ]")
        lines += textwrap.wrap(f'"""{told}"""', 110, initial_indent=" " * 4, subsequent_indent=" " * 4)
    return HEAD + "\n".join(lines) + "\n" + TAIL


def given() -> str:
    """Returns the text of the file of the attributes."""
    head = GIVEN.read_text(encoding="utf-8").partition(GIVEN_HEAD)[0]
    names = [(each["name"], "str" if each["choices"] else "float") for each in _native.variables()]
    lines = [f"    {name} = Attribute[{kind}]()\n" for name, kind in [*names, ("kinematics", "str")]]
    for name, description, unit in _native.calculated():
        told = json.dumps(f"{limited(description, unit)}.", ensure_ascii=False)
        line = f"    {name} = Attribute[float]({told})\n"
        if len(line) > 111:
            parts = textwrap.wrap(told[1:-1], 98, drop_whitespace=False)
            wrapped = "".join(f'        "{part}"\n' for part in parts)
            line = f"    {name} = Attribute[float](\n{wrapped}    )\n"
        lines.append(line)
    return head + GIVEN_HEAD + "\n" + "".join(lines) + GIVEN_TAIL


def limited(description: str, unit: str, limits: str = "") -> str:
    """Returns a description with unit and limits, before the condition where it has one."""
    description, where, condition = description.partition("; where ")
    return f"{description}{f' [{unit}]' if unit else ''}{limits}{where}{condition}"


def stale() -> list[Path]:
    """Returns the files that are not what they should be."""
    return [file for file, made in FILES.items() if file.read_text(encoding="utf-8") != made()]


FILES = {FILE: text, GIVEN: given}

if __name__ == "__main__":
    if "--check" in sys.argv:
        sys.exit("\n".join(f"{file}: run `cargo xtask generate python`" for file in stale()) or None)
    for file, made in FILES.items():
        file.write_text(made(), encoding="utf-8")
