"""Campaigns on a Dask cluster: the program ``mechaudit`` does the shards, Dask hands them out.

.. code-block:: sh

    python -m mechaudit.campaign plan.toml --output out --shards 500 --local 2
    python -m mechaudit.campaign out --scheduler tcp://host:8786

The folder is that of ``mechaudit campaign``: whatever is missing in it is done, so a campaign that was ended, whatever
ended it, is taken up by the same command, with Dask or without. Results come back to the client, which writes each
shard once, whole or not at all; with ``shared=True`` workers write into the folder themselves.

Needs the extra ``campaign`` (``distributed``, ``tqdm``) and the program, on the path of every worker or as ``binary``.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._checks import whole
from ._files import write

if TYPE_CHECKING:
    from distributed import Client as _Client

#: How often a task is tried before it is given up.
TRIALS = 3
#: Tasks in the scheduler's hands for each thread of the cluster: it never sees more of a large campaign.
AHEAD = 4
#: Shards of a campaign, as the program has it.
MOST_SHARDS = 1_000_000
#: Worker processes on one machine.
MOST_WORKERS = 1024
#: States of a task that will come to something.
UNDER_WAY = ("pending", "lost")


class CampaignError(RuntimeError):
    """The program refused, or the cluster is gone; what was done until then is in the folder."""


@dataclass
class Outcome:
    """What a run came to."""

    #: Shards written by this run.
    done: int = 0
    #: Shards whose tasks died or failed :data:`TRIALS` times, and how.
    lost: dict[int, str] = field(default_factory=dict)
    #: Whether every shard of the campaign is done.
    complete: bool = False


def _call(binary: str, *arguments: str, codes: Sequence[int] = (0,)) -> str:
    """The program's output; its own message if it refuses."""
    try:
        found = subprocess.run([binary, "campaign", *arguments], capture_output=True, text=True, check=False)
    except OSError as e:
        raise CampaignError(f"cannot start {binary}: {e.strerror}") from e
    if found.returncode not in codes:
        said = found.stderr.strip() or f"ended with status {found.returncode}"
        raise CampaignError(said.removeprefix("mechaudit: "))
    return found.stdout


def _shard(folder: Path, number: int) -> Path:
    return folder / "shards" / f"{number:06}.json"


def task(binary: str, plan: bytes | None, folder: str | None, numbers: range) -> dict[int, bytes]:
    """Does some shards, on a worker: their files' bytes, or nothing if they are in a shared folder.

    The program runs as a process of its own, so that whatever it does leaves the worker alone.
    """
    one = f"{numbers.start}-{numbers.stop - 1}"
    if folder is not None:
        _call(binary, "run", folder, "--jobs", "1", "--shard", one)
        return {}
    assert plan is not None
    # Beside the worker's own files, which the next worker removes if this one is killed.
    from distributed import get_worker

    try:
        place = get_worker().local_directory
    except ValueError:
        place = None
    with tempfile.TemporaryDirectory(prefix="mechaudit-", dir=place) as own:
        path = Path(own)
        (path / "plan.json").write_bytes(plan)
        (path / "shards").mkdir()
        _call(binary, "run", own, "--jobs", "1", "--shard", one)
        return {k: _shard(path, k).read_bytes() for k in numbers}


def _batches(numbers: Sequence[int], size: int) -> Iterator[range]:
    """Groups neighbours, at most `size` together."""
    start = None
    for at, k in enumerate(numbers):
        if start is None:
            start = k
        last = at + 1 == len(numbers) or numbers[at + 1] != k + 1
        if last or k + 1 - start == size:
            yield range(start, k + 1)
            start = None


def plan(file: str | Path, output: str | Path, *, shards: int = 64, binary: str = "mechaudit") -> Path:
    """Cuts a plan into shards: makes the campaign's folder, or finds it made."""
    shards = whole("shards", shards, 1, MOST_SHARDS)
    _call(binary, "plan", str(file), "--shards", str(shards), "--output", str(output))
    return Path(output)


def status(folder: str | Path, *, binary: str = "mechaudit") -> dict[str, Any]:
    """What ``mechaudit campaign status`` says."""
    found: dict[str, Any] = json.loads(_call(binary, "status", str(folder), "--format", "json", codes=(0, 1)))
    return found


