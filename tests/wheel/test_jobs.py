"""What the jobs of the program `wall` find, the methods of a wall find too."""

import csv
import dataclasses
import json
import pickle
import re
from html import escape
from pathlib import Path
import warnings

import numpy as np
import pytest

import rocking_wall as rw

ROOT = Path(__file__).parents[2]
SET = {"height": 3.0, "thickness": 0.25, "overburden_eccentricity": 0.02, "overburden": 2000.0}
ARGUMENTS = [word for name, value in SET.items() for word in ("--set", f"{name}={value}")]


def columns(path):
    """Reads the columns of a CSV file."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [row[name] for row in rows] for name in rows[0]}


def assert_table(table, path, names=None):
    """Compares a table with a CSV file, column by column; `names` are those of some columns."""
    told = columns(path)
    told = told if names is None else {name: told[name] for name in names}
    assert list(table) == list(told)
    for name, texts in told.items():
        for value, text in zip(table[name], texts, strict=True):
            if isinstance(value, (np.bool_, np.str_)):
                assert str(value).lower() == text.lower(), name
            elif text.startswith("open >"):
                assert value == np.inf, name
            elif text == "" or text.startswith("open"):
                assert np.isnan(value), name
            elif text in ("true", "false"):
                assert value == (text == "true"), name
            else:
                assert value == float(text), name


def records(program, folder, count):
    """Writes records and returns their paths."""
    paths = [folder / f"{seed}.csv" for seed in range(1, count + 1)]
    for seed, path in enumerate(paths, 1):
        samples = rw.synthetic_record(seed, duration=12.0, pga=2.0).a
        rows = (f"{0.005 * k:.3f},{a!r}\n" for k, a in enumerate(samples.tolist()))
        path.write_text("time,a_g\n" + "".join(rows), encoding="utf-8")
    return paths


def literal(value):
    """Returns a value as TOML: numbers, texts, lists and tables."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{name} = {literal(each)}" for name, each in value.items()) + " }"
    return json.dumps(value)


def written(folder, wall, checked):
    """Writes the scene of a check; a text is the scene, without its table `[check]`."""
    if not isinstance(wall, str):
        of = {"geometry": {}, "tie": {}, "force_law": {}}
        for name, value in wall.items():
            group = "tie" if name.startswith("tie") else "force_law" if name == "a1" else "geometry"
            of[group][name] = value
        wall = "".join(f"{group} = {literal(values)}\n" for group, values in of.items())
    path = folder / "scene.toml"
    lines = (f"{name} = {literal(value)}\n" for name, value in checked.items())
    path.write_text(f"{wall}\n[check]\n{''.join(lines)}", encoding="utf-8")
    return path


def assert_verdict(verdict, told, path):
    """Compares a verdict with the program's JSON, and its rows with the program's CSV."""
    assert verdict.numbers == told and verdict.passed == told["passed"] == (verdict.zeta >= 1)
    assert_table(verdict.table, path)
    html = verdict._repr_html_()
    assert "<svg" in html and escape(verdict.headline) in html
    with pytest.raises(dataclasses.FrozenInstanceError):
        verdict.passed = True


@pytest.mark.parametrize("scene", [None, "scenes/parapet_on_a_roof.toml"])
def test_a_check_at_fractions_with_records(program, tmp_path, scene):
    paths = records(program, tmp_path, 3)
    wall = rw.Wall(**SET) if scene is None else rw.Wall.from_toml(scene)
    named = {"records": {"files": [path.name for path in paths], "unit": "m/s2"}}
    checked = {"code": "fractions", "damping": 0.03}
    scene = written(tmp_path, SET if scene is None else (ROOT / scene).read_text(), {**checked, **named})
    told = program("check", scene, "--json", "--csv", tmp_path / "rows.csv")
    verdict = wall.check([rw.read_record(path, unit="m/s2") for path in paths], **checked)
    assert_verdict(verdict, told, tmp_path / "rows.csv")


def test_a_check_at_fractions_with_a_spectrum(program, tmp_path):
    points = [[0.0, 2.0], [0.1, 5.0], [0.5, 5.0], [1.0, 2.5], [2.0, 1.25], [4.0, 0.3]]
    checked = {"code": "fractions", "displacement_fraction": 0.6, "secant_fraction": 0.5, "spectrum": points}
    checked["unit"] = "m/s2"
    told = program("check", written(tmp_path, SET, checked), "--json", "--csv", tmp_path / "rows.csv")
    verdict = rw.Wall(**SET).check(**checked)
    assert_verdict(verdict, told, tmp_path / "rows.csv")
    assert verdict.numbers["governs"]["displacement"]["ratio"] == verdict.zeta and not verdict.warnings
    assert verdict.governs == "displacement" and len(verdict.table["check"]) == 4
    roof = rw.Wall.from_toml("scenes/parapet_on_a_roof.toml")
    assert "the storeys are not applied" in roof.check(**checked).warnings[0]


