"""Packs the playground into one file.

    python pack.py LIBRARY.wasm PAGE.html

The library is compressed and written as text; the browser unpacks it. The page loads nothing else.
"""

import gzip
import sys
from base64 import b64encode
from html import escape
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "crates/playground/src/page"
# Marks of the template, and the files that take their place. Texts are escaped.
PARTS = {"style": "page.css", "fields": "fields.js", "script": "page.js", "language": "language.js",
         "italian": "italian.txt"}
# What the pages of the program begin with, how they print, and how they move.
REPORT = ROOT / "crates/report/src"
HEAD, PAPER, MOVING = REPORT / "page.html", REPORT / "paper.css", REPORT / "moving.js"
WALL = ROOT / "crates/run/src/page/wall.css"
TEXTS = {"notices": PAGE / "notices.txt", "mit": ROOT / "LICENSE-MIT", "apache": ROOT / "LICENSE-APACHE"}


def main():
    library, page = map(Path, sys.argv[1:])
    parts = {mark: read(PAGE / name) for mark, name in PARTS.items()}
    parts["title"] = "Rocking wall: playground"
    parts["style"] += read(WALL) + read(PAPER)
    parts["moving"] = read(MOVING)
    parts |= {mark: escape(read(path)) for mark, path in TEXTS.items()}
    # no time in the archive: the same library makes the same page with one version of zlib
    parts["library"] = b64encode(gzip.compress(library.read_bytes(), mtime=0)).decode()
    html = read(HEAD) + read(PAGE / "page.html")
    for mark, text in parts.items():
        before, after = html.split("{{" + mark + "}}")
        html = before + text + after
    page.write_text(html, encoding="utf-8", newline="\n")


def read(path):
    return path.read_text(encoding="utf-8")


if __name__ == "__main__":
    main()
