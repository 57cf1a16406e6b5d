"""The check of a wall by a code: Circolare 7/2019 to NTC 2018."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any, Literal, TypedDict

from ._tables import Table, shown


class LimitState(TypedDict, total=False):
    """What is stated of a limit state: the hazard, or a spectrum at the wall's place."""

    ag: float
    """a_g [g]."""
    F0: float
    """F0 [-]; with records, it may be left out together with TC."""
    TC: float
    """T_C* [s]."""
    spectrum: Sequence[Sequence[float]]
    """Points [T, Sa] at the wall's place [s, g], T from 0 on, instead of F0 and TC."""
    spectrum_damping: float
    """Damping ratio of that spectrum [-]."""
    damping: float
    """Damping ratio of the mechanism [-]; by default 0.05 for SLD, 0.08 for SLV, 0.10 for SLC."""
    building_damping: float
    """Damping ratio of the building [-], for a wall at a height."""
    building_period: float
    """T₁ of the building in this limit state [s]; by default that of the building."""
    displacement: float
    """u of a local instability [m]; SLC only."""


class Site(TypedDict, total=False):
    """The limit states that are checked."""

    SLD: LimitState
    """Damage."""
    SLV: LimitState
    """Life safety."""
    SLC: LimitState
    """Collapse."""


class Mode(TypedDict):
    """A mode of a building at the place of a wall."""

    period: float
    """T_k [s]."""
    participation: float
    """γ_k ψ_k(z) [-]."""


class Place(TypedDict, total=False):
    """The building that a wall stands on: storeys, period and height_ratio, or modes."""

    storeys: int
    """Number of storeys n."""
    period: float
    """T₁ [s]."""
    height_ratio: float
    """z/H of the wall, 0 to 1."""
    modes: Sequence[Mode]
    """Modes instead of these three, the first first."""


class Statements(TypedDict, total=False):
    """What the engineer states beside site and building; the keys of a scene's table [check]."""

    before_activation: Literal["rigid", "law", "beam"]
    """The wall before it rocks: held by transverse walls, elastic as its force law, or a beam."""
    young_modulus: float
    """E of the masonry [Pa], for a beam."""
    confidence_factor: float
    """FC [-]; by default 1.35. A smaller one needs compression_considered."""
    knowledge_level: Literal["LC1", "LC2", "LC3"]
    """Level of knowledge instead of FC."""
    compression_considered: bool
    """Whether the hinges are set back for compression."""
    overburden_mass: float
    """Share of the overburden whose mass moves with a parapet [-]."""
    behaviour_factor: float
    """q of the linear check [-]; by default 2."""
    soil: Literal["A", "B", "C", "D", "E"]
    """Soil of NTC 3.2.2."""
    topography: Literal["T1", "T2", "T3", "T4"] | float
    """Category of topography, or S_T [-]; by default T1."""
    use_class: Literal["I", "II", "III", "IV"]
    """Use class; class IV makes SLD count."""
    method: Literal["nonlinear", "linear", "dynamic"]
    """What decides; by default nonlinear, SLV and SLC by displacement."""
    record_scale: Literal["ag", "none"]
    """What the peaks of the records become: a_g S by default, or what they are."""


@dataclass(frozen=True)
class ActivationCheck:
    """A check of accelerations, C8.7.1.2.1.5 and C8.7.1.2.1.7."""

    capacity: float
    """Capacity, with FC and, in the linear check, times q [m/s²]."""
    demand: float
    """Demand [m/s²]."""
    ratio: float
    """ζ_E, capacity over demand [-]."""
    ag: float
    """a_g that just brings the wall there [g]."""


@dataclass(frozen=True)
class DisplacementCheck:
    """A check of displacements, C8.7.1.2.1.8."""

    d: float
    """d_SLV or d_SLC [m]."""
    a: float
    """a(d) there, with FC [m/s²]."""
    T: float
    """T_SLV or T_SLC [s]."""
    S_e: float
    """S_e or S_eZ at that period [m/s²]."""
    demand: float
    """S_d [m]."""
    demand_terms: tuple[float, float | None]
    """Both terms of [C8.7.1.12]; the second only at a height [m]."""
    ratio: float
    """d/S_d [-]."""
    ag: float
    """a_g that just brings the wall there [g]."""
    zeta_E: float
    """ζ_E [-]."""
    limited_by_tie: bool
    """Whether the tie breaks there."""
    raised_to_SLD: bool
    """Whether a_g is that of SLD, which is larger."""


@dataclass(frozen=True)
class SideVerdict:
    """The check of one side."""

    alpha0: float
    """α0 [-]."""
    e_star: float
    """e* [-]."""
    M_star: float
    """M* [kg]."""
    a0: float
    """a_0 without FC [m/s²]."""
    d0: float
    """d_0 [m]."""
    T0: float
    """T0 of the elastic branch; 0 where the wall is rigid [s]."""
    dy: float
    """d_y, the end of the elastic branch [m]."""
    ay: float
    """a_y without FC [m/s²]."""
    d_per_u: float
    """d/u [-]."""
    SLD: ActivationCheck | None = None
    """Activation."""
    SLV_q: ActivationCheck | None = None
    """SLV with q."""
    SLV: DisplacementCheck | None = None
    """SLV by displacement."""
    SLC: DisplacementCheck | None = None
    """SLC by displacement."""


@dataclass(frozen=True)
class SideVerdicts:
    """The sides of a wall; `None` for one to which it cannot rock."""

    positive: SideVerdict | None = None
    """u > 0."""
    negative: SideVerdict | None = None
    """u < 0."""


