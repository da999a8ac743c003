"""Files that are whole or not there."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

__all__: list[str] = []


def whole(path: str | os.PathLike[str], mode: str, write: Callable[[Any], Any]) -> None:
    """Write a file under another name, and give it its own once it is whole."""
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


def written_whole(path: str | os.PathLike[str], text: str) -> None:
    """Write a text."""
    whole(path, "w", lambda file: file.write(text))
