"""The package as a whole: documentation, stubs, licences, import, processes, memory."""

import doctest
import importlib
import importlib.metadata
import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
from pathlib import Path

import mechaudit
import numpy as np
import pytest
from mechaudit import special

PYTHON = Path(__file__).parents[1]
MODULES = ["", ".special", "._linear"]
if mechaudit.HAS_ORACLE:
    MODULES += ["._spline", ".certified", "._audit", "._compare", "._machines", "._methods", "._vectors"]
OPTIONS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def python(code, *arguments, **options):
    """Runs a program and gives what it printed."""
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code), *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=options.pop("timeout", 300),
        **options,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings(name):
    module = importlib.import_module(f"mechaudit{name}")
    failed, tried = doctest.testmod(module, optionflags=OPTIONS)
    assert not failed
    if name == ".certified":
        for function in ("wofz", "erf", "erfc", "erfcx", "erfi", "dawsn", "wofz_derivative"):
            assert run_examples(getattr(module, function), function) > 0


def run_examples(thing, name):
    finder = doctest.DocTestParser()
    test = finder.get_doctest(textwrap.dedent(thing.__doc__), {}, name, None, 0)
    runner = doctest.DocTestRunner(optionflags=OPTIONS)
    runner.run(test)
    assert runner.summarize(verbose=False).failed == 0
    return len(test.examples)


def test_examples_of_the_ufuncs():
    for name in special.__all__:
        assert run_examples(getattr(special, name), name) > 0


def test_examples_of_the_readme():
    if mechaudit.HAS_ORACLE:
        failed, tried = doctest.testfile(
            str(PYTHON / "README.md"), module_relative=False, optionflags=OPTIONS
        )
        assert tried > 10 and not failed


def test_docstrings_are_there_and_in_numpydoc_style():
    for name in mechaudit.__all__:
        thing = getattr(mechaudit, name)
        if callable(thing):
            assert thing.__doc__, name
    for name in special.__all__:
        doc = getattr(special, name).__doc__
        for heading in ("Parameters\n----------", "Returns\n-------", "Notes\n-----", "Examples\n--------"):
            assert heading in doc, (name, heading)


@pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="the stubs are those of the full build")
def test_stubs_and_types():
    config = str(PYTHON / "pyproject.toml")
    for command in (
        ["-m", "mypy", "--config-file", config, "-p", "mechaudit"],
        ["-m", "mypy.stubtest", "--mypy-config-file", config, "mechaudit"],
    ):
        done = subprocess.run([sys.executable, *command], capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stdout + done.stderr
    assert (Path(mechaudit.__file__).parent / "py.typed").exists()


def test_licences_are_installed():
    files = importlib.metadata.files("mechaudit") or []
    names = {Path(str(f)).name: f for f in files if "licenses" in str(f)}
    expected = {"LICENSE-MIT", "LICENSE-APACHE", "GPL-3.0.txt", "LGPL-3.0.txt", "GMP-and-MPFR.md"}
    assert expected <= names.keys()
    text = names["LGPL-3.0.txt"].read_text()
    assert "GNU LESSER GENERAL PUBLIC LICENSE" in text and "Version 3" in text
    assert "Relinking" in names["GMP-and-MPFR.md"].read_text()


def test_import_loads_little():
    """The modules that importing brings in beside NumPy; the README has the time measured."""
    code = """
        import sys, numpy
        before = set(sys.modules)
        import mechaudit
        print(*sorted(set(sys.modules) - before))
    """
    loaded = [name for name in python(code).split() if not hasattr(sys, name)]
    own = {name for name in loaded if name.partition(".")[0] == "mechaudit"}
    assert own == {"mechaudit", "mechaudit._mechaudit", "mechaudit.special"}
    assert len(loaded) <= 12, loaded


def test_notebook_runs(tmp_path):
    if not mechaudit.HAS_ORACLE:
        pytest.skip("needs references")
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    notebook = nbformat.read(PYTHON / "examples" / "tour.ipynb", as_version=4)
    nbformat.validate(notebook)
    assert not any(cell.get("outputs") for cell in notebook.cells)
    client = nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}})
    client.execute()
    kinds = {kind for c in notebook.cells for o in c.get("outputs", []) for kind in o.get("data", {})}
    assert "text/html" in kinds


