"""Calls a callable at the cases of a run."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from ._methods import Description, block_answers, numbers_of
from ._report import Finding, Report

__all__: list[str] = []

#: Cases handed to a vectorised callable at a time.
_BLOCK = 4096
_DAY = 86_400.0
#: Seconds of work that are refused, as `mechaudit audit` has it, and after how many it is known.
_ENDLESS = 30 * _DAY
_TRIAL = 1.0
_NAN = "the answer holds NaN where it is not due"


class Findings:
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


def _bits(a: Any) -> Any:
    return np.ascontiguousarray(a).view(np.uint64)


def _is_vectorised(description: Description, run: Any, f: Callable[..., Any], outputs: Any) -> bool:
    """Whether the callable takes three points at a time and gives three answers."""
    if not description.fixed:
        return False
    count = min(3, len(run))
    block = run.block(0, count)
    try:
        block_answers(description, f(*description.arguments(block)), count, outputs)
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


def audited(
    description: Description,
    run: Any,
    f: Callable[..., Any] | None,
    chosen: list[str] | None,
    vectorised: bool | None,
    progress: bool | None,
    name: str | None,
    single: bool = False,
) -> Report:
    outputs = description.outputs if chosen is None else [o for o in description.outputs if o in chosen]
    findings = Findings(run, description.name)
    if single and f is not None:
        called_in_single = f
        f = lambda *arguments: called_in_single(*map(in_single, arguments))  # noqa: E731
        name = name or str(getattr(called_in_single, "__name__", type(called_in_single).__name__))
    total = len(run)
    bar = _progress(total, progress)
    interrupted = False
    if f is None:
        mode, called = "in Rust", name or "its own solver"
    else:
        called = name or str(getattr(f, "__name__", type(f).__name__))
        if vectorised is None:
            vectorised = _is_vectorised(description, run, f, outputs)
        elif vectorised and not description.fixed:
            raise ValueError(f"vectorised: the inputs of {description.name} have no fixed number")
        mode = "vectorised" if vectorised else "scalar"
    done = 0
    begin = time.monotonic()
    is_forecast = False
    try:
        while done < total:
            if f is None:
                end = min(total, done + _BLOCK)
                run.judge_own(done, end)
            elif vectorised:
                end = min(total, done + _BLOCK)
                _vectorised(description, run, f, done, end, outputs, findings, single)
            else:
                end = _scalar(description, run, f, done, total, outputs, findings, single)
            if bar is not None:
                bar.update(end - done)
            done = end
            seconds = time.monotonic() - begin
            if not is_forecast and seconds > _TRIAL:
                is_forecast = True
                _forecast(total, total / done * seconds)
    except KeyboardInterrupt:
        interrupted = True
    finally:
        if bar is not None:
            bar.close()
    facts = run.finish(interrupted, None if f is None else called)
    return Report(facts, list(findings.all.values()), mode, called, run.page())


def _forecast(total: int, seconds: float) -> None:
    """Refuses what cannot end, by what the first cases took."""
    if seconds > _ENDLESS:
        raise ValueError(
            f"cases: {total:.2e} take about {seconds / _DAY:.2g} days; more than {_ENDLESS / _DAY:.0f} days are refused: "
            "take fewer"
        )


def in_single(x: Any) -> Any:
    """An argument in single precision."""
    if isinstance(x, np.ndarray):
        return x.astype(np.complex64 if x.dtype.kind == "c" else np.float32)
    return np.complex64(x) if isinstance(x, complex) else np.float32(x)


def _vectorised(
    description: Description,
    run: Any,
    f: Any,
    start: int,
    end: int,
    outputs: Any,
    findings: Findings,
    single: bool,
) -> None:
    block = run.block(start, end)
    arguments = description.arguments(block)
    before = [a.copy() for a in arguments]
    try:
        answer = f(*arguments)
        values = block_answers(description, answer, end - start, outputs)
    except KeyboardInterrupt:
        raise
    except Exception:
        # Which of the points it is, they tell one by one.
        _one_by_one(description, run, f, start, end, outputs, findings)
        return
    if any(not np.array_equal(_bits(a), _bits(b)) for a, b in zip(arguments, before)):
        findings.add("overwritten", "the callable writes to its arguments", start)
    narrow = _single_types(answer)
    if narrow is not None and not single:
        findings.add(narrow, f"the answer is {narrow} for arguments in double precision", start)
    passed = np.array(run.judge_block(start, values))
    for i in np.flatnonzero(np.isnan(values).any(axis=1) & ~passed):
        findings.add("NaN", _NAN, start + int(i))


def _one_by_one(
    description: Description, run: Any, f: Any, start: int, end: int, outputs: Any, findings: Findings
) -> None:
    """A block that failed as a whole, point by point in arrays of one."""
    answers: list[Any] = []
    for i in range(start, end):
        try:
            answer = f(*description.arguments(run.block(i, i + 1)))
            row = block_answers(description, answer, 1, outputs)
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


def _failed(e: Exception, i: int, findings: Findings) -> tuple[bool, str | None]:
    refuses = isinstance(e, (ValueError, ArithmeticError, NotImplementedError))
    findings.add(type(e).__name__, str(e) or type(e).__name__, i)
    # A refusal without a word of the method's own: right wherever the reference refuses.
    return (True, None) if refuses else (False, f"{type(e).__name__}: {e}")


def _scalar(
    description: Description,
    run: Any,
    f: Any,
    start: int,
    total: int,
    outputs: Any,
    findings: Findings,
    single: bool,
) -> int:
    answers: list[Any] = []
    clock = time.monotonic()
    i = start
    inputs: Iterator[Any]
    if description.fixed:
        ones = [1] * len(description.inputs)
        inputs = ((row, ones) for row in run.block(start, min(total, start + _BLOCK)))
    else:
        inputs = (run.input(k) for k in range(start, min(total, start + _BLOCK)))
    try:
        for numbers, lengths in inputs:
            try:
                answer = f(*description.single(numbers, lengths))
                row = numbers_of(description, answer, outputs)
                narrow = _single_types(answer)
                if narrow is not None and not single:
                    message = f"the answer is {narrow} for arguments in double precision"
                    findings.add(narrow, message, i)
                answers.append(row)
            except KeyboardInterrupt:
                raise
            except Exception as e:
                answers.append(_failed(e, i, findings))
            i += 1
            # Slow callables: the bar moves, and Ctrl-C is near, every quarter of a second.
            if time.monotonic() - clock > 0.25:
                break
    except KeyboardInterrupt:
        _judged(run, start, answers, findings)
        raise
    _judged(run, start, answers, findings)
    return i


def _judged(run: Any, start: int, answers: list[Any], findings: Findings) -> None:
    for i, passed in enumerate(run.judge(start, answers)):
        answer = answers[i]
        if not passed and isinstance(answer, list) and any(x != x for x in answer):
            findings.add("NaN", _NAN, start + i)
