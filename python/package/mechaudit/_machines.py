"""Linkages, run-ups and cams, as their files describe them."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from . import _checks as checks
from . import _mechaudit
from ._checks import number, whole
from ._exact import exact, hexadecimal
from .certified import _checked

__all__ = ["Cam", "Linkage", "Rows"]

#: As `mechaudit chirp --harmonics` has it.
_MOST_HARMONICS = 100_000


class Rows(np.ndarray[Any, Any]):
    """A structured array; the names of its fields end in their units."""

    def to_pandas(self) -> Any:
        """The rows as a `pandas.DataFrame`."""
        import pandas as pd

        return pd.DataFrame({name: np.asarray(self[name]) for name in self.dtype.names or ()})

    def plot(self, y: str | list[str] | None = None, x: str | None = None, ax: Any = None) -> Any:
        """Draw columns with matplotlib.

        Parameters
        ----------
        y : str or list of str, optional
            Columns; all but the first and the branch if not given.
        x : str, optional
            The abscissa, the first column if not given.
        ax : matplotlib.axes.Axes, optional
            Where; a new figure if not given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        names = list(self.dtype.names or ())
        if x is None:
            x = names[0]
        chosen = [y] if isinstance(y, str) else y
        if chosen is None:
            chosen = [n for n in names if n not in (x, "branch")]
        for name in [x, *chosen]:
            if name not in names:
                raise ValueError(f"there is no column {name!r}; there are: {', '.join(names)}")
        if ax is None:
            import matplotlib.pyplot as plt

            _, ax = plt.subplots()
        for name in chosen:
            ax.plot(np.asarray(self[x]), np.asarray(self[name]), label=name)
        ax.set_xlabel(x)
        if len(chosen) == 1:
            ax.set_ylabel(chosen[0])
        else:
            ax.legend()
        return ax

    def __array_finalize__(self, obj: Any) -> None:
        pass


def _rows(table: tuple[list[str], Any]) -> Rows:
    names, values = table
    kinds = [(n, np.int64 if n == "branch" else np.float64) for n in names]
    # In the memory of the table, which nobody else has.
    seen: Rows = values.view(kinds).reshape(len(values)).view(Rows)
    return seen


def _source(description: str | os.PathLike[str] | Mapping[str, Any]) -> tuple[str, bool]:
    """The text of a description, and whether it is JSON."""
    if isinstance(description, Mapping):
        return json.dumps(description), True
    if not isinstance(description, (str, os.PathLike)):
        raise TypeError(f"a description is a path, a text or a dictionary, got {description!r}")
    if isinstance(description, os.PathLike) or "\n" not in description:
        path = Path(description)
        return path.read_text(encoding="utf-8"), path.suffix == ".json"
    return description, description.lstrip().startswith("{")


def _angles(phi: Any) -> Any:
    angles = np.atleast_1d(np.asarray(phi, dtype=np.float64))
    if angles.ndim != 1:
        raise ValueError(f"phi must have one dimension, got {angles.ndim}")
    return np.ascontiguousarray(angles)


