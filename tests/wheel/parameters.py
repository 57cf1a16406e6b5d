"""Writes `_parameters.py`, the parameters of a wall and what follows from them, from the model description.

Run it in an environment with the wheel: python tests/wheel/parameters.py
"""

import textwrap
from pathlib import Path

from rocking_wall import _native

FILE = Path(__file__).parents[2] / "crates/python/python/rocking_wall/_parameters.py"

HEAD = '''"""The parameters of a wall, and what follows from them.

Written by `tests/wheel/parameters.py` from the model description.
"""

from collections.abc import Sequence
from typing import Literal, TypedDict

from . import _native


class Parameters(TypedDict, total=False):
    """The parameters of a wall, by the names of the FMU's variables; in SI units."""
'''
TAIL = '''
    kinematics: Literal["linear", "trigonometric"]
    """Small rotations, or full ones (rigid-linear walls with restitution)."""
    points: Sequence[Sequence[float]]
    """Corners [[u/u_ins, F/F0], ...] of the force law "multilinear"."""
'''

CALCULATED = '''

class Calculated:
    """What follows from the parameters of a wall; in SI units."""

    _native: _native.Wall
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
    return HEAD + "\n".join(lines) + "\n" + TAIL + CALCULATED + calculated()


def limited(description: str, unit: str, limits: str = "") -> str:
    """Returns a description with unit and limits, before the condition where it has one."""
    description, where, condition = description.partition("; where ")
    return f"{description}{f' [{unit}]' if unit else ''}{limits}{where}{condition}"


def calculated() -> str:
    """Returns the properties of what follows from the parameters."""
    lines = []
    for name, description, unit in _native.calculated():
        told = f'"""{limited(description, unit)}."""'
        lines += ["", "    @property", f"    def {name}(self) -> float:"]
        lines += textwrap.wrap(told, 110, initial_indent=" " * 8, subsequent_indent=" " * 8)
        lines += [f'        return self._native.calculated("{name}")']
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
