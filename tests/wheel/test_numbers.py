"""The numbers of Python are those of the program `wall`, to the last digit."""

import csv

import numpy as np
import pytest

import rocking_wall as rw

SET = {"height": 3.0, "thickness": 0.25, "a1": 0.02}
ARGUMENTS = [word for name, value in SET.items() for word in ("--set", f"{name}={value}")]


def columns(path):
    """Reads the columns of a CSV file."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [row[name] for row in rows] for name in rows[0]}


@pytest.mark.parametrize("more", [{}, {"damping_model": "none", "impact": "restitution"}, {"u_start": 0.01}])
def test_a_run(program, record, tmp_path, more):
    arguments = [word for name, value in more.items() for word in ("--set", f"{name}={value}")]
    arguments += ["--csv", tmp_path / "run.csv", "--json"]
    told = program("simulate", "--synthetic", "--scale", "1.5", *ARGUMENTS, *arguments)
    response = rw.Wall(**SET, **more).simulate(record, scale=1.5)
    peaks = ("u_max", "u_ratio_max", "overturned", "overturn_time")
    for name in (*peaks, "pieces", "corners", "impacts", "demands"):
        assert getattr(response, name) == told[name], name
    history = columns(tmp_path / "run.csv")
    # the program adds units to the names
    assert all(title.startswith(name) for title, name in zip(history, response.history, strict=True))
    for name, column in zip(response.history, history.values()):
        # the program rounds times to a nanosecond
        tolerance = 1e-9 if name == "time" else 0.0
        np.testing.assert_allclose(response.history[name], np.array(column, float), rtol=0.0, atol=tolerance)


def test_a_scene(program):
    told = program("simulate", "scenes/shaken_parapet.toml", "--json")
    assert rw.Wall.from_toml("scenes/shaken_parapet.toml").simulate().u_max == told["u_max"]


def test_free_vibration(program):
    assert rw.Wall().simulate().demands == program("simulate", "--json")["demands"]


def test_a_description(program):
    told = program("describe", "--json", *ARGUMENTS)
    found = rw.Wall(**SET).describe()
    for name, value in told.items():
        if isinstance(value, float):
            assert found[name] == value, name
    np.testing.assert_array_equal(found["backbone"], told["backbone"])
    assert set(found) <= set(told)


def test_a_law_of_points():
    law = {"force_law": "multilinear", "points": [[0.02, 0.8], [0.1, 0.9], [1.0, 0.0]]}
    found = rw.Wall(height=3, thickness=0.25, **law).describe()
    u, force = found["backbone"].T
    for ratio, part in law["points"]:
        assert np.interp(ratio * found["u_ins"], u, force) == pytest.approx(part * found["F0"], abs=1e-9)
    for name, value in law.items():
        with pytest.raises(ValueError, match="beside it"):
            rw.Wall(**{name: value})


def test_a_batch(record):
    wall = rw.Wall(**SET)
    factors = [0.3, 1.0, 2.0, 20.0]
    peaks = wall.peaks(record, factors)
    for index, factor in enumerate(factors):
        run = wall.simulate(record, scale=factor)
        assert peaks.overturned[index] == run.overturned
        if run.overturned:
            assert peaks.overturn_time[index] == pytest.approx(run.overturn_time, rel=1e-9)
        else:
            assert peaks.u_max[index] == pytest.approx(run.u_max, rel=1e-9)
            assert peaks.u_ratio_max[index] == pytest.approx(run.u_ratio_max, rel=1e-9)


def test_many_walls_and_records_have_their_own_peaks(record):
    """Arrays are broadcast, and each run has the bits of a batch of its own, with any number of threads."""
    ratio = SET | {"damping_model": "constant_ratio"}
    walls = [rw.Wall(**SET), rw.Wall(**ratio), rw.Wall(**SET).on_storeys([rw.Storey(period=0.3)])]
    coarser = rw.Record(0.01, np.asarray(rw.synthetic_record(5))[::2])
    records, factors = [record, coarser], [0.3, 1.0, 20.0]
    grid = [[[wall]] for wall in walls], [[each] for each in records], factors
    found = rw.simulate_many(*grid, threads=1)
    assert found.u_max.shape == found.overturned.shape == (3, 2, 3)
    assert repr(found).startswith("Peaks(18 runs")
    assert 2 < found.overturned.sum() < 16 and len(found.table.rows()) == 18
    for n, wall in enumerate(walls):
        for m, record in enumerate(records):
            alone = wall.peaks(record, factors)
            for name in ("factor", "u_max", "u_ratio_max", "overturn_time"):
                np.testing.assert_array_equal(getattr(found, name)[n, m], getattr(alone, name))
    one = rw.simulate_many(walls[1], records[0], 0.3)
    assert one.u_max.shape == () and one.u_max == found.u_max[1, 0, 0]
    assert rw.simulate_many(walls[:2], records).u_max.tolist() == found.u_max[[0, 1], [0, 1], 1].tolist()
    assert rw.simulate_many([], record).u_max.shape == (0,)


def test_many_runs_are_the_same_on_any_number_of_threads(record):
    """300 runs are two groups of one thread, and six of threads that share them."""
    walls = [rw.Wall(**SET), rw.Wall(**SET | {"thickness": 0.3})]
    factors = np.linspace(0.1, 1.0, 150)[:, None]
    found = rw.simulate_many(walls, record, factors, threads=1)
    np.testing.assert_array_equal(rw.simulate_many(walls, record, factors, threads=6).u_max, found.u_max)
    # 10⁷ steps of Newmark in one of the record
    slow = rw.Wall(**SET | {"solver": "newmark", "newmark_step": 1e-6})
    coarse = rw.Record(10.0, [0.0, 0.01, 0.0])
    for threads in (1, 6):
        with pytest.raises(RuntimeError, match=r"run 281, of factor 0.5: .*than are followed"):
            rw.simulate_many([walls[0]] * 281 + [slow] + [walls[1]] * 19, coarse, 0.5, threads=threads)


def test_many_runs_that_cannot_be(record):
    wall = rw.Wall(**SET)
    rows = np.empty(2, dtype=object)
    rows[:] = [wall], [wall, wall]
    with pytest.raises(TypeError, match=r"walls\[0\] must be a Wall, found a value of the type list"):
        rw.simulate_many(rows, record)
    with pytest.raises(ValueError, match=r"walls has parts of different shapes"):
        rw.simulate_many([[wall], [wall, wall]], record)
    with pytest.raises(ValueError, match=r"\(2,\), \(3,\) and \(\), which do not fit"):
        rw.simulate_many([wall] * 2, [record] * 3)
    with pytest.raises(TypeError, match=r"walls\[1\] must be a Wall"):
        rw.simulate_many([wall, 3.0], record)
    with pytest.raises(TypeError, match=r"rw.read_record\('x.AT2'\)"):
        rw.simulate_many(wall, "x.AT2")
    with pytest.raises(ValueError, match="cannot be scaled by inf"):
        rw.simulate_many(wall, record, [1.0, float("inf")])


def test_parts_of_a_long_batch_are_the_whole(record):
    wall, factors = rw.Wall(**SET), np.linspace(0.1, 1.0, 1500)
    whole, part = wall.peaks(record, factors), wall.peaks(record, factors[1400:])
    np.testing.assert_array_equal(whole.u_max[1400:], part.u_max)


def test_a_start_by_name_is_kept(record):
    wall = rw.Wall(**SET, u_start=0.05)
    assert wall.simulate(record).u[0] == 0.05
    assert wall.peaks(record, [0.0]).u_max[0] == 0.05
    assert rw.Wall(**SET).simulate(record).u[0] == 0.0


def test_a_record(program, tmp_path, record):
    path = tmp_path / "record.csv"
    program("record", "--synthetic", "--samples", path)
    read = rw.read_record(path)
    np.testing.assert_array_equal(read.a, record.a)
    [told] = program("record", path, "--json", "--periods", "0.2,1")["records"]
    g = 9.80665
    assert (read.dt, read.pga / g) == (told["step_s"], told["pga_g"])
    np.testing.assert_array_equal(read.spectrum([0.2, 1.0]) / g, told["sa_g"])
    assert read.average_sa() / g == told["average_sa_g"]
    names = ("peak_velocity_m_s", "peak_displacement_m", "arias_m_s", "cav_m_s")
    assert [read.pgv, read.pgd, read.arias, read.cav] == [told[name] for name in names]
    # sums of 6,000 terms in the same order
    trapezoids = np.cumsum(read.dt * (read.a[1:] + read.a[:-1]) / 2)
    np.testing.assert_allclose(read.velocity[1:], trapezoids, atol=1e-13)
    assert read.velocity[0] == read.displacement[0] == 0
    assert 0 <= read.pgd - abs(read.displacement).max() < read.pgv * read.dt
    periods = np.arange(10, 251) / 100
    housner = np.trapezoid(read.spectrum(periods) * periods / (2 * np.pi), periods)
    assert abs(read.housner() / housner - 1) < 1e-13
    [told] = program("record", path, "--json", "--at-samples", "--damping", "0.02")["records"]
    assert read.average_sa(damping=0.02, maxima="at_samples") / g == told["average_sa_g"]


def test_a_study(program, tmp_path):
    text = open("examples/python/fragility.py", encoding="utf-8").read().split('"""')[3]
    path = tmp_path / "study.toml"
    path.write_text(text, encoding="utf-8")
    program("study", "ida", path, "-o", tmp_path / "results")
    study = rw.Study.from_toml(path)
    results = study.run(progress=False, threads=1)
    for name in ("levels", "collapses", "fragilities"):
        table, told = getattr(results, name), columns(tmp_path / "results" / f"{name}.csv")
        assert list(table) == list(told), name
        for column, texts in told.items():
            for value, text in zip(table[column], texts, strict=True):
                if text.startswith("open"):
                    assert not np.isfinite(value)
                elif text == "":
                    assert np.isnan(value)
                elif column == "overturned":
                    assert value == (text == "true")
                else:
                    assert value == (text if column in ("wall", "model", "record") else float(text)), column


def test_a_package(program, fmu, tmp_path):
    scene = "scenes/shaken_parapet.toml"
    program("package", scene, "-o", tmp_path / "one.fmu", "--base", fmu)
    rw.package(scene, tmp_path / "two.fmu", base=fmu)
    assert (tmp_path / "one.fmu").read_bytes() == (tmp_path / "two.fmu").read_bytes()
    rw.package(rw.Wall.from_toml(scene), tmp_path / "three.fmu")
    assert (tmp_path / "three.fmu").stat().st_size > 0
