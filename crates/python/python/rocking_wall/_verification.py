"""Every formula against a reference of its own."""

from __future__ import annotations

from ._native import verify_formulas
from ._tables import Table


def verify() -> Table:
    """Checks every formula of the model against a reference of its own, as `wall verify formulas` does.

    A row is a number: its formula, case, quantity and unit, the reference and the computed number, the error
    and the bound on it, both over the scale, and whether it passes.

    >>> verify()["passes"].all()
    np.True_
    """
    return Table(verify_formulas())
