"""Campaigns on Dask: real workers in processes of their own, killed, stopped and resumed. Each sum has to be that of a
run in one process, byte for byte.

The program is `MECHAUDIT_BINARY`, or what stands in `target/`.
"""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytest.importorskip("distributed")

ROOT = Path(__file__).parents[2]
BUILT = [ROOT / "target" / profile / "mechaudit" for profile in ("release", "debug")]
BINARY = os.environ.get("MECHAUDIT_BINARY") or next((str(b) for b in BUILT if b.exists()), None)
#: The module, or its file where the package is not installed.
MODULE = os.environ.get("MECHAUDIT_CAMPAIGN", "").split() or ["-m", "mechaudit.campaign"]

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(BINARY is None, reason="needs the program: cargo build"),
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="sends signals"),
]

#: Some ten seconds of a debug build.
PLAN = """
name = "dask"
[[part]]
methods = ["slider-crank", "erf"]
cases = 400
[[part]]
kind = "hunt"
methods = ["four-bar"]
hunts = 40
evaluations = 40
"""
SHARDS = 20
#: Anything that waits longer than this has gone wrong.
PATIENCE = 120


def program(*arguments, code=0):
    found = subprocess.run([BINARY, "campaign", *arguments], capture_output=True, check=False, timeout=PATIENCE)
    assert found.returncode == code, found.stderr
    return found.stdout


@pytest.fixture(scope="module")
def due(tmp_path_factory):
    """The sum of a run in one process, in one shard."""
    folder = tmp_path_factory.mktemp("one")
    (folder / "plan.toml").write_text(PLAN)
    whole = str(folder / "whole")
    program("plan", str(folder / "plan.toml"), "--shards", "1", "--output", whole)
    program("run", whole)
    return program("merge", whole)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "plan.toml").write_text(PLAN)
    made = tmp_path / "campaign"
    program("plan", str(tmp_path / "plan.toml"), "--shards", str(SHARDS), "--output", str(made))
    return made


@pytest.fixture
def begun(tmp_path):
    """Starts processes that end with the test."""
    processes = []

    def begin(*arguments, **options):
        log = open(tmp_path / f"log-{len(processes)}", "wb")
        process = subprocess.Popen(
            arguments, stdout=log, stderr=subprocess.STDOUT, start_new_session=True, cwd=tmp_path, **options
        )
        processes.append(process)
        process.log = Path(log.name)
        return process

    yield begin
    for process in processes:
        for signal_ in (signal.SIGCONT, signal.SIGKILL):
            try:
                os.killpg(process.pid, signal_)
            except ProcessLookupError:
                break
        process.wait()


def dask(begun, *arguments):
    return begun(sys.executable, "-m", "distributed.cli." + arguments[0], *arguments[1:])


def scheduler(begun, tmp_path, name="scheduler"):
    """A scheduler, and the file with its address."""
    file = tmp_path / f"{name}.json"
    process = dask(begun, "dask_scheduler", "--port", "0", "--dashboard-address", ":0", "--scheduler-file", str(file))
    until(file.exists)
    return process, str(file)


def worker(begun, file):
    """A worker that nobody restarts."""
    return dask(
        begun, "dask_worker", "--scheduler-file", file, "--nthreads", "1", "--no-nanny", "--no-dashboard"
    )


def client(begun, *arguments, binary=None):
    return begun(sys.executable, *MODULE, *arguments, "--binary", binary or BINARY)


