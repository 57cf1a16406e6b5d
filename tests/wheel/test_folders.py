"""Studies in folders from Python: the bytes of the program, resumed, in shards, and read again."""

import csv
import json
import math
import shutil

import numpy as np
import pytest

import rocking_wall as rw
from test_jobs import ROOT, assert_table

STUDY = """
title = "Two parapets"
models = ["CR", "CDC"]
intensity = { measure = "PGA" }
levels = { method = "hunt", first = 0.1, increase = 0.1, top = 1.2, gap = 0.3 }
records = { synthetic = { count = 4, duration = 12, step = 0.01 } }
report = { fractions = [0.4, 1.0], loss_ratios = [0.2, 1.0], resamples = 100, modelling_uncertainty = 0.2 }
classes = [{ name = "both", weights = [2, 1] }]
hazard = { points = [[0.05, 0.033], [0.2, 0.002], [0.8, 5e-5]], target = 1e-3 }

[[walls]]
name = "1"
geometry = { height = 2, thickness = 0.3 }

[[walls]]
name = "2"
geometry = { height = 3, thickness = 0.3 }

[walls.tie]
tie_height = 2.6
tie_stiffness = 2e5
tie_slack = 5e-3
tie_strength = 1e3
tie_ultimate = 0.05
"""


def files(folder):
    """Every file of a folder with its bytes."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@pytest.fixture(scope="module")
def study(program, tmp_path_factory):
    """A study of two walls, and the folder that the program makes of it."""
    folder = tmp_path_factory.mktemp("study")
    path = folder / "study.toml"
    path.write_text(STUDY, encoding="utf-8")
    program("study", "ida", path, "-o", folder / "program")
    return rw.Study(path), folder / "program"


def test_results_have_every_table_of_the_program(study, tmp_path):
    asked, given = study
    with pytest.warns(UserWarning):
        found = asked.run(tmp_path / "out", progress=False)
    assert files(tmp_path / "out") == files(given)
    for one in (found, rw.read_results(given)):
        assert repr(one) == f"StudyResults({len(one.levels['wall'])} runs, 16 curves)"
        tables = ("levels", "collapses", "fragilities", "rates", "rate_shares", "losses")
        tables += ("vulnerability", "ties")
        for name, path in (*((name, name) for name in tables), ("curves", "fragility_curves")):
            table = getattr(one, name)
            told = [name for name, column in table.items() if column.dtype.kind in "fib"]
            assert_table({name: table[name] for name in told}, given / f"{path}.csv", told)
        assert set(one.curves["wall"]) == {"1", "2", "both"} == set(one.rates["wall"])
        assert set(one.ties["wall"]) == {"2"} and one.ties["yielded"].any() and one.ties["broken"].any()
        assert one.nrml == (given / "fragilities.xml").read_text(encoding="utf-8")
    # without a folder the same, and nothing is kept
    with pytest.warns(UserWarning):
        kept = asked.run(progress=False)
    assert kept.rates["annual_rate"].tolist() == found.rates["annual_rate"].tolist()
    assert not list(tmp_path.glob("study_results"))
    kept.to_nrml(tmp_path / "walls.xml")
    assert (tmp_path / "walls.xml").read_bytes() == (given / "fragilities.xml").read_bytes()
    with pytest.raises(FileExistsError):
        kept.to_nrml(tmp_path / "walls.xml")


def test_a_stopped_study_goes_on_in_its_folder(study, tmp_path):
    asked, given = study
    out = tmp_path / "out"
    asked.compute(out, progress=False)
    parts = sorted((out / "runs").rglob("*.parquet"))
    with pytest.raises(ValueError, match="has no results yet; run the study"):
        rw.read_results(out)
    before = parts[0].stat().st_mtime_ns
    parts[1].unlink()
    parts[2].write_bytes(parts[2].read_bytes()[:-20])
    with pytest.raises(ValueError, match="combinations are missing"):
        rw.read_results(out)
    with pytest.warns(UserWarning, match="1 of .* parts are damaged"):
        asked.run(out, progress=False)
    assert files(out) == files(given) and parts[0].stat().st_mtime_ns == before


def test_results_of_another_report_are_not_read(study, tmp_path):
    _, given = study
    path = tmp_path / "study.toml"
    path.write_text(STUDY.replace("target = 1e-3", "target = 2e-3"), encoding="utf-8")
    shutil.copytree(given, tmp_path / "out")
    # one part is gone, so that the tables of the new report cannot be made
    next((tmp_path / "out" / "runs").rglob("*.parquet")).unlink()
    rw.Study(path).compute(tmp_path / "out", (2, 2), progress=False)
    with pytest.raises(ValueError, match="combinations are missing|has no results yet"):
        rw.read_results(tmp_path / "out")
    rw.Study(path).compute(tmp_path / "out", progress=False)
    with pytest.raises(ValueError, match="has no results yet"):
        rw.read_results(tmp_path / "out")


def test_a_study_of_parts_becomes_a_file(tmp_path, monkeypatch):
    """A study of objects, dictionaries and arrays gives the same tables from its file; ξ of a wall too."""
    walls = {"low": rw.Wall(1.5, 0.25), "own": {"height": 3, "thickness": 0.25, "xi": 0.07}}
    rng = np.random.default_rng(5)
    records = [rw.synthetic_record(rng, duration=10) for _ in range(3)]
    # before the others: the bootstrap sees the order
    records.insert(0, rw.sequence(records[:2], pause=3))
    levels = {"method": "step", "step": 0.4, "top": 4}
    report = {"resamples": 100, "seed": np.random.default_rng(7)}
    hazard = tmp_path / "elsewhere" / "curve.csv"
    hazard.parent.mkdir()
    hazard.write_text("intensity,annual_rate\n0.05,0.03\n0.8,5e-5\n", encoding="utf-8")
    monkeypatch.chdir(hazard.parent)
    options = {"report": report, "hazard": {"file": "curve.csv"}}
    study = rw.Study(walls=walls, records=records, models=["CR", "CDC"], levels=levels, **options)
    study.to_toml(tmp_path / "study.toml")
    (tmp_path / "b_records").mkdir()
    with pytest.raises(FileExistsError, match="b_records: exists; remove it"):
        study.to_toml(tmp_path / "b.toml")
    (tmp_path / "b_records").rmdir()
    again = rw.Study(tmp_path / "study.toml")
    for name, each in {"parts": study, "file": again}.items():
        each.run(tmp_path / name, progress=False)
    assert files(tmp_path / "parts") == files(tmp_path / "file")
    with pytest.raises(FileExistsError):
        study.to_toml(tmp_path / "study.toml")
    with pytest.raises(ValueError, match="is a file already"):
        again.to_toml(tmp_path / "other.toml")
    pair = rw.sequence(records[1:3], name="pair")
    rw.Study(walls=walls, records=[pair], models=["CDC"], levels=levels).to_toml(tmp_path / "pair.toml")
    assert rw.Study(tmp_path / "pair.toml").records == ["pair 1 + pair 2"]
    mixed = [records[0], rw.synthetic_record(dt=0.01)]
    with pytest.raises(ValueError, match="steps of 0.005 s and 0.01 s"):
        rw.Study(walls=walls, records=mixed, models=["CDC"], levels=levels).to_toml(
            tmp_path / "b.toml"
        )
    floor = rw.Storey(period=0.3)
    wall = rw.Wall(2, 0.3).on_storeys([floor])
    housed = rw.Study(walls=wall, records=records, models=["CR"], levels=levels)
    with pytest.raises(ValueError, match="stands on storeys"):
        housed.to_toml(tmp_path / "c.toml")
    assert not list(tmp_path.glob("[bc]*.toml")) and not list(tmp_path.glob("[bc]_records"))


def test_curves_are_components_of_pelicun(study):
    """Columns and keys are those of pelicun's damage and loss library, numbers those of the curves."""
    curves = rw.read_results(study[1]).curves.rows()
    described = json.loads((study[1] / "pelicun.json").read_text(encoding="utf-8"))
    with open(study[1] / "pelicun.csv", encoding="utf-8", newline="") as file:
        rows = {row["ID"]: row for row in csv.DictReader(file)}
    assert list(rows) == list(described)[1:] and "both.CR" in rows
    for name, row in rows.items():
        wall, model = name.split(".")
        of = [curve for curve in curves if (curve["wall"], curve["model"]) == (wall, model)]
        assert len(of) == 2 == len(described[name]["LimitStates"])
        assert (row["Demand-Type"], row["Demand-Unit"]) == ("Peak Ground Acceleration", "g")
        assert (row["Demand-Offset"], row["Demand-Directional"], row["Incomplete"]) == ("0", "1", "0")
        for k, curve in enumerate(of, 1):
            assert row[f"LS{k}-Family"] == "lognormal" and row[f"LS{k}-DamageStateWeights"] == ""
            assert float(row[f"LS{k}-Theta_0"]) == curve["theta"]
            assert float(row[f"LS{k}-Theta_1"]) == curve["beta"]
            assert list(described[name]["LimitStates"][f"LS{k}"]) == [f"DS{k}"]


