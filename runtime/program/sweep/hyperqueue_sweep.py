"""Shares a program out among HyperQueue's workers on this machine, then merges.

    pip install hyperqueue
    python3 hyperqueue_sweep.py 64 --workers 2 -- branched-pendulum cascade --starts 640 --threads 1 --output sweep

Killed and started again, it computes what is missing. On a cluster, `hq server start` and
`hq alloc add slurm` take the place of LocalCluster: Client(server_dir) finds them.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

from hyperqueue import Job
from hyperqueue.cluster import LocalCluster, WorkerConfig


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("shards", type=int)
    parser.add_argument("--workers", type=int, default=2)
    parser.usage = "%(prog)s [options] shards -- program arguments"
    words = sys.argv[1:]
    place = words.index("--") if "--" in words else len(words)
    given, program = parser.parse_args(words[:place]), words[place + 1:]
    if not program:
        parser.error("no program behind --")
    with tempfile.TemporaryDirectory() as folder, LocalCluster() as cluster:
        for _ in range(given.workers):
            cluster.start_worker(WorkerConfig(cores=1))
        client = cluster.client()
        job = Job(default_workdir=Path(folder))
        for index in range(given.shards):
            shard = program + ["--shard", f"{index}/{given.shards}"]
            job.program(shard, cwd=Path.cwd(), stdout=None, stderr=None)
        client.wait_for_jobs([client.submit(job)])
    return subprocess.run(program + ["--merge", str(given.shards)]).returncode


if __name__ == "__main__":
    sys.exit(main())
