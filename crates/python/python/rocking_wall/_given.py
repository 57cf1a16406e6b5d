"""The parameters of a wall as attributes."""

from __future__ import annotations

from typing import Any, overload

from . import _native


class Number:
    """A parameter that is a number."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, wall: None, owner: type) -> Number: ...
    @overload
    def __get__(self, wall: Given, owner: type) -> float: ...
    def __get__(self, wall: Given | None, owner: type) -> Number | float:
        if wall is None:
            return self
        value: float = wall._native.parameter(self.name)
        return value


class Name:
    """A parameter that is the name of a choice."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, wall: None, owner: type) -> Name: ...
    @overload
    def __get__(self, wall: Given, owner: type) -> str: ...
    def __get__(self, wall: Given | None, owner: type) -> Name | str:
        if wall is None:
            return self
        value: str = wall._native.parameter(self.name)
        return value


class Given:
    """The parameters of a wall by their names, in SI units; a parameter to be computed is -1."""

    _native: _native.Wall

    mechanism = Name()
    height = Number()
    thickness = Number()
    width = Number()
    density = Number()
    gravity = Number()
    hinge_ratio = Number()
    overburden = Number()
    overburden_eccentricity = Number()
    eccentricity_mode = Name()
    force_law = Name()
    a1 = Number()
    a3 = Number()
    d1 = Number()
    softening = Name()
    damping_model = Name()
    xi = Number()
    c_bar = Number()
    impact = Name()
    restitution_source = Name()
    restitution = Number()
    rocking = Name()
    u_start = Number()
    u_dot_start = Number()
    solver = Name()
    tolerance = Number()
    newmark_step = Number()
    tie_height = Number()
    tie_stiffness = Number()
    tie_slack = Number()
    tie_strength = Number()
    tie_side = Name()
    kinematics = Name()

    @property
    def points(self) -> list[list[float]] | None:
        """Corners [[u/u_ins, F/F0], ...] of the force law "multilinear"; None for another law."""
        points: list[list[float]] | None = self._native.parameter("points")
        return points
