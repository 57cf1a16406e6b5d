"""Lists what is linked into the released files: components.py NAME VERSION PACKAGE... writes

NAME.cdx.json      the crates with versions, licences and checksums, as CycloneDX 1.5
NAME-notices.txt   their licence texts, each once

from the lock file and the sources of the crates. Without times and paths, the same commit gives the same
bytes.
"""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

TEXTS = re.compile(r"(LICEN[CS]E|COPYING|COPYRIGHT|NOTICE|UNLICENSE)", re.IGNORECASE)
LARGEST = 100_000


def linked(metadata, roots):
    """Returns the packages that the roots link, by name and version, each with what it links itself."""
    packages = {package["id"]: package for package in metadata["packages"]}
    nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}

    def is_linked(dependency):
        kinds = {kind["kind"] for kind in dependency["dep_kinds"]}
        targets = packages[dependency["pkg"]]["targets"]
        return None in kinds and not any("proc-macro" in target["kind"] for target in targets)

    found, waiting = {}, [package["id"] for package in packages.values() if package["name"] in roots]
    assert len(waiting) == len(roots), f"not all of {roots} are packages"
    while waiting:
        name = waiting.pop()
        if name not in found:
            found[name] = [each["pkg"] for each in nodes[name]["deps"] if is_linked(each)]
            waiting += found[name]
    names = {name: f"{packages[name]['name']}@{packages[name]['version']}" for name in found}
    return {
        names[name]: (packages[name], [names[each] for each in others]) for name, others in found.items()
    }


def components(found, version, checksums):
    """Returns the document of CycloneDX."""
    listed = []
    for name, (package, _) in sorted(found.items()):
        component = {
            "type": "library",
            "bom-ref": name,
            "name": package["name"],
            "version": package["version"],
            "licenses": [{"expression": package["license"].replace("/", " OR ")}],
            "purl": f"pkg:cargo/{name}",
        }
        if name in checksums:
            component["hashes"] = [{"alg": "SHA-256", "content": checksums[name]}]
        listed.append(component)
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": {"type": "application", "name": "rocking-wall", "version": version}},
        "components": listed,
        "dependencies": [
            {"ref": name, "dependsOn": sorted(others)} for name, (_, others) in sorted(found.items())
        ],
    }


def notices(found):
    """Returns a list of all crates of others, then each text with the crates that it belongs to."""
    texts, lines = {}, []
    for name, (package, _) in sorted(found.items()):
        if package["source"] is None:
            continue
        lines.append(f"{name}: {package['license']}")
        for path in sorted(Path(package["manifest_path"]).parent.iterdir()):
            if TEXTS.match(path.name) and path.is_file() and path.stat().st_size < LARGEST:
                text = path.read_text(errors="replace").replace("\r\n", "\n").strip()
                texts.setdefault(text, []).append(name)
    lines += ["", "Rust's standard library: MIT OR Apache-2.0"]
    lines += ["mingw-w64 (files for Windows): ZPL-2.1 and public domain"]
    for text, names in sorted(texts.items(), key=lambda item: item[1]):
        lines += ["", "-" * 80, *names, "", text]
    return "\n".join(lines) + "\n"


def main(name, version, *roots):
    command = ["cargo", "metadata", "--locked", "--format-version", "1"]
    metadata = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    lock = tomllib.loads(Path("Cargo.lock").read_text())["package"]
    checksums = {f"{each['name']}@{each['version']}": each["checksum"] for each in lock if "checksum" in each}
    found = linked(metadata, set(roots))
    document = components(found, version, checksums)
    Path(f"{name}.cdx.json").write_text(json.dumps(document, indent=1) + "\n")
    Path(f"{name}-notices.txt").write_text(notices(found))


if __name__ == "__main__":
    main(*sys.argv[1:])
