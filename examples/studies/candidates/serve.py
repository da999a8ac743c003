"""Answers the lines of `mechaudit audit FILE --exec` by a function of floats."""

import sys


def serve(name, function):
    """Calls a function of all inputs for each line, and prints its value or its tuple of values."""
    print(f"# name: {name}")
    for line in sys.stdin:
        if line.startswith("#"):
            continue
        try:
            values = function(*(float.fromhex(field) for field in line.split(",")))
            values = values if isinstance(values, tuple) else (values,)
            print(",".join(float(value).hex() for value in values))
        except (OverflowError, ZeroDivisionError, ValueError) as e:
            print(f"refuse {e}")