@pytest.mark.parametrize(
    "arguments, words",
    [
        ({}, "the demand is spectrum"),
        ({"spectrum": [[0.1, 1.0], [1.0, 1.0]]}, "T from 0 on that rises"),
        ({"spectrum": [[0.0, 1.0], [1.0, 1.0], [0.5, 1.0]]}, "found T = 0.5 s .* at point 3 of the spectrum"),
        ({"spectrum": [[0.0, 1.0], [0.1, 1.0]]}, r"goes from 0 to 0.1 s and has no T = "),
        ({"spectrum": [[0.0, 1.0], [9.0, 1.0]], "secant_fraction": 2.0}, "must be above 0 and at most 1"),
    ],
)
def test_what_cannot_be_checked_at_fractions(arguments, words):
    with pytest.raises(ValueError, match=words):
        rw.Wall(**SET).check(code="fractions", unit="m/s2", **arguments)


HAZARD = {"ag": 0.15, "F0": 2.45, "TC": 0.32}
SLV = {"SLV": HAZARD, "soil": "B"}
TIED_PARAPET = {"tie_height": 3.0, "tie_stiffness": 2e5, "tie_slack": 0.03, "tie_strength": 5e3}
DAMPED = {"SLD": 0.05, "SLV": 0.1, "SLC": 0.1}
AT_HEIGHT = {
    **{name: {**HAZARD, "building_damping": xi} for name, xi in DAMPED.items()},
    "building": {"storeys": 3, "period": 0.3, "height_ratio": 1.0},
    "soil": "B",
    "before_activation": "law",
}
# what a check wants to be stated
PARAPET = {"height": 4.0, "thickness": 0.4, "density": 1800.0, "a1": 0.03}
# a wall, its check, and ζ_E of SLV on the side u > 0
CHECKED = {
    "on the ground": ({}, {**SLV, "before_activation": "rigid"}, 0.855812),
    "on the roof": ({}, AT_HEIGHT, 0.79084),
    "tied, on the ground": (TIED_PARAPET, {**SLV, "before_activation": "law"}, 1.35612),
    "tied, on the roof": (TIED_PARAPET, AT_HEIGHT, 0.727534),
}


@pytest.mark.parametrize("wall, checked, zeta", CHECKED.values(), ids=CHECKED)
def test_a_check_by_the_code(program, tmp_path, wall, checked, zeta):
    wall = {**PARAPET, **wall}
    verdict = rw.Wall(**wall).check(**checked)
    # six digits
    found = verdict.numbers["sides"]["positive"]["SLV"]["zeta_E"]
    assert found == pytest.approx(zeta, abs=5e-6 if zeta > 1 else 5e-7)
    scene = written(tmp_path, wall, {"code": "circolare-2019", **checked})
    told = program("check", scene, "--json", "--csv", tmp_path / "rows.csv")
    assert_verdict(verdict, told, tmp_path / "rows.csv")
    assert rw.Wall.from_toml(scene).check(**checked) == verdict == pickle.loads(pickle.dumps(verdict))


def test_a_dynamic_check_by_the_code(program, tmp_path):
    paths = records(program, tmp_path, 3)
    checked = {**SLV, "before_activation": "law", "method": "dynamic"}
    named = {"code": "circolare-2019", "records": {"files": [path.name for path in paths], "unit": "m/s2"}}
    scene = written(tmp_path, PARAPET, {**checked, **named})
    told = program("check", scene, "--json", "--csv", tmp_path / "rows.csv")
    motions = [rw.read_record(path, unit="m/s2") for path in paths]
    verdict = rw.Wall(**PARAPET).check(motions, **checked)
    assert_verdict(verdict, told, tmp_path / "rows.csv")
    dynamic = verdict.numbers["dynamic"]["SLV"]
    assert [run["record"] for run in dynamic["runs"]] == ["1.csv", "2.csv", "3.csv"]
    assert verdict.zeta == dynamic["zeta_E"] and "SLV under records" in verdict.table["check"]
    # records whose spectrum is the demand
    of_spectrum = {**checked, "SLV": {"ag": 0.15}, "method": "nonlinear", "record_scale": "none"}
    own = rw.Wall(**PARAPET).check(motions, **of_spectrum)
    demands = [each.numbers["sides"]["positive"]["SLV"]["demand"] for each in (own, verdict)]
    assert demands[0] != demands[1]


