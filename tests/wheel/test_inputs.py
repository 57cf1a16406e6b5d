"""Inputs of studies that were misread, and messages about others."""

import io
import pydoc
import sys
import warnings

import numpy as np
import pytest

import rocking_wall as rw

GRID = {"method": "grid", "values": [0.1, 0.3]}
SHAPE = {"height": [3.0, 2.5], "thickness": [0.3, 0.3]}


def study(walls, **options):
    """Makes a study of walls under one record."""
    whole = {"records": [rw.synthetic_record(duration=12)], "models": ["CDC"], "levels": GRID}
    return rw.Study(walls=walls, **{**whole, "intensity": {"measure": "PGA"}, **options})


def test_names_of_a_frame():
    """Names are a column, an index without a name, or one called `name`; any other index is a column."""
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(SHAPE)
    named = frame.set_axis(["north", "south"])
    for table, names in [
        (frame, ["1", "2"]),
        (named, ["north", "south"]),
        (named.rename_axis("name"), ["north", "south"]),
        (frame.assign(name=["a", "b"]).set_axis([7, 9]), ["a", "b"]),
        (frame.set_axis([7, 9]), ["7", "9"]),
        (named.reset_index(names="name"), ["north", "south"]),
        (frame.set_index("height", drop=False), ["1", "2"]),
        (frame.set_index("height"), ["1", "2"]),
    ]:
        assert study(table).walls == names
        assert study(table)._native.sent()[1][1][1] == study(frame)._native.sent()[1][1][1]
    with pytest.raises(TypeError, match='"site" is not a parameter'):
        study(named.rename_axis("site"))
    with pytest.raises(ValueError, match='the name "a" occurs twice'):
        study(frame.set_axis(["a", "a"]))
    with pytest.raises(ValueError, match="row 2 of the table of walls has no name"):
        study(frame.set_axis(["a", None]))


def test_names_of_a_dataset():
    xarray = pytest.importorskip("xarray")
    columns = {name: ("name", values) for name, values in SHAPE.items()}
    assert study(xarray.Dataset(columns, {"name": ["north", "south"]})).walls == ["north", "south"]
    columns = {name: ("wall", values) for name, values in SHAPE.items()}
    assert study(xarray.Dataset(columns, {"name": ("wall", ["n", "s"])})).walls == ["n", "s"]
    assert study(xarray.Dataset(columns)).walls == ["1", "2"]


@pytest.mark.parametrize("missing", [float("nan"), None, np.nan, ""])
def test_gaps_are_refused(missing):
    for walls in ({**SHAPE, "height": [3.0, missing]}, [{"height": 3.0, "thickness": missing}]):
        with pytest.raises(ValueError, match="has no (height|thickness); write it"):
            study(walls)
    # other parameters may be left out by some walls
    assert len(study({**SHAPE, "a1": [0.05, missing]})) == 2


@pytest.mark.filterwarnings("error")
def test_a_wall_without_sizes_is_warned_of():
    for walls in (rw.Wall(), {"a": {"thickness": 0.3}}):
        with pytest.raises(UserWarning, match="1 of 1 walls have no height; the default of 4 m counts"):
            study(walls)
    study(rw.Wall(3, 0.3))


def test_one_wall_has_one_result(tmp_path):
    """ξ counts however a wall is given."""
    given = {"height": 3.0, "thickness": 0.3, "xi": 0.2}
    (tmp_path / "a.toml").write_text("[geometry]\nheight = 3\nthickness = 0.3\n[damping]\nxi = 0.2\n")
    columns = {name: [value] for name, value in given.items()}
    parts = [study(walls)._native.part(0) for walls in ([given], rw.Wall(**given), columns)]
    parts.append(study(rw.Wall.from_toml(tmp_path / "a.toml"))._native.part(0))
    assert all(part == parts[0] for part in parts)
    assert study(rw.Wall(3, 0.3))._native.part(0) != parts[0]


