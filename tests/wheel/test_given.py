"""What Python gives as numbers, records and tables: right, or refused with its name."""

import decimal
import pathlib
import warnings

import numpy as np
import pytest

import rocking_wall as rw

A = np.sin(np.arange(0, 4, 0.01))
GRID = {"method": "grid", "values": [0.1, 0.3]}


class WithUnit(np.ndarray):
    """Stands for a quantity of astropy: an array with a unit."""

    unit = "cm / s2"


def study(walls, **options):
    whole = {"records": [rw.synthetic_record(duration=12)], "models": ["CDC"], "levels": GRID}
    return rw.Study(walls=walls, **{**whole, "intensity": {"measure": "PGA"}, **options})


def test_units_of_samples_are_those_stated():
    """A quantity, or an array of xarray with the attribute `units`, is not taken for plain numbers."""
    xarray = pytest.importorskip("xarray")
    plain = rw.Record(0.01, A, unit="cm/s2")
    pint = type("Quantity", (), {"units": "cm/s2", "__array__": lambda *_, **__: A})()
    written = type("Quantity", (), {"units": "centimeter / second ** 2", "__array__": pint.__array__})()
    assert rw.Record(0.01, written, unit="cm/s2") == plain
    for samples in (xarray.DataArray(A, attrs={"units": "cm/s2"}), pint, A.view(WithUnit)):
        assert rw.Record(0.01, samples, unit="cm/s2") == plain
        with pytest.raises(ValueError, match="a unit of their own, cm ?/ ?s2; convert them to m/s2"):
            rw.Record(0.01, samples)
    wall = rw.Wall(3, 0.3)
    for call in (lambda: wall.peaks(plain, A.view(WithUnit)), lambda: plain.spectrum(A.view(WithUnit))):
        with pytest.raises(ValueError, match="a unit of their own, cm / s2; convert them and give"):
            call()
    assert rw.Record(0.01, xarray.DataArray(A, attrs={"long_name": "a"})) == rw.Record(0.01, A)


def test_times_of_samples_agree_with_the_step():
    pandas = pytest.importorskip("pandas")
    xarray = pytest.importorskip("xarray")
    plain, times = rw.Record(0.01, A), np.arange(len(A)) * 0.01
    for index in (times, times.round(2), pandas.to_timedelta(times, "s"), pandas.Index(range(5, 405))):
        assert rw.Record(0.01, pandas.Series(A, index=index)) == plain
    dates = pandas.date_range("2020", periods=len(A), freq="10ms")
    assert rw.Record(0.01, xarray.DataArray(A, coords={"time": dates}, dims="time")) == plain
    series = pandas.Series(A, index=times)
    for odd in (
        pandas.Series(A, index=times / 2),
        pandas.Series(A, index=pandas.to_timedelta(times / 2, "s")),
        series[::-1],
        series.drop(times[7]),
        xarray.DataArray(A, coords={"time": times / 2}, dims="time"),
    ):
        with pytest.raises(ValueError, match="times of their own, .* s apart, and dt is 0.01 s; give that"):
            rw.Record(0.01, odd)


def test_records_and_traces_are_no_samples():
    record = rw.Record(0.01, A)
    with pytest.raises(TypeError, match="a Record, which has a step of its own; use record.a"):
        rw.Record(0.02, record, unit="g")
    trace = type("Trace", (), {"stats": None, "__array__": lambda *_, **__: A})()
    with pytest.raises(TypeError, match=r"a Trace, .*; use Record.from_trace\(trace, unit\)"):
        rw.Record(0.01, trace)


@pytest.mark.parametrize("step", [np.timedelta64(10_000_000, "ns"), True, np.True_])
def test_a_step_is_a_number(step):
    with pytest.raises(TypeError, match="dt must be the time between samples in s"):
        rw.Record(step, A)


@pytest.mark.parametrize(
    "step, words",
    [(200.0, "longer than records have; are the times in milliseconds"), (1e-9, "shorter than records have")],
)
def test_steps_that_no_record_has_are_warned_of(step, words):
    with pytest.warns(UserWarning, match=words) as told:
        record = rw.Record(step, A)
    assert len(told) == 1 and record.warnings == (str(told[0].message).removeprefix("record: "),)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert (2 * record).warnings == record.warnings