def run(
    folder: str | Path,
    client: _Client,
    *,
    binary: str = "mechaudit",
    batch: int = 1,
    shared: bool = False,
    progress: bool | None = None,
) -> Outcome:
    """Does the shards that are missing on a cluster.

    `batch` shards go into a task: for shards shorter than a second. A task that dies or fails three times is given up
    and named in the outcome; the others go on. One that shared its workers with others is tried again alone first, at
    the end. (How often a task may take its worker along is the scheduler's to say:
    ``distributed.scheduler.allowed-failures`` of 2 for three times.)
    """
    from distributed import KilledWorker, as_completed, wait
    from tqdm import tqdm

    batch = whole("batch", batch, 1, MOST_SHARDS)
    folder = Path(folder)
    before = status(folder, binary=binary)
    missing: list[int] = before["missing"]
    for bad in before["bad"]:
        # Set aside, as the program does.
        file = _shard(folder, bad["shard"])
        os.replace(file, file.with_suffix(".json.aside"))
    outcome = Outcome()
    name = before["name"]
    given = None if shared else (folder / "plan.json").read_bytes()
    where = str(folder.resolve()) if shared else None
    # It goes with every task, a few kilobytes: data scattered to workers is lost with them.
    todo = _batches(missing, batch)
    numbers: dict[str, range] = {}

    def submitted(some: range, trial: str = "") -> Any:
        key = f"{name}-{some.start:06}{trial}"
        future = client.submit(task, binary, given, where, some, key=key, pure=False, retries=TRIALS - 1)
        numbers[key] = some
        return future

    def threads() -> int:
        found: dict[str, int] = client.nthreads()
        return max(sum(found.values()), 1)

    hidden = None if progress is None else not progress
    with tqdm(total=before["shards"], initial=before["done"], unit="shard", desc=name, disable=hidden) as bar:

        def taken(future: Any, alone: bool) -> range | None:
            """Writes what a task did; gives its shards if they are to be tried again alone."""
            some = numbers[future.key]
            if future.status == "finished":
                # Waits where the result went with its worker and is computed again.
                for k, found in future.result().items():
                    write(_shard(folder, k), found)
                outcome.done += len(some)
                bar.update(len(some))
            elif future.status == "cancelled":
                raise CampaignError("the scheduler is gone, or has dropped its tasks")
            else:
                why = future.exception()
                if isinstance(why, KilledWorker) and not alone:
                    return some
                text = " ".join(str(why).split()) or type(why).__name__
                outcome.lost.update(dict.fromkeys(some, text))
                tqdm.write(f"shards {some.start} to {some.stop - 1}: {text}", file=sys.stderr)
            return None

        ahead = AHEAD * threads()
        waiting = as_completed([submitted(some) for some in islice(todo, ahead)])
        suspects = []
        for future in waiting:
            if future.status in UNDER_WAY:
                # It was done, and went with its worker.
                waiting.add(future)
                continue
            if (suspect := taken(future, alone=False)) is not None:
                suspects.append(suspect)
            del numbers[future.key]
            future.release()
            for some in islice(todo, max(ahead - len(numbers), 0)):
                waiting.add(submitted(some))
        # Whose worker was killed may have stood beside the culprit.
        for suspect in suspects:
            future = submitted(suspect, "-alone")
            while future.status in UNDER_WAY:
                wait(future)
            taken(future, alone=True)
            future.release()
    after = status(folder, binary=binary)
    outcome.complete = not after["missing"]
    return outcome


def _counting(most: int) -> Callable[[str], int]:
    """The type of an argument that counts something."""

    def read(text: str) -> int:
        try:
            return whole("the number", int(text), 1, most)
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be a whole number from 1 to {most}, got {text!r}") from None

    return read


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m mechaudit.campaign",
        description="Does the shards of a campaign on a Dask cluster; mechaudit campaign merge adds them up.",
        epilog="Exit codes: 0, every shard is done; 1, some were given up; 2, bad usage, or the cluster is gone; "
        "130, Ctrl-C. The same command goes on.",
    )
    parser.add_argument("plan", metavar="PLAN", help="a plan, or the folder of a campaign")
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--scheduler", metavar="ADDRESS", help="a running scheduler: tcp://host:8786, or its file")
    where.add_argument("--local", metavar="N", type=_counting(MOST_WORKERS), help="N worker processes on this machine")
    parser.add_argument("--output", metavar="DIR", help="the campaign's folder, for a plan")
    shards = _counting(MOST_SHARDS)
    parser.add_argument("--shards", metavar="N", type=shards, default=64, help="how many, for a plan [64]")
    parser.add_argument("--batch", metavar="B", type=shards, default=1, help="shards of a task [1]")
    parser.add_argument("--shared", action="store_true", help="workers write into the folder themselves")
    parser.add_argument("--binary", metavar="FILE", help="the program, as workers find it [on the path]")
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """The command; gives its exit code."""
    args = _parser().parse_args(arguments)
    binary = args.binary or shutil.which("mechaudit")
    if binary is None:
        print("mechaudit.campaign: there is no mechaudit on the path, give --binary", file=sys.stderr)
        return 2
    try:
        distributed, _ = (importlib.import_module(name) for name in ("distributed", "tqdm"))
    except ImportError as e:
        print(f"mechaudit.campaign: needs {e.name}: pip install 'mechaudit[campaign]'", file=sys.stderr)
        return 2
    folder = Path(args.plan)
    try:
        if not folder.is_dir():
            if args.output is None:
                print("mechaudit.campaign: a plan needs --output DIR", file=sys.stderr)
                return 2
            folder = plan(args.plan, args.output, shards=args.shards, binary=binary)
        with _client(distributed, args.scheduler, args.local) as client:
            outcome = run(folder, client, binary=binary, batch=args.batch, shared=args.shared)
    except CampaignError as e:
        print(f"mechaudit.campaign: {e}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    except (OSError, TimeoutError, CancelledError) as e:
        # Also whatever distributed raises when its scheduler goes.
        print(f"mechaudit.campaign: {' '.join(str(e).split()) or type(e).__name__}", file=sys.stderr)
        return 2
    print(f"{outcome.done} shards done, {len(outcome.lost)} given up.")
    return 0 if outcome.complete else 1


def _client(distributed: Any, address: str | None, local: int | None) -> Any:
    """A client, with a cluster of its own if there is no address."""
    import dask

    # Three deaths of a worker end a task, as three exceptions do; none waits on a worker beside one that is under way,
    # whose deaths it would share.
    scheduler = "distributed.scheduler"
    dask.config.set({f"{scheduler}.allowed-failures": TRIALS - 1, f"{scheduler}.worker-saturation": 1.0})
    if address is None:
        # A worker waits for a process: there is nothing to profile in it, and its memory need not be watched closely.
        worker = "distributed.worker"
        dask.config.set({f"{worker}.profile.enabled": False, f"{worker}.memory.monitor-interval": "1s"})
        cluster = distributed.LocalCluster(n_workers=local, threads_per_worker=1, dashboard_address=":0")
        return distributed.Client(cluster)
    if Path(address).is_file():
        return distributed.Client(scheduler_file=address)
    return distributed.Client(address)


if __name__ == "__main__":
    sys.exit(main())
