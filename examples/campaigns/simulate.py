"""Where a scheduler or the merge becomes the limit of a campaign: simulate.py [--shards 1e5] [--workers 1000]

Events of a campaign on a cluster with one scheduler and one client, both serial: a task costs the scheduler and the
client `--task` seconds in all, a result costs the client `--write` seconds more (a file, synchronised), a worker starts
the program in `--start` seconds, and a shard takes `--shard` seconds, give or take a fifth. The merge reads a shard in
`--merge` seconds on one core. The defaults are what was measured; see the book's chapter on campaigns.
"""

import argparse
import heapq
import random


def campaign(shards, workers, seconds, batch, task, write, start, ahead=4):
    """Seconds until all results are written, and the share of the workers' time that was work."""
    rng = random.Random(1)
    tasks = -(-shards // batch)
    free = 0.0  # When scheduler and client have time again.
    given, done, busy = 0, 0, 0.0
    ends = []  # Tasks under way: their ends.
    queued = 0

    def begin(now):
        nonlocal busy
        work = sum(seconds * rng.uniform(0.8, 1.2) for _ in range(min(batch, 50))) * batch / min(batch, 50)
        busy += work
        heapq.heappush(ends, now + start + work)

    while given < min(tasks, ahead * workers):
        free += task
        given += 1
        if len(ends) < workers:
            begin(free)
        else:
            queued += 1
    while done < tasks:
        now = heapq.heappop(ends)
        # A queued task waits at the scheduler, which hands it over when it hears of the end.
        free = max(free, now) + task / 2
        if queued:
            queued -= 1
            begin(free)
        free += task / 2 + write * batch
        done += 1
        if given < tasks:
            given += 1
            queued += 1
            if len(ends) < workers:
                queued -= 1
                begin(free)
    return free, busy / (free * workers)


def main():
    number = lambda text: int(float(text))  # noqa: E731
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shards", type=number, default=100_000)
    parser.add_argument("--workers", type=number, default=1000)
    parser.add_argument("--shard", type=float, default=10.0)
    parser.add_argument("--task", type=float, default=0.012)
    parser.add_argument("--write", type=float, default=0.007)
    parser.add_argument("--start", type=float, default=0.05)
    parser.add_argument("--merge", type=float, default=0.001)
    args = parser.parse_args()
    ideal = args.shards * args.shard / args.workers
    print(f"{args.shards} shards of {args.shard} s on {args.workers} workers: {ideal:.0f} s at best")
    print(f"{'batch':>6} {'results':>10} {'seconds':>9} {'work':>7}")
    for batch in (1, 3, 10, 30):
        for name, write in (("client", args.write), ("shared", 0.0)):
            end, share = campaign(args.shards, args.workers, args.shard, batch, args.task, write, args.start)
            print(f"{batch:6d} {name:>10} {end:9.0f} {100 * share:6.1f}%")
    serial = args.shards * args.merge
    print(f"merge: {serial:.0f} s on one core, {serial / 16:.0f} s on 16 (each adds up a part, then the parts are added)")


if __name__ == "__main__":
    main()
