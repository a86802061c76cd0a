//! The libraries and programs that `cargo test` compiles a second time, for unit tests, are those
//! that have unit tests.

use super::{PACKAGES, fixture};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Packages that have no modules worth a look at their order, in addition to [`PACKAGES`].
const OTHERS: &[&str] = &[
    "codegen/cli",
    "codegen/macros",
    "examples",
    "tests",
    "tests/compiler",
];

/// Packages with workspaces of their own, which `cargo test` does not build.
const OUTSIDE: &[&str] = &["runtime/python", "runtime/web"];

/// Tables of a manifest with the given head, as text.
fn tables<'m>(manifest: &'m str, head: &str) -> Vec<&'m str> {
    let parts = manifest.split("\n[").skip(1);
    let own = parts.filter_map(|part| part.strip_prefix(head)?.strip_prefix("]\n"));
    own.collect()
}

fn is_tested(table: &str) -> bool {
    !table.lines().any(|line| line == "test = false")
}

/// The Rust files below a folder; none if there is no such folder.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.expect("it can be read").path();
        match path.extension() {
            None => files(&path, found),
            Some(ending) if ending == "rs" => found.push(path),
            Some(_) => {}
        }
    }
}

fn with_tests(folder: &Path) -> BTreeSet<PathBuf> {
    let mut found = Vec::new();
    files(folder, &mut found);
    let has_tests = |file: &PathBuf| {
        let text = fs::read_to_string(file).expect("it can be read");
        text.lines().any(|line| line.trim_start() == "#[test]")
    };
    found.retain(has_tests);
    let absolute = found
        .iter()
        .map(|file| file.canonicalize().expect("it is there"));
    absolute.collect()
}

/// Modules of the library that integration tests compile as their own: the files after `#[path]`.
fn compiled_by_tests(package: &Path) -> BTreeSet<PathBuf> {
    let mut found = Vec::new();
    files(&package.join("tests"), &mut found);
    let mut compiled = BTreeSet::new();
    for file in found {
        let text = fs::read_to_string(&file).expect("it can be read");
        let paths = text.lines().filter_map(|line| {
            let path = line.trim_start().strip_prefix("#[path = \"")?;
            path.strip_suffix("\"]")
        });
        let folder = file.parent().expect("a file is in a folder");
        compiled.extend(paths.map(|path| folder.join(path).canonicalize().expect("it is there")));
    }
    compiled
}

/// True for one of these files, and for one in the folder of a `mod.rs` among them.
fn is_below(file: &Path, compiled: &BTreeSet<PathBuf>) -> bool {
    let mut folders = file.ancestors().skip(1);
    compiled.contains(file) || folders.any(|folder| compiled.contains(&folder.join("mod.rs")))
}

#[test]
fn unit_tests_are_compiled_where_there_are_some() {
    let mut wrong = Vec::new();
    for name in PACKAGES.iter().chain(OTHERS) {
        if OUTSIDE.contains(name) {
            continue;
        }
        let package = fixture("../..").join(name);
        let manifest = package.join("Cargo.toml");
        let manifest = fs::read_to_string(manifest).expect("a package has a manifest");
        let programs = tables(&manifest, "[bin]");
        let sources = fs::read_dir(package.join("src/bin")).map_or(0, Iterator::count)
            + usize::from(package.join("src/main.rs").exists());
        if programs.len() != sources || programs.into_iter().any(is_tested) {
            wrong.push(format!("{name}: a program without `test = false`"));
        }
        let own = with_tests(&package.join("src"));
        let elsewhere = compiled_by_tests(&package);
        let unseen: Vec<_> = own
            .iter()
            .filter(|file| !is_below(file, &elsewhere))
            .collect();
        match tables(&manifest, "lib").as_slice() {
            [] if own.is_empty() => {}
            [table] if is_tested(table) => {
                if own.is_empty() {
                    wrong.push(format!("{name}: no unit tests: write `test = false`"));
                }
            }
            [_] if unseen.is_empty() => {}
            _ => wrong.push(format!("{name}: no target runs the tests of {unseen:?}")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
