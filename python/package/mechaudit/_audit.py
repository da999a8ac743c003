"""The audit of a callable against certified references."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _checks as checks
from . import _mechaudit, certified
from ._checks import function, names, number, whole
from ._methods import Description, block_answers, flat
from ._report import Report, called
from ._run import audited

if TYPE_CHECKING:
    from ._study import Study

__all__ = ["Case", "audit", "case", "judge", "points"]

#: The name of a method's own solver.
OURS = "ours"
#: Cases in each region: more take years.
_MOST_CASES = 1_000_000_000
#: Points in each region: more fill the memory.
_MOST_POINTS = 10_000_000


def _sides(box: Mapping[str, Any] | str) -> str:
    """A box as `mechaudit audit --box` writes it."""
    if isinstance(box, str):
        return box
    sides = []
    for name, side in box.items():
        if isinstance(side, str) or not isinstance(side, Iterable):
            side = (side,)
        ends = [repr(number(f"box: {name}", x)) for x in side if not isinstance(x, str)]
        words = [x for x in side if isinstance(x, str)]
        if not 1 <= len(ends) <= 2 or words not in ([], ["log"], ["+-log"]):
            rule = "a number, two numbers, or two numbers and 'log' or '+-log'"
            raise ValueError(f"box: {name} takes {rule}, got {side!r}")
        sides.append(f"{name}={' '.join([*words, '..'.join(ends)])}")
    return ", ".join(sides)


_BUDGETS = ("ulps", "conditioned", "relative", "absolute", "normwise")


def scope_of(
    outputs: str | Iterable[str] | None = None,
    budgets: Mapping[str, float | None] | None = None,
    **where: Any,
) -> dict[str, Any]:
    """What is judged, where and by which budget, as the compiled part takes it."""
    limits = {k: number(k, v) for k, v in (budgets or {}).items() if v is not None}
    scope: dict[str, Any] = {"limits": limits, **where}
    if outputs is not None:
        scope["outputs"] = names("outputs", outputs)
    return scope


def audit(
    method: str | Study,
    f: Callable[..., Any] | str,
    *,
    seed: int = 1,
    cases: int = 200,
    regions: str | Iterable[str] | None = None,
    box: Mapping[str, Any] | str | None = None,
    near: str | complex | Iterable[float] | None = None,
    radius: float | None = None,
    ordinary: bool = False,
    outputs: str | Iterable[str] | None = None,
    ulps: float | None = None,
    conditioned: float | None = None,
    relative: float | None = None,
    absolute: float | None = None,
    normwise: float | None = None,
    single: bool = False,
    vectorised: bool | None = None,
    progress: bool | None = None,
    name: str | None = None,
) -> Report:
    """Audit a callable as a method: same inputs, certified references, the method's budget.

    Parameters
    ----------
    method : str or Study
        Its name, see `methods`; or a `Study`, or the path of its file.
    f : callable or "ours"
        Takes the method's inputs, each an array or a number; functions of a complex variable take
        and give complex numbers. It refuses an input by raising `ValueError`, `ArithmeticError` or
        `mechaudit.DomainError`. The name "ours" stands for the method's own solver.
    seed : int
        Key of the random stream.
    cases : int
        Random cases in each region, in a box that names every input, or about an input.
    regions : str or sequence of str, optional
        Only these, without the named cases.
    box : dict or str, optional
        Intervals of inputs, ``{"Re z": (0, 8), "Im z": (1e-9, 1, "log")}``; ``"+-log"`` draws either
        sign, a single number is that number. The others come from the regions in turn. As text it is
        written as for ``mechaudit audit --box``.
    near : str, complex or sequence of float, optional
        Cases about an input: its numbers, the name of a check point, ``"REGION/CASE"`` or
        ``"hard/N"``; needs `radius`.
    radius : float, optional
        Of that neighbourhood, relative, positive and at most 1.
    ordinary : bool
        Leaves out regions and named cases at the ends of the range of floating-point numbers.
    outputs : str or sequence of str, optional
        Only these are judged.
    ulps, conditioned, relative, absolute : float, optional
        A user-supplied budget for each output: units in the last place, units of
        ``2**-53 * (1 + condition)``, a relative or an absolute error. Of the last two given together
        the larger one counts.
    normwise : float, optional
        A user-supplied budget for the norm of all errors by the norm of all values.
    single : bool
        Whether `f` computes in single precision: it is given float32 and complex64, inputs are numbers
        of that format, ulps are its ulps.
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
    own = isinstance(f, str) and f == OURS
    if not own and not callable(f):
        raise TypeError(f"f must be callable, or {OURS!r} for the method's own solver, got {f!r}")
    seed, cases = checks.seed(seed), whole("cases", cases, 1, _MOST_CASES)
    if box is not None and near is not None:
        raise ValueError("box and near exclude each other")
    if (near is None) != (radius is None):
        raise ValueError("near and radius need each other")
    description = Description(method)
    where: dict[str, Any] = {"single": single, "ordinary": ordinary}
    if regions is not None:
        where["regions"] = names("regions", regions)
    if box is not None:
        where["sides"] = _sides(box)
    if near is not None and radius is not None:
        where["near"] = (_centre(near), number("radius", radius))
    budgets = dict(zip(_BUDGETS, (ulps, conditioned, relative, absolute, normwise)))
    chosen = names("outputs", outputs)
    scope = scope_of(chosen, budgets, **where)
    run = _mechaudit.Run(description.key, seed=seed, cases=cases, scope=scope)
    called = None if own else function("f", f)
    return audited(description, run, called, chosen, vectorised, progress, name, single)