class Linkage:
    """A linkage: class III, four-bar or slider-crank.

    Made by `from_toml` or `from_dict`. Crank angles are in degrees; every quantity of a description
    is a string with its unit.

    Examples
    --------
    >>> from mechaudit import Linkage
    >>> linkage = Linkage.from_dict({
    ...     "type": "four-bar",
    ...     "geometry": {"crank": "2 cm", "coupler": "7 cm", "rocker": "9 cm", "frame": "6 cm"},
    ... })
    >>> rows = linkage.sweep([0, 90])
    >>> rows.dtype.names[:3]
    ('phi1_deg', 'branch', 'phi2_deg')
    """

    def __init__(self, compiled: _mechaudit.Linkage, text: str, is_json: bool) -> None:
        self._compiled = compiled
        self._text = text
        self._is_json = is_json

    @classmethod
    def from_toml(cls, source: str | os.PathLike[str]) -> Linkage:
        """Read a description in TOML (or JSON): the path of a file, or the text itself.

        Raises
        ------
        ValueError
            The description is refused; the message names the value, the rule and the line.
        """
        text, is_json = _source(source)
        return cls(_mechaudit.Linkage(text, is_json), text, is_json)

    @classmethod
    def from_dict(cls, description: Mapping[str, Any]) -> Linkage:
        """Take a description as a dictionary: the tables of the file."""
        text, is_json = _source(description)
        return cls(_mechaudit.Linkage(text, is_json), text, is_json)

    @property
    def name(self) -> str | None:
        """Its name, if the description gives one."""
        return self._compiled.name

    @property
    def type(self) -> str:
        """'class-iii', 'four-bar', 'slider-crank' or 'planar'."""
        return self._compiled.kind

    def modes(self, phi: float) -> Rows:
        """All assembly modes at a crank angle in degrees (a displacement in metres), a row for each."""
        return _rows(self._compiled.modes(number("phi", phi)))

    def sweep(self, phi: Any, branch: int | None = None) -> Rows:
        """A row for each crank angle, following one branch.

        Parameters
        ----------
        phi : array_like
            Crank angles in degrees, or displacements of the drive in metres, followed in this order.
        branch : int, optional
            Its number among the modes at the description's start angle, or at the first angle; the
            description's own if not given.

        Returns
        -------
        Rows
            NaN where the branch does not reach.
        """
        return _rows(self._compiled.sweep(_angles(phi), checks.branch(branch)))

    def certified(self, phi: Any, digits: int = 20, branch: int | None = None) -> dict[str, str | None]:
        """Certified digits of the row at a value of the drive.

        Parameters
        ----------
        phi : number or str
            The crank angle in degrees, or the displacement in metres that drives the linkage, taken
            exactly.
        digits : int
            Significant digits.
        branch : int, optional
            As for `sweep`.

        Returns
        -------
        dict
            Decimals by column; the last digit is wrong by at most 0.51 units. None where they could
            not be proved.

        Raises
        ------
        DomainError
            The branch does not reach the value.
        Undecided
            No position could be proved.
        """
        angle = hexadecimal(exact("phi", phi))
        return dict(self._compiled.certified(angle, _checked(digits), checks.branch(branch)))

    def run_up(self, *, tolerance: float | None = None) -> Rows:
        """The machine's motion under its motor: the description has tables for motor, load and run.

        Parameters
        ----------
        tolerance : float, optional
            Instead of the description's.

        Returns
        -------
        Rows
            Over time; the attribute `outcome` says how the run ended.
        """
        if tolerance is not None:
            tolerance = number("tolerance", tolerance)
        table, outcome = _mechaudit.run_up(self._text, self._is_json, tolerance)
        rows = _rows(table)
        rows.outcome = outcome  # type: ignore[attr-defined]
        return rows

    def __reduce__(self) -> tuple[Any, ...]:
        return _linkage, (self._text, self._is_json)

    def __repr__(self) -> str:
        name = f" {self.name!r}" if self.name else ""
        return f"<Linkage{name}: {self.type}>"

    def svg(self, branch: int | None = None) -> str:
        """A drawing of one branch: several positions, and the paths of the joints.

        Parameters
        ----------
        branch : int, optional
            Its number among the modes at the description's start, or at 0; the description's own if not
            given.
        """
        return self._compiled.svg(checks.branch(branch))

    def _repr_html_(self) -> str:
        try:
            return self.svg()
        except ValueError:
            # No branch is chosen, or it cannot be assembled where it starts.
            return f"<code>{_escaped(repr(self))}</code>"


def _escaped(text: str) -> str:
    import html

    return html.escape(text)


def _linkage(text: str, is_json: bool) -> Linkage:
    return Linkage(_mechaudit.Linkage(text, is_json), text, is_json)


class Cam:
    """A cam-driven oscillator whose shaft changes speed.

    Parameters
    ----------
    source : str, path or dict
        Its description: the path of a file in TOML or JSON, its text, or its tables.
    harmonics : int, optional
        Harmonics of the cam's displacement, instead of the description's.
    """

    def __init__(
        self, source: str | os.PathLike[str] | Mapping[str, Any], *, harmonics: int | None = None
    ) -> None:
        if harmonics is not None:
            harmonics = whole("harmonics", harmonics, 1, _MOST_HARMONICS)
        text, is_json = _source(source)
        self._arguments = (text, is_json, harmonics)
        self._compiled = _mechaudit.Cam(text, is_json, harmonics)

    @property
    def name(self) -> str:
        """Its name."""
        return self._compiled.name

    @property
    def law(self) -> str:
        """The name of the cam's law."""
        return self._compiled.law

    @property
    def harmonics(self) -> int:
        """Harmonics that are taken."""
        return self._compiled.harmonics

    def response(self, t: Any) -> Rows:
        """The motion at times in seconds, a row for each."""
        times = np.atleast_1d(np.asarray(t, dtype=np.float64))
        if times.ndim != 1:
            raise ValueError(f"t must have one dimension, got {times.ndim}")
        return _rows(self._compiled.response(np.ascontiguousarray(times)))

    def __reduce__(self) -> tuple[Any, ...]:
        return _cam, self._arguments

    def __repr__(self) -> str:
        return f"<Cam {self.name!r}: {self.law}, {self.harmonics} harmonics>"


def _cam(text: str, is_json: bool, harmonics: int | None) -> Cam:
    cam = Cam.__new__(Cam)
    cam._arguments = (text, is_json, harmonics)
    cam._compiled = _mechaudit.Cam(text, is_json, harmonics)
    return cam
