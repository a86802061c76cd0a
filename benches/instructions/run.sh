#!/usr/bin/env bash
# Instructions of one evaluation or step, as the tables in docs/performance.md. With --check
# compares them with those: fails where one has grown by more than 3 % or a row is missing.
# With --renew writes them there. Needs valgrind, and gungraun-runner in the version of
# gungraun in Cargo.lock.
set -euo pipefail
cd "$(dirname "$0")/../.."
page=docs/performance.md
folder="$(mktemp -d)"
trap 'rm -r "$folder"' EXIT

cargo bench --quiet -p branched-pendulum-instructions --features valgrind -- \
    --callgrind-metrics=ir --parallel > "$folder/log" || { cat "$folder/log"; exit 1; }
# Names are `instructions::counts::COLUMN ROW:...`; each count is of 64 passes.
awk '
    /^instructions::/ {
        column = $1; sub(/.*::/, "", column)
        row = $2; sub(/:.*/, "", row); gsub("_", " ", row)
        if (!(row in known)) { known[row] = column; rows[++count] = row }
    }
    /Instructions:/ { counts[row, column] = sprintf("%.0f", $2 / 64) }
    END {
        print "| model | accelerations | batch, for a state | energies |\n|---|---:|---:|---:|"
        for (i = 1; i <= count; i++) if (known[row = rows[i]] != "others")
            print "| " row " | " counts[row, "accelerations"] " | " counts[row, "batch"] \
                " | " counts[row, "energies"] " |"
        print "\n| paper\047s pendulum | instructions |\n|---|---:|"
        for (i = 1; i <= count; i++) if (known[row = rows[i]] == "others")
            print "| " row " | " counts[row, "others"] " |"
    }' "$folder/log" > "$folder/tables"

case "${1:-}" in
    --check)
        awk -F ' *[|] *' '
            FNR == 1 { file++ }
            # Of the page this section alone.
            file == 1 && /^## / { inside = /^## Instructions/ }
            file == 1 && inside { for (i = 3; i < NF; i++) old[$2, i] = $i }
            file == 2 && NF > 2 && $3 ~ /^[0-9]/ {
                for (i = 3; i < NF; i++) if (old[$2, i] == "" ? $i != "" : $i > 1.03 * old[$2, i]) {
                    print $2 ": " $i " instructions, not " (old[$2, i] == "" ? "in the table" : old[$2, i])
                    failed = 1
                }
            }
            END { exit failed }' "$page" "$folder/tables"
        ;;
    --renew)
        awk -F ' *[|] *' '
            FNR == NR { if ($3 ~ /^[0-9]/) new[$2] = $0; next }
            /^## / { inside = /^## Instructions/ }
            inside && $2 in new { print new[$2]; next }
            { print }' "$folder/tables" "$page" > "$folder/page"
        cp "$folder/page" "$page"
        ;;
    *) cat "$folder/tables" ;;
esac
