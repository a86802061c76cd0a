//! The floors that `docs/architecture.md` lists are those of the source, and within a floor no
//! two modules name each other.

mod arms;
mod targets;
mod uses;

use branched_pendulum_compiler_tests::source::fixture;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use uses::{ModulePath, NamedModules, PackageSource};

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

fn root(package: &str) -> PathBuf {
    fixture("../..").join(package).join("src")
}

fn check_floors(package: &str) {
    let page = fs::read_to_string(fixture("../../docs/architecture.md")).expect("it exists");
    let floors = floors(&page, package);
    let source = PackageSource::read(&root(package));
    let mut seen = BTreeSet::new();
    for path in source.modules() {
        let module = &path[0];
        assert!(
            floors.contains_key(module),
            "docs/architecture.md has no floor for `{module}` of {package}"
        );
        seen.insert(module.clone());
    }
    let mut wrong = Vec::new();
    for (path, named) in source.named() {
        let Some(module) = path.first() else { continue };
        for other in named.keys().filter_map(|path| path.first()) {
            if floors[other] > floors[module] {
                wrong.push(format!("{}: names `{other}`", path.join("::")));
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
    check_floors("codegen");
    check_floors("runtime");
}

/// Where packages are that have modules.
const PACKAGES: &[&str] = &[
    "codegen",
    "runtime",
    "runtime/advice",
    "runtime/charts",
    "runtime/data",
    "runtime/frame",
    "runtime/measure",
    "runtime/program",
    "runtime/python",
    "runtime/trees",
    "runtime/web",
    "benches/evaluation",
    "benches/studies",
];

/// Modules that name each other, and why they may: the folder, the modules.
const TOGETHER: &[(&str, &str, &[&str])] = &[
    // A chart draws error bars and marks beyond its axes, which are placed by its parts.
    ("runtime/charts", "", &["beyond", "compose", "error_bars"]),
    // An error holds the best fit so far; a fit is of a record, which an error refuses.
    (
        "runtime/measure",
        "identification",
        &["error", "fit", "record"],
    ),
    // Numbers that are registers, and registers of numbers.
    ("runtime", "", &["scalar", "simd"]),
    // A trait, and what its methods are written with.
    (
        "runtime",
        "integrate",
        &["events", "integrator", "run", "stepper"],
    ),
    ("runtime", "integrate::explicit", &["pair", "stages"]),
    ("runtime", "scalar", &["kind", "lanes"]),
    ("runtime", "scalar::sincos", &["fused", "tail"]),
    // A model becomes one on other numbers, which is a pendulum; a pendulum is a model, and calls
    // the functions that a model has.
    (
        "runtime",
        "system",
        &["function", "fused", "model", "pendulum"],
    ),
    // A map of rates looks for tongues, which ask for rates along lines.
    ("runtime/program", "commands::map", &["rates", "tongues"]),
    // A description becomes a tree, which knows it; what a tree computes by one of its parts
    // is defined next to that part.
    (
        "runtime/trees",
        "",
        &[
            "description",
            "lineage",
            "prescribed",
            "scales",
            "series",
            "symmetric",
            "tree",
        ],
    ),
    // The evaluation of states in registers is a form at one time.
    ("runtime/trees", "", &["evaluator", "forms"]),
];

/// Folders of a package with modules in them that name each other, by way of others or not. What
/// a folder's own file names does not count: it holds the folder together.
fn knots(source: &PackageSource) -> Vec<(String, Vec<String>)> {
    let named = source.named();
    let folders: BTreeSet<&[String]> = source
        .modules()
        .flat_map(|path| (0..path.len()).map(|length| &path[..length]))
        .collect();
    let mut knots = Vec::new();
    for folder in folders {
        let within = within(&named, folder);
        let reach: BTreeMap<&String, BTreeSet<&String>> = within
            .keys()
            .map(|module| (module, reached(&within, module)))
            .collect();
        let mut done: BTreeSet<&String> = BTreeSet::new();
        for (&module, reached) in &reach {
            let knot: Vec<String> = reached
                .iter()
                .filter(|other| reach.get(*other).is_some_and(|back| back.contains(module)))
                .map(|&other| other.clone())
                .collect();
            if knot.len() > 1 && done.insert(module) {
                done.extend(reach.keys().filter(|other| knot.contains(other)));
                knots.push((folder.join("::"), knot));
            }
        }
    }
    knots.dedup();
    knots
}

/// Which modules of a folder name which, with all that is in them.
fn within(named: &NamedModules, folder: &[String]) -> BTreeMap<String, BTreeSet<String>> {
    let place = |path: &ModulePath| path.strip_prefix(folder)?.first().cloned();
    let mut within: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (path, others) in named {
        let Some(module) = place(path) else { continue };
        let others = others.keys().filter_map(place);
        let others: Vec<String> = others.filter(|other| *other != module).collect();
        within.entry(module).or_default().extend(others);
    }
    within
}

fn reached<'w>(
    within: &'w BTreeMap<String, BTreeSet<String>>,
    from: &String,
) -> BTreeSet<&'w String> {
    let mut reached = BTreeSet::new();
    let mut pending: Vec<&String> = within[from].iter().collect();
    while let Some(module) = pending.pop() {
        if reached.insert(module) {
            pending.extend(within.get(module).into_iter().flatten());
        }
    }
    reached
}

#[test]
fn modules_do_not_name_each_other() {
    let mut wrong = Vec::new();
    for package in PACKAGES {
        let mut allowed: Vec<(String, Vec<String>)> = TOGETHER
            .iter()
            .filter(|(of, ..)| of == package)
            .map(|(_, folder, modules)| {
                let modules = modules.iter().map(|&module| module.to_owned());
                ((*folder).to_owned(), modules.collect())
            })
            .collect();
        allowed.sort();
        let mut found = knots(&PackageSource::read(&root(package)));
        found.sort();
        if found != allowed {
            wrong.push(format!("{package}: {found:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Folders of the packages, and files beside a folder of the same name.
fn beside(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("it can be read").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && !["target", "node_modules", "snapshots"].contains(&name.as_ref()) {
            let file = path.with_extension("rs");
            let has_modules = fs::read_to_string(&file).is_ok_and(|text| {
                let lines = text.lines();
                lines
                    .filter_map(|line| line.trim_end().strip_suffix(';'))
                    .any(|line| line.starts_with("mod ") || line.starts_with("pub mod "))
            });
            if has_modules {
                found.push(file);
            }
            beside(&path, found);
        }
    }
}

#[test]
fn a_module_with_modules_is_a_folder_with_a_file_of_its_own() {
    let mut found = Vec::new();
    for folder in ["benches", "codegen", "runtime", "tests", "examples"] {
        beside(&fixture("../..").join(folder), &mut found);
    }
    assert!(found.is_empty(), "write FOLDER/mod.rs instead: {found:?}");
}
