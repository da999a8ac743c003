"""What can be audited, and how its callables are called."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _mechaudit
from ._exact import is_sequence

__all__ = ["methods"]


def methods() -> list[dict[str, Any]]:
    """What can be audited: name, inputs, outputs, regions and check points of each method.

    Examples
    --------
    >>> import mechaudit
    >>> "faddeeva" in [m["name"] for m in mechaudit.methods()]
    True
    """
    return _mechaudit.methods()


class Description:
    """How a method's callables are called."""

    def __init__(self, method: Any) -> None:
        # A study is found by a key of its own: the file of its name may have changed.
        self.key = method if isinstance(method, str) else getattr(method, "_key", method)
        facts = _mechaudit.method(self.key)
        self.name: str = facts["name"]
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
        return str(self.inputs[k]).split(" (")[0].split("[")[0]

    def arguments(self, block: Any) -> tuple[Any, ...]:
        """The arguments of a vectorised callable for the rows of a block."""
        if self.is_complex:
            return (complex_of(block),)
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


def complex_of(block: Any) -> Any:
    z = np.empty(len(block), dtype=np.complex128)
    # Not re + 1j*im, which loses the signs of zeros and makes NaN of infinities.
    z.real, z.imag = block[:, 0], block[:, 1]
    return z


def numbers_of(description: Description, answer: Any, outputs: Sequence[str]) -> list[float]:
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
    return flat(answer)


def flat(answer: Any) -> list[float]:
    if isinstance(answer, Mapping):
        answer = list(answer.values())
    if isinstance(answer, (tuple, list)):
        return [x for part in answer for x in flat(part)]
    array = np.asarray(answer)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"the answer holds {array.dtype}, real numbers are due")
    return [float(x) for x in array.reshape(-1)]


def block_answers(description: Description, answer: Any, count: int, outputs: Sequence[str]) -> Any:
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