def test_threads_share_nothing():
    z = np.random.default_rng(5).normal(size=(8, 20_000)).view(complex)
    due = special.wofz(z)
    found = [None] * 8

    def work(k):
        found[k] = [special.wofz(z[k]) for _ in range(5)][-1]

    threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    np.testing.assert_array_equal(np.stack(found), due)


def test_the_gil_is_released():
    """Python goes on while a loop runs."""
    z = np.full(4_000_000, 2.0 - 1.0j)
    ticks, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            ticks[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    # The count while one loop holds the interpreter cannot be much more than a switch.
    before = ticks[0]
    special.erf(z)
    during = ticks[0] - before
    stop.set()
    thread.join()
    assert during > 1000


def child(queue):
    import mechaudit

    answers = [str(special.wofz(1 + 1j))]
    if mechaudit.HAS_ORACLE:
        from mechaudit import certified

        answers.append(str(certified.erf([0.1, 0.2, 0.3], digits=30)))
        answers.append(mechaudit.audit("faddeeva", special.wofz, cases=5, progress=False).passed)
    queue.put(answers)


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_fork_after_threads_were_started():
    if "fork" not in multiprocessing.get_all_start_methods():
        pytest.skip("no fork here")
    context = multiprocessing.get_context("fork")
    mine, theirs = context.Queue(), context.Queue()
    child(mine)
    process = context.Process(target=child, args=(theirs,))
    process.start()
    try:
        assert theirs.get(timeout=120) == mine.get(timeout=10)
    finally:
        process.join(timeout=10)
        if process.is_alive():
            process.kill()
    assert process.exitcode == 0


@pytest.mark.skipif(os.name != "posix" or not mechaudit.HAS_ORACLE, reason="needs signals and references")
def test_interrupt():
    """Ctrl-C ends a long certification soon, and an audit with what was found."""
    code = """
        import threading, os, signal, sys, time
        import mechaudit
        from mechaudit import certified, special
        def after(seconds):
            time.sleep(seconds)
            os.kill(os.getpid(), signal.SIGINT)
        threading.Thread(target=after, args=(0.5,)).start()
        try:
            certified.erf([k / 7 for k in range(1, 10**6)], digits=200)
        except KeyboardInterrupt:
            print("interrupted")
        threading.Thread(target=after, args=(1.0,)).start()
        report = mechaudit.audit("faddeeva", special.wofz, cases=10**7, progress=False)
        print(report.interrupted, report.passed, report.cases > 0)
    """
    # A Python that runs in the background may ignore the signal.
    done = python(code, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler), timeout=120)
    assert done.split() == ["interrupted", "True", "False", "True"]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="limits its own memory as Linux has it")
def test_a_hundred_million_elements_in_bounded_memory(tmp_path):
    """In place on a file of 800 MB with 200 MB to spare: nothing as long as the array is allocated."""
    code = """
        import resource, sys
        import numpy as np
        from mechaudit import special
        z = np.memmap(sys.argv[1], dtype=np.complex64, mode="w+", shape=10**8)
        block = np.random.default_rng(1).normal(size=2 * 10**6).astype(np.float32).view(np.complex64)
        for k in range(100):
            z[k * 10**6 : (k + 1) * 10**6] = block
        data = int(next(l for l in open("/proc/self/status") if l.startswith("VmData")).split()[1])
        resource.setrlimit(resource.RLIMIT_DATA, ((data << 10) + (200 << 20),) * 2)
        special.wofz(z, out=z)
        due = special.wofz(block)
        print(all(np.array_equal(z[k * 10**6 : (k + 1) * 10**6], due) for k in (0, 57, 99)))
    """
    file = tmp_path / "large"
    try:
        assert python(code, file).strip() == "True"
    finally:
        file.unlink(missing_ok=True)
