"""The audit of a callable against certified references."""

from __future__ import annotations

import csv
import os
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import _mechaudit, certified
from ._exact import is_sequence
from ._report import Finding, Report

__all__ = ["Case", "Comparison", "audit", "case", "compare", "judge", "methods", "points", "vectors"]

#: Cases handed to a vectorised callable at a time.
_BLOCK = 4096
_NAN = "the answer holds NaN where it is not due"


def methods() -> list[dict[str, Any]]:
    """What can be audited: name, inputs, outputs, regions and check points of each method.

    Examples
    --------
    >>> import mechaudit
    >>> "faddeeva" in [m["name"] for m in mechaudit.methods()]
    True
    """
    return _mechaudit.methods()


class _Description:
    """How a method's callables are called."""

    def __init__(self, method: str) -> None:
        # Also by the name of an earlier release; an unknown one is refused with those there are.
        name = _mechaudit.Run(method, seed=1, cases=1).finish(True, 0)["method"]
        facts = next(m for m in methods() if m["name"] == name)
        self.name = name
        self.facts = facts
        self.inputs = [i[0] for i in facts["inputs"]]
        self.outputs = [o[0] for o in facts["outputs"]]
        self.fixed = bool(facts["fixed"])
        #: One complex number in, one out.
        self.is_complex = self.fixed and len(self.inputs) == 2 and len(self.outputs) == 2 and all(
            names[0].startswith("Re") and names[1].startswith("Im")
            for names in (self.inputs, self.outputs)
        )

    def symbol(self, k: int) -> str:
        """The name of an input as a field of an array."""
        return self.inputs[k].split(" (")[0].split("[")[0]

    def arguments(self, block: Any) -> tuple[Any, ...]:
        """The arguments of a vectorised callable for the rows of a block."""
        if self.is_complex:
            return (_complex_of(block),)
        return tuple(np.ascontiguousarray(block[:, k]) for k in range(block.shape[1]))

    def single(self, numbers: Any, lengths: Sequence[int]) -> tuple[Any, ...]:
        """The arguments of a scalar callable."""
        if self.is_complex:
            return (complex(numbers[0], numbers[1]),)
        parts = []
        start = 0
        for name, length in zip(self.inputs, lengths):
            end = start + length
            is_list = "[" in name.split(" (")[0]
            parts.append(numbers[start:end].copy() if is_list else float(numbers[start]))
            start = end
        return tuple(parts)


def _complex_of(block: Any) -> Any:
    z = np.empty(len(block), dtype=np.complex128)
    # Not re + 1j*im, which loses the signs of zeros and makes NaN of infinities.
    z.real, z.imag = block[:, 0], block[:, 1]
    return z


def _numbers(description: _Description, answer: Any, outputs: Sequence[str]) -> list[float]:
    """A scalar answer as a list of floats."""
    if description.is_complex and not is_sequence(answer):
        if hasattr(answer, "_mpf_") or hasattr(answer, "_mpc_"):
            answer = complex(answer)
        z = np.asarray(answer)
        if z.dtype.kind not in "fiubc" or z.shape not in ((), (1,)):
            raise TypeError(f"the answer is {type(answer).__name__}, a complex number is due")
        z = np.asarray(z.reshape(()), dtype=np.complex128)
        both = {"Re": float(z.real), "Im": float(z.imag)}
        return [both[name[:2]] for name in outputs]
    return _flat(answer)


def _flat(answer: Any) -> list[float]:
    if isinstance(answer, Mapping):
        answer = list(answer.values())
    if isinstance(answer, (tuple, list)):
        return [x for part in answer for x in _flat(part)]
    array = np.asarray(answer)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"the answer holds {array.dtype}, real numbers are due")
    return [float(x) for x in array.reshape(-1)]


class _Findings:
    def __init__(self, run: Any, method: str) -> None:
        self.run = run
        self.method = method
        self.all: dict[str, Finding] = {}

    def add(self, kind: str, message: str, case: int) -> None:
        known = self.all.get(kind)
        if known is not None:
            known.count += 1
            return
        self.all[kind] = Finding(kind, message, self.method, self.run.place(case)[1])


