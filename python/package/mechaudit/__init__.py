"""Certified accuracy for numerical code, beside solvers that keep it."""

from __future__ import annotations

from . import special
from ._mechaudit import HAS_ORACLE, __version__

__all__ = ["HAS_ORACLE", "__version__", "special"]