def test_the_report_is_that_of_the_program(program, tmp_path):
    """All but where each number comes from, the program's version and the fingerprints of the inputs: the
    program's are those of a file that states less."""
    checked = {**SLV, "before_activation": "law"}
    project = {"language": "it", "project": "Casa", "designer": "ing. Rossi", "date": "1 marzo 2026"}
    scene = written(tmp_path, PARAPET, {"code": "circolare-2019", **checked})
    report = "".join(f"{name} = {literal(value)}\n" for name, value in project.items())
    scene.write_text(f'title = "Parapetto"\n{scene.read_text()}\n[report]\n{report}', encoding="utf-8")
    program("check", scene, "--report", tmp_path / "program.html")
    verdict = pickle.loads(pickle.dumps(rw.Wall(**PARAPET))).check(**checked)
    verdict.write_report(tmp_path / "python.html", title="Parapetto", **project)
    pages = [(tmp_path / f"{name}.html").read_text(encoding="utf-8") for name in ("program", "python")]
    assert "NON SUPERATA" in pages[0].upper() or "NON VERIFICAT" in pages[0].upper()
    sections = [re.split("(?=<h2)", page) for page in pages]
    heads = [[re.sub("<[^>]*>", "", part.splitlines()[0]) for part in each] for each in sections]
    assert heads[0] == heads[1]
    differ = [head for head, *pair in zip(heads[0], *sections) if pair[0] != pair[1]]
    assert set(differ) <= {
        "La parete",
        "Provenienza dei dati",
        "Codice di calcolo (NTC 10.2)",
        "Documento",
    }, differ
    with pytest.raises(FileExistsError):
        verdict.write_report(tmp_path / "python.html")
    with pytest.raises(ValueError, match="desinger"):
        verdict.write_report(tmp_path / "other.html", desinger="x")
    assert not (tmp_path / "other.html").exists()


def test_what_decides_is_stated(program, tmp_path):
    """What nobody stated is refused as by the program; the hinge of a strip is sought."""
    rigid = {**SLV, "before_activation": "rigid"}
    plain = rw.Wall(4, 0.4)
    for wall in (plain, plain.replace(a1=0.03), pickle.loads(pickle.dumps(plain))):
        with pytest.raises(ValueError, match="density not stated"):
            wall.check(**rigid)
    strip = {"mechanism": "vertical_spanning", "height": 4, "thickness": 0.3, "density": 1800}
    scene = written(tmp_path, strip, {"code": "circolare-2019", **rigid})
    told = program("check", scene, "--json")
    assert rw.Wall(**strip).check(**rigid).numbers == told
    assert rw.Wall(**strip, hinge_ratio=0.5).check(**rigid).numbers != told
    read = rw.Wall.from_toml(scene)
    assert read.check(**rigid).numbers == told and read == rw.Wall(**strip)


@pytest.mark.parametrize(
    "arguments, words",
    [
        ({"soil": "B"}, "SLV needs its site"),
        (SLV, "before_activation is missing, or does not go with the law"),
        ({**SLV, "before_activation": "beam"}, "and young_modulus, E in Pa, go together"),
        ({**SLV, "code": "EC8"}, 'code = "EC8"; state one of "circolare-2019", "fractions"'),
        ({**SLV, "sol": "B"}, 'unknown key "sol" in .check. .did you mean "soil"'),
        ({**SLV, "building": {"storey": 3}}, 'key "storey" in .check.building. .*mean "storeys"'),
        ({**SLV, "method": "dynamic", "before_activation": "law"}, "dynamic\" needs records"),
    ],
)
def test_what_the_code_cannot_check(arguments, words):
    with pytest.raises(ValueError, match=words):
        rw.Wall(**PARAPET).check(**arguments)


@pytest.mark.parametrize("axes", ["heights", "radii"])
def test_a_spectrum_over_walls(program, tmp_path, axes):
    [path] = records(program, tmp_path, 1)
    out = tmp_path / "spectrum.csv"
    rows = "ratios" if axes == "heights" else "angles"
    given = {"heights": "1:4:4", "radii": "1:4:4", "ratios": "5:15:3", "angles": "0.05:0.15:3"}
    options = [word for name in (axes, rows) for word in (f"--{name}", given[name])]
    program("study", "spectrum", *ARGUMENTS, "--record", path, "--unit", "m/s2", "--csv", out, *options)
    sizes = [1.0, 2.0, 3.0, 4.0]
    values = {"heights": sizes, "radii": sizes, "ratios": [5.0, 10.0, 15.0], "angles": [0.05, 0.1, 0.15]}
    record = rw.read_record(path, unit="m/s2")
    found = rw.Wall(**SET).rocking_spectrum(record, **{axes: values[axes], rows: values[rows]})
    assert found.u_ratio_max.shape == (3, 4) and found.overturned.any() and not found.overturned.all()
    assert_table(found.table, out)
    alone = rw.Wall(**SET).rocking_spectrum(record, **{axes: values[axes], rows: values[rows]}, threads=1)
    np.testing.assert_array_equal(alone.u_ratio_max, found.u_ratio_max)
    assert "<svg" in found._repr_svg_() and "slenderness" in found._repr_svg_()


