"""The parameters of a wall as attributes."""

from __future__ import annotations

from typing import Generic, TypeVar, overload

from . import _native


Value = TypeVar("Value", float, str)


class Parameter(Generic[Value]):
    """A parameter of a wall: a number, or the name of a choice."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, wall: None, owner: type) -> Parameter[Value]: ...
    @overload
    def __get__(self, wall: Given, owner: type) -> Value: ...
    def __get__(self, wall: Given | None, owner: type) -> Parameter[Value] | Value:
        if wall is None:
            return self
        value: Value = wall._native.parameter(self.name)
        return value


class Given:
    """The parameters of a wall by their names, in SI units; a parameter to be computed is -1."""

    _native: _native.Wall

    mechanism = Parameter[str]()
    height = Parameter[float]()
    thickness = Parameter[float]()
    width = Parameter[float]()
    density = Parameter[float]()
    gravity = Parameter[float]()
    hinge_ratio = Parameter[float]()
    overburden = Parameter[float]()
    overburden_eccentricity = Parameter[float]()
    eccentricity_mode = Parameter[str]()
    force_law = Parameter[str]()
    a1 = Parameter[float]()
    a3 = Parameter[float]()
    d1 = Parameter[float]()
    softening = Parameter[str]()
    damping_model = Parameter[str]()
    xi = Parameter[float]()
    c_bar = Parameter[float]()
    impact = Parameter[str]()
    restitution_source = Parameter[str]()
    restitution = Parameter[float]()
    rocking = Parameter[str]()
    u_start = Parameter[float]()
    u_dot_start = Parameter[float]()
    solver = Parameter[str]()
    tolerance = Parameter[float]()
    newmark_step = Parameter[float]()
    tie_height = Parameter[float]()
    tie_stiffness = Parameter[float]()
    tie_slack = Parameter[float]()
    tie_strength = Parameter[float]()
    tie_side = Parameter[str]()
    kinematics = Parameter[str]()

    @property
    def points(self) -> list[list[float]] | None:
        """Corners [[u/u_ins, F/F0], ...] of the force law "multilinear"; None for another law."""
        points: list[list[float]] | None = self._native.parameter("points")
        return points