def test_components_by_other_measures(tmp_path):
    """Demands and units are those of pelicun's vocabulary (DLML, `dlml/vocabulary.py`, EDP_TYPES)."""
    records = [rw.synthetic_record(seed, duration=10) for seed in range(8)]
    levels = {"method": "hunt", "first": 0.1, "increase": 0.1, "top": 4, "unit": "m/s"}
    for intensity, demand, unit in (
        ({"measure": "Sa", "period": 0.5}, "Spectral Acceleration|0.5", "g"),
        ({"measure": "PGV"}, "Peak Ground Velocity", "cmps"),
    ):
        of = levels if unit == "cmps" else {**levels, "unit": "g"}
        parts = {"walls": rw.Wall(2, 0.3), "records": records, "models": ["CR"], "levels": of}
        study = rw.Study(**parts, intensity=intensity, report={"fractions": [1.0], "resamples": 100})
        found = study.run(tmp_path / intensity["measure"], progress=False)
        with open(tmp_path / intensity["measure"] / "pelicun.csv", encoding="utf-8", newline="") as file:
            [row] = csv.DictReader(file)
        assert (row["Demand-Type"], row["Demand-Unit"]) == (demand, unit)
        assert float(row["LS1-Theta_0"]) == found.curves["theta"][0]
        assert found.curves["unit"][0] == {"g": "g", "cmps": "cm/s"}[unit]


