#!/bin/sh
#SBATCH --job-name=mechaudit-campaign
#SBATCH --array=0-499
#SBATCH --cpus-per-task=1
#SBATCH --time=00:30:00
#SBATCH --mem=1G
#SBATCH --requeue
# A Slurm array, a shard for each of its tasks: sbatch slurm-array.sh DIR, DIR planned with --shards 500. What a
# time limit or a lost node leaves undone, the same command does.
exec mechaudit campaign run "$1" --shard "$SLURM_ARRAY_TASK_ID" --jobs "${SLURM_CPUS_PER_TASK:-1}"