def _centre(near: str | complex | Iterable[float]) -> str:
    if isinstance(near, str):
        return near
    if isinstance(near, (complex, np.complexfloating)):
        near = (near.real, near.imag)
    numbers = near if isinstance(near, Iterable) else (near,)
    return ",".join(repr(number("near", x)) for x in numbers)


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

    def __init__(self, method: str | Study, place: str) -> None:
        self._description = Description(method)
        self._run = _mechaudit.Run(self._description.key, place=shlex.split(place))
        self._single = "--single" in shlex.split(place)
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
        run = _mechaudit.Run(self._description.key, place=shlex.split(self.place))
        return audited(self._description, run, function("f", f), None, False, False, None, self._single)

    def __reduce__(self) -> tuple[Any, ...]:
        return Case, (self.method, self.place)

    def __repr__(self) -> str:
        return called(self.method, self.place)


def case(method: str | Study, place: str) -> Case:
    """The case of a method that a report names.

    Parameters
    ----------
    method : str or Study
        Its name, or a `Study`.
    place : str
        ``--region NAME --seed S --case N``, ``--check-point NAME``, ``--hard-case N``, ``--at X,Y``,
        or a ``--case N`` of a ``--box`` or of what is ``--near``.

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


def drawn(
    description: Description, n: int, seed: int, regions: str | Iterable[str] | None
) -> _mechaudit.Run:
    """n cases of each region, without the named cases."""
    chosen = names("regions", regions)
    if chosen is None:
        chosen = [name for name, _ in description.facts["regions"]]
    scope = scope_of(regions=chosen)
    return _mechaudit.Run(description.key, seed=checks.seed(seed), cases=n, scope=scope)


def points(method: str | Study, n: int, *, seed: int = 1, regions: str | Iterable[str] | None = None) -> Any:
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
    n = whole("n", n, 1, _MOST_POINTS)
    description = Description(method)
    run = drawn(description, n, seed, regions)
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


def judge(method: str | Study, points: Any, values: Any, **options: Any) -> Report:
    """Judge values that were computed elsewhere.

    Parameters
    ----------
    method : str or Study
        Its name, or a `Study`.
    points : array_like
        Inputs: complex numbers for functions of a complex variable, else an array with a row for
        each point, or the structured array of `points`.
    values : array_like
        What is to be judged: complex numbers, one number a point, or a row for each point.
    **options
        `outputs`, `single`, and budgets: `ulps`, `conditioned`, `relative`, `absolute`, `normwise`.

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
    chosen = names("outputs", options.pop("outputs", None))
    budgets = {k: options.pop(k, None) for k in _BUDGETS}
    single = bool(options.pop("single", False))
    if options:
        raise TypeError(f"judge has no option {next(iter(options))!r}")
    rows = _rows(description, points)
    scope = scope_of(chosen, budgets, single=single)
    run = _mechaudit.Run(description.key, scope=scope, given=rows)
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
    name = "the values given"
    return Report(run.finish(False, name), [], "as values", name, run.page())


def _rows(description: Description, points: Any) -> list[list[float]]:
    array = np.asarray(points) if not isinstance(points, list) or not points else points
    if isinstance(array, np.ndarray) and array.ndim == 0:
        raise TypeError(f"points must be a list or an array, got {points!r}")
    if isinstance(array, np.ndarray) and array.dtype.names:
        fields = [array[n].astype(np.float64) for n in array.dtype.names if n != "region"]
        array = np.stack(fields, axis=1)
    if description.is_complex:
        z = np.asarray(array)
        if z.ndim == 1:
            z = z.astype(np.complex128)
            array = np.stack([z.real, z.imag], axis=1)
    return [[float(x) for x in np.asarray(row, dtype=np.float64).reshape(-1)] for row in array]
