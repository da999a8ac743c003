"""Several callables at the same cases."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

from ._audit import audit
from ._checks import function
from ._report import Report

__all__ = ["Comparison", "compare"]


class Comparison:
    """Several callables at the same cases.

    Attributes
    ----------
    reports : dict
        The report of each.
    seconds_per_case : dict
        What a call cost a case, measured once in this run, the callable alone.
    """

    def __init__(self, reports: dict[str, Report], seconds: dict[str, float]) -> None:
        self.reports = reports
        self.seconds_per_case = seconds

    @property
    def passed(self) -> bool:
        """Whether all passed."""
        return all(r.passed for r in self.reports.values())

    def rows(self) -> list[dict[str, Any]]:
        """A row for each region and output: the worst error in ulps of each callable, and the best."""
        table: dict[tuple[str, str], dict[str, Any]] = {}
        for name, report in self.reports.items():
            for row in report.rows():
                key = (row["region"], row["output"])
                entry = table.setdefault(key, {"region": key[0], "output": key[1]})
                entry[name] = row["worst_ulps"]
        for entry in table.values():
            known = [n for n in self.reports if n in entry]
            entry["best"] = min(known, key=lambda n: entry[n])
        return list(table.values())

    def to_frame(self) -> Any:
        """The rows as a `pandas.DataFrame`."""
        import pandas as pd

        return pd.DataFrame(self.rows())

    def __str__(self) -> str:
        names = list(self.reports)
        width = max(12, *(len(n) + 2 for n in names))
        lines = [f"{'region':<22}{'output':<10}" + "".join(f"{n:>{width}}" for n in names)]
        for row in self.rows():
            cells = ""
            for n in names:
                mark = "*" if row["best"] == n else " "
                cells += f"{row.get(n, float('nan')):>{width - 1}.3g}{mark}"
            lines.append(f"{row['region']:<22}{row['output']:<10}{cells}")
        lines.append("worst found in ulps; * the best of a row")
        for n in names:
            word = "pass" if self.reports[n].passed else "FAIL"
            lines.append(f"{n}: {word}, {1e9 * self.seconds_per_case[n]:.3g} ns a case")
        return "\n".join(lines)

    __repr__ = __str__


class _Timed:
    def __init__(self, f: Callable[..., Any]) -> None:
        self.f = f
        self.seconds = 0.0
        self.__name__ = getattr(f, "__name__", type(f).__name__)

    def __call__(self, *arguments: Any) -> Any:
        start = time.perf_counter()
        try:
            return self.f(*arguments)
        finally:
            self.seconds += time.perf_counter() - start


def compare(method: str, candidates: Mapping[str, Callable[..., Any]], **options: Any) -> Comparison:
    """Audit several callables at the same cases and set them side by side.

    Parameters
    ----------
    method : str
        Its name.
    candidates : dict
        Callables by name.
    **options
        Those of `audit`.

    Examples
    --------
    >>> import mechaudit
    >>> from mechaudit.special import wofz
    >>> both = {"mine": wofz, "rough": lambda z: wofz(z) * (1 + 1e-9)}
    >>> mechaudit.compare("faddeeva", both, cases=5).passed
    False
    """
    if not isinstance(candidates, Mapping):
        raise TypeError(f"candidates must be a dictionary of callables by name, got {candidates!r}")
    if not candidates:
        raise ValueError("candidates: there is nothing to compare")
    for name, f in candidates.items():
        if not isinstance(name, str):
            raise TypeError(f"candidates: a name must be a string, got {name!r}")
        function(f"candidates: {name}", f)
    reports = {}
    seconds = {}
    for name, f in candidates.items():
        timed = _Timed(f)
        report = audit(method, timed, name=name, **options)
        reports[name] = report
        seconds[name] = timed.seconds / max(report.cases, 1)
        if report.interrupted:
            break
    return Comparison(reports, seconds)
