"""Files: whole or not at all, by the writer of the program; what is there stays what it is."""

import os
import stat
import subprocess
import sys
import threading

import mechaudit
import pytest

pytestmark = [
    pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs references"),
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="devices, FIFOs and links as Linux has them"),
]


def writers():
    """Everything that writes a file: its name and a call with a path."""
    report = mechaudit.audit("voigt", mechaudit.special.voigt_profile, cases=1, progress=False)
    vectors = mechaudit.vectors("voigt", 1, 10)
    return {"html": report.html, "csv": vectors.to_csv, "npz": vectors.to_npz}


@pytest.fixture(scope="module")
def all_writers():
    return writers()


@pytest.fixture(params=["html", "csv", "npz"])
def write(request, all_writers):
    return all_writers[request.param]


def test_a_device_is_written_to_and_stays_one(write):
    write("/dev/null")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)
    with pytest.raises(OSError, match="No space left") as failed:
        write("/dev/full")
    assert failed.value.filename == "/dev/full" and failed.value.errno == 28
    assert stat.S_ISCHR(os.lstat("/dev/full").st_mode)


def test_a_device_behind_a_link(write, tmp_path):
    link = tmp_path / "link"
    link.symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space left"):
        write(link)
    assert link.is_symlink()


def test_a_link_is_written_through(write, tmp_path):
    write(tmp_path / "plain")
    due = (tmp_path / "plain").read_bytes()
    (tmp_path / "far").mkdir()
    target = tmp_path / "far" / "target"
    target.write_text("before")
    target.chmod(0o600)
    (tmp_path / "second").symlink_to("far/target")
    (tmp_path / "first").symlink_to("second")
    (tmp_path / "dangling").symlink_to("far/new")
    write(tmp_path / "first")
    write(tmp_path / "dangling")
    assert all((tmp_path / name).is_symlink() for name in ("first", "second", "dangling"))
    for file in (target, tmp_path / "far" / "new"):
        # A compressed archive holds the time.
        assert file.read_bytes()[:2] == due[:2] and len(file.read_bytes()) == len(due)
    assert stat.S_IMODE(target.stat().st_mode) == 0o600


def test_a_pipe_is_written_to(write, tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    read = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()))
    reader.start()
    write(pipe)
    reader.join(timeout=60)
    assert read and len(read[0]) > 100
    assert stat.S_ISFIFO(os.stat(pipe).st_mode) and os.listdir(tmp_path) == ["pipe"]


def test_a_file_keeps_its_names_and_appears_whole(write, tmp_path):
    (tmp_path / "one").write_text("before")
    os.link(tmp_path / "one", tmp_path / "other")
    write(tmp_path / "one")
    assert (tmp_path / "one").read_bytes() == (tmp_path / "other").read_bytes() != b"before"
    with pytest.raises(OSError):
        write(tmp_path / "none" / "file")
    with pytest.raises(OSError, match="it is a folder"):
        write(tmp_path)
    assert sorted(os.listdir(tmp_path)) == ["one", "other"]


def test_nobody_who_reads_a_pipe_is_waited_for_without_end(tmp_path):
    """Ctrl-C ends it."""
    os.mkfifo(tmp_path / "pipe")
    code = """
import signal, sys, threading, os, time
signal.signal(signal.SIGINT, signal.default_int_handler)
from mechaudit._files import write
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    write(sys.argv[1], "x")
except KeyboardInterrupt:
    print("interrupted")
"""
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "pipe")], capture_output=True, text=True, timeout=60
    )
    assert done.stdout.split() == ["interrupted"], done.stderr


def test_tables_of_xsref(tmp_path):
    pytest.importorskip("pyarrow")
    vectors = mechaudit.vectors("voigt", 1, 10)
    (tmp_path / "far").mkdir()
    name = "In_d_d_d-d.parquet"
    (tmp_path / name).symlink_to(f"far/{name}")
    first, second = vectors.to_parquet(tmp_path)
    assert first.is_symlink() and (tmp_path / "far" / name).exists() and not second.is_symlink()
