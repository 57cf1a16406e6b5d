"""The references of `wall verify formulas` are those that tests/data/references.py computes."""

import importlib.util
from pathlib import Path

DATA = Path(__file__).parents[1] / "data"


def test_the_references_are_those_of_the_mechanics():
    spec = importlib.util.spec_from_file_location("references", DATA / "references.py")
    references = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(references)
    text = references.text()
    assert text.count("\n") > 90
    assert text == (references.FOLDER / "references.csv").read_text()