@pytest.mark.parametrize("form", ["sine_cycle", "cosine_cycle", "rectangle", "triangle", "falling_triangle"])
def test_a_spectrum_over_pulses(program, tmp_path, form):
    out = tmp_path / "spectrum.csv"
    options = ["--frequency-ratios", "1:9:9", "--amplitude-ratios", "1:6:6"]
    program("study", "spectrum", *ARGUMENTS, "--pulse", form, "--csv", out, *options)
    found = rw.Wall(**SET).pulse_spectrum(form, frequency_ratios=range(1, 10), amplitude_ratios=range(1, 7))
    assert_table(found.table, out)


def test_a_spectrum_of_a_scene_and_its_refusals(record):
    wall = rw.Wall.from_toml("scenes/shaken_parapet.toml")
    found = wall.rocking_spectrum(heights=[2.0, 3.0], ratios=[10.0])
    assert found.u_ratio_max.shape == (1, 2)
    for call, words in [
        (lambda: rw.Wall().rocking_spectrum(), "needs a record"),
        (lambda: wall.rocking_spectrum(record, heights=[1], radii=[1]), "either heights or radii"),
        (lambda: wall.rocking_spectrum(record, heights=[]), "at least one value"),
        (lambda: wall.rocking_spectrum(record, heights=[1] * 1000, ratios=[9] * 1000), "1000000 points"),
        (lambda: wall.pulse_spectrum("square"), 'form = "square" is not one of ricker'),
    ]:
        with pytest.raises(ValueError, match=words):
            call()


def test_a_calibration(program, tmp_path):
    out = tmp_path / "fits.csv"
    grid = ["--restitution", "0.85,0.9", "--a1", "0.02,0.04", "--start", "0.8,0.9"]
    program("study", "calibrate", *ARGUMENTS, *grid, "--csv", out)
    found = rw.Wall(**SET).calibrate(restitution=[0.85, 0.9], a1=[0.02, 0.04], start=[0.8, 0.9])
    assert_table(found.fits, out)
    models = len(set(found.fits["damping_model"].tolist()))
    assert found.fits["samples"].dtype.kind == "i" and models >= 3
    assert len(found.coefficients["x"]) == models * 2 * 2
    # two values of a1 lie on their law
    for model, start, q, r in zip(*found.laws.values()):
        for row in found.coefficients.rows():
            if (row["damping_model"], row["u0_over_u_ins"]) == (model, start):
                assert row["x"] == pytest.approx(q * row["a1"] ** r, rel=1e-6)
    assert found._repr_html_().count("<svg") == models + 2


def test_a_calibration_of_a_law_with_its_own_a1():
    rigid = rw.Wall(force_law="rigid_linear", damping_model="none").calibrate(restitution=[0.85])
    assert rigid.fits["damping_model"].tolist() == ["free_standing_block"] and len(rigid.laws["q"]) == 0
    with pytest.raises(ValueError, match="models: \"viscous\" is not one of"):
        rw.Wall().calibrate(["viscous"])
    with pytest.raises(ValueError, match="e = 2: must be above 0 and below 1"):
        rw.Wall().calibrate(restitution=[2.0])


def test_a_verification(program):
    found = rw.verify()
    formulas = program("verify", "formulas", "--json")["formulas"]
    checks = [check for formula in formulas for check in formula["checks"]]
    assert len(checks) > 150 and found["passes"].all()
    for column in ["case", "quantity", "unit", "reference", "computed", "error", "bound"]:
        assert found[column].tolist() == [check[column] for check in checks]


TIED = {"height": 3.0, "thickness": 0.25, "tie_height": 2.5, "tie_strength": 2e3}


@pytest.mark.parametrize("both", [False, True])
def test_a_tie(program, tmp_path, both):
    paths, out = records(program, tmp_path, 3), tmp_path / "tie.csv"
    arguments = [word for name, value in TIED.items() for word in ("--set", f"{name}={value}")]
    arguments += ["--unit", "m/s2", "--scale", "1.5", "--stiffness", "0,1e4,1e6"]
    program("study", "tie", *arguments, "--records", *paths, "--csv", out, *["--both-polarities"] * both)
    motions = [rw.read_record(path, unit="m/s2") for path in paths]
    wall = rw.Wall(**TIED)
    found = wall.tie(motions, stiffness=[1e6, 0, 1e4], scale=1.5, both_polarities=both)
    assert_table(found.table, out)
    assert found.force.shape == (3, 6 if both else 3) and found.falls.any() and found.strength_reached.any()
    np.testing.assert_array_equal(found.falls.sum(axis=1), found.table["falls"])
    np.testing.assert_array_equal(np.median(found.force, axis=1), found.table["force_median_n"])
    assert found.table["falls"].dtype.kind == "i" and "<svg" in found._repr_html_()
    alone = wall.tie(motions, stiffness=[0, 1e4, 1e6], scale=1.5, both_polarities=both, threads=1)
    np.testing.assert_array_equal(alone.u_ratio_max, found.u_ratio_max)


