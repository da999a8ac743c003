"""Pages written by the program, in Debian's Chromium.

Playwright drives it (waits for what is to happen, knows colour schemes, widths, print and the clipboard)
from its Python package, which brings its own driver: no Node.js has to be installed.
"""

import os
import shutil
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("MECHAUDIT", str(ROOT / "target/release/mechaudit"))
BROWSER = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")

# A candidate that is wrong in many ways: a series with too few terms, NaN, refusals, a name to be escaped.
BAD = ROOT / "tests/browser/bad_w.py"

# A campaign with every kind of part that a page shows.
PLAN = """
name = "pages"
[[part]]
methods = ["faddeeva", "erf"]
seeds = [1, 2]
cases = 5
[[part]]
methods = ["faddeeva"]
box = "Re z=0..8,Im z=log 1e-9..1"
cases = 50
[[part]]
kind = "hunt"
methods = ["four-bar"]
hunts = 2
evaluations = 100
"""

# The arguments of the program for each page, and the exit codes that are no accident.
PAGES = {
    "audit": (["audit", "--cases", "4"], [0]),
    "method": (["audit", "faddeeva", "--cases", "20"], [0]),
    "candidate": (["audit", "faddeeva", "--cases", "20", "--exec", f"{sys.executable} {BAD}"], [1]),
    "comparison": (
        ["compare", "faddeeva", "--cases", "10", "--with", "ours", "--exec", f"{sys.executable} {BAD}"],
        [1],
    ),
    "campaign": (["campaign", "report"], [0]),
    "paper": (["paper", "zinchenko"], [0]),
    "plain-paper": (["paper", "gembara-senyk"], [0]),
    "ledger": (["paper", "zinchenko", "--ledger"], [0]),
    "long-ledger": (["paper", "gembara-senyk", "--ledger"], [0]),
    "linkage": (["linkage", "examples/quick-return.toml", "--reactions"], [0]),
    "linkage-arc": (["linkage", "examples/no-full-turn.toml"], [0]),
    "run-up": (["runup", "examples/sand-screen-run-up.toml"], [0]),
    "work-precision": (["runup", "examples/four-bar-run-up.toml", "--work-precision"], [0]),
    "motion": (["motion", "examples/studies/motion/double-pendulum.toml", "--times", "0:10:0.05"], [0]),
    "chirp": (["chirp", "examples/chirp-run-up.toml"], [0]),
    "chirp-chart": (["chirp", "examples/chirp-chart.toml"], [0]),
}

# Every other linkage: opened, moved and measured.
LINKAGES = """andrews cylinder-boom double-butterfly four-bar jansen-leg n-four-bar peaucellier-cell pmksweb-91 pmksweb-92
rack-and-wheel sand-screen sand-screen-bodies slider-crank stephenson-1 stephenson-2 stephenson-3 watt-1 watt-2""".split()
MOVED = {f"linkage-{name}": (["linkage", f"examples/{name}.toml"], [0]) for name in LINKAGES}


def campaign(folder):
    """A campaign's folder, done in part."""
    plan, made = folder / "plan.toml", folder / "campaign"
    plan.write_text(PLAN)
    for step in (["plan", plan, "--shards", "4", "--output", made], ["run", made, "--shard", "0-2"]):
        subprocess.run([PROGRAM, "campaign", *step], check=True, capture_output=True)
    return made


@pytest.fixture(scope="session")
def written(tmp_path_factory):
    """Paths of all pages by name."""
    folder = tmp_path_factory.mktemp("pages")
    paths = {}
    for name, (arguments, codes) in (PAGES | MOVED).items():
        paths[name] = folder / f"{name}.html"
        form = ["--format", "html"]
        if name == "campaign":
            form = [campaign(folder)]
        command = [PROGRAM, *arguments, *form, "--output", paths[name]]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        assert done.returncode in codes, f"{command}: {done.returncode}\n{done.stderr}"
    return paths


@pytest.fixture(scope="session")
def browser():
    # Without its sandbox, which needs what a container does not grant; it opens these files alone.
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=BROWSER, args=["--no-sandbox"])
        yield browser
        browser.close()


@contextmanager
def visits(browser, written):
    """A function that opens a page from disk; at the end fails if one logged anything, or asked for anything else."""
    contexts, complaints = [], []

    def visit(name, width=1280, scheme="light", **options):
        context = browser.new_context(
            viewport={"width": width, "height": 900}, color_scheme=scheme, **options
        )
        contexts.append(context)
        page = context.new_page()
        own = written[name].as_uri()
        page.on("console", lambda m: complaints.append(f"{name}: {m.type}: {m.text}"))
        page.on("pageerror", lambda e: complaints.append(f"{name}: {e}"))
        page.on("request", lambda r: r.url.split("#")[0] == own or complaints.append(r.url))
        page.goto(own)
        return page

    yield visit
    for context in contexts:
        context.close()
    assert not complaints, "\n".join(complaints)


@pytest.fixture
def visit(browser, written):
    with visits(browser, written) as visit:
        yield visit


@pytest.fixture(scope="module", params=PAGES)
def page(request, browser, written):
    """Each page, opened once for all tests of a module that leave it as it is."""
    with visits(browser, written) as visit:
        yield visit(request.param)
