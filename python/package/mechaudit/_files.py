"""Files that are whole or not there."""

from __future__ import annotations

import os

from ._mechaudit import write_file

__all__: list[str] = []


def write(path: str | os.PathLike[str], content: str | bytes) -> None:
    """Write a file with the program's own writer: whole or not at all; a device or FIFO stays one."""
    write_file(path, content.encode() if isinstance(content, str) else content)
