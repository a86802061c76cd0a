//! The floors that `docs/architecture.md` lists are those of the source.

use branched_pendulum_compiler_tests::source::fixture;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Floor of each module of a package, as the page's table for `package` says.
fn floors(page: &str, package: &str) -> BTreeMap<String, usize> {
    let head = format!("| floor | modules of `{package}/src` |");
    let (_, table) = page.split_once(&head).expect("the page has the table");
    let rows = table.lines().skip(2).take_while(|row| row.starts_with('|'));
    let mut floors = BTreeMap::new();
    for row in rows {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let [_, floor, modules, ..] = cells.as_slice() else {
            panic!("no row: {row}")
        };
        let floor = floor.parse().expect("floors have numbers");
        for module in modules.split(',') {
            let module = module.trim().trim_matches('`').to_owned();
            assert_eq!(floors.insert(module, floor), None, "{row}: twice");
        }
    }
    floors
}

/// Source files below a folder, tests of their own left out.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("it can be read").path())
        .collect();
    entries.sort();
    for path in entries {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && name != "tests" && name != "bin" {
            sources(&path, found);
        } else if name.ends_with(".rs") && !name.ends_with("tests.rs") {
            found.push(path);
        }
    }
}

/// Modules of its own package that a file names outside comments and tests.
fn named(source: &str) -> Vec<String> {
    let own_tests = source.find("#[cfg(test)]\nmod ");
    let code = &source[..own_tests.unwrap_or(source.len())];
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code: String = lines.collect::<Vec<_>>().join("\n");
    let identifier = |text: &str| -> String {
        let letters = text.chars();
        letters
            .take_while(|letter| letter.is_alphanumeric() || *letter == '_')
            .collect()
    };
    let mut modules = Vec::new();
    for (start, _) in code.match_indices("crate::") {
        let before = code[..start].chars().next_back();
        if before.is_some_and(|letter| letter.is_alphanumeric() || letter == '_' || letter == '$') {
            continue;
        }
        let rest = &code[start + "crate::".len()..];
        match rest.strip_prefix('{') {
            // `use crate::{a::B, c::D}`
            Some(list) => {
                let (list, _) = list.split_once("};").unwrap_or((list, ""));
                modules.extend(list.split(',').map(|item| identifier(item.trim())));
            }
            None => modules.push(identifier(rest)),
        }
    }
    modules
}

fn check(package: &str) {
    let page = fs::read_to_string(fixture("../../docs/architecture.md")).expect("it exists");
    let floors = floors(&page, package);
    let root = fixture("../..").join(package).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let mut seen = Vec::new();
    let mut wrong = Vec::new();
    for file in files {
        let path = file.strip_prefix(&root).expect("it is below");
        let first = path.iter().next().unwrap_or_default().to_string_lossy();
        let module = first.trim_end_matches(".rs").to_owned();
        if module == "lib" {
            continue;
        }
        let Some(&floor) = floors.get(&module) else {
            panic!("docs/architecture.md has no floor for `{module}` of {package}")
        };
        seen.push(module.clone());
        let source = fs::read_to_string(&file).expect("it is text");
        for other in named(&source) {
            // Names that the library re-exports at its root are no modules.
            let Some(&above) = floors.get(&other) else {
                continue;
            };
            if above > floor {
                wrong.push(format!("{}: `{module}` names `{other}`", path.display()));
            }
        }
    }
    for module in floors.keys() {
        assert!(seen.contains(module), "{package} has no module `{module}`");
    }
    assert!(wrong.is_empty(), "{package}:\n{}", wrong.join("\n"));
}

#[test]
fn floors_know_nothing_above_them() {
    check("codegen");
    check("runtime");
}