def test_copies_and_other_units_are_warned_of(tmp_path):
    record = rw.synthetic_record(duration=12)
    copy = rw.Record(record.dt, record.a, name="copy")
    with pytest.warns(UserWarning, match='"synthetic 1", "copy" are the same motion, which counts 2 times'):
        study(rw.Wall(3, 0.3), records=[record, copy])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        study(rw.Wall(3, 0.3), records=[record, -record, 2 * record][:1])
    with pytest.warns(UserWarning, match="at a return period of 2475 years, PGA = 3.* is unusual"):
        study(rw.Wall(3, 0.3), hazard={"points": [[1.0, 1e-2], [4.0, 3.5e-4]]})
    (tmp_path / "h.csv").write_text("PGA;annual_rate\n0,1;0,01\n0,4;0,0004\n")
    study(rw.Wall(3, 0.3), hazard={"file": str(tmp_path / "h.csv")})


@pytest.mark.parametrize("encoding", ["cp932", "gbk", "cp1250", "ascii"])
def test_any_console_can_print(encoding, monkeypatch):
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(io.BytesIO(), encoding=encoding))
    wall, record = rw.Wall(3, 0.3), rw.Record(0.01, [0.0, 1.0], name="Süd²")
    for each in (record, wall, wall.describe(), wall.simulate(record), study(wall, title="è 建物 ω")):
        print(each)
        print(repr(each))


@pytest.mark.parametrize(
    "walls, error, words",
    [
        ({"height": 3, "thickness": 0.3}, TypeError, "the column 'height' of a table of walls is one value"),
        ({"a": {"name": "b", "height": 3}}, ValueError, "the wall 'a' is called 'b', too"),
        ({"mechanism": "parapet"}, TypeError, "the column 'mechanism' of a table of walls is one value"),
        (3, TypeError, "walls = 3: give a table, walls, or dictionaries"),
        ("study.toml", TypeError, "a study file goes to Study.from_toml"),
    ],
)
def test_what_are_no_walls(walls, error, words):
    with pytest.raises(error, match=words):
        study(walls)


def test_messages_say_what_is_meant():
    wall, record = rw.Wall(3, 0.3), rw.synthetic_record(duration=12)
    with pytest.raises(AttributeError, match="^a wall has no 'hight'; did you mean 'height'\\?$"):
        _ = wall.hight
    with pytest.raises(ValueError, match="NaN") as caught:
        study(wall, levels={"method": "grid", "values": [0.1, float("nan")]})
    assert "\n" not in str(caught.value)
    with pytest.raises(TypeError, match="records must be a Record, found a value of the type int"):
        study(wall, records=3)
    with pytest.raises(TypeError, match="records must be a Record, found a value of the type int"):
        wall.check(3)
    one, listed = (wall.simulate(record, thresholds=given).demands for given in (0.5, [0.5]))
    assert repr(one) == repr(listed)
    assert wall.on_storeys([{"period": 0.3}]) == wall.on_storeys([rw.Storey(period=0.3)])


def test_peaks_have_the_shape_of_the_factors():
    wall, record = rw.Wall(3, 0.3), rw.synthetic_record(duration=12)
    flat = wall.peaks(record, [0.2, 0.5, 0.8, 1.0])
    square = wall.peaks(record, [[0.2, 0.5], [0.8, 1.0]])
    assert square.u_max.shape == (2, 2) and np.array_equal(square.u_max.ravel(), flat.u_max)
    assert wall.peaks(record, 0.5).u_max == flat.u_max[1]


def test_help_of_the_options_has_no_methods_of_dictionaries():
    shown = pydoc.plain(pydoc.render_doc(rw.options))
    assert shown.count("\n") < 400 and "popitem" not in shown
    assert all(word in shown for word in ("Levels:", "- method", "Hazard:", "- points"))
    for method in (rw.Wall.simulate, rw.Wall.peaks):
        assert "simulate_many" in method.__doc__