def test_warnings_of_a_file_are_told_once(tmp_path):
    """The quick check of a file: baseline, tail, and a step that no record has."""
    path = tmp_path / "moving.txt"
    path.write_text("\n".join(map(str, 2 + A.round(6))))
    with pytest.warns(UserWarning) as told:
        record = rw.read_record(path, dt=0.5, unit="m/s2")
    said = [str(warning.message) for warning in told]
    assert said == [f"{path}: {warning}" for warning in record.warnings]
    assert [warning.split(": ")[0] for warning in record.warnings] == ["step", "baseline", "start", "tail"]
    assert told[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert rw.read_channels(path, dt=0.5, unit="m/s2") == [record]


def test_accelerations_have_a_limit():
    """As the inputs of an FMU have it."""
    record, wall = rw.Record(0.01, A), rw.Wall(3, 0.3)
    with pytest.raises(ValueError, match="sample 1 .* is 1000001.0; every sample must be .* at most 1e6"):
        rw.Record(0.01, [0.0, 1_000_001.0])
    for call in (
        lambda: 2e6 * record,
        lambda: wall.simulate(record, scale=2e6),
        lambda: wall.peaks(record, [2e6]),
        lambda: rw.simulate_many(wall, record, -2e6),
        lambda: wall.peaks(record, np.nan),
    ):
        with pytest.raises(ValueError, match="cannot be scaled by|must be a finite number"):
            call()


def test_truth_values_are_no_numbers():
    record = rw.Record(0.01, A)
    for call in (
        lambda: rw.Wall(height=True),
        lambda: rw.Wall(3, 0.3, width=np.True_),
        lambda: study([{"height": 3.0, "thickness": True}]),
        lambda: True * record,
        lambda: rw.Wall(3, 0.3).simulate(record, scale=True),
    ):
        with pytest.raises((TypeError, ValueError), match="must be a (finite )?number|expected a number"):
            call()


def test_masked_factors_are_refused():
    factors = np.ma.array([0.5, 1.0], mask=[True, False])
    for call in (rw.Wall(3, 0.3).peaks, lambda *given: rw.simulate_many(rw.Wall(3, 0.3), *given)):
        with pytest.raises(ValueError, match="masked; fill or cut out"):
            call(rw.Record(0.01, A), factors)


@pytest.mark.parametrize("missing", ["NaT", "masked", "decimal", "blank"])
def test_gaps_of_every_kind(missing):
    pandas = pytest.importorskip("pandas")
    gaps = {"NaT": pandas.NaT, "masked": np.ma.masked, "decimal": decimal.Decimal("nan"), "blank": " "}
    gap = gaps[missing]
    with pytest.raises(ValueError, match="the wall '1' has no height; write it"):
        study([{"height": gap, "thickness": 0.3}])
    left_out = study([{"height": 3.0, "thickness": 0.3, "a1": gap}])
    assert left_out._native.part(0) == study([{"height": 3.0, "thickness": 0.3}])._native.part(0)


def test_a_parapet_has_no_top():
    record = rw.Record(0.01, A)
    with pytest.raises(ValueError, match="a parapet has no top support"):
        rw.Wall(3, 0.3).simulate(record, top=record)
    rw.Wall(3, 0.3, mechanism="vertical_spanning").simulate(record, top=record)


def test_paths_and_ranges_in_options(tmp_path):
    (tmp_path / "h.csv").write_text("PGA,annual_rate\n0.1,0.01\n0.4,0.0004\n")
    texts = [
        study(
            rw.Wall(3, 0.3), hazard={"file": path}, levels={"method": "grid", "values": values}
        )._native.sent()[0]
        for path, values in ((tmp_path / "h.csv", range(1, 3)), (str(tmp_path / "h.csv"), [1, 2]))
    ]
    assert texts[0] == texts[1]
    with pytest.raises(TypeError, match="^ag: expected numbers, .* type Decimal"):
        rw.Wall(3, 0.3).check(SLV={"ag": decimal.Decimal("0.15")})
    with pytest.raises(TypeError, match="^values: expected numbers, .* type WithUnit"):
        study(rw.Wall(3, 0.3), levels={"method": "grid", "values": np.array([1.0]).view(WithUnit)})
    with pytest.raises(FileNotFoundError, match="no.toml"):
        rw.Wall.from_toml(bytes(tmp_path / "no.toml"))
    assert rw.read_record(bytes(written(tmp_path)), dt=0.01, unit="m/s2").name == "r.txt"


def written(folder):
    path = pathlib.Path(folder) / "r.txt"
    path.write_text("\n".join(map(str, np.diff(A, prepend=0.0, append=0.0))))
    return path


def test_tables_that_are_none():
    pandas = pytest.importorskip("pandas")
    xarray = pytest.importorskip("xarray")
    wall = rw.Wall(3, 0.3)
    with pytest.raises(TypeError, match="records must be a Record, found a value of the type DataFrame"):
        study(wall, records=pandas.DataFrame({"a": A}))
    with pytest.raises(TypeError, match="'height' of a table of walls is one value"):
        study(xarray.Dataset({"height": 3.0, "thickness": 0.3}))
    with pytest.raises(TypeError, match="a wall of a study is a Wall or .* type DataArray"):
        study(xarray.DataArray([3.0, 2.0], dims="height"))
    for points in (5, "[[0, 1]]", {0.1: 0.9}, [[0.1, 0.9, 0.0]]):
        with pytest.raises(TypeError, match="points must be "):
            rw.Wall(3, 0.3, force_law="multilinear", points=points)
    for shard in (2, (1,), "12", (1.0, 2.0), (3, 2)):
        with pytest.raises(ValueError, match="shard = .* must be a number and how many there are"):
            study(wall).compute("nowhere", shard)
