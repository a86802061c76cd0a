//! Checks statements of the documentation pages about the tool and its licences.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Collects all pages below a folder, with their text.
fn pages(folder: &Path, found: &mut Vec<(PathBuf, String)>) {
    for entry in std::fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the folder can be read").path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let is_made = ["target", "node_modules", "book"].contains(&name.as_str());
        if name.starts_with('.') || is_made {
            continue;
        }
        if path.is_dir() {
            pages(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "md") {
            let text = std::fs::read_to_string(&path).expect("a page is text");
            found.push((path, text));
        }
    }
}

/// Returns the commands of the tool in a page: lines of listings, and code within sentences.
fn commands(page: &str) -> BTreeSet<String> {
    let lines = page.lines().map(str::trim_start);
    let sentences = page.split('`').skip(1).step_by(2);
    let all = lines
        .map(str::to_owned)
        .chain(sentences.map(|code| code.replace('\n', " ")));
    let name = "cargo branched-pendulum ";
    all.filter_map(|text| Some(text.strip_prefix(name)?.trim().to_owned()))
        .collect()
}

fn tool(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_cargo-branched-pendulum"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the tool starts")
}

/// Checks the command lines only, not the files: a wrong command line exits with 2. Commands within
/// sentences without a source are checked for their words alone.
#[test]
fn commands_of_all_pages_are_understood() {
    let mut found = Vec::new();
    pages(&repository(), &mut found);
    let empty = std::env::temp_dir().join(format!("pages-{}", std::process::id()));
    std::fs::create_dir_all(&empty).expect("the temporary folder is writable");
    let helps = ["expand", "check", "stage", "emit"].map(|name| {
        let help = tool(&[name, "--help"], &empty).stdout;
        name.to_owned() + &String::from_utf8_lossy(&help)
    });
    let help = helps.concat();
    let (mut whole, mut words) = (0, 0);
    for (path, page) in found {
        for command in commands(&page) {
            let place = format!("{}: {command}", path.display());
            let arguments: Vec<&str> = command.split_whitespace().collect();
            if arguments.iter().any(|argument| argument.ends_with(".rs")) {
                whole += 1;
                let output = tool(&arguments, &empty);
                let errors = String::from_utf8_lossy(&output.stderr);
                assert_ne!(output.status.code(), Some(2), "{place}: {errors}");
                continue;
            }
            // Words in capitals are placeholders.
            let is_name = |word: &&&str| !word.chars().all(char::is_uppercase);
            for word in arguments.iter().filter(is_name) {
                words += 1;
                assert!(help.contains(*word), "{place}");
            }
        }
    }
    assert!(whole >= 7 && words >= 7, "{whole} commands, {words} words");
    std::fs::remove_dir_all(empty).expect("the folder is ours");
}

/// Returns the packages that the macro and the tool contain, by licence, except those that the MIT
/// licence or the Apache License alone covers.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
fn licences() -> BTreeMap<String, BTreeSet<String>> {
    let output = Command::new(env!("CARGO"))
        .args([
            "tree",
            "--offline",
            "--edges",
            "normal,build",
            "--prefix",
            "none",
        ])
        .args([
            "--package",
            "branched-pendulum-macros",
            "--package",
            "cargo-branched-pendulum",
        ])
        .args(["--format", "{p}|{l}"])
        .current_dir(repository())
        .output()
        .expect("cargo starts");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let tree = String::from_utf8(output.stdout).expect("cargo writes UTF-8");
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for line in tree.lines().filter(|line| !line.is_empty()) {
        let (package, licence) = line.split_once('|').expect("a package and its licence");
        let name = package.split(' ').next().unwrap_or_default();
        let licence = licence.trim_end_matches(" (*)");
        let mut choices = licence.split(" OR ").flat_map(|choice| choice.split('/'));
        if !choices.any(|choice| ["MIT", "Apache-2.0"].contains(&choice)) {
            found
                .entry(licence.to_owned())
                .or_default()
                .insert(name.to_owned());
        }
    }
    found
}

/// Compares with the table that is read from the page.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[test]
fn licences_are_those_of_the_page() {
    let mut found = licences();
    // This has its own section.
    let own = found.remove("").unwrap_or_default();
    assert_eq!(own, BTreeSet::from(["symbolica".to_owned()]));
    let page = std::fs::read_to_string(repository().join("docs/licences.md"));
    let page = page.expect("the page exists");
    let (_, table) = page
        .split_once("| licence | packages |\n|---|---|\n")
        .expect("a table");
    let rows = table.lines().take_while(|line| line.starts_with('|'));
    let reported: BTreeMap<String, BTreeSet<String>> = rows
        .map(|row| {
            let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
            let [licence, packages] = cells[..] else {
                panic!("{row}")
            };
            let packages = packages
                .split(", ")
                .map(|name| name.trim_matches('`').to_owned());
            (licence.to_owned(), packages.collect())
        })
        .collect();
    assert_eq!(reported, found);
}
