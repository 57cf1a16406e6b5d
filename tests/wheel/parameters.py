"""Writes the parameters of a wall, and what follows from them, from the model description, and the options of
a study from its schema.

`cargo xtask generate python` runs it; with --check it says what is stale.
"""

import json
import re
import sys
import textwrap
from pathlib import Path
from typing import Any

import rocking_wall as rw
from rocking_wall import _native

FOLDER = Path(__file__).parents[2] / "crates/python/python/rocking_wall"
FILE = FOLDER / "_parameters.py"
GIVEN = FOLDER / "_given.py"
OPTIONS = FOLDER / "options.py"
GIVEN_HEAD = "    _native: _native.Wall\n"
"""After this line the file of the attributes is written."""

HEAD = '''"""The parameters of a wall.

Written by `cargo xtask generate python` from the schema of scenes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, Required, TypedDict
'''
ABOUT = "The parameters of a wall, by the names of the FMU's variables; in SI units."
GROUPS = ("geometry", "force_law", "damping", "impact", "start", "solver", "tie")

GIVEN_TAIL = '''\
    points = Attribute[list[list[float]] | None](
        'Corners [[u/u_ins, F/F0], ...] of the force law "multilinear"; None for another law.'
    )
'''


def schemas() -> tuple[dict[str, Any], dict[str, Any]]:
    """Returns the schemas of scenes and of studies."""
    scene, study = map(json.loads, _native.schemas())
    return scene, study


def text() -> str:
    """Returns the text of the file."""
    tables = schemas()[0]["properties"]
    # one tie is a table, several are a list of such tables
    one, several = tables["tie"]["anyOf"]
    groups = tables | {"tie": one}
    known = {name: value for group in GROUPS for name, value in groups[group]["properties"].items()}
    known["tie"] = several | {"description": "Several ties, in place of one by tie_height, tie_stiffness, …."}
    bar = {f"bar_{name}": value for name, value in known["bar"]["properties"].items()}
    names = [*rw.Wall().parameters, "kinematics", "points", "part", "opening", "load", "tie"]
    names += ["curve", "at_height", "curve_tolerance", "oscillator"]
    made = Options({"$defs": schemas()[0]["$defs"], "properties": {}})
    made.table("Parameters", {"description": ABOUT, "properties": {n: known[n] for n in names} | bar})
    return HEAD + "".join(made.classes.values())


def given() -> str:
    """Returns the text of the file of the attributes."""
    head = GIVEN.read_text(encoding="utf-8").partition(GIVEN_HEAD)[0]
    names = [(name, type(value).__name__) for name, value in rw.Wall().parameters.items()]
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


OPTIONS_HEAD = '''"""The options of a study: dictionaries with the keys of the tables of a study file.

Written by `cargo xtask generate python` from the schema of studies.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, Required, TypedDict, is_typeddict

from numpy.random import Generator
'''
OPTIONS_TAIL = '''

_told = [f"{name}: {kind.__doc__}" for name, kind in list(globals().items()) if is_typeddict(kind)]
__doc__ = "\\n\\n".join([__doc__, *_told])
__all__: list[str] = []
"""Empty, since `help` would tell with each class what every dictionary has."""
'''
OPTIONS_OF_STUDY = (
    "check",
    "classes",
    "hazard",
    "intensity",
    "levels",
    "models",
    "reliability",
    "report",
    "uncertain",
)
"""Keys of a study that are typed."""
INLINE = {"bar": "Bar", "tie": "Tie", "models": "Model", "parameters": "Distribution"}
"""Names of the tables that have none in the schema, by the keys that hold them."""
KINDS = {"number": "float", "integer": "int", "string": "str", "boolean": "bool"}