YIELDING = TIED | {"tie_stiffness": 1e6, "tie_ultimate": 0.01}
BARRED = {"height": 3.0, "thickness": 0.25, "tie_height": 2.5, "bar_diameter": 6e-3, "bar_length": 6.0}
BARRED |= {"bar_yield_stress": 2e8, "bar_ultimate_strain": 0.02}


def test_a_tie_that_yields(program, tmp_path):
    paths, out = records(program, tmp_path, 3), tmp_path / "tie.csv"
    arguments = [word for name, value in YIELDING.items() for word in ("--set", f"{name}={value}")]
    arguments += ["--unit", "m/s2", "--ultimate", "0,0.01,1"]
    program("study", "tie", *arguments, "--records", *paths, "--csv", out)
    motions = [rw.read_record(path, unit="m/s2") for path in paths]
    found = rw.Wall(**YIELDING).tie(motions, ultimate=[1, 0, 0.01])
    assert_table(found.table, out)
    assert found.varied == "tie_ultimate" and found.values.tolist() == [0, 0.01, 1]
    assert found.broken[0].any() and not found.broken[2].any()
    assert (found.force <= YIELDING["tie_strength"]).all()
    assert (found.elongation[0] == 0).all() and (found.elongation[2] > 0).any()


@pytest.mark.parametrize(
    ("varied", "tied", "values"),
    [
        ("stiffness", YIELDING, [1e4, 1e6]),
        ("strength", YIELDING, [5e2, 2e3]),
        ("slack", YIELDING, [0, 0.02]),
        ("height", YIELDING, [1.5, 3]),
        ("bar_diameter", BARRED, [4e-3, 8e-3]),
    ],
)
def test_numbers_of_a_tie_that_yields(program, tmp_path, varied, tied, values):
    paths, out = records(program, tmp_path, 2), tmp_path / "tie.csv"
    arguments = [word for name, value in tied.items() for word in ("--set", f"{name}={value}")]
    arguments += ["--unit", "m/s2", f"--{varied.replace('_', '-')}", ",".join(map(str, values))]
    program("study", "tie", *arguments, "--records", *paths, "--csv", out)
    motions = [rw.read_record(path, unit="m/s2") for path in paths]
    found = rw.Wall(**tied).tie(motions, **{varied: values})
    assert_table(found.table, out)
    assert found.varied.endswith(varied) and found.values.tolist() == values
    assert found.elongation.any() and (found.u_ratio_max[0] != found.u_ratio_max[1]).any()


def test_a_tie_at_the_level_of_a_check(program, tmp_path):
    paths, out = records(program, tmp_path, 3), tmp_path / "tie.csv"
    check = {"before_activation": "law", "soil": "B", "SLV": {"ag": 0.3, "F0": 2.45, "TC": 0.32}}
    of_check = "".join(f"{name} = {literal(value)}\n" for name, value in check.items())
    geometry = "[geometry]\nheight = 3.0\nthickness = 0.25\ndensity = 1800\n[force_law]\na1 = 0.05\n"
    scene = geometry + f'[check]\ncode = "circolare-2019"\n{of_check}'
    (tmp_path / "scene.toml").write_text(scene, encoding="utf-8")
    tied = {"tie_height": 2.5, "tie_stiffness": 1e6, "tie_side": "positive"}
    arguments = [word for name, value in tied.items() for word in ("--set", f"{name}={value}")]
    arguments += ["--unit", "m/s2", "--level", "SLV", "--stiffness", "1e4,1e6"]
    program("study", "tie", tmp_path / "scene.toml", *arguments, "--records", *paths, "--csv", out)
    motions = [rw.read_record(path, unit="m/s2") for path in paths]
    wall = rw.Wall(height=3.0, thickness=0.25, density=1800, a1=0.05, **tied)
    with pytest.warns(UserWarning, match="SLV: "):
        found = wall.tie(motions, stiffness=[1e4, 1e6], level="SLV", check=check)
    assert_table(found.table, out)
    # the check runs both signs of records on a wall whose sides differ
    assert found.force.shape == (2, 6)
    for given, message in (
        ({"level": "SLC", "check": check}, "SLC is not stated; give its ag"),
        ({"level": "SLX", "check": check}, "SLX is not stated; .* or another of SLD, SLV and SLC"),
        ({"level": "SLV"}, "level and check go together"),
    ):
        with pytest.raises(ValueError, match=message):
            wall.tie(motions, stiffness=[1e6], **given)
    with pytest.raises(ValueError, match="level needs records"):
        wall.tie(stiffness=[1e6], level="SLV", check=check)