def _block_answers(description: _Description, answer: Any, count: int, outputs: Sequence[str]) -> Any:
    """The answer of a vectorised callable as rows of floats, or why it is none."""
    if description.is_complex:
        z = np.asarray(answer)
        if z.shape != (count,):
            raise ValueError(f"the answer has shape {z.shape} for {count} points")
        if z.dtype.kind not in "fiubc":
            raise TypeError(f"the answer holds {z.dtype}, complex numbers are due")
        z = z.astype(np.complex128)
        both = {"Re": z.real, "Im": z.imag}
        return np.stack([both[name[:2]] for name in outputs], axis=1)
    parts = answer if isinstance(answer, (tuple, list)) and len(outputs) > 1 else [answer]
    if isinstance(answer, np.ndarray) and answer.ndim == 2 and answer.shape == (count, len(outputs)):
        parts = list(answer.T)
    columns = [np.asarray(p) for p in parts]
    for column in columns:
        if column.shape != (count,):
            raise ValueError(f"the answer has shape {column.shape} for {count} points")
        if column.dtype.kind not in "fiub":
            raise TypeError(f"the answer holds {column.dtype}, real numbers are due")
    if len(columns) != len(outputs):
        raise ValueError(f"the answer has {len(columns)} columns, {len(outputs)} are due")
    return np.stack([c.astype(np.float64) for c in columns], axis=1)


def _bits(a: Any) -> Any:
    return np.ascontiguousarray(a).view(np.uint64)


def _is_vectorised(description: _Description, run: Any, f: Callable[..., Any], outputs: Any) -> bool:
    """Whether the callable takes three points at a time and gives three answers."""
    if not description.fixed:
        return False
    count = min(3, len(run))
    block = run.block(0, count)
    try:
        _block_answers(description, f(*description.arguments(block)), count, outputs)
    except Exception:
        return False
    return count > 0


def _single_types(answer: Any) -> str | None:
    """The single-precision type of an answer, if it has one."""
    dtype = getattr(answer, "dtype", None)
    return str(dtype) if dtype in (np.complex64, np.float32, np.float16) else None


def _progress(total: int, shown: bool | None) -> Any:
    if shown is False:
        return None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    # Only where somebody looks, unless asked for.
    return tqdm(total=total, unit=" cases", disable=None if shown is None else False)


def _intervals(description: _Description, box: Mapping[str, Any]) -> list[tuple[int, float, float, bool]]:
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


def _limit(ulps: float | None, conditioned: float | None, normwise: float | None) -> Any:
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
    description = _Description(method)
    chosen = _names(outputs)
    run = _mechaudit.Run(
        description.name,
        seed=seed,
        cases=cases,
        regions=_names(regions),
        intervals=None if box is None else _intervals(description, box),
        outputs=chosen,
        limit=_limit(ulps, conditioned, normwise),
    )
    return _audited(description, run, f, chosen, vectorised, progress, name)


def _names(names: str | Iterable[str] | None) -> list[str] | None:
    if names is None:
        return None
    return [names] if isinstance(names, str) else list(names)


def _audited(
    description: _Description,
    run: Any,
    f: Callable[..., Any] | None,
    chosen: list[str] | None,
    vectorised: bool | None,
    progress: bool | None,
    name: str | None,
) -> Report:
    outputs = description.outputs if chosen is None else [o for o in description.outputs if o in chosen]
    findings = _Findings(run, description.name)
    total = len(run)
    bar = _progress(total, progress)
    interrupted = False
    if f is None:
        mode, name = "in Rust", name or "its own solver"
    else:
        name = name or getattr(f, "__name__", type(f).__name__)
        if vectorised is None:
            vectorised = _is_vectorised(description, run, f, outputs)
        elif vectorised and not description.fixed:
            raise ValueError(f"vectorised: the inputs of {description.name} have no fixed number")
        mode = "vectorised" if vectorised else "scalar"
    done = 0
    try:
        while done < total:
            # Scalar callables are slow: the bar moves every quarter of a second.
            if f is None:
                end = min(total, done + _BLOCK)
                run.judge_own(done, end)
            elif vectorised:
                end = min(total, done + _BLOCK)
                _vectorised(description, run, f, done, end, outputs, findings)
            else:
                end = _scalar(description, run, f, done, total, outputs, findings)
            if bar is not None:
                bar.update(end - done)
            done = end
    except KeyboardInterrupt:
        interrupted = True
    finally:
        if bar is not None:
            bar.close()
    facts = run.finish(interrupted, 0)
    return Report(facts, list(findings.all.values()), mode, name)


