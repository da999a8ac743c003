"""What the scripts of independent values have in common: write the table, or compare it."""
import os
import pathlib
import sys

import mpmath as mp


def run(script, table, program=f"mpmath {mp.__version__}"):
    """Writes `table()` beside the script, with `.csv` for `.py`; with `--check` compares instead."""
    path = pathlib.Path(script).with_suffix(".csv")
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(f"unknown argument {sys.argv[1]!r}: only --check is known")
    text = table()
    if not sys.argv[1:]:
        temporary = path.with_suffix(".tmp")
        temporary.write_text(text)
        os.replace(temporary, path)
    elif path.read_text() != text:
        sys.exit(f"{path.name} differs from what {program} gives")
    else:
        print(f"{path.name}: {text.count(chr(10)) - 1} rows as recorded")
