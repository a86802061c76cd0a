# Sourced by the run.sh beside: makes a package in a temporary folder that has the
# main.rs beside run.sh and depends on the runtime, and sets $repository, $folder and
# $expand.
cd "$(dirname "${BASH_SOURCE[0]}")/.."
repository="$PWD"

cargo build --quiet --package cargo-branched-pendulum
expand="$(realpath "${CARGO_TARGET_DIR:-target}")/debug/cargo-branched-pendulum"
folder="$(mktemp -d)"
trap 'rm -r "$folder"' EXIT

# Name of the package and of the folder of its main.rs.
package() {
    mkdir "$folder/src"
    cp "benches/$1/main.rs" "$folder/src"
    cp Cargo.lock "$folder"
    cat > "$folder/Cargo.toml" <<TOML
[package]
name = "$1"
edition = "2024"

[dependencies]
branched-pendulum = { path = "$repository/runtime", default-features = false, features = ["std"] }
branched-pendulum-timing = { path = "$repository/benches/timing" }
rand_xoshiro = "0.8"

[workspace]
TOML
}
