"""Static capacity against demand."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field

from ._tables import Table, shown


@dataclass(frozen=True)
class CheckedSide:
    """The check of one side, in d* = u/λ and a* = F/(λ m_eff)."""

    sign: float
    """1 for u > 0, -1 for u < 0."""
    onset_acceleration: float
    """a0*, the acceleration of the onset of rocking [m/s²]."""
    zero_displacement: float
    """d* at which the force of the wall alone vanishes [m]."""
    displacement_capacity: float
    """Displacement capacity d_u* [m]."""
    limited_by_tie: bool
    """Whether the strength of the tie limits it."""
    secant_displacement: float
    """Displacement of the secant [m]."""
    secant_acceleration: float
    """Acceleration of the secant [m/s²]."""
    secant_period: float
    """Period of the secant T_s [s]."""
    peak_acceleration: float
    """Sa(0) of the demand [m/s²]."""
    displacement_demand: float
    """Sd(T_s) of the demand [m]."""
    acceleration_ratio: float
    """a0*/Sa(0) [-]."""
    displacement_ratio: float
    """d_u*/Sd(T_s) [-]."""


@dataclass(frozen=True, repr=False)
class Check:
    """The check of a wall, side by side."""

    sides: tuple[CheckedSide, ...]
    """The sides to which the wall can rock, u > 0 first."""
    _picture: str = field(compare=False)

    def __repr__(self) -> str:
        onset, displacement = self.onset, self.displacement
        return (
            f"Check(onset {shown(onset.acceleration_ratio)} at {name_of(onset)}, "
            f"displacement {shown(displacement.displacement_ratio)} at {name_of(displacement)})"
        )

    @property
    def onset(self) -> CheckedSide:
        """The side with the smallest acceleration_ratio: below 1 the wall rocks."""
        return min(self.sides, key=lambda side: side.acceleration_ratio)

    @property
    def displacement(self) -> CheckedSide:
        """The side with the smallest displacement_ratio: below 1 it goes beyond its capacity."""
        return min(self.sides, key=lambda side: side.displacement_ratio)

    @property
    def table(self) -> Table:
        """All numbers, a row for each side."""
        rows = [asdict(side) for side in self.sides]
        return Table({name: [row[name] for row in rows] for name in rows[0]})

    def _repr_html_(self) -> str:
        return self.table._repr_html_() + self._picture


def name_of(side: CheckedSide) -> str:
    """Returns the name of a side."""
    return "u > 0" if side.sign > 0 else "u < 0"
