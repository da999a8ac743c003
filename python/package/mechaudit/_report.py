"""What an audit found."""

from __future__ import annotations

import html
import math
import os
from typing import Any

from ._files import write

__all__ = ["Finding", "Report", "called"]

#: Failing cases written out in messages.
_SHOWN = 5


def _short(x: float) -> str:
    if math.isnan(x):
        return "-"
    if x == 0 or 1e-3 <= abs(x) < 1e3 or math.isinf(x):
        return f"{x:.3f}"
    return f"{x:.0f}" if 1e3 <= abs(x) < 1e6 else f"{x:.2e}"


def called(method: str, place: str) -> str:
    """The Python expression that gives a case."""
    return f'mechaudit.case("{method}", "{place}")'


class Finding:
    """A finding other than an error in digits: an exception, a wrong shape, a wrong type.

    Attributes
    ----------
    kind : str
        What kind of thing, for instance 'ValueError' or 'complex64'.
    message : str
        What happened at the first case.
    count : int
        At how many cases, or blocks of cases.
    method, place : str
        Of the first case, for `mechaudit.case`.
    """

    def __init__(self, kind: str, message: str, method: str, place: str) -> None:
        self.kind = kind
        self.message = message
        self.count = 1
        self.method = method
        self.place = place

    @property
    def reproducer(self) -> str:
        """The Python expression that gives the case."""
        return called(self.method, self.place)

    def __repr__(self) -> str:
        return f"{self.kind} ({self.count}): {self.message}; {self.reproducer}"


def _rank(case: dict[str, Any]) -> float:
    share = case["share"]
    return math.inf if math.isnan(share) else float(share)