def _vectorised(
    description: _Description, run: Any, f: Any, start: int, end: int, outputs: Any, findings: _Findings
) -> None:
    block = run.block(start, end)
    arguments = description.arguments(block)
    before = [a.copy() for a in arguments]
    try:
        answer = f(*arguments)
        values = _block_answers(description, answer, end - start, outputs)
    except KeyboardInterrupt:
        raise
    except Exception:
        # Which of the points it is, they tell one by one.
        _one_by_one(description, run, f, start, end, outputs, findings)
        return
    if any(not np.array_equal(_bits(a), _bits(b)) for a, b in zip(arguments, before)):
        findings.add("overwritten", "the callable writes to its arguments", start)
    single = _single_types(answer)
    if single is not None:
        findings.add(single, f"the answer is {single} for arguments in double precision", start)
    passed = np.array(run.judge_block(start, values))
    for i in np.flatnonzero(np.isnan(values).any(axis=1) & ~passed):
        findings.add("NaN", _NAN, start + int(i))


def _one_by_one(
    description: _Description, run: Any, f: Any, start: int, end: int, outputs: Any, findings: _Findings
) -> None:
    """A block that failed as a whole, point by point in arrays of one."""
    answers: list[Any] = []
    for i in range(start, end):
        try:
            answer = f(*description.arguments(run.block(i, i + 1)))
            row = _block_answers(description, answer, 1, outputs)
            answers.append([float(x) for x in row[0]])
        except KeyboardInterrupt:
            _judged(run, start, answers, findings)
            raise
        except Exception as e:
            answers.append(_failed(e, i, findings))
    _judged(run, start, answers, findings)
    if all(isinstance(a, list) for a in answers):
        message = "it fails for many points at once and for none of them alone"
        findings.add("block", message, start)


def _failed(e: Exception, i: int, findings: _Findings) -> tuple[bool, str | None]:
    refuses = isinstance(e, (ValueError, ArithmeticError, NotImplementedError))
    findings.add(type(e).__name__, str(e) or type(e).__name__, i)
    # A refusal without a word of the method's own: right wherever the reference refuses.
    return (True, None) if refuses else (False, f"{type(e).__name__}: {e}")


def _scalar(
    description: _Description, run: Any, f: Any, start: int, total: int, outputs: Any, findings: _Findings
) -> int:
    answers: list[Any] = []
    clock = time.monotonic()
    i = start
    try:
        while i < total and len(answers) < _BLOCK and time.monotonic() - clock < 0.25:
            numbers, lengths = run.input(i)
            try:
                answer = f(*description.single(numbers, lengths))
                row = _numbers(description, answer, outputs)
                single = _single_types(answer)
                if single is not None:
                    message = f"the answer is {single} for arguments in double precision"
                    findings.add(single, message, i)
                answers.append(row)
            except KeyboardInterrupt:
                raise
            except Exception as e:
                answers.append(_failed(e, i, findings))
            i += 1
    except KeyboardInterrupt:
        _judged(run, start, answers, findings)
        raise
    _judged(run, start, answers, findings)
    return i