def test_results_become_a_dataset(study):
    found = rw.read_results(study[1])
    data = found.to_xarray()
    assert data["theta_g"].dims == ("wall", "model", "u_max_over_u_ins")
    assert data["collapse_g"].dims == ("wall", "model", "record")
    assert data["wall"].values.tolist() == ["1", "2"] and data["model"].values.tolist() == ["CR", "CDC"]
    for row in found.collapses.rows():
        place = {name: row[name] for name in ("wall", "model", "record")}
        np.testing.assert_equal(data["collapse_g"].sel(place).item(), row["collapse_g"])


def test_shards_are_merged(study, tmp_path):
    asked, given = study
    for number in (1, 2, 3):
        asked.compute(tmp_path / str(number), (number, 3), progress=False)
        asked.compute(tmp_path / "shared", (number, 3), progress=False)
    with pytest.raises(ValueError, match="combinations are missing"):
        rw.merge([tmp_path / "1", tmp_path / "3"], tmp_path / "part")
    with pytest.raises(ValueError, match="needs one for the result"):
        rw.merge([tmp_path / "1", tmp_path / "3"])
    with pytest.raises(ValueError, match="no folder to merge"):
        rw.merge([])
    part = next((tmp_path / "1" / "runs").rglob("*.parquet"))
    whole = part.read_bytes()
    part.write_bytes(whole[:-20])
    with pytest.raises(ValueError, match="combinations are missing.*1 of .* parts are damaged"):
        rw.merge([tmp_path / str(number) for number in (1, 2, 3)], tmp_path / "damaged")
    part.write_bytes(whole)
    with pytest.warns(UserWarning):
        merged = rw.merge([tmp_path / str(number) for number in (1, 2, 3)], tmp_path / "merged")
    with pytest.warns(UserWarning):
        rw.merge(tmp_path / "shared")
    assert files(tmp_path / "merged") == files(given) == files(tmp_path / "shared")
    assert len(merged.rates["wall"]) == 3 * 2 * 2
    for shard in ((0, 2), (3, 2)):
        with pytest.raises(ValueError, match="such as"):
            asked.compute(tmp_path / "x", shard)
    levels = {"method": "grid", "values": [1]}
    other = rw.Study(walls=[rw.Wall()], records=rw.synthetic_record(), models=["CR"], levels=levels)
    with pytest.raises(ValueError, match="holds results of another study"):
        other.run(tmp_path / "merged", progress=False)