def test_what_is_no_tie(record):
    wall = rw.Wall(**TIED)
    for call, words in [
        (lambda: rw.Wall().tie(record), "no tie_height, so tie_stiffness has no effect; set it"),
        (lambda: wall.tie(), "there is no motion"),
        (lambda: wall.tie(scale=2.0), "scale needs records"),
        (lambda: wall.tie(record, stiffness=[1e6], slack=[0.0]), "stiffness and slack are given"),
        (lambda: wall.tie(record, stiffness=[-1.0]), "tie_stiffness = -1.0 N/m is below its minimum, 0.0"),
        (lambda: wall.tie(record, bar_diameter=[0.01]), "no bar, so bar_diameter has no effect; set it"),
    ]:
        with pytest.raises(ValueError, match=words):
            call()


@pytest.mark.parametrize("scale", [0.3, 2.0])
def test_a_building(program, tmp_path, record, scale):
    out, options = tmp_path / "building.csv", ["--tail", "1", "--tolerance", "0.05"]
    motion = ["--synthetic", "--scale", scale, "--csv", out]
    told = program("building", "scenes/building/three_storeys.toml", *motion, *options, "--json")
    building = rw.Building.from_toml("scenes/building/three_storeys.toml")
    found = building.simulate(record, scale=scale, tail=1.0, tolerance=0.05)
    assert (found.title, found.step, found.change) == (told["title"], told["step"], told["change"])
    assert list(found.floors) == building.floors == [floor["name"] for floor in told["floors"]]
    for floor in told["floors"]:
        ours = found.floors[floor["name"]]
        assert (ours.acceleration_peak, ours.drift_peak) == (floor["acceleration"], floor["drift"])
    assert list(found.walls) == building.walls == [wall["name"] for wall in told["walls"]]
    for wall in told["walls"]:
        ours = found.walls[wall["name"]]
        told_of_fall = (wall["u_max"], wall["overturn_time"], wall["falls"])
        assert (ours.u_max, ours.overturn_time, ours.falls) == told_of_fall
        told_of_tie = (wall["tie_elongation"] or 0.0, wall["tie_break_time"])
        assert (ours.tie_elongation, ours.tie_break_time) == told_of_tie
        for name in ("u_ratio", "reaction_bottom", "reaction_top"):
            assert getattr(ours, f"{name}_peak") == wall[name], name
    histories = columns(out)
    for name, wall in found.walls.items():
        np.testing.assert_array_equal(wall.u, np.array(histories[f"{name}.u_m"], float))
    assert any(wall.falls for wall in found.walls.values()) == (scale == 2.0)
    assert found.peaks["overturned"].dtype.kind == "b" and "<svg" in found._repr_html_()


def test_what_is_no_building(tmp_path, record):
    with pytest.raises(FileNotFoundError, match="none.toml: cannot be read"):
        rw.Building(tmp_path / "none.toml")
    with pytest.warns(UserWarning, match='floor "floor_1" does not start at rest'):
        building = rw.Building("scenes/building/building.toml")
    with pytest.raises(ValueError, match="tolerance = 2 must be from 1e-6 to 1"):
        building.simulate(record, tolerance=2.0)
    with pytest.raises(TypeError, match="must be a Record"):
        building.simulate("x.AT2")


STUDY = """
title = "Parts"
models = ["CR", { model = "CDC", xi = 0.05 }]
levels = { method = "step", step = 0.3, top = 6 }
intensity = { measure = "PGA" }
report = { fractions = [0.4, 1.0], resamples = 100 }
records = { files = ["1.csv", "2.csv", "3.csv"], unit = "m/s2" }
walls = [{ table = "walls.csv" }]
"""
ROWS = [
    {"name": "low", "height": 1.5, "force_law": "bilinear", "restitution": None},
    {"name": "high", "height": 3.0, "force_law": "trilinear", "restitution": 0.9},
]
OPTIONS = {
    "models": ["CR", {"model": "CDC", "xi": 0.05}],
    "levels": {"method": "step", "step": 0.3, "top": 6},
    "intensity": {"measure": "PGA"},
    "report": {"fractions": np.array([0.4, 1.0]), "resamples": 100},
    "title": "Parts",
}


