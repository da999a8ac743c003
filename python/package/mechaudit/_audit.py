"""The audit of a callable against certified references."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from . import _mechaudit, certified
from ._methods import Description, block_answers, flat
from ._report import Report
from ._run import audited

__all__ = ["Case", "audit", "case", "judge", "points"]


def _intervals(description: Description, box: Mapping[str, Any]) -> list[tuple[int, float, float, bool]]:
    symbols = [description.symbol(k) for k in range(len(description.inputs))]
    if not description.fixed:
        raise ValueError(f"box: the inputs of {description.name} have no fixed number")
    found = []
    for name, interval in box.items():
        if name not in symbols:
            raise ValueError(f"box: {description.name} has no input {name!r}; it has: {', '.join(symbols)}")
        low, high, *more = interval
        low, high = float(low), float(high)
        if not (np.isfinite(low) and np.isfinite(high) and low < high):
            raise ValueError(f"box: {name} needs two finite numbers in order, got {low} and {high}")
        logarithmic = more == ["log"]
        if more and not logarithmic:
            raise ValueError(f"box: {name} takes 'log' after its ends, got {more}")
        if logarithmic and low <= 0 <= high:
            raise ValueError(f"box: {name} cannot be logarithmic across zero")
        found.append((symbols.index(name), low, high, logarithmic))
    return found


def limit_of(ulps: float | None, conditioned: float | None, normwise: float | None) -> Any:
    given = {"ulps": ulps, "conditioned": conditioned, "normwise": normwise}
    chosen = [(k, float(v)) for k, v in given.items() if v is not None]
    if len(chosen) > 1:
        raise ValueError(f"one budget at a time: {' and '.join(k for k, _ in chosen)} exclude each other")
    return chosen[0] if chosen else None


def audit(
    method: str,
    f: Callable[..., Any] | None = None,
    *,
    seed: int = 1,
    cases: int = 200,
    regions: str | Iterable[str] | None = None,
    box: Mapping[str, Any] | None = None,
    outputs: str | Iterable[str] | None = None,
    ulps: float | None = None,
    conditioned: float | None = None,
    normwise: float | None = None,
    vectorised: bool | None = None,
    progress: bool | None = None,
    name: str | None = None,
) -> Report:
    """Audit a callable as a method: same inputs, certified references, the method's budget.

    Parameters
    ----------
    method : str
        Its name, see `methods`.
    f : callable, optional
        Takes the method's inputs, each an array or a number; functions of a complex variable take
        and give complex numbers. It refuses an input by raising `ValueError`, `ArithmeticError` or
        `mechaudit.DomainError`. Without it the method's own solver is audited.
    seed : int
        Key of the random stream.
    cases : int
        Random cases in each region, or in the box.
    regions : str or sequence of str, optional
        Only these, without the named cases.
    box : dict, optional
        Intervals of inputs, ``{"Re z": (0, 8), "Im z": (1e-9, 1, "log")}``; the others come from the
        regions in turn.
    outputs : str or sequence of str, optional
        Only these are judged.
    ulps, conditioned, normwise : float, optional
        A budget of one's own: units in the last place, units of ``2**-53 * (1 + condition)``, the
        same of the largest value.
    vectorised : bool, optional
        Whether `f` takes arrays. Found out with three points if not given.
    progress : bool, optional
        Whether tqdm shows how far it is; where a terminal looks on if not given.
    name : str, optional
        What to call the callable in reports.

    Returns
    -------
    Report
        Ctrl-C gives the report of the cases judged until then, which does not pass.

    Examples
    --------
    >>> import numpy as np
    >>> import mechaudit
    >>> from mechaudit.special import wofz
    >>> report = mechaudit.audit("faddeeva", wofz, cases=20)
    >>> report.passed, report.mode
    (True, 'vectorised')
    >>> bad = mechaudit.audit("faddeeva", lambda z: wofz(z) * (1 + 1e-12), cases=20)
    >>> bad.passed
    False
    """
    if seed < 0 or cases < 1:
        raise ValueError(f"seed = {seed} must not be negative, cases = {cases} must be at least 1")
    if regions is not None and box is not None:
        raise ValueError("regions and box exclude each other")
    description = Description(method)
    chosen = names_of(outputs)
    run = _mechaudit.Run(
        description.name,
        seed=seed,
        cases=cases,
        regions=names_of(regions),
        intervals=None if box is None else _intervals(description, box),
        outputs=chosen,
        limit=limit_of(ulps, conditioned, normwise),
    )
    return audited(description, run, f, chosen, vectorised, progress, name)


def names_of(names: str | Iterable[str] | None) -> list[str] | None:
    if names is None:
        return None
    return [names] if isinstance(names, str) else list(names)


class Case:
    """One case of a method.

    Attributes
    ----------
    method, region, place : str
        Which case; `place` also chooses it on the command line, ``mechaudit points METHOD PLACE``.
    input : tuple of float
        The numbers.
    arguments : tuple
        The arguments of a callable: a complex number, or a number or array for each input.
    """

    def __init__(self, method: str, place: str) -> None:
        self._description = Description(method)
        self._run = _mechaudit.Run(self._description.name, seed=1, cases=1, place=place)
        numbers, lengths = self._run.input(0)
        self.method = self._description.name
        self.region, self.place = self._run.place(0)
        self.input = tuple(float(x) for x in numbers)
        self.arguments = self._description.single(numbers, lengths)

    def due(self, digits: int = 20) -> list[certified.Real]:
        """The certified values, one for each output."""
        digits = certified._checked(digits)

        def ask(which: list[int], more: int) -> Any:
            return [self._run.due(0, more)[0] for _ in which]

        return certified._components(ask, 1, digits)[0]

    @property
    def proof(self) -> str | None:
        """Why the certified values hold."""
        return self._run.due(0, 20)[1]

    def judge(self, f: Callable[..., Any]) -> Report:
        """The audit of a callable at this case alone."""
        run = _mechaudit.Run(self._description.name, seed=1, cases=1, place=self.place)
        return audited(self._description, run, f, None, False, False, None)

    def __reduce__(self) -> tuple[Any, ...]:
        return Case, (self.method, self.place)

    def __repr__(self) -> str:
        return f"mechaudit.case({self.method!r}, {self.place!r})"


def case(method: str, place: str) -> Case:
    """The case of a method that a report names.

    Parameters
    ----------
    method : str
        Its name.
    place : str
        ``--region NAME --seed S --case N``, ``--check-point NAME``, ``--hard-case N`` or
        ``--at X,Y``.

    Examples
    --------
    >>> import mechaudit
    >>> c = mechaudit.case("faddeeva", "--at 0x1p+0,0x1p+0")
    >>> c.arguments
    ((1+1j),)
    >>> print(c.due(25)[0])
    0.3047442052569125924571388
    """
    return Case(method, place)


def points(method: str, n: int, *, seed: int = 1, regions: str | Iterable[str] | None = None) -> Any:
    """Inputs of a method: n in each region.

    Returns
    -------
    structured ndarray, or list of tuples
        The fields are the inputs; the field `region` comes last. Methods whose inputs have no fixed
        number give a list of ``(region, arguments)``.

    Examples
    --------
    >>> import mechaudit
    >>> p = mechaudit.points("voigt", 2, regions="even")  # doctest: +SKIP
    """
    if n < 1:
        raise ValueError(f"n must be at least 1, got {n}")
    description = Description(method)
    run = _mechaudit.Run(
        description.name, seed=seed, cases=n, regions=names_of(regions), named=False
    )
    count = len(run)
    places = [run.place(i)[0] for i in range(count)]
    if not description.fixed:
        return [(places[i], description.single(*run.input(i))) for i in range(count)]
    block = run.block(0, count)
    width = max(map(len, places), default=1)
    fields = [(description.symbol(k), np.float64) for k in range(block.shape[1])]
    table = np.empty(count, dtype=[*fields, ("region", f"U{width}")])
    for k, (name, _) in enumerate(fields):
        table[name] = block[:, k]
    table["region"] = places
    return table


def judge(method: str, points: Any, values: Any, **options: Any) -> Report:
    """Judge values that were computed elsewhere.

    Parameters
    ----------
    method : str
        Its name.
    points : array_like
        Inputs: complex numbers for functions of a complex variable, else an array with a row for
        each point, or the structured array of `points`.
    values : array_like
        What is to be judged: complex numbers, one number a point, or a row for each point.
    **options
        `outputs`, and a budget: `ulps`, `conditioned` or `normwise`.

    Returns
    -------
    Report

    Examples
    --------
    >>> import mechaudit
    >>> mechaudit.judge("faddeeva", [0j, 1j], [1, 0.427583576155807]).passed
    True
    """
    description = Description(method)
    chosen = names_of(options.pop("outputs", None))
    limit = limit_of(*(options.pop(k, None) for k in ("ulps", "conditioned", "normwise")))
    if options:
        raise TypeError(f"judge has no option {next(iter(options))!r}")
    rows = _rows(description, points)
    run = _mechaudit.Run(
        description.name, seed=1, cases=1, given=rows, outputs=chosen, limit=limit
    )
    outputs = description.outputs if chosen is None else [o for o in description.outputs if o in chosen]
    given = values
    array = np.asarray(values)
    if array.ndim == 0 or len(array) != len(rows):
        raise ValueError(f"values: {array.shape} does not fit {len(rows)} points")
    if description.is_complex and array.ndim == 1:
        run.judge_block(0, block_answers(description, array, len(rows), outputs))
    elif array.dtype != object and array.ndim == 2:
        run.judge_block(0, np.ascontiguousarray(array, dtype=np.float64))
    else:
        run.judge(0, [flat(v) for v in given])
    return Report(run.finish(False), [], "as values", "the values given")


def _rows(description: Description, points: Any) -> list[list[float]]:
    array = np.asarray(points) if not isinstance(points, list) or not points else points
    if isinstance(array, np.ndarray) and array.dtype.names:
        fields = [array[n].astype(np.float64) for n in array.dtype.names if n != "region"]
        array = np.stack(fields, axis=1)
    if description.is_complex:
        z = np.asarray(array)
        if z.ndim == 1:
            z = z.astype(np.complex128)
            array = np.stack([z.real, z.imag], axis=1)
    return [[float(x) for x in np.asarray(row, dtype=np.float64).reshape(-1)] for row in array]
