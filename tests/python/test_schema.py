"""Tests the JSON schemas that `wall schema` prints: examples are valid, mistyped keys are not."""

import copy
import json
import subprocess
import tomllib
from pathlib import Path

import jsonschema
import pytest

ROOT = Path(__file__).parents[2]
EXAMPLES = {
    "scene": [*(ROOT / "scenes").glob("*.toml"), *(ROOT / "scenes/building").glob("[gps]*.toml")],
    "study": [*(ROOT / "studies").glob("*.toml")],
    "building": [ROOT / f"scenes/building/{name}.toml" for name in ("building", "three_storeys")],
}


@pytest.mark.parametrize("kind", EXAMPLES)
def test_examples_are_valid(wall, kind):
    printed = subprocess.run([wall, "schema", kind], check=True, capture_output=True, text=True).stdout
    schema = json.loads(printed)
    validator = jsonschema.validators.validator_for(schema)
    validator.check_schema(schema)
    assert EXAMPLES[kind]
    for example in EXAMPLES[kind]:
        document = tomllib.loads(example.read_text())
        validator(schema).validate(document)
        mistyped = copy.deepcopy(document)
        mistyped["titel"] = "x"
        assert not validator(schema).is_valid(mistyped), example
