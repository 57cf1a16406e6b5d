"""Walls."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import as_file, files
from inspect import getdoc
from os import PathLike, fsdecode
from typing import Any, Literal, NoReturn, Unpack
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._given import Given
from ._parameters import Parameters
from ._records import Record, listed, motion_of, scaled
from ._responses import Peaks, Response
from ._results import Calibration, RockingSpectrum, TieStudy, Verdict
from ._tables import Table, printable, shown, toml_lines


class Description(dict[str, Any]):
    """What follows from the parameters of a wall: numbers in SI units, by the names of `wall describe`."""

    def __init__(self, wall: _native.Wall) -> None:
        self._facts = wall.facts()
        super().__init__((name, value) for name, _, value, _ in self._facts)
        self["solver"], backbone, self["warnings"], self._picture = wall.description()
        self["backbone"] = np.array(backbone)

    def __repr__(self) -> str:
        lines = [f"{name:<22}{symbol:<8}{shown(value)} {unit}" for name, symbol, value, unit in self._facts]
        return printable("\n".join(lines + [f"warning: {warning}" for warning in self["warnings"]]))

    def _repr_html_(self) -> str:
        rows = (
            f"<tr><td>{name}</td><td>{escape(symbol)}</td><td>{shown(value)} {unit}</td></tr>"
            for name, symbol, value, unit in self._facts
        )
        return f"<table><tbody>{''.join(rows)}</tbody></table>{self._picture}"


@dataclass(frozen=True, kw_only=True)
class Storey:
    """A storey between ground and wall: the mass of its floor, and a stiffness or a period.

    A single storey with a period needs no mass.
    """

    mass: float | None = None
    """Mass of the floor [kg]."""
    stiffness: float | None = None
    """Lateral stiffness [N/m]."""
    period: float | None = None
    """Period that the storey alone would have on the ground [s], instead of the stiffness."""
    damping_ratio: float | None = None
    """Damping ratio [-]; by default 0.05."""


def _split(parameters: dict[str, Any]) -> tuple[dict[str, Any], str | None, str | None]:
    """Returns the parameters without the tables of a body and of ties and without a capacity curve, and both
    of these as TOML."""
    keys = [key for key in ("part", "opening", "load") if key in parameters]
    body: dict[str, Any] = {key: parameters.pop(key) for key in keys}
    tables: dict[str, Any] = {"geometry": body} if body else {}
    if "tie" in parameters:
        tables["tie"] = parameters.pop("tie")
    of_law = [key for key in ("curve", "at_height", "curve_tolerance", "oscillator") if key in parameters]
    curve: dict[str, Any] = {key: parameters.pop(key) for key in of_law}
    if "curve" in curve:
        curve["curve"] = _pairs(curve["curve"])
    law = toml_lines({"force_law": curve}) if curve else None
    return parameters, toml_lines(tables) if tables else None, law


def _pairs(curve: Any) -> list[list[float]]:
    """Returns the points of a capacity curve."""
    try:
        points = np.asarray(curve, dtype=float)
    except (TypeError, ValueError):
        points = np.empty(0)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(
            "curve must be pairs [[u, F], ...] in m and N, such as an array or a DataFrame of two columns; "
            "a scene reads a file of them: Wall.from_toml"
        )
    pairs: list[list[float]] = points.tolist()
    return pairs


class Wall(Given):
    def __init__(
        self,
        height: float | None = None,
        thickness: float | None = None,
        /,
        **parameters: Unpack[Parameters],
    ) -> None:
        sizes = {"height": height, "thickness": thickness}
        for name, value in sizes.items():
            if value is not None and name in parameters:
                raise TypeError(f"{name} is given twice, by place and by name; leave one out")
        places = {name: value for name, value in sizes.items() if value is not None}
        parameters = {**places, **parameters}  # type: ignore[typeddict-item]
        object.__setattr__(self, "_native", _native.Wall(*_split(dict(parameters))))

    @classmethod
    def _of(cls, native: _native.Wall) -> Wall:
        wall = cls.__new__(cls)
        object.__setattr__(wall, "_native", native)
        return wall

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(
            f"a wall never changes: wall.replace({name}={value!r}) returns another one"
        )

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError("a wall never changes")

    def __getstate__(self) -> object:
        return self._native.sent()

    def __setstate__(self, state: Any) -> None:
        object.__setattr__(self, "_native", _native.Wall.received(state))

    def __eq__(self, other: object) -> bool:
        """Whether both have the same parameters, storeys, motion and times; titles do not count."""
        if not isinstance(other, Wall):
            return NotImplemented
        return self._native.equals(other._native)

    def __hash__(self) -> int:
        return hash(tuple(self.parameters.values()))

    @classmethod
    def from_toml(cls, path: str | PathLike[str]) -> Wall:
        """Reads a scene: a wall and, if it has one, its motion."""
        return cls._of(_native.Wall.from_toml(fsdecode(path)))

    def replace(self, **parameters: Unpack[Parameters]) -> Wall:
        """Returns the same wall with other values of some parameters.

        >>> Wall(height=3).replace(height=4) == Wall(height=4)
        True
        """
        return self._of(self._native.replaced(*_split(dict(parameters))))

    def on_storeys(
        self,
        storeys: Sequence[Storey],
        *,
        bottom: int | None = None,
        top: int | None = None,
        drift: bool = True,
    ) -> Wall:
        """Returns the same wall on storeys, the lowest first: records shake the ground below them.

        The storeys move as if there were no wall. A run warns of a wall above a twentieth of the mass of its
        floor, which is for `Building`.

        :param bottom: Floor that the wall stands on, counted from 1, or 0 for the ground; by default the
            roof, and for a strip wall the floor below the roof.
        :param top: Floor that a strip wall leans on; by default the one above the bottom.
        :param drift: Whether the drift between the supports acts on a strip wall.

        Raises `ValueError` for storeys that cannot be, and for floors that are not there.

        >>> from rocking_wall import synthetic_record
        >>> wall = Wall(height=1.5, thickness=0.3).on_storeys([Storey(period=0.3, damping_ratio=0.05)])
        >>> bool(wall.simulate(synthetic_record()).a_bottom.max() > synthetic_record().pga)
        True
        """
        given = [Storey(**each) if isinstance(each, Mapping) else each for each in storeys]
        tables = [(each.mass, each.stiffness, each.period, each.damping_ratio) for each in given]
        return self._of(self._native.on_storeys(tables, bottom, top, drift))

    @property
    def parameters(self) -> dict[str, float | str]:
        """All parameters by their names."""
        return {name: value_of(text) for name, text in self._native.parameters}

    def __repr__(self) -> str:
        is_body = self.mechanism == "rigid_body"
        of_body = ("effective_mass", "participation") if is_body else ("height", "thickness")
        names = ("mechanism", *of_body, "force_law", "damping_model", "impact")
        return f"Wall({', '.join(f'{name}={getattr(self, name)!r}' for name in names)}, ...)"

    def describe(self) -> Description:
        """Computes masses, strength, instability displacement, periods and damping.

        >>> wall = Wall(height=3, thickness=0.25)
        >>> round(wall.describe()["u_ins"], 9)
        0.125
        """
        return Description(self._native)

    def simulate(
        self,
        record: Record | None = None,
        *,
        scale: float = 1.0,
        top: Record | None = None,
        tail: float = 10.0,
        stop_time: float | None = None,
        output_step: float | None = None,
        thresholds: Sequence[float] | float | None = None,
        hold: bool = False,
    ) -> Response:
        """Runs the wall under a record, under the motion of its scene, or in free vibration.

        Under a record the wall starts upright unless `u_start` was given. For the peaks alone, `peaks` runs
        many factors and `simulate_many` many walls and records at once.

        :param scale: Factor on the record, and on `top`.
        :param top: Record of the top support, where it has its own.
        :param tail: Free vibration after the record [s].
        :param stop_time: End of the run [s]; by default that of record and tail, or 30 s.
        :param output_step: Step of the history [s]; by default that of the record, or 0.01 s.
        :param thresholds: Fractions of u_ins whose first crossings are reported.
        :param hold: Hold each sample until the next, as most FMI importers do.
        """
        for name, given in (("scale", scale != 1.0), ("top", top is not None)):
            if record is None and given:
                raise ValueError(f"{name} needs a record beside it")
        values = self._native.simulate(
            None if record is None else scaled(motion_of(record), scale, "scale"),
            top=None if top is None else scaled(motion_of(top, "top"), scale, "scale"),
            tail=tail,
            stop_time=stop_time,
            output_step=output_step,
            thresholds=None if thresholds is None else np.atleast_1d(thresholds).tolist(),
            hold=hold,
        )
        for warning in values.pop("warnings"):
            warn(warning, stacklevel=2)
        if values.pop("put_to_rest"):
            warn("the limit on impacts in one step was reached: the wall was put to rest", stacklevel=2)
        return Response(**values.pop("history"), **values)

    def peaks(self, record: Record, factors: ArrayLike, *, tail: float = 10.0) -> Peaks:
        """Computes the peaks under a record multiplied by each of many factors, side by side.

        Each run goes on for `tail` [s] in free vibration, and stops where the wall overturns. It starts as
        that of `simulate`. Factors may have any shape, which is that of the results. `simulate_many` runs
        many walls and records.

        >>> from rocking_wall import synthetic_record
        >>> peaks = Wall(height=3, thickness=0.25).peaks(synthetic_record(), [0.2, 0.5, 1.0])
        >>> peaks.overturned
        array([False, False,  True])
        """
        given = _native.plain(factors)
        of_runs = [0] * given.size
        found = _native.simulate_many(
            [self._native], [motion_of(record)], of_runs, of_runs, given.ravel(), tail, 1
        )
        return Peaks(given.astype(np.float64), *(peaks.reshape(given.shape) for peaks in found))

    def check(
        self,
        records: Sequence[Record] | Record = (),
        *,
        code: str = "circolare-2019",
        **statements: Any,
    ) -> Verdict:
        """Checks the wall by a code.

        The arguments are the keys of the table `[check]` of a scene. `rocking_wall.options` lists them, with
        a class for each code; docs/model.md explains them. A wall on storeys stands in their building.

        :param records: Records of the ground, for a dynamic check or as the demand.
        :param code: The code, as the key `code` has it.
        :param statements: What that code needs: its other keys.

        Raises `ValueError` for what cannot be checked: a statement that is missing, unknown or outside its
        limits, a demand without the secant period, a parameter of the wall that decides and that nobody
        stated.

        >>> wall = Wall(height=4, thickness=0.4, density=1800)
        >>> hazard = {"ag": 0.15, "F0": 2.45, "TC": 0.32}
        >>> wall.check(SLV=hazard, soil="B", before_activation="rigid")
        Verdict(NOT PASSED: SLV governs with zeta_E = 0.856 (both sides alike))

        >>> verdict = wall.check(code="fractions", spectrum=[[0.0, 1.0], [4.0, 1.0]], unit="m/s2")
        >>> round(verdict.numbers["governs"]["onset"]["ratio"], 9)
        0.95157
        """
        records = listed(records)
        table = {"code": code, **statements}
        if len(records) > 0:
            # their motions are handed over beside the text
            table["records"] = {}
        text = "[check]\n" + toml_lines(table)
        named = [(getattr(record, "name", ""), motion_of(record)) for record in records]
        summary, numbers, rows, picture = _native.check_wall(self._native, text, named)
        said, values = json.loads(summary), json.loads(numbers)
        given = (self, text, named)
        return Verdict(**said, table=Table(rows), numbers=values, _picture=picture, _given=given)

    def rocking_spectrum(
        self,
        record: Record | None = None,
        *,
        heights: ArrayLike | None = None,
        radii: ArrayLike | None = None,
        ratios: ArrayLike | None = None,
        angles: ArrayLike | None = None,
        threads: int | None = None,
    ) -> RockingSpectrum:
        """Computes u_max/u_ins of walls of many sizes under a record, or under the motion of the scene.

        The walls are otherwise as this one, upright and at rest. Ctrl-C stops the work.

        :param heights: Heights [m] along the columns; by default 31 from 0.5 to 8.
        :param radii: Semi-diagonals R of a parapet [m] instead.
        :param ratios: Slendernesses h/b along the rows; by default 33 from 4 to 20.
        :param angles: Angles atan(b/h) of a parapet [rad] instead.
        :param threads: Number of threads; by default one for each core.

        >>> from rocking_wall import sine_cycle
        >>> Wall().rocking_spectrum(sine_cycle(2.0, 1.0), heights=[1, 2, 4], ratios=[5, 10])
        RockingSpectrum(slenderness x height_m, 2 x 3, 4 overturned)
        """
        if heights is not None and radii is not None:
            raise ValueError("give either heights or radii")
        if ratios is not None and angles is not None:
            raise ValueError("give either ratios or angles")
        sizes = radii if radii is not None else HEIGHTS if heights is None else heights
        slendernesses = angles if angles is not None else RATIOS if ratios is None else ratios
        columns, rows, table, picture = _native.spectrum_over_walls(
            self._native,
            None if record is None else motion_of(record),
            (radii is not None, sizes),
            (angles is not None, slendernesses),
            threads,
        )
        return RockingSpectrum(columns, rows, Table(table), picture)

    def pulse_spectrum(
        self,
        form: Literal[
            "ricker", "sine_cycle", "cosine_cycle", "half_sine", "rectangle", "triangle", "falling_triangle"
        ],
        *,
        frequency_ratios: ArrayLike | None = None,
        amplitude_ratios: ArrayLike | None = None,
        threads: int | None = None,
    ) -> RockingSpectrum:
        """Computes u_max/u_ins of this wall under pulses of one form. Ctrl-C stops the work.

        Half sine, rectangle and triangles last half a period, π/ω_p. A falling triangle has its peak at the
        start, a triangle in the middle.

        :param frequency_ratios: ω_p/p along the columns; by default 39 from 0.5 to 10.
        :param amplitude_ratios: a_p/a₀ along the rows, with the acceleration a₀ at which the rigid wall
            begins to rock; by default 39 from 0.5 to 10.
        :param threads: Number of threads; by default one for each core.

        >>> Wall().pulse_spectrum("ricker", frequency_ratios=[2, 4], amplitude_ratios=[0.5, 5]).rocked
        array([[False,  True],
               [ True,  True]])
        """
        columns = PULSES if frequency_ratios is None else frequency_ratios
        rows = PULSES if amplitude_ratios is None else amplitude_ratios
        across, up, table, picture = _native.spectrum_over_pulses(self._native, form, columns, rows, threads)
        return RockingSpectrum(across, up, Table(table), picture)

    def record_pulses(self, record: Record, *, threads: int | None = None) -> Table:
        """Finds the sine, the cosine and the Ricker pulse in a record, the one that fits best first. The
        amplitude of each is that with which this wall has its peak under the record. Ctrl-C stops the work.

        Columns are those of `wall study spectrum --pulse-of RECORD --csv FILE`.

        :param threads: Number of threads; by default one for each core.

        >>> from rocking_wall import sine_cycle
        >>> pulses = Wall().record_pulses(sine_cycle(1.0, 1.0))
        >>> str(pulses["pulse"][0]), float(pulses["amplitude_m_s2"][0].round(2))
        ('sine_cycle', 1.0)
        """
        return Table(_native.record_pulses(self._native, motion_of(record), threads))

    def tie(
        self,
        records: Sequence[Record] | Record = (),
        *,
        stiffness: ArrayLike | None = None,
        strength: ArrayLike | None = None,
        slack: ArrayLike | None = None,
        height: ArrayLike | None = None,
        ultimate: ArrayLike | None = None,
        bar_diameter: ArrayLike | None = None,
        scale: float = 1.0,
        level: str | None = None,
        check: Mapping[str, Any] | None = None,
        both_polarities: bool = False,
        threads: int | None = None,
    ) -> TieStudy:
        """Runs the wall with ties that differ in one parameter, by default the stiffness. Ctrl-C stops the
        work.

        :param records: Records, each from rest; by default the motion of the scene.
        :param stiffness: Stiffnesses of the tie [N/m], 0 for none; by default 0, and 1e-2 to 1e3 of 2 W/h at
            the tie.
        :param strength: Strengths of the tie [N] instead, 0 for none.
        :param slack: Slacks of the tie [m] instead.
        :param height: Heights of the tie above the base [m] instead.
        :param ultimate: Plastic elongations at which the tie breaks [m] instead, -1 for one that stays
            elastic.
        :param bar_diameter: Diameters of the bar of the tie [m] instead.
        :param scale: Factor on the records.
        :param level: "SLD", "SLV" or "SLC": bring the records to the level of that limit state, as the
            dynamic check does.
        :param check: The statements of the check, as those of `check()`, such as `SLV` and `soil`.
        :param both_polarities: Run each motion with both signs.
        :param threads: Number of threads; by default one for each core.

        Raises `ValueError` for a wall without a tie or a motion, a value beyond its limits, or a limit state
        that `check` does not state.

        >>> from rocking_wall import synthetic_record
        >>> wall = Wall(height=3, thickness=0.25, tie_height=3)
        >>> wall.tie([synthetic_record()], stiffness=[0, 1e4, 1e6]).force.argmin()
        np.int64(0)
        """
        given = listed(records)
        if scale != 1.0 and len(given) == 0:
            raise ValueError("scale needs records beside it")
        if (level is None) != (check is None):
            raise ValueError("level and check go together: a limit state, and what states its level")
        if level is not None and len(given) == 0:
            raise ValueError("level needs records beside it, whose level that is")
        motions = [scaled(motion_of(record), scale, "scale") for record in given]
        of_check = None
        if level is not None:
            table = {"code": "circolare-2019", **(check or {}), "records": {}}
            names = [getattr(record, "name", "") for record in given]
            of_check = (level, "[check]\n" + toml_lines(table), list(zip(names, motions, strict=True)))
        ties = {"stiffness": stiffness, "strength": strength, "slack": slack}
        ties |= {"height": height, "ultimate": ultimate, "bar_diameter": bar_diameter}
        chosen = [name for name, values in ties.items() if values is not None] or ["stiffness"]
        if len(chosen) > 1:
            raise ValueError(f"{' and '.join(chosen)} are given; give one of them")
        varied = chosen[0] if chosen[0] == "bar_diameter" else f"tie_{chosen[0]}"
        values, found, picture, is_alike, warnings = _native.tie_of_wall(
            self._native, motions, of_check, (varied, ties[chosen[0]]), both_polarities, threads
        )
        for warning in warnings:
            warn(warning, stacklevel=2)
        return TieStudy(
            varied, **values, table=Table(found), alike_on_both_sides=is_alike, _picture=picture
        )

    def calibrate(
        self,
        models: Sequence[str] | None = None,
        *,
        restitution: ArrayLike | None = None,
        a1: ArrayLike | None = None,
        start: ArrayLike = (0.9,),
        step: float = 0.01,
        threads: int | None = None,
    ) -> Calibration:
        """Finds the damping with which the wall rocks freely as with restitution. Ctrl-C stops the work.

        :param models: Damping models; by default all that the force law allows.
        :param restitution: Coefficients of restitution e; by default 0.80, 0.82 … 0.98.
        :param a1: Ends of the elastic branch; by default nine from 0.01 to 0.10. A law of points and the
            rigid-linear law have their own.
        :param start: Initial displacements over u_ins.
        :param step: Time between the samples compared [s].
        :param threads: Number of threads; by default one for each core.

        >>> found = Wall().calibrate(["constant_ratio"], restitution=[0.85], a1=[0.03])
        >>> abs(found.fits["damping"][0] - 0.04) < 0.01
        np.True_
        """
        names = [models] if isinstance(models, str) else None if models is None else list(models)
        (fits, coefficients, laws), pictures = _native.calibrate_wall(
            self._native, names, restitution, a1, start, step, threads
        )
        return Calibration(Table(fits), Table(coefficients), Table(laws), pictures)


HEIGHTS = np.linspace(0.5, 8.0, 31).round(12)
RATIOS = np.linspace(4.0, 20.0, 33).round(12)
PULSES = np.linspace(0.5, 10.0, 39).round(12)


def value_of(text: str) -> float | str:
    """Returns the value of a parameter from its text in a scene file."""
    return text.strip('"') if text.startswith('"') else float(text)


def package(
    scene: str | PathLike[str] | Wall,
    path: str | PathLike[str],
    *,
    base: str | PathLike[str] | None = None,
) -> int:
    """Writes the FMU of a scene file, or of a wall, and returns the number of its variables.

    It needs no compiler. It starts from the general FMU, which the wheel brings; `base` names another one.
    """
    wall = scene if isinstance(scene, Wall) else Wall.from_toml(scene)
    if base is not None:
        return wall._native.package(fsdecode(path), fsdecode(base))
    if not (files(__package__) / "wall.fmu").is_file():
        raise FileNotFoundError(
            "this installation has no wall.fmu, because pip has built it from a checkout: install the wheel "
            "of `cargo xtask wheel`, or run `cargo xtask fmu` and pass base='fmu_out/wall.fmu'"
        )
    with as_file(files(__package__) / "wall.fmu") as general:
        return wall._native.package(fsdecode(path), fsdecode(general))


Wall.__doc__ = f"""A wall: a parapet, or a vertical spanning strip.

