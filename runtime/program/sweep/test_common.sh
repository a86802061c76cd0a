# What the tests of the engines share: a short sweep, in one process and cut into shards.
#
# Sourced; takes the arguments of the test. Leaves `cascade` (the command and its options, but
# for --output), `folder` (temporary) and the functions below.
[ -n "${1:-}" ] && [ -x "$1" ] || {
    echo "usage: $0 COMMAND, the binary branched-pendulum" >&2
    exit 2
}
shards=64
folder=$(mktemp -d)
cascade=("$(realpath "$1")" cascade --generations 3 --starts "$shards" --duration "${DURATION:-100}"
    --steps 128 --samples 8 --set friction=1e-4 --threads 1 --checkpoint 0)
sweep="$folder/sweep"

# Number of finished shards.
finished() {
    find "$sweep" -name results.bin 2> /dev/null | wc -l
}

has_finished() {
    [ "$(finished)" -ge "$1" ]
}

# wait_until SECONDS CONDITION...: looks twice a second, and gives up in words.
wait_until() {
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
        [ "$SECONDS" -lt "$end" ] || {
            echo "waited in vain for: $*" >&2
            return 1
        }
        sleep 0.5
    done
}

one_process() {
    "${cascade[@]}" --output "$folder/one-process" > "$folder/one-process.log"
}

# All tables, charts and words; records of a run name its arguments and its time.
same_bytes() {
    diff -r --exclude='shard-*' --exclude=sweep.json --exclude=run.json \
        "$folder/one-process" "$sweep"
    echo "$(find "$folder/one-process" -type f ! -name run.json | wc -l) files have the bytes of one process"
}

# end CODE: keeps the folder of a test that failed.
end() {
    if [ "$1" -eq 0 ]; then
        rm -rf "$folder"
    else
        echo "failed; what it wrote is in $folder" >&2
    fi
}