class Report:
    """What an audit found.

    Attributes
    ----------
    passed : bool
        Whether every case passed and there was at least one; never for a run that was interrupted.
    cases, passed_cases : int
        How many.
    findings : list of Finding
        Exceptions, wrong shapes and types.
    mode : str
        How the callable was called: 'vectorised' or 'scalar'.
    facts : dict
        Everything, as plain numbers and text.
    """

    def __init__(
        self, facts: dict[str, Any], findings: list[Finding], mode: str, name: str, page: str
    ) -> None:
        self.facts = facts
        self.findings = findings
        self.mode = mode
        self.name = name
        self._page = page

    @property
    def passed(self) -> bool:
        return bool(self.facts["within_budget"])

    @property
    def cases(self) -> int:
        return int(self.facts["cases"])

    @property
    def passed_cases(self) -> int:
        return int(self.facts["passed"])

    @property
    def interrupted(self) -> bool:
        return bool(self.facts["interrupted"])

    @property
    def method(self) -> str:
        return str(self.facts["method"])

    def worst(self, n: int = 10) -> list[dict[str, Any]]:
        """The n worst of those kept, the worst of each region first.

        Kept are the ten with the largest shares of a budget, the worst of each region before the rest,
        and the first of each way of being wrong in kind. Each has its `region`, `input`, what was `got` and what is `due` to 20 digits with its
        `radius`, `ulps`, `of_budget`, `condition`, `verdict`, `reason`, and a `reproducer`.
        """
        by_region: dict[str, list[dict[str, Any]]] = {}
        for case in self.facts["worst"]:
            by_region.setdefault(case["region"], []).append(case)
        ranked = [sorted(cases, key=_rank, reverse=True) for cases in by_region.values()]
        ordered: list[dict[str, Any]] = []
        for place in range(max(map(len, ranked), default=0)):
            layer = [cases[place] for cases in ranked if len(cases) > place]
            ordered.extend(sorted(layer, key=_rank, reverse=True))
        return [
            {**case, "reproducer": called(case["method"], case["place"])}
            for case in ordered[:n]
        ]

    def rows(self) -> list[dict[str, Any]]:
        """A row of statistics for each region and output."""
        table = []
        for region, found in self.facts["regions"].items():
            for o in found["outputs"]:
                table.append(
                    {
                        "region": region,
                        "output": o["name"],
                        "cases": found["cases"],
                        "passed": found["passed"],
                        "values": o["values"],
                        "wrong_kind": o["wrong_kind"],
                        "worst_ulps": o["ulps"]["max"],
                        "p99_ulps": o["ulps"]["p99"],
                        "median_ulps": o["ulps"]["median"],
                        "rms_ulps": o["ulps"]["rms"],
                        "worst_conditioned_u": o["conditioned_u"]["max"],
                        "worst_of_budget": o["max_of_budget"],
                    }
                )
        return table

    def to_frame(self) -> Any:
        """The rows as a `pandas.DataFrame`."""
        import pandas as pd

        return pd.DataFrame(self.rows())

    def assert_within_budget(self) -> Report:
        """Raise `AssertionError` with what can be acted on, unless everything passed."""
        if not self.passed:
            raise AssertionError("\n" + str(self))
        return self

    def html(self, path: str | os.PathLike[str]) -> None:
        """Write the report as a page that needs nothing from elsewhere.

        The page of ``mechaudit audit --format html``: regions, histograms, errors against the inputs,
        and for each case the expression that gives it.
        """
        write(path, self._page)

    def _case_lines(self, case: dict[str, Any]) -> list[str]:
        reason = case["reason"] or case["verdict"]
        lines = ["", f"{case['method']} / {case['region']}: {reason}"]
        for x in case["input"]:
            lines.append(f"  input      {x!r} = {x.hex()}")
        got = case["got"]
        if not isinstance(got, list):
            lines.append(f"  got        {got}")
        else:
            for i, x in enumerate(got):
                lines.append(f"  got        {x!r}")
                if i < len(case["due"]) and case["due"][i] is not None:
                    lines.append(f"  due        {case['due'][i]}")
                if i < len(case["ulps"]):
                    lines.append(
                        f"             {_short(case['ulps'][i])} ulps, "
                        f"{_short(case['of_budget'][i])} of its budget, "
                        f"condition {_short(case['condition'][i])}"
                    )
        proof = f", {case['proof']}" if case["proof"] else ""
        lines.append(f"  reference  {case['bits']} bits{proof}")
        lines.append(f"  reproduce  {called(case['method'], case['place'])}")
        lines.append(f"             mechaudit points {case['method']} {case['place']}")
        return lines

    def __str__(self) -> str:
        f = self.facts
        word = "pass" if self.passed else "FAIL"
        interrupted = ", interrupted" if self.interrupted else ""
        lines = [
            f"{f['method']} by {self.name}: {word}, {f['passed']} of {f['cases']} cases within "
            f"budget (seed {f['seed']}, {f['cases_per_region']} cases per region, called "
            f"{self.mode}{interrupted})"
        ]
        for o in f["outputs"]:
            lines.append(
                f"  {o['name']:<11}{o['values']} values, {o['wrong_kind']} of the wrong kind; worst found {_short(o['ulps']['max'])} ulps, "
                f"99 % below {_short(o['ulps']['p99'])}, {_short(o['max_of_budget'])} of its budget"
            )
        for name, budget, reason in f["budgets"]:
            lines.append(f"  {'budget':<11}{name}: {budget} ({reason})")
        for finding in self.findings:
            lines.append(f"  {'finding':<11}{finding!r}")
        for case in f["failures"][:_SHOWN]:
            lines.extend(self._case_lines(case))
        left = f["cases"] - f["passed"] - f["recorded"] - min(len(f["failures"]), _SHOWN)
        if left > 0:
            lines.extend(["", f"{left} more failing cases"])
        return "\n".join(lines)

    def __repr__(self) -> str:
        word = "pass" if self.passed else "FAIL"
        return f"<Report of {self.method} by {self.name}: {word}, {self.passed_cases} of {self.cases}>"

    def _repr_html_(self) -> str:
        text = html.escape
        head = (
            f"<p><b>{text(self.method)}</b> by {text(self.name)}: "
            f"<b>{'pass' if self.passed else 'FAIL'}</b>, {self.passed_cases} of {self.cases} cases "
            f"within budget</p>"
        )
        columns = (
            ("region", "region"),
            ("output", "output"),
            ("cases", "cases"),
            ("passed", "passed"),
            ("wrong_kind", "of the wrong kind"),
            ("worst_ulps", "worst found, ulps"),
            ("p99_ulps", "99 % below, ulps"),
            ("worst_of_budget", "share of budget"),
        )
        cells = "".join(f"<th>{text(title)}</th>" for _, title in columns)
        body = []
        for row in self.rows():
            values = (row[key] for key, _ in columns)
            shown = (_short(v) if isinstance(v, float) else text(str(v)) for v in values)
            body.append("<tr>" + "".join(f"<td>{v}</td>" for v in shown) + "</tr>")
        worst = []
        for case in self.worst(10):
            reason = case["reason"] or case["verdict"]
            worst.append(f"<li>{text(str(reason))}<br><code>{text(case['reproducer'])}</code></li>")
        return (
            f"{head}<table><thead><tr>{cells}</tr></thead><tbody>{''.join(body)}</tbody></table>"
            f"<details><summary>ten worst</summary><ol>{''.join(worst)}</ol></details>"
        )