Parameters are given by their names, height and thickness also by their places: `Wall(3, 0.25)`. What is not
given has its default. A wall that exists is valid and never changes; its parameters can be read.

>>> Wall(3, 0.25).thickness
0.25

>>> Wall(height=3, thickness=0.25, damping_model="none", impact="restitution")
Wall(mechanism='parapet', height=3.0, thickness=0.25, force_law='bilinear', damping_model='none', \
impact='restitution', ...)

{getdoc(Parameters)}

What follows from them, such as `u_ins`, can be read, too. `kinematics`, `points` of `force_law="multilinear"`
and the bar of a tie are those of scenes only. A bar and its anchor stand for `tie_stiffness`, `tie_strength`
and `tie_ultimate`.

`part`, `opening` and `load` are lists of dictionaries that describe a wall in place of height, thickness,
width and density, such as a gable of 2.4 m:

>>> gable = Wall(part=[{{"height": 2.4, "thickness": 0.25, "width": [6.0, 0.0]}}])
>>> round(gable.u_ins, 12)
0.125

`tie` is a list of dictionaries of ties at several heights:

>>> wall = Wall(4, 0.4, tie=[{{"tie_height": y, "tie_stiffness": 1e6}} for y in (2.0, 4.0)])
>>> len(wall.simulate().tie_forces)
2
"""