@pytest.fixture(scope="module")
def study_file(program, tmp_path_factory):
    """A study as a file, and its results."""
    folder = tmp_path_factory.mktemp("study")
    records(program, folder, 3)
    rows = ["low,1.5,bilinear,0.25,", "high,3.0,trilinear,0.25,0.9"]
    table = "\n".join(["name,height,force_law,thickness,restitution", *rows]) + "\n"
    (folder / "walls.csv").write_text(table, encoding="utf-8")
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    return folder, rw.Study(folder / "study.toml").run(progress=False)


def walls_of(kind):
    """The walls of the study in several ways."""
    given = [{name: value for name, value in row.items() if value is not None} for row in ROWS]
    given = [{**row, "thickness": 0.25} for row in given]
    parameters = [{name: value for name, value in row.items() if name != "name"} for row in given]
    if kind == "frame":
        pandas = pytest.importorskip("pandas")
        return pandas.DataFrame(ROWS).assign(thickness=0.25)
    if kind == "missing":
        pandas = pytest.importorskip("pandas")
        return pandas.DataFrame(ROWS).assign(thickness=0.25).convert_dtypes()
    if kind == "index":
        return pytest.importorskip("pandas").DataFrame(ROWS).assign(thickness=0.25).set_index("name")
    if kind == "pyarrow columns":
        pandas = pytest.importorskip("pandas")
        pytest.importorskip("pyarrow")
        return pandas.DataFrame(ROWS).assign(thickness=0.25).convert_dtypes(dtype_backend="pyarrow")
    if kind == "pyarrow":
        pyarrow = pytest.importorskip("pyarrow")
        return pyarrow.Table.from_pylist([{**row, "thickness": 0.25} for row in ROWS])
    if kind == "emptied":
        pandas = pytest.importorskip("pandas")
        frame = pandas.DataFrame(ROWS).assign(thickness=0.25)
        return pandas.concat([frame[:1], pandas.DataFrame([{"name": None}]), frame[1:]])
    if kind == "table":
        return rw.Table({name: [row[name] for row in ROWS] for name in ROWS[0]} | {"thickness": [0.25] * 2})
    if kind == "list":
        return given
    names = [row["name"] for row in ROWS]
    if kind == "dictionaries":
        return dict(zip(names, parameters))
    return {name: rw.Wall(**row) for name, row in zip(names, parameters)}


KINDS = ("frame", "missing", "emptied", "index", "pyarrow columns", "pyarrow")
KINDS += ("table", "list", "dictionaries", "walls")


@pytest.mark.parametrize("kind", KINDS)
def test_a_study_without_a_file(study_file, kind):
    folder, told = study_file
    paths = [folder / f"{number}.csv" for number in (1, 2, 3)]
    motions = [rw.read_record(path, unit="m/s2") for path in paths]
    study = rw.Study(walls=walls_of(kind), records=motions, **OPTIONS)
    assert (study.walls, study.records) == (["low", "high"], ["1.csv", "2.csv", "3.csv"])
    assert study.title == "Parts" and study.measure == "PGA" and study.models == ["CR", "CDC 0.05"]
    found = study.run(progress=False)
    for name in ("levels", "collapses", "fragilities"):
        for column, values in getattr(told, name).items():
            np.testing.assert_array_equal(getattr(found, name)[column], values)


def test_a_table_of_walls_has_names_of_its_own(record):
    pandas = pytest.importorskip("pandas")
    options = {"records": record, "models": ["CDC 0.05"], "levels": OPTIONS["levels"]}
    frame = pandas.DataFrame([["low", 1.5, 0.25], ["high", 3.0, 0.25]], columns=["name", "height", "height"])
    with pytest.raises(ValueError, match="two columns 'height'"):
        rw.Study(walls=frame, **options)
    frame.columns = ["name", "height", "thickness"]
    frame.loc[1, "name"] = np.nan
    with pytest.raises(ValueError, match="row 2 of the table of walls has no name"):
        rw.Study(walls=frame, **options)


def test_columns_of_walls_have_one_length(record):
    options = {"records": record, "models": ["CDC 0.05"], "levels": OPTIONS["levels"]}
    columns = {"name": ["low", "middle", "high"], "height": [1.5, 2.0], "thickness": [0.25] * 3}
    with pytest.raises(ValueError, match="'name' has 3, 'height' has 2, 'thickness' has 3"):
        rw.Study(walls=columns, **options)


def test_a_table_of_pyarrow_has_names_of_its_own(record):
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table([["low"], [1.5], [0.25]], names=["name", "height", "height"])
    with pytest.raises(ValueError, match="two columns 'height'"):
        rw.Study(walls=table, records=record, models=["CDC 0.05"], levels=OPTIONS["levels"])


