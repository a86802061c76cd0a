#!/usr/bin/env bash
# dask_sweep.py on two workers, one of which is killed: README.md beside this file.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
python="${PYTHON:-python3}"
"$python" -c "import dask.distributed" 2> /dev/null || {
    echo "not run: $python has no Dask (pip install \"dask[distributed]\"; PYTHON names another)" >&2
    exit 1
}
. "$here/test_common.sh"

cluster="$folder/scheduler.json"
dask() {
    exec setsid "$python" -m dask "$@" --scheduler-file "$cluster"
}

stop() {
    local code=$?
    # Each is a group of its own, with what it started. Asked kindly, a worker waits for its
    # scheduler.
    for process in $(jobs -p); do
        kill -9 -- "-$process" 2> /dev/null || true
    done
    wait 2> /dev/null
    end "$code"
}

trap stop EXIT
dask scheduler --host 127.0.0.1 --port 0 --no-dashboard > "$folder/scheduler.log" 2>&1 &
wait_until 60 test -s "$cluster"
for number in 1 2; do
    dask worker --nthreads 1 --no-nanny --no-dashboard > "$folder/worker-$number.log" 2>&1 &
done
worker=$!
one_process
address=$("$python" -c "import json, sys; print(json.load(open(sys.argv[1]))['address'])" "$cluster")
setsid "$python" "$here/dask_sweep.py" "$shards" --scheduler "$address" -- \
    "${cascade[@]}" --output "$sweep" > "$folder/sweep.log" 2>&1 &
engine=$!
wait_until 300 has_finished 20
# The worker and the shard that it computes.
kill -9 -- "-$worker"
wait "$worker" 2> /dev/null || true
done_then=$(finished)
[ "$done_then" -lt "$shards" ]
echo "a worker of two killed after $done_then of $shards shards"
wait "$engine"
same_bytes
