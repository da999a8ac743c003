"""The missing shards of a campaign by HyperQueue (`pip install hyperqueue`): hyperqueue_local.py DIR CPUS

On a cluster its own program does the same, from a server and workers that it starts:

    mechaudit campaign status DIR --missing > missing
    hq submit --each-line missing --crash-limit 3 -- sh -c 'mechaudit campaign run DIR --jobs 1 --shard "$HQ_ENTRY"'
"""

import subprocess
import sys

from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig

folder, cpus = sys.argv[1], int(sys.argv[2])
status = subprocess.run(["mechaudit", "campaign", "status", folder, "--missing"], capture_output=True, text=True)
with LocalCluster() as cluster:
    cluster.start_worker(WorkerConfig(cores=cpus))
    job = Job()
    for shard in status.stdout.split():
        job.program(["mechaudit", "campaign", "run", folder, "--jobs", "1", "--shard", shard])
    client = cluster.client()
    client.wait_for_jobs([client.submit(job)])
