"""Shares a program out among Dask's workers, then merges.

    pip install "dask[distributed]"
    python3 dask_sweep.py 64 -- branched-pendulum cascade --starts 640 --threads 1 --output sweep
    python3 dask_sweep.py 64 --scheduler tcp://host:8786 -- …    (a cluster that is there)

All workers must see the output folder. Killed and started again, it computes what is missing.
"""

import argparse
import subprocess
import sys

from dask.distributed import Client


def shard(program, index, shards):
    subprocess.run(program + ["--shard", f"{index}/{shards}"], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("shards", type=int)
    parser.add_argument("--scheduler", help="address; without one, this machine's cores")
    parser.usage = "%(prog)s [options] shards -- program arguments"
    words = sys.argv[1:]
    place = words.index("--") if "--" in words else len(words)
    given, program = parser.parse_args(words[:place]), words[place + 1:]
    if not program:
        parser.error("no program behind --")
    with Client(given.scheduler) if given.scheduler else Client(threads_per_worker=1) as client:
        parts = [client.submit(shard, program, index, given.shards, pure=False, retries=2)
                 for index in range(given.shards)]
        client.gather(parts)
    return subprocess.run(program + ["--merge", str(given.shards)]).returncode


if __name__ == "__main__":
    sys.exit(main())
