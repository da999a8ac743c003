"""Certified test vectors."""

from __future__ import annotations

import csv
import hashlib
import io
import os
from collections.abc import Iterable
from decimal import ROUND_CEILING, Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from . import _mechaudit, certified
from ._audit import drawn
from ._checks import whole
from ._files import write
from ._methods import Description

__all__ = ["Vectors", "vectors"]


#: Binary exponents up to which exact arithmetic is quick.
_WRITTEN_OUT = 1 << 14
#: More in a region take longer than anybody waits.
_MOST = 100_000

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

    def __init__(self, description: Description, digits: int) -> None:
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

        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow([*names, "proof"])
        for i in range(len(self)):
            row: list[str] = [self.regions[i], *(float(x).hex() for x in self.inputs[i])]
            for k in range(len(outputs)):
                row += [self.decimals[i][k], self.radii[i][k]]
            writer.writerow([*row, self.proofs[i]])
        write(path, text.getvalue())

    def to_npz(self, path: str | os.PathLike[str]) -> None:
        """All columns as arrays."""
        columns = {k: np.asarray(v) for k, v in self._columns().items()}
        content = io.BytesIO()
        save: Any = np.savez_compressed
        save(content, **columns)
        write(path, content.getvalue())

    def to_parquet(self, folder: str | os.PathLike[str]) -> tuple[Path, Path]:
        """Two tables in the layout of scipy's xsref: ``In_*.parquet`` and ``Out_*.parquet``.

        Returns
        -------
        tuple of Path
            The files. Metadata hold the types and the name of the function as there; the table of
            values also has, for each row, decimals, radii and the proof. ``fallback`` is False: no
            value comes from the code under test.
        """
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
        content = _parquet(pq, table)
        write(file_in, content)
        checksum = hashlib.sha256(content).hexdigest().encode()
        columns = {name: self.values[:, k] for k, name in enumerate(outputs)}
        columns["fallback"] = np.zeros(len(self), dtype=bool)
        for k, name in enumerate(outputs):
            columns[f"{name}_decimal"] = [row[k] for row in self.decimals]
            columns[f"{name}_radius"] = [row[k] for row in self.radii]
        columns["proof"] = self.proofs
        metadata[b"input_checksum"] = checksum
        metadata[b"mechaudit_version"] = _mechaudit.__version__.encode()
        values = pa.table(columns).replace_schema_metadata(metadata)
        write(file_out, _parquet(pq, values))
        return file_in, file_out


def _parquet(pq: Any, table: Any) -> bytes:
    content = io.BytesIO()
    pq.write_table(table, content, compression="zstd")
    return content.getvalue()


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
    n = whole("n", n, 1, _MOST)
    description = Description(method)
    if not description.fixed:
        raise ValueError(f"method: the inputs or outputs of {description.name} have no fixed number")
    run = drawn(description, n, seed, regions)
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
    if abs(x.size) > _WRITTEN_OUT:
        return float(x)
    low, high = (float(end) for end in x.interval)
    return low if low == high else None


def _upward(x: certified.Real) -> str:
    """A bound on the distance from the decimal to the true value: three digits, rounded up."""
    if abs(x.size) > _WRITTEN_OUT:
        # The ends of the interval are too long to be written out; half a unit of the last digit is a bound.
        return certified.written(certified.half_unit(x))
    low, high = x.interval
    at = Fraction(x.decimal)
    off = max(high - at, at - low)
    if not off:
        return "0"
    up = certified.context(3, ROUND_CEILING)
    return certified.written(up.divide(Decimal(off.numerator), Decimal(off.denominator)))