def test_uncertain_parameters_are_samples(program, tmp_path):
    uncertain = {"samples": 12, "seed": 3, "parameters": {"height": {"normal": [3.0, 0.1]}}}
    motions = [rw.synthetic_record(seed, duration=10.0) for seed in (1, 2, 3)]
    study = rw.Study(
        walls=[rw.Wall(3, 0.3)],
        records=motions,
        models=["CDC"],
        levels={"method": "step", "step": 0.2, "top": 4},
        report={"resamples": 100},
        uncertain=uncertain,
    )
    assert study.walls == [f"1 {number:02}" for number in range(1, 13)]
    found = study.run(tmp_path / "out", progress=False)
    heights = found.samples["height"]
    # each of twelve equally probable parts of the distribution has one sample
    parts = [math.floor(12 * 0.5 * math.erfc((3.0 - h) / (0.1 * math.sqrt(2)))) for h in heights]
    assert sorted(parts) == list(range(12))
    assert set(found.sensitivity["parameter"]) == {"height"}
    assert "1" in set(found.curves["wall"])
    program("study", "merge", tmp_path / "out")


def test_measures_are_compared(program, tmp_path, monkeypatch):
    """A study of objects compares measures as its file does; the table of records stays where it is."""
    walls = {"low": rw.Wall(2, 0.3), "3": rw.Wall(3, 0.3)}
    records = {str(seed): rw.synthetic_record(seed, duration=9.0 + seed) for seed in range(1, 6)}
    rows = "".join(f"{name},{5.0 + 0.3 * place}\n" for place, name in enumerate(records))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "flatfile.csv").write_text("record,magnitude\n" + rows, encoding="utf-8")
    names = ["PGA", "PGV", "Arias", "Sa(0.5)"]
    intensity = {"measure": "PGA", "compare": names, "records_table": "flatfile.csv"}
    levels = {"method": "hunt", "first": 0.1, "increase": 0.1, "top": 4}
    options = {"intensity": intensity, "report": {"resamples": 100}}
    study = rw.Study(walls=walls, records=records, models=["CR"], levels=levels, **options)
    found = study.run(tmp_path / "python", progress=False).measures
    assert found["wall"].tolist() == ["low"] * 4 + ["3"] * 4 + ["all walls"] * 4
    assert found["measure"].tolist() == ["PGA", "PGV", "Arias", "Sa(0.5 s)"] * 3
    assert (found["records"] == [5] * 8 + [10] * 4).all() and (found["b"] > 0.4).all()
    probabilities = [found[f"p_{y}_{z}"] for y in ("theta", "d") for z in ("duration", "magnitude")]
    assert all(((p > 0) & (p <= 1)).all() for p in probabilities) and "p_d_distance" not in found
    (tmp_path / "elsewhere").mkdir()
    study.to_toml(tmp_path / "elsewhere" / "study.toml")
    program("study", "ida", tmp_path / "elsewhere" / "study.toml", "-o", tmp_path / "program")
    assert files(tmp_path / "program") == files(tmp_path / "python")
    options["intensity"] = {"measure": "PGA"}
    plain = rw.Study(walls=walls, records=records, models=["CR"], levels=levels, **options)
    assert plain.run(tmp_path / "python", progress=False).measures is None
    with pytest.raises(ValueError, match='flatfile.csv has no record "x"; add a row'):
        more = records | {"x": records["1"] * 2}
        rw.Study(walls=walls, records=more, models=["CR"], levels=levels, intensity=intensity)


def test_what_is_no_folder(tmp_path):
    with pytest.raises(FileNotFoundError, match="expected a folder that"):
        rw.read_results(tmp_path)


def test_reliability_is_kept_too(program, tmp_path):
    text = (ROOT / "docs/tutorials/reliability.md").read_text(encoding="utf-8")
    path = tmp_path / "study.toml"
    path.write_text(text.split("```toml\n")[1].split("```")[0], encoding="utf-8")
    program("study", "reliability", path, "-o", tmp_path / "program")
    asked = rw.Study(path)
    asked.compute(tmp_path / "python", (1, 2), progress=False)
    asked.reliability(tmp_path / "python", progress=False)
    assert files(tmp_path / "python") == files(tmp_path / "program")


def test_curves_are_drawn(study, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    found = rw.read_results(study[1])
    ax = found.plot()
    rows = [row for row in found.curves.rows() if row["u_max_over_u_ins"] == 1.0]
    drawn = [row for row in rows if math.isfinite(row["theta"])]
    assert [line.get_label() for line in ax.lines] == [f"{row['wall']}, {row['model']}" for row in drawn]
    for line, row in zip(ax.lines, drawn):
        x, y = line.get_data()
        assert abs(np.interp(0.5, y, x) / row["theta"] - 1) < 1e-9
    assert len(found.plot(["1"]).lines) == 2
    with pytest.raises(ValueError, match="no wall or class 'none'"):
        found.plot(["none"])