class Options:
    """The classes of the options under construction."""

    def __init__(self, schema: dict[str, Any]) -> None:
        self.tables = schema["$defs"]
        self.classes: dict[str, str] = {}
        for key in OPTIONS_OF_STUDY:
            if key in schema["properties"]:
                self.kind(schema["properties"][key], key)

    def kind(self, value: dict[str, Any], key: str) -> str:
        """Returns the type of a value, and writes the classes that it needs."""
        if "$ref" in value:
            table = value["$ref"].rpartition("/")[2]
            return self.table(table.removesuffix("Table"), self.tables[table])
        if "anyOf" in value:
            return " | ".join(dict.fromkeys(self.kind(each, key) for each in value["anyOf"]))
        if "enum" in value:
            return f"Literal[{', '.join(json.dumps(each) for each in value['enum'])}]"
        if value.get("type") == "array":
            items = value.get("items")
            return f"Sequence[{self.kind(items, key) if items else 'object'}]"
        if value["type"] == "object":
            tables = list(value["properties"].values())
            # a table of alike tables by names that are not those of keys
            if all(each == tables[0] and each.get("type") == "object" for each in tables):
                return f"Mapping[str, {self.table(INLINE[key], tables[0])}]"
            return self.table(INLINE[key], value)
        types = [value["type"]] if isinstance(value["type"], str) else value["type"]
        return " | ".join(KINDS[each] for each in types)

    def table(self, name: str, table: dict[str, Any]) -> str:
        """Writes a class, if it is not yet there, and returns its name."""
        if name not in self.classes:
            self.classes[name] = ""
            about = [*wrapped('"""' + table.get("description", f"A {name.lower()}.")), ""]
            keys = []
            for key, value in table["properties"].items():
                # a generator draws a seed
                kind = "int | Generator" if key == "seed" else self.kind(value, key)
                keys += typed(key, f"Required[{kind}]" if key in table.get("required", ()) else kind)
                about += wrapped(f"- {key}{told(value)}", "  ") if told(value) else []
            lines = ["", "", f"class {name}(TypedDict, total=False):", *about, '    """', "", *keys]
            self.classes[name] = "\n".join(lines) + "\n"
        return name


def told(value: dict[str, Any]) -> str:
    """Returns what a schema says of a key: description, limits, default."""
    words, unit = re.fullmatch(r"(.*?)\.?(?: \[([^]]+)\])?", value.get("description", "")).groups()
    limits = [f"{word} {value[limit]:g}" for limit, word in LIMITS.items() if limit in value]
    default = f"; default {shown(value['default'])}" if "default" in value else ""
    said = limited(words, unit if unit != "1" else "", "".join(f", {limit}" for limit in limits)) + default
    return f": {said.removeprefix(', ')}." if said else ""


def shown(value: object) -> str:
    """Returns a value as people write it in Python."""
    return json.dumps(value) if isinstance(value, str) else repr(value)


LIMITS = {
    "minimum": "at least",
    "exclusiveMinimum": "above",
    "maximum": "at most",
    "exclusiveMaximum": "below",
}


def options() -> str:
    """Returns the text of the file of the options."""
    return OPTIONS_HEAD + "".join(Options(schemas()[1]).classes.values()) + OPTIONS_TAIL


def wrapped(words: str, indent: str = "") -> list[str]:
    """Returns the lines of a paragraph of the docstring of a class."""
    return textwrap.wrap(words, 110, initial_indent=" " * 4, subsequent_indent=" " * 4 + indent)


def typed(name: str, kind: str) -> list[str]:
    """Returns the lines of a key with its type."""
    if len(f"    {name}: {kind}") <= 110:
        return [f"    {name}: {kind}"]
    head, _, rest = kind.partition("[")
    inner = textwrap.wrap(rest.removesuffix("]"), 110, initial_indent=" " * 8, subsequent_indent=" " * 8)
    return [f"    {name}: {head}[", *inner, "    ]"]


def limited(description: str, unit: str, limits: str = "") -> str:
    """Returns a description with unit and limits, before the condition where it has one."""
    description, where, condition = description.partition("; where ")
    return f"{description}{f' [{unit}]' if unit else ''}{limits}{where}{condition}"


def stale() -> list[Path]:
    """Returns the files that are not what they should be."""
    return [file for file, made in FILES.items() if not file.exists() or file.read_text("utf-8") != made()]


FILES = {FILE: text, GIVEN: given, OPTIONS: options}

if __name__ == "__main__":
    if "--check" in sys.argv:
        sys.exit("\n".join(f"{file}: run `cargo xtask generate python`" for file in stale()) or None)
    for file, made in FILES.items():
        file.write_text(made(), encoding="utf-8")
