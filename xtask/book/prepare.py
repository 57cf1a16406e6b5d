"""Prepares the sources of the book:

    python xtask/book/prepare.py WALL REPOSITORY FOLDER

They are docs/ and the README, and reference pages made of what the program and the descriptions say: the
help of every command, the keys of the JSON schemas, the variables of both model descriptions. Links that
leave docs/ lead to the repository. A link to a page or a picture that does not exist is an error.
"""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).parents[2]
DESCRIPTIONS = {
    "A wall": ROOT / "modelDescription/modelDescription.xml",
    "A floor": ROOT / "crates/floor/modelDescription/modelDescription.xml",
}


LIMITS = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}


def output(wall, *arguments):
    return subprocess.run([wall, *arguments], check=True, capture_output=True, text=True).stdout


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def commands(wall):
    """The help of the program, and of each command that it lists, with those of a group below it."""

    def listed(text):
        _, found, rest = text.partition("Commands:\n")
        lines = rest.split("\n\n")[0].splitlines() if found else []
        names = [line.split()[0] for line in lines if line.startswith("  ") and line[2] != " "]
        return [name for name in names if name != "help"]

    def sections(*words):
        text = output(wall, *words, "--help")
        title = f"\n{'#' * (len(words) + 1)} wall {' '.join(words)}\n" if words else "# Commands\n"
        return f"{title}\n```text\n{text}```\n" + "".join(sections(*words, name) for name in listed(text))

    return sections()


def kind(value, definitions):
    """A few words on the values of a key."""
    if "$ref" in value:
        name = value["$ref"].rsplit("/", 1)[1]
        return f"[{name}](#{name.lower()})" if "properties" in definitions.get(name, {}) else name
    if "enum" in value:
        return ", ".join(f"`{item}`" for item in value["enum"])
    if value.get("type") == "array":
        return f"list of {kind(value.get('items', {}), definitions)}"
    for choice in ("anyOf", "oneOf"):
        if choice in value:
            return " or ".join(kind(item, definitions) for item in value[choice])
    limits = [
        f"{sign} {value[key]}"
        for key, sign in LIMITS.items()
        if key in value
    ]
    return " ".join([str(value.get("type", "")), *limits])


def table(properties, definitions):
    rows = ["| key | values | default | |", "|---|---|---|---|"]
    for key, value in properties.items():
        default = f"`{json.dumps(value['default'])}`" if value.get("default") is not None else ""
        cells = [f"`{key}`", kind(value, definitions), default, value.get("description", "")]
        rows.append(f"| {' | '.join(map(cell, cells))} |")
    return "\n".join(rows) + "\n"


def keys(wall, name):
    """The keys of a kind of file: its own, then those of each table in it."""
    schema = json.loads(output(wall, "schema", name))
    definitions = schema.get("$defs", {})
    own = {key: value for key, value in schema["properties"].items() if "properties" not in value}
    inline = {key: value for key, value in schema["properties"].items() if "properties" in value}
    lists = {key: value["items"] for key, value in own.items() if "properties" in value.get("items", {})}
    page = f"# {schema['title']}\n\n{table(own, definitions)}"
    for key, value in [*inline.items(), *lists.items(), *definitions.items()]:
        if "properties" in value:
            description = value.get("description", "")
            page += f"\n## {key}\n\n{description}\n\n{table(value['properties'], definitions)}"
    return page


def variables():
    page = "# Variables of the FMUs\n"
    for title, path in DESCRIPTIONS.items():
        page += f"\n## {title}\n\n| variable | | unit | start | |\n|---|---|---|---|---|\n"
        root = ElementTree.parse(path).getroot()
        for variable in root.iter("ScalarVariable"):
            value = variable[0]
            cells = [f"`{variable.get('name')}`", variable.get("causality", "local"), value.get("unit", ""),
                     value.get("start", ""), variable.get("description", "")]  # fmt: skip
            page += f"| {' | '.join(map(cell, cells))} |\n"
    return page


LINK = re.compile(r"(\]\()([^)\s]+)(\))")


def led(text, page, repository):
    """The text of a page of the project, its links as they are in the book."""

    def replaced(link):
        target, _, part = link[2].partition("#")
        if not target or re.match(r"\w+:", target):
            return link[0]
        path = (page.parent / target).resolve().relative_to(ROOT)
        if not (ROOT / path).exists():
            sys.exit(f"{page}: there is no {path}")
        part = f"#{part}" if part else ""
        if path == Path("README.md"):
            inside = Path("introduction.md")
        elif path.parts[0] == "docs":
            inside = Path(*path.parts[1:])
        else:
            return f"{link[1]}{repository}/blob/main/{path}{part}{link[3]}"
        up = "../" * (len(page.relative_to(ROOT).parts) - 2) if page.parent != ROOT else ""
        return f"{link[1]}{up}{inside}{part}{link[3]}"

    return LINK.sub(replaced, text)


def main(wall, repository, folder):
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs", folder)
    for page in (ROOT / "docs").rglob("*.md"):
        (folder / page.relative_to(ROOT / "docs")).write_text(led(page.read_text(), page, repository))
    readme = ROOT / "README.md"
    (folder / "introduction.md").write_text(led(readme.read_text(), readme, repository))
    shutil.copy(ROOT / "xtask/book/summary.txt", folder / "SUMMARY.md")
    reference = folder / "reference"
    reference.mkdir()
    (reference / "commands.md").write_text(commands(wall))
    for name in ("scene", "study", "building"):
        (reference / f"{name}.md").write_text(keys(wall, name))
    (reference / "variables.md").write_text(variables())
    for target in LINK.findall((folder / "SUMMARY.md").read_text()):
        if not (folder / target[1]).exists():
            sys.exit(f"xtask/book/summary.txt: there is no {target[1]}")


if __name__ == "__main__":
    main(*sys.argv[1:])
