#!/usr/bin/env bash
# The job array of slurm.sh on a one-node Slurm of its own: README.md beside this file.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
PATH="$PATH:/usr/sbin:/sbin"
for program in munged slurmctld slurmd sbatch scontrol squeue scancel; do
    command -v "$program" > /dev/null || {
        echo "not run: there is no $program (Debian: apt-get install slurmctld slurmd slurm-client munge)" >&2
        exit 1
    }
done
. "$here/test_common.sh"

# Two tasks at once, whatever the machine has; nothing of a Slurm that is installed is touched.
start_slurm() {
    local host user port
    host=$(hostname -s)
    user=$(id -un)
    port=$((20000 + RANDOM % 10000))
    mkdir "$folder/state" "$folder/spool"
    (umask 077 && head -c 1024 /dev/urandom > "$folder/munge.key")
    export SLURM_CONF="$folder/slurm.conf"
    cat > "$SLURM_CONF" << CONF
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthInfo=socket=$folder/munge.socket
SlurmUser=$user
SlurmdUser=$user
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SlurmdParameters=config_overrides
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
KillWait=2
MailProg=/bin/true
NodeName=$host NodeAddr=127.0.0.1 CPUs=2
PartitionName=one Nodes=ALL Default=YES
CONF
    # munged takes no socket in a folder that others may not enter.
    chmod 711 "$folder"
    munged --foreground --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
        --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" \
        --seed-file="$folder/munge.seed" > "$folder/munged.log" 2>&1 &
    wait_until 20 test -S "$folder/munge.socket"
    slurmctld -D -i > "$folder/slurmctld.log" 2>&1 &
    slurmd -D > "$folder/slurmd.log" 2>&1 &
    wait_until 60 is_idle
}

is_idle() {
    [ "$(sinfo --noheader --format=%t 2> /dev/null)" = idle ]
}

stop() {
    local code=$?
    scancel --user="$(id -un)" 2> /dev/null && wait_until 20 is_done || true
    # The node first: it tells the controller that it goes.
    local daemons=($(jobs -p))
    kill "${daemons[@]}" 2> /dev/null || true
    wait
    end "$code"
}

# Submits the array, and prints the job's number.
submit() {
    (cd "$folder" && sbatch --parsable "--array=0-$((shards - 1))" "$here/slurm.sh" "$shards" \
        "${cascade[@]}" --output "$sweep")
}

is_done() {
    [ -z "$(squeue --noheader)" ]
}

# Index and job number of a task that runs.
running() {
    squeue --noheader --array --states=RUNNING --format='%K %A' | head -n 1
}

is_running() {
    [ -n "$(running)" ]
}

# lose COMMAND...: calls it with index and number of running tasks until one is lost on its way.
lose() {
    local index job
    for _ in {1..20}; do
        wait_until 60 is_running
        read -r index job <<< "$(running)"
        "$@" "$index" "$job" || continue
        sleep 1
        [ -e "$sweep/shard-$index-of-$shards/results.bin" ] || { lost=$index; return; }
    done
    echo "no task could be caught on its way" >&2
    return 1
}

requeue() {
    scontrol requeue "$2"
}

kill_process() {
    local pid
    pid=$(scontrol listpids "$2" | awk -v job="$2" '$2 == job { print $1 }' | head -n 1)
    [ -n "$pid" ] && kill -9 "$pid"
}

trap stop EXIT
start_slurm
one_process
job=$(submit)
wait_until 300 has_finished 16
lose requeue
requeued=$lost
lose kill_process
killed=$lost
echo "task $requeued requeued and task $killed killed after $(finished) of $shards shards"
# Slurm lets what was requeued wait for two minutes.
scontrol update JobId="${job}_$requeued" StartTime=now
wait_until 600 is_done
refused=$("${cascade[@]}" --output "$sweep" --merge "$shards" 2>&1) && exit 1
grep -F "1 of $shards shards are not finished: $killed" <<< "$refused"

# Once more, for all of them.
job=$(submit)
wait_until 600 is_done
there=$(grep -l "is there" "$folder/shards-$job"-*.log | wc -l)
echo "submitted again: $there of $shards shards were there"
[ "$there" -eq $((shards - 1)) ]
"${cascade[@]}" --output "$sweep" --merge "$shards" > "$folder/merge.log"
same_bytes