def _judged(run: Any, start: int, answers: list[Any], findings: _Findings) -> None:
    for i, passed in enumerate(run.judge(start, answers)):
        answer = answers[i]
        if not passed and isinstance(answer, list) and any(x != x for x in answer):
            findings.add("NaN", _NAN, start + i)


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
        self._description = _Description(method)
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
        return _audited(self._description, run, f, None, False, False, None)

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
    description = _Description(method)
    run = _mechaudit.Run(
        description.name, seed=seed, cases=n, regions=_names(regions), named=False
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
    description = _Description(method)
    chosen = _names(options.pop("outputs", None))
    limit = _limit(*(options.pop(k, None) for k in ("ulps", "conditioned", "normwise")))
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
        run.judge_block(0, _block_answers(description, array, len(rows), outputs))
    elif array.dtype != object and array.ndim == 2:
        run.judge_block(0, np.ascontiguousarray(array, dtype=np.float64))
    else:
        run.judge(0, [_flat(v) for v in given])
    return Report(run.finish(False, 0), [], "as values", "the values given")


def _rows(description: _Description, points: Any) -> list[list[float]]:
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
    if not candidates:
        raise ValueError("candidates: there is nothing to compare")
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


#: Names in scipy's tables, and their types.
_XSREF = {
    "faddeeva": ("wofz", "D", "D"),
    "erf": ("erf", "D", "D"),
    "erfc": ("erfc", "D", "D"),
    "erfcx": ("erfcx", "D", "D"),
    "erfi": ("erfi", "D", "D"),
    "dawson": ("dawsn", "D", "D"),
    "faddeeva-derivative": ("wofz_derivative", "D", "D"),
    "voigt": ("voigt_profile", "ddd", "d"),
}


class Vectors:
    """Certified test vectors.

    Attributes
    ----------
    inputs : ndarray, shape (n, inputs)
    values : ndarray, shape (n, outputs)
        The floats nearest to the certified values.
    decimals : list of list of str
        The values rounded correctly to the digits asked for.
    radii : list of list of str
        Bounds on the distance from a ball's midpoint to the true value, upward.
    proofs, regions : list of str
    """

    def __init__(self, description: _Description, digits: int) -> None:
        self._description = description
        self.digits = digits
        self.inputs: Any = np.empty((0, len(description.inputs)))
        self.values: Any = np.empty((0, len(description.outputs)))
        self.decimals: list[list[str]] = []
        self.radii: list[list[str]] = []
        self.proofs: list[str] = []
        self.regions: list[str] = []

    def __len__(self) -> int:
        return len(self.regions)

    def _columns(self) -> dict[str, Any]:
        columns: dict[str, Any] = {"region": self.regions}
        inputs, outputs = self._names()
        for k, name in enumerate(inputs):
            columns[name] = self.inputs[:, k]
        for k, name in enumerate(outputs):
            columns[name] = self.values[:, k]
            columns[f"{name}_decimal"] = [row[k] for row in self.decimals]
            columns[f"{name}_radius"] = [row[k] for row in self.radii]
        columns["proof"] = self.proofs
        return columns

    def _names(self) -> tuple[list[str], list[str]]:
        """Columns as scipy's tables name them."""
        if self._description.is_complex:
            return ["in0_real", "in0_imag"], ["out0_real", "out0_imag"]
        return (
            [f"in{k}" for k in range(self.inputs.shape[1])],
            [f"out{k}" for k in range(self.values.shape[1])],
        )

    def to_frame(self) -> Any:
        """All columns as a `pandas.DataFrame`."""
        import pandas as pd

        return pd.DataFrame(self._columns())

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Inputs as hexadecimal floats, which are exact, and values as decimals."""
        inputs, outputs = self._names()
        names = ["region", *inputs]
        for name in outputs:
            names += [name, f"{name}_radius"]

        def write(file: Any) -> None:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow([*names, "proof"])
            for i in range(len(self)):
                row: list[str] = [self.regions[i], *(float(x).hex() for x in self.inputs[i])]
                for k in range(len(outputs)):
                    row += [self.decimals[i][k], self.radii[i][k]]
                writer.writerow([*row, self.proofs[i]])

        _whole(path, "w", write)

    def to_npz(self, path: str | os.PathLike[str]) -> None:
        """All columns as arrays."""
        columns = {k: np.asarray(v) for k, v in self._columns().items()}
        _whole(path, "wb", lambda file: np.savez_compressed(file, **columns))

    def to_parquet(self, folder: str | os.PathLike[str]) -> tuple[Path, Path]:
        """Two tables in the layout of scipy's xsref: ``In_*.parquet`` and ``Out_*.parquet``.

        Returns
        -------
        tuple of Path
            The files. Metadata hold the types and the name of the function as there; the table of
            values also has, for each row, decimals, radii and the proof. ``fallback`` is False: no
            value comes from the code under test.
        """
        import hashlib

        import pyarrow as pa
        import pyarrow.parquet as pq

        if self._description.name not in _XSREF:
            known = ", ".join(_XSREF)
            raise ValueError(f"scipy's layout is for functions it has: {known}, not {self._description.name}")
        function, types_in, types_out = _XSREF[self._description.name]
        inputs, outputs = self._names()
        metadata = {b"in": types_in.encode(), b"out": types_out.encode(), b"function": function.encode()}
        codes = {"D": "cd", "d": "d"}
        stem = "_".join(codes[t] for t in types_in) + "-" + "_".join(codes[t] for t in types_out)
        where = Path(folder)
        where.mkdir(parents=True, exist_ok=True)
        file_in, file_out = where / f"In_{stem}.parquet", where / f"Out_{stem}.parquet"
        columns = {name: self.inputs[:, k] for k, name in enumerate(inputs)}
        table = pa.table(columns).replace_schema_metadata(metadata)
        _whole(file_in, "wb", lambda file: pq.write_table(table, file, compression="zstd"))
        checksum = hashlib.sha256(file_in.read_bytes()).hexdigest().encode()
        columns = {name: self.values[:, k] for k, name in enumerate(outputs)}
        columns["fallback"] = np.zeros(len(self), dtype=bool)
        for k, name in enumerate(outputs):
            columns[f"{name}_decimal"] = [row[k] for row in self.decimals]
            columns[f"{name}_radius"] = [row[k] for row in self.radii]
        columns["proof"] = self.proofs
        metadata[b"input_checksum"] = checksum
        metadata[b"mechaudit_version"] = _mechaudit.__version__.encode()
        values = pa.table(columns).replace_schema_metadata(metadata)
        _whole(file_out, "wb", lambda file: pq.write_table(values, file, compression="zstd"))
        return file_in, file_out


def _whole(path: str | os.PathLike[str], mode: str, write: Callable[[Any], Any]) -> None:
    """Writes a file that is whole or not there."""
    path = Path(path)
    text = {"newline": "", "encoding": "utf-8"} if "b" not in mode else {}
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with open(handle, mode, **text) as file:  # type: ignore[call-overload]
            write(file)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def vectors(
    method: str,
    n: int,
    digits: int = 30,
    *,
    seed: int = 1,
    regions: str | Iterable[str] | None = None,
) -> Vectors:
    """Certified test vectors, n in each region.

    Parameters
    ----------
    method : str
        A method whose inputs and outputs have a fixed number.
    n : int
        How many in each region; inputs at which there is no finite certified value are left out.
    digits : int
        Significant digits of the decimals.
    seed : int
        Key of the random stream.
    regions : str or sequence of str, optional
        Only these.

    Returns
    -------
    Vectors

    Examples
    --------
    >>> import mechaudit
    >>> v = mechaudit.vectors("faddeeva", 1, 25, regions="mid")
    >>> len(v), v.proofs[0] != ""
    (1, True)
    """
    digits = certified._checked(digits)
    if n < 1:
        raise ValueError(f"n must be at least 1, got {n}")
    description = _Description(method)
    if not description.fixed:
        raise ValueError(f"method: the inputs or outputs of {description.name} have no fixed number")
    run = _mechaudit.Run(description.name, seed=seed, cases=n, regions=_names(regions), named=False)
    found = Vectors(description, digits)
    inputs, values = [], []
    for i in range(len(run)):
        proof: list[str | None] = []

        def ask(which: list[int], more: int, i: int = i, proof: list[str | None] = proof) -> Any:
            components, why = run.due(i, more)
            proof.append(why)
            return [components]

        try:
            row = certified._components(ask, 1, digits)[0]
            nearest = [_nearest(x) for x in row]
            if None in nearest:
                # Next to the middle between two floats.
                finer = certified._components(ask, 1, digits + 60)[0]
                nearest = [float(x) for x in finer]
        except (_mechaudit.DomainError, OverflowError):
            continue
        inputs.append(run.input(i)[0])
        values.append(nearest)
        found.decimals.append([str(x) for x in row])
        found.radii.append([_upward(x) for x in row])
        found.proofs.append(proof[-1] or "")
        found.regions.append(run.place(i)[0])
    if inputs:
        found.inputs, found.values = np.stack(inputs), np.array(values)
    return found


def _nearest(x: certified.Real) -> float | None:
    """The nearest float, where the ball tells which it is."""
    low, high = (float(end) for end in x.interval)
    return low if low == high else None


def _upward(x: certified.Real) -> str:
    """A bound on the distance from the decimal to the true value: three digits, rounded up."""
    from decimal import ROUND_CEILING, Context, Decimal
    from fractions import Fraction

    low, high = x.interval
    at = Fraction(x.decimal)
    off = max(high - at, at - low)
    if not off:
        return "0"
    up = Context(prec=3, rounding=ROUND_CEILING, Emin=-(10**9), Emax=10**9)
    return str(up.divide(Decimal(off.numerator), Decimal(off.denominator)))