@dataclass(frozen=True)
class DynamicRun:
    """A run under a record."""

    record: str
    """Name of the record."""
    factor: float
    """Factor on the record [-]."""
    d: tuple[float, float]
    """Largest d on the sides u > 0 and u < 0 [m]."""
    beyond_d0: bool
    """Whether one of them exceeds d_0."""


@dataclass(frozen=True)
class DynamicState:
    """The dynamic check of a limit state."""

    passed: bool
    """Whether no run exceeds d_0 and the mean of the maxima is within the threshold."""
    d: float
    """Mean of the maxima of |d|, or the largest of fewer than 7 records [m]."""
    ratio: float
    """Threshold over it, each side by its own [-]."""
    beyond_d0: int
    """How many runs exceed d_0."""
    zeta_E: float
    """The lowest factor on all records that fails [-]."""
    side: Literal["positive", "negative"]
    """The side of the largest |d| over its threshold."""
    runs: tuple[DynamicRun, ...]
    """The runs."""


@dataclass(frozen=True)
class DynamicCheck:
    """The dynamic check of a wall, C8.7.1.2.1.9."""

    SLV: DynamicState | None = None
    """Life safety."""
    SLC: DynamicState | None = None
    """Collapse."""


@dataclass(frozen=True)
class Governs:
    """What governs: the smallest ζ_E of the checks that decide."""

    side: Literal["positive", "negative"]
    """The side; in the dynamic check that of the largest response."""
    limit_state: Literal["SLD", "SLV_q", "SLV", "SLC"]
    """The limit state."""
    zeta_E: float
    """ζ_E [-]."""


@dataclass(frozen=True, repr=False)
class Verdict:
    """The check of a wall by a code: the numbers of `wall check --json`, by its names."""

    code: str
    """The code."""
    passed: bool
    """Whether every limit state that decides holds on every side."""
    governs: Governs
    """What governs."""
    sides: SideVerdicts
    """The sides."""
    warnings: tuple[str, ...]
    """What the engineer should know; none of it stops the check."""
    dynamic: DynamicCheck | None = None
    """The dynamic check, where there are records for it."""
    _picture: str = field(default="", compare=False)

    def __repr__(self) -> str:
        return f"Verdict({self.headline})"

    @property
    def headline(self) -> str:
        """The verdict in a line."""
        passed = "passed" if self.passed else "not passed"
        governs = self.governs
        zeta = f"zeta_E = {governs.zeta_E:.3f}"
        return f"{passed}: {governs.limit_state} governs with {zeta}, {SIDES[governs.side]}"

    @property
    def zeta_E(self) -> float:
        """ζ_E of what governs [-]."""
        return self.governs.zeta_E

    @property
    def table(self) -> Table:
        """A row for each check: its side, ζ_E, the a_g of the ground [g], capacity and demand.

        Capacity and demand are accelerations [m/s²] for SLD and SLV_q, displacements [m] for SLV and SLC.
        """
        rows = list(self._rows())
        names = ("side", "check", "zeta_E", "ag_g", "capacity", "demand")
        return Table(dict(zip(names, map(list, zip(*rows)))))

    def _rows(self) -> Iterator[tuple[str, str, float, float, float, float]]:
        for name, side in (("u > 0", self.sides.positive), ("u < 0", self.sides.negative)):
            if side is None:
                continue
            for check, by_acceleration in (("SLD", side.SLD), ("SLV_q", side.SLV_q)):
                if by_acceleration is not None:
                    one = by_acceleration
                    yield name, check, one.ratio, one.ag, one.capacity, one.demand
            for check, by_displacement in (("SLV", side.SLV), ("SLC", side.SLC)):
                if by_displacement is not None:
                    other = by_displacement
                    yield name, check, other.zeta_E, other.ag, other.d, other.demand
        dynamic = self.dynamic or DynamicCheck()
        for check, runs in (("SLV dynamic", dynamic.SLV), ("SLC dynamic", dynamic.SLC)):
            if runs is not None:
                yield SIDES[runs.side], check, runs.zeta_E, float("nan"), runs.ratio * runs.d, runs.d

    def _repr_html_(self) -> str:
        warnings = "".join(f"<p>warning: {escape(warning)}</p>" for warning in self.warnings)
        return f"<p><b>{escape(self.headline)}</b></p>{self.table._repr_html_()}{warnings}{self._picture}"


SIDES = {"positive": "u > 0", "negative": "u < 0"}
"""The sides as tables name them."""


def verdict(text: str, picture: str) -> Verdict:
    """Makes a verdict of its JSON."""
    values = json.loads(text)
    sides = {name: side(values) for name, values in values.pop("sides").items()}
    states = {name: dynamic_state(values) for name, values in values.pop("dynamic", {}).items()}
    return Verdict(
        governs=Governs(**values.pop("governs")),
        sides=SideVerdicts(**sides),
        dynamic=DynamicCheck(**states) if states else None,
        warnings=tuple(values.pop("warnings")),
        _picture=picture,
        **values,
    )


def side(values: Mapping[str, Any]) -> SideVerdict:
    """Makes the verdict of a side."""
    made = dict(values)
    for name in ("SLD", "SLV_q"):
        if name in made:
            made[name] = ActivationCheck(**made[name])
    for name in ("SLV", "SLC"):
        if name in made:
            terms = tuple(made[name]["demand_terms"])
            made[name] = DisplacementCheck(**{**made[name], "demand_terms": terms})
    return SideVerdict(**made)


def dynamic_state(values: Mapping[str, Any]) -> DynamicState:
    """Makes the dynamic check of a limit state."""
    runs = (DynamicRun(**{**run, "d": tuple(run["d"])}) for run in values["runs"])
    return DynamicState(**{**values, "runs": tuple(runs)})
