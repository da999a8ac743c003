"""A campaign on Slurm by Dask (`pip install 'mechaudit[campaign]' dask-jobqueue`): slurm_dask.py DIR

Workers come and go as the queue lets them; the client runs on the login node, or in a job of its own.
"""

import sys

import dask
from dask_jobqueue import SLURMCluster
from distributed import Client

from mechaudit import campaign

# A task that takes its worker along three times is given up; none waits beside one that is under way.
dask.config.set({"distributed.scheduler.allowed-failures": 2, "distributed.scheduler.worker-saturation": 1.0})


def cluster() -> SLURMCluster:
    return SLURMCluster(
        job_name="mechaudit-campaign",
        cores=16,
        processes=16,  # A worker for each core: the program computes on one.
        memory="16GB",
        walltime="04:00:00",
        job_extra_directives=["--requeue"],
        # Workers leave before Slurm ends them.
        worker_extra_args=["--lifetime", "225m", "--lifetime-stagger", "5m"],
        python="python3",
    )


if __name__ == "__main__":
    with cluster() as workers, Client(workers) as client:
        workers.adapt(maximum_jobs=64)
        outcome = campaign.run(sys.argv[1], client)
    sys.exit(not outcome.complete)
