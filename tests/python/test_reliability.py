"""`wall study reliability` beside a script that reads `wall check --json` and the tables of `ida`."""

import csv
import re
import subprocess
import sys

from conftest import ROOT

sys.path.append(str(ROOT / "examples/python"))
import passing_walls  # noqa: E402
import reliability  # noqa: E402


def test_probabilities_are_those_of_check_and_analysis(wall, tmp_path):
    tutorial = (ROOT / "docs/tutorials/reliability.md").read_text(encoding="utf-8")
    text = re.search(r"```toml\n(.*?)```", tutorial, re.S)[1]
    slc = "SLC = { ag = 0.2, F0 = 2.45, TC = 0.33 }\n\n[reliability]"
    study = tmp_path / "study.toml"
    study.write_text(text.replace("[reliability]", slc), encoding="utf-8")
    analysis, safe = tmp_path / "analysis", tmp_path / "safe"
    for command, folder in (("ida", analysis), ("reliability", safe)):
        subprocess.run([wall, "study", command, study, "-o", folder], check=True, capture_output=True)
    for name in ("levels.csv", "fragilities.csv", "collapses.csv", "study.html", "study.json"):
        assert (analysis / name).read_bytes() == (safe / name).read_bytes(), name
    with (safe / "reliability.csv").open(encoding="utf-8") as file:
        rows = csv.DictReader(file)
        given = {(row["wall"], row["model"], row["check"]): row for row in rows if row["event"] == "fall"}
    found = reliability.main(str(wall), str(study), str(analysis))
    assert len(found) == len(given) == 3 * 2 * 3
    for one in found:
        row = given[one["wall"], one["model"], one["check"]]
        for name in ("ag_code_g", "margin"):
            assert abs(float(row[name]) / one[name] - 1) < 1e-9, (name, row, one)
        assert abs(float(row["probability"]) - one["probability"]) < 1e-9, (row, one)


def cells(text, *first):
    """Returns the cells after the first ones of a row."""
    begin = f"| {' | '.join(first)} | "
    (row,) = (line for line in text.splitlines() if line.startswith(begin))
    return row[len(begin) :].rstrip(" |").split(" | ")


def test_the_tables_of_walls_that_pass(wall, tmp_path, monkeypatch):
    """Two parapets on soil B under 14 motions, with a coarse search: the tables of docs/reliability.md."""
    for name, value in {
        "WALLS": 2,
        "SYNTHETIC": "synthetic = { count = 14 }",
        "SOILS": "B",
        "KINDS": {"parapets": passing_walls.KINDS["parapets"]},
        "HUNT": 'method = "hunt", first = 0.2, increase = 0.2, top = 4, resolution = 0.1',
        "STEPS": 'method = "grid", values = [0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.2, 2, 4]',
        "DOCUMENT": tmp_path / "reliability.md",
    }.items():
        monkeypatch.setattr(passing_walls, name, value)
    before = "a\n<!-- synthetic -->\nb\n<!-- end synthetic -->\nc\n"
    passing_walls.DOCUMENT.write_text(before, encoding="utf-8")
    passing_walls.main(wall, tmp_path)
    text = passing_walls.DOCUMENT.read_text(encoding="utf-8")
    assert text.startswith("a\n<!-- synthetic -->\n\n| walls |") and text.endswith("synthetic -->\nc\n")
    with (tmp_path / "synthetic/parapets_B_storeys/reliability.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["event"] == "fall"]
    margins = [float(row["margin"]) for row in rows if (row["check"], row["model"]) == ("SLC", "CDR")]
    # of two walls the lower one is the median
    assert len(margins) == 2
    assert cells(text, "parapets", "storeys", "SLC", "CDR")[1] == f"{min(margins):.2f}"
    # the first wall is at the parts 1/2 + 1/1.16730 and 1/2 + 1/1.16730² of its ranges, less 1
    first = passing_walls.walls("parapets").splitlines()[1].split(",")
    height = 0.6 + 2.4 * 0.356674883854503
    assert abs(float(first[2]) / height - 1) < 1e-12
    assert abs(float(first[2]) / float(first[3]) / (3 + 9 * 0.233891856627126) - 1) < 1e-12

    motions = (wall, tmp_path / "synthetic", passing_walls.SYNTHETIC)
    changed, searched = passing_walls.changes(*motions), passing_walls.searches(*motions)
    of = [float(cell.split()[0].rstrip(",")) for cell in cells(changed, "SLV", "B")]
    # a β of modelling, and a check without its reserve, make a fall likelier
    assert of[0] < of[1] < of[3] and of[0] < of[2] < of[3], changed
    steps = (cells(searched, "steps of 2 %", collapse, "SLC") for collapse in ("first", "fraction"))
    assert next(steps) != next(steps), searched
