#!/usr/bin/env bash
# The fixture scenes in other languages: README.md beside this file.
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=target/languages
rm -rf "$folder/scenes"
mkdir -p "$folder/scenes"
[ -d "$folder/venv" ] || python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet 'numpy>=2' 'tree-sitter==0.26.*' 'tree-sitter-julia==0.23.*'

# Run: C, NumPy and Julia against the interpreter. None of the tool's own tests is of this name,
# but the tool is built for them.
PATH="$PWD/$folder/venv/bin:$PATH" cargo test --workspace --test stages --test tool \
    all_scenes_in_all_languages -- --nocapture

# Written by the tool. Scenes in loops have no functions in Julia, and say so.
loops=0
for scene in tests/fixtures/scenes/*.rs; do
    name="$folder/scenes/$(basename "$scene" .rs)"
    target/debug/cargo-branched-pendulum emit latex "$scene" --output "$name.tex"
    if ! message=$(target/debug/cargo-branched-pendulum emit julia "$scene" --output "$name.jl" 2>&1); then
        grep -qF "loops have no functions in other languages" <<< "$message" || {
            echo "$message" >&2
            exit 1
        }
        loops=$((loops + 1))
    fi
done
echo "$loops scenes in loops, which are not written in Julia"
"$folder/venv/bin/python" tests/languages/julia_parses.py "$folder"/scenes/*.jl

if command -v pdflatex > /dev/null; then
    latex=(pdflatex -interaction=nonstopmode -halt-on-error -output-directory="$folder/scenes")
elif command -v tectonic > /dev/null; then
    latex=(tectonic --outdir "$folder/scenes")
else
    echo "not checked: LaTeX; there is neither pdflatex nor tectonic" \
        "(Debian: apt-get install texlive-latex-base)"
    exit 0
fi
count=0
for document in "$folder"/scenes/*.tex; do
    if ! "${latex[@]}" "$document" > "$document.txt" 2>&1 || grep -q Overfull "$document.txt"; then
        echo "$document is not compiled, or runs off the page:" >&2
        tail -n 30 "$document.txt" >&2
        exit 1
    fi
    count=$((count + 1))
done
echo "LaTeX: $count documents are compiled by ${latex[0]}"