def test_a_study_without_a_file_is_sent(program, tmp_path, record):
    wall = rw.Wall(height=1.5, thickness=0.25).on_storeys([rw.Storey(period=0.3)])
    options = {"models": ["CR"], "levels": {"method": "grid", "values": [1]}}
    study = rw.Study(walls=[wall], records={"one": record}, **options)
    assert study.walls == ["1"] and study.records == ["one"]
    assert pickle.loads(pickle.dumps(study))._native.part(0) == study._native.part(0)
    path = tmp_path / "motion.csv"
    program("record", "--synthetic", "--samples", path)
    read = rw.Study(walls=wall, records=path, **options)
    assert read.records == ["motion.csv"] and read._native.sent()[2][0][1][0] == record.dt


def test_a_study_warns_of_what_it_does_not_use(record):
    levels = {"method": "grid", "values": [1]}
    wall = rw.Wall(height=3, thickness=0.25, damping_model="none", impact="restitution", u_start=0.01)
    with pytest.warns(UserWarning, match="does not use damping_model, impact, u_start; its models"):
        rw.Study(walls=[wall], records=record, models=["CR"], levels=levels)
    scene = rw.Wall.from_toml("scenes/shaken_parapet.toml")
    with pytest.warns(UserWarning, match="the motion of its scene"):
        rw.Study(walls=[scene], records=record, models=["CR"], levels=levels)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rw.Study(walls=[wall.replace(**PLAIN)], records=record, models=["CR"], levels=levels)


PLAIN = {"damping_model": "constant_ratio", "impact": "none", "u_start": 0.0}


@pytest.mark.parametrize(
    "parts, error, words",
    [
        ({"walls": None}, TypeError, "needs a path, or its parts: walls missing"),
        ({"walls": []}, ValueError, "at least one wall"),
        ({"walls": ["low"]}, TypeError, "a Wall or a dictionary of parameters, found .* str"),
        ({"walls": [{"impact": "none"}]}, TypeError, 'wall "1": "impact" is not a parameter of a wall'),
        ({"walls": [{"height": -1}]}, ValueError, '^wall "1": height = -1.0 m is below'),
        ({"walls": [{"name": "a"}, {"name": "a"}]}, ValueError, 'the name "a" occurs twice'),
        ({"records": [[0.0, 1.0]]}, TypeError, "record must be a Record, found a value of the type list"),
        ({"records": []}, ValueError, "at least one record"),
        ({"models": ["CDX"]}, ValueError, '^models: "CDX" is not a damping model'),
        ({"levels": {"method": "walk"}}, ValueError, 'method = "walk" is not one of hunt, step, grid'),
        ({"report": {"fractions": [1.5]}}, ValueError, "^report.fractions = 1.5 must be above 0"),
        ({"report": {"fractions": {1, 2}}}, TypeError, "found a value of the type set"),
        ({"path": "study.toml"}, TypeError, "a study file has its own walls, records, models, levels"),
    ],
)
def test_what_is_no_study(record, parts, error, words):
    whole = {
        "walls": [{"height": 3.0, "thickness": 0.25}],
        "records": [record],
        "models": ["CR"],
        "levels": {"method": "grid", "values": [0.5]},
    }
    with pytest.raises(error, match=words):
        rw.Study(**{**whole, **parts})


def test_reliability_is_that_of_the_program(program, tmp_path):
    text = (ROOT / "docs/tutorials/reliability.md").read_text(encoding="utf-8")
    path = tmp_path / "study.toml"
    path.write_text(text.split("```toml\n")[1].split("```")[0], encoding="utf-8")
    program("study", "reliability", path, "-o", tmp_path / "results")
    found = rw.Study.from_toml(path).reliability(progress=False)
    assert repr(found) == "ReliabilityResults(3 walls)"
    for table, name in ((found.walls, ""), (found.rules, "_rules"), (found.summary, "_summary")):
        assert_table(table, tmp_path / "results" / f"reliability{name}.csv")
    site = {"ag": 0.15, "F0": 2.45, "TC": 0.32}
    check = {"code": "circolare-2019", "before_activation": "law", "soil": "B", "SLV": site}
    levels = {"method": "step", "step": 0.05, "top": 2}
    parts = {"walls": [rw.Wall(1.5, 0.3, density=1800, a1=0.05)], "models": ["CR"], "levels": levels}
    motions = [rw.synthetic_record(seed) for seed in range(1, 9)]
    study = rw.Study(records=motions, intensity={"measure": "code"}, check=check, **parts)
    assert study.measure == "a_g" and len(study.reliability(progress=False).walls["wall"]) == 4
    with pytest.raises(ValueError, match='measure = "code"'):
        other = rw.Study(records=motions, intensity={"measure": "PGA"}, check=check, **parts)
        other.reliability(progress=False)