def until(condition, run=None):
    """Waits for a condition, as long as a process runs."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end
        assert run is None or run.poll() is None, run.log.read_text()
        time.sleep(0.01)


def done(folder):
    return len(list((folder / "shards").glob("*.json")))


def ended(process, code=0):
    assert process.wait(timeout=PATIENCE) == code, process.log.read_text()
    return process.log.read_text()


def test_local_workers_and_a_shared_folder(folder, begun, due):
    ended(client(begun, str(folder), "--local", "2", "--batch", "3", "--shared"))
    assert program("merge", str(folder)) == due
    # Nothing is done twice.
    assert "0 shards done" in ended(client(begun, str(folder), "--local", "1"))


def test_a_worker_killed_in_the_middle_and_one_stopped(folder, begun, due, tmp_path):
    _, file = scheduler(begun, tmp_path)
    killed, stopped = worker(begun, file), worker(begun, file)
    run = client(begun, str(folder), "--scheduler", file)
    until(lambda: done(folder) >= 2, run)
    os.killpg(stopped.pid, signal.SIGSTOP)
    os.kill(killed.pid, signal.SIGKILL)
    third = worker(begun, file)
    at = done(folder)
    until(lambda: done(folder) >= min(at + 4, SHARDS - 2), run)
    os.killpg(stopped.pid, signal.SIGCONT)
    ended(run)
    assert killed.wait() == -signal.SIGKILL and third.poll() is None
    assert program("merge", str(folder)) == due
    assert done(folder) == SHARDS == len(list((folder / "shards").iterdir()))


def test_the_scheduler_killed_and_the_campaign_taken_up(folder, begun, due, tmp_path):
    process, file = scheduler(begun, tmp_path)
    worker(begun, file)
    run = client(begun, str(folder), "--scheduler", file)
    until(lambda: done(folder) >= 3, run)
    os.kill(process.pid, signal.SIGKILL)
    said = ended(run, code=2)
    assert "mechaudit.campaign: " in said
    before = done(folder)
    assert 3 <= before < SHARDS
    program("status", str(folder), code=1)
    _, file = scheduler(begun, tmp_path, "second")
    worker(begun, file)
    # A shard that is not whole is done again.
    half = folder / "shards" / "000000.json"
    half.write_bytes(half.read_bytes()[:-100])
    ended(client(begun, str(folder), "--scheduler", file))
    assert program("merge", str(folder)) == due


def test_a_task_that_dies_three_times_is_named_and_the_rest_goes_on(folder, begun, due, tmp_path):
    deadly = tmp_path / "deadly"
    count = tmp_path / "deaths"
    deadly.write_text(
        f'#!/bin/sh\ncase "$*" in *"--shard 4-4") echo >> {count}; kill -9 $PPID;; esac\nexec {BINARY} "$@"\n'
    )
    deadly.chmod(0o755)
    said = ended(client(begun, str(folder), "--local", "2", binary=str(deadly)), code=1)
    assert "shards 4 to 4: " in said and "19 shards done, 1 given up." in said
    # Three times, and three times alone.
    assert len(count.read_text().splitlines()) == 6
    assert done(folder) == SHARDS - 1
    ended(client(begun, str(folder), "--local", "1"))
    assert program("merge", str(folder)) == due


def test_what_the_program_refuses_is_said(folder, begun, tmp_path):
    ended(client(begun, str(tmp_path), "--local", "1"), code=2)
    ended(client(begun, str(folder), "--local", "1", binary="/nowhere/mechaudit"), code=2)
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(PLAN.replace("erf", "erff"))
    said = ended(client(begun, str(wrong), "--local", "1", "--output", str(tmp_path / "x")), code=2)
    assert 'there is no method "erff"' in said


def example(name):
    return ROOT / "examples" / "campaigns" / name


def test_hyperqueue(folder, begun, due, tmp_path):
    pytest.importorskip("hyperqueue")
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "mechaudit").symlink_to(BINARY)
    path = f"{tmp_path / 'bin'}:{os.environ['PATH']}"
    ended(begun(sys.executable, str(example("hyperqueue_local.py")), str(folder), "2", env={**os.environ, "PATH": path}))
    assert program("merge", str(folder)) == due


def test_the_job_that_slurm_gets(begun, tmp_path):
    """As far as it goes without Slurm: the job is what it is meant to be."""
    pytest.importorskip("dask_jobqueue")
    pytest.importorskip("mechaudit")
    show = "import sys; sys.path.insert(0, sys.argv[1])\nimport slurm_dask\nwith slurm_dask.cluster() as c: print(c.job_script())"
    job = ended(begun(sys.executable, "-c", show, str(example(""))))
    # The scheduler's address differs.
    job = re.sub(r"tcp://\S+", "tcp://HOST:PORT", job)
    assert [line for line in job.splitlines() if line] == example("slurm_dask.job").read_text().splitlines()
