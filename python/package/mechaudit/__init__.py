"""Certified accuracy for numerical code, beside solvers that keep it.

========================  ====================================================================
`mechaudit.special`       the Faddeeva function and its relatives as NumPy ufuncs
`mechaudit.certified`     the same functions with certified digits
`mechaudit.audit`         the audit of a callable; `compare`, `judge`, `points`, `case`, `vectors`
`mechaudit.Study`         a problem of your own in a file; `formula`, a problem in one line
`mechaudit.CubicSpline`   cubic splines with scipy's interface; `PchipInterpolator`, `Akima1DInterpolator`
`mechaudit.Linkage`       linkages of class III, four-bars and slider-cranks; `Cam`
========================  ====================================================================

A build without references (see the README) has `special`, `CubicSpline`, `solve_tridiagonal` and
`solve_cyclic` alone: `HAS_ORACLE` is False there.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from . import special
from ._mechaudit import HAS_ORACLE, DomainError, Undecided, __version__

if TYPE_CHECKING:
    from . import certified
    from ._report import Finding, Report
    from ._audit import Case, audit, case, judge, points
    from ._compare import Comparison, compare
    from ._linear import Solution, Stability, solve_cyclic, solve_tridiagonal
    from ._machines import Cam, Linkage, Rows
    from ._methods import methods
    from ._spline import Akima1DInterpolator, CubicSpline, PchipInterpolator
    from ._study import Study, formula
    from ._vectors import Vectors, vectors

#: Where each name is defined: loaded when it is first asked for, so that importing costs little.
_HOMES = {
    "Akima1DInterpolator": "_spline",
    "CubicSpline": "_spline",
    "PchipInterpolator": "_spline",
    "Solution": "_linear",
    "Stability": "_linear",
    "solve_cyclic": "_linear",
    "solve_tridiagonal": "_linear",
}
_ORACLE = {
    "Cam": "_machines",
    "Case": "_audit",
    "Comparison": "_compare",
    "Finding": "_report",
    "Linkage": "_machines",
    "Report": "_report",
    "Rows": "_machines",
    "Study": "_study",
    "Vectors": "_vectors",
    "audit": "_audit",
    "case": "_audit",
    "certified": "",
    "compare": "_compare",
    "formula": "_study",
    "judge": "_audit",
    "methods": "_methods",
    "points": "_audit",
    "vectors": "_vectors",
}

__all__ = [
    "HAS_ORACLE",
    "DomainError",
    "Undecided",
    "__version__",
    "special",
    "Akima1DInterpolator",
    "Cam",
    "Case",
    "Comparison",
    "CubicSpline",
    "Finding",
    "Linkage",
    "PchipInterpolator",
    "Report",
    "Rows",
    "Solution",
    "Stability",
    "Study",
    "Vectors",
    "audit",
    "case",
    "certified",
    "compare",
    "formula",
    "judge",
    "methods",
    "points",
    "solve_cyclic",
    "solve_tridiagonal",
    "vectors",
]
if not HAS_ORACLE:
    __all__ = [name for name in __all__ if name not in _ORACLE]


def __getattr__(name: str) -> Any:
    home = _HOMES.get(name)
    if home is None and name in _ORACLE:
        if not HAS_ORACLE:
            raise AttributeError(f"{name} needs references, which this build of mechaudit is without")
        home = _ORACLE[name]
    if home is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = importlib.import_module(f".{home or name}", __name__)
    found = module if not home else getattr(module, name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES, *(_ORACLE if HAS_ORACLE else ())})
