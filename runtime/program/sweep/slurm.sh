#!/usr/bin/env bash
# A program as a Slurm job array, a shard a task; merge when all are done:
#
#   sbatch --array=0-63 runtime/program/sweep/slurm.sh 64 branched-pendulum cascade --starts 640 --threads 1 --output sweep
#   branched-pendulum cascade --starts 640 --threads 1 --output sweep --merge 64
#
# Submitted again, for all shards or some (--array=3,17), it computes what is missing, from
# checkpoints where there are some.
#SBATCH --job-name=shards
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --output=%x-%A-%a.log
set -euo pipefail
shards="$1"
shift
exec "$@" --shard "$SLURM_ARRAY_TASK_ID/$shards"
