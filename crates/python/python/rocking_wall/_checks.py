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

    @property
    def ratio(self) -> float:
        """The smaller of both ratios [-]."""
        return min(self.acceleration_ratio, self.displacement_ratio)


@dataclass(frozen=True, repr=False)
class Check:
    """The check of a wall, side by side."""

    sides: tuple[CheckedSide, ...]
    """The sides to which the wall can rock, u > 0 first."""
    governing: CheckedSide
    """The side with the smallest ratio."""
    _picture: str = field(compare=False)

    def __repr__(self) -> str:
        side = "u > 0" if self.governing.sign > 0 else "u < 0"
        return f"Check({side} governs with {shown(self.ratio)})"

    @property
    def ratio(self) -> float:
        """Capacity over demand of the governing side [-]."""
        return self.governing.ratio

    @property
    def table(self) -> Table:
        """All numbers, a row for each side."""
        rows = [asdict(side) for side in self.sides]
        return Table({name: [row[name] for row in rows] for name in rows[0]})

    def _repr_html_(self) -> str:
        return self.table._repr_html_() + self._picture
