"""`wall study reliability` beside a script that reads `wall check --json` and the tables of `ida`."""

import csv
import re
import subprocess
import sys

from conftest import ROOT

sys.path.append(str(ROOT / "examples/python"))
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
