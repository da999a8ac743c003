"""Studies: problems of the user's own, as formulas or files."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from . import _mechaudit, certified
from ._audit import audit
from ._checks import number
from ._exact import exact, hexadecimal, is_sequence
from ._mechaudit import DomainError
from ._report import Report

__all__ = ["Study", "formula"]


class Study:
    """A problem in a file or a text: inputs, what the outputs mean, and budgets.

    Every function that takes the name of a method takes a study as well: `audit`, `compare`, `judge`,
    `points`, `case`. The language of the file is in the chapter "Your own problem" of the book.

    Parameters
    ----------
    path_or_text : str or os.PathLike
        A file ``.toml`` or ``.fpcore``, ``"FILE.fpcore#NAME"`` for one core of several, or the text
        itself: a string of several lines, or one that begins with a bracket.
    solver : str, optional
        The solver that `eval` takes and that ``audit("ours")`` judges; the first one if not given.

    Attributes
    ----------
    name : str
        Its name in reports.
    inputs, outputs : list of str
        Their names in the order of the file.

    Raises
    ------
    ValueError
        If the study cannot be read; the message has the line, the column and the rule.

    Examples
    --------
    >>> import mechaudit
    >>> study = mechaudit.Study('''
    ... [inputs]
    ... x = { from = 0, to = 1e300, spacing = "log" }
    ... [outputs]
    ... y = { is = "sqrt(x + 1) - sqrt(x)", budget = "4 ulp", why = "five roundings" }
    ... ''')
    >>> study.eval([1e10], digits=20)
    ['0.0000049999999998750000000']
    >>> study.audit(lambda x: 1 / ((x + 1)**0.5 + x**0.5), cases=20).passed
    True
    """

    def __init__(self, path_or_text: str | os.PathLike[str], *, solver: str | None = None) -> None:
        if not isinstance(path_or_text, (str, os.PathLike)):
            raise TypeError(f"path_or_text must be a path or a text, got {path_or_text!r}")
        text = os.fspath(path_or_text)
        is_text = isinstance(path_or_text, str) and (
            "\n" in text or text.lstrip().startswith(("(", ";"))
        )
        self._open(_mechaudit.open_study(text, not is_text, solver))

    def _open(self, key: str) -> None:
        self._key = key
        self._facts = _mechaudit.method(key)
        self.name: str = self._facts["name"]
        self.inputs: list[str] = [i[0] for i in self._facts["inputs"]]
        self.outputs: list[str] = [o[0] for o in self._facts["outputs"]]

    def eval(self, values: Any, digits: int | None = None) -> list[str] | list[float]:
        """The outputs at an input, in the order of the file.

        Parameters
        ----------
        values : number, sequence or mapping
            The inputs in the order of the file, or by name. They are taken exactly: floats, integers,
            fractions, decimals and strings such as ``"0.1"`` or ``"1/3"``.
        digits : int, optional
            The number of certified decimals.

        Returns
        -------
        list of str
            With `digits` certified decimals; ``"0"`` where a value is proved to be zero, ``"nan"``
            where it is undefined over the reals, ``"undecided"`` where it could not be decided.
        list of float
            Without `digits` the answers of the study's solver in binary64.

        Raises
        ------
        mechaudit.DomainError
            Without `digits`, if the solver has no value there.
        ValueError
            Without `digits`, if the study states no solver.
        """
        numbers = [exact(name, x) for name, x in zip(self.inputs, self._row(values))]
        if digits is not None:
            row = [hexadecimal(x) for x in numbers]
            found = _mechaudit.study_digits(self._key, row, certified._checked(digits))
            return [text if text is not None else "undecided" for text in found]
        if not self.describe()["solvers"]:
            raise ValueError(f"{self.name}: the study states no solver; give digits")
        answer, why = _mechaudit.study_values(self._key, [_nearest(x) for x in numbers])
        if answer is None:
            raise DomainError(f"{self.name}: {why}")
        return answer

    def _row(self, values: Any) -> list[Any]:
        if isinstance(values, Mapping):
            for name in values:
                if name not in self.inputs:
                    known = ", ".join(self.inputs)
                    raise ValueError(f"values: there is no input {name!r}; there are: {known}")
            for name in self.inputs:
                if name not in values:
                    raise ValueError(f"values: the input {name} is missing")
            return [values[name] for name in self.inputs]
        row = list(values) if is_sequence(values) else [values]
        if len(row) != len(self.inputs):
            names = ", ".join(self.inputs)
            raise ValueError(f"values: {len(row)} numbers for {len(self.inputs)} inputs ({names})")
        return row

    def audit(
        self, f: Callable[..., Any] | str = "ours", *, cases: int = 200, seed: int = 1, **options: Any
    ) -> Report:
        """Audit a callable against the definition, or the study's own solver.

        Parameters
        ----------
        f : callable or "ours"
            Takes the inputs in the order of the file and gives the outputs.
        cases : int
            Random cases in each region.
        seed : int
            Key of the random stream.
        **options
            As for `mechaudit.audit`: ``ulps``, ``relative``, ``regions``, ``vectorised`` and others.
        """
        return audit(self, f, cases=cases, seed=seed, **options)

    def describe(self) -> dict[str, Any]:
        """Inputs, outputs, budgets and regions as `methods` has them of a method, with the definitions
        of the outputs, the names of the solvers, and remarks on names and solvers."""
        definitions, solvers, remarks = _mechaudit.study_facts(self._key)
        facts = dict(self._facts)
        facts["definitions"] = dict(zip(self.outputs, definitions))
        facts["solvers"] = solvers
        facts["remarks"] = remarks
        return facts

    def __repr__(self) -> str:
        return f"<mechaudit.Study {self.name}: {', '.join(self.inputs)} -> {', '.join(self.outputs)}>"


def _nearest(x: Any) -> float:
    try:
        return float(x)
    except OverflowError:
        return float("inf") if x > 0 else float("-inf")


def formula(text: str, /, *, where: str | None = None, **ranges: Any) -> Study:
    """The study of one formula.

    Parameters
    ----------
    text : str
        The formula in the language of studies.
    where : str, optional
        A condition on the inputs, such as ``"a < b"``.
    **ranges
        Each input with its ends, ``x=(0, 1)``; ``None`` in place of an end leaves that side open, and
        in place of both ends every finite number is meant.

    Returns
    -------
    Study
        Its only output is called ``value``.

    Examples
    --------
    >>> import math
    >>> import mechaudit
    >>> study = mechaudit.formula("log(1 + x) - x", x=(0, 1))
    >>> study.eval("1e-10", digits=10)
    ['-5.000000000e-21']
    >>> study.audit(lambda x: math.log1p(x) - x, cases=20).passed
    False
    """
    if not isinstance(text, str):
        raise TypeError(f"text must be a formula, got {text!r}")
    study = Study.__new__(Study)
    inputs = [(name, *_ends(name, ends)) for name, ends in ranges.items()]
    study._open(_mechaudit.open_formula(text, inputs, where))
    return study


def _ends(name: str, ends: Any) -> tuple[float, float]:
    if ends is None:
        ends = (None, None)
    if not isinstance(ends, Iterable) or isinstance(ends, str) or len(ends := tuple(ends)) != 2:
        raise ValueError(f"{name}: a range is a pair of numbers, got {ends!r}")
    open_ends = (float("-inf"), float("inf"))
    low, high = (e if x is None else number(name, x) for x, e in zip(ends, open_ends))
    return low, high
