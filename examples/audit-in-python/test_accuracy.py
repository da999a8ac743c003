"""sweep() against certified references: `pip install pytest && pytest`, with mechaudit on the path."""

import json
import shlex
import subprocess
import sys
from pathlib import Path

CANDIDATE = Path(__file__).with_name("candidate.py")


def audit(method, command, *options):
    """The report on a candidate, and what was said of it."""
    arguments = ["mechaudit", "audit", method, "--format", "json", *options, "--exec", command]
    done = subprocess.run(arguments, capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    return json.loads(done.stdout)


def test_every_region_is_within_budget():
    report = audit("tridiagonal", shlex.join([sys.executable, str(CANDIDATE)]), "--cases", "50")
    (method,) = report["methods"]
    failing = [f"{f['judgement']['reason']}\n{f['reproduce']}" for f in method["failures"]]
    assert report["passed"], "\n".join(failing[:10])


def test_silence_is_no_pass():
    """An audit that cannot fail would be worth nothing."""
    assert not audit("tridiagonal", "false", "--cases", "5")["passed"]
