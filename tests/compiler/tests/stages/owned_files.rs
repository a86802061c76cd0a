//! The sources create, replace, cut and remove files in few places: two modules, which touch only files that the project
//! has created, and functions that write the one file that their caller names.

use branched_pendulum_compiler_tests::source::fixture;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};

/// Files that call such functions, the functions, and the reason.
const ALLOWED: &[(&str, &[&str], &str)] = &[
    (
        "runtime/frame/src/owned.rs",
        &[
            "OpenOptions::new",
            "hard_link",
            "remove_dir",
            "remove_file",
            "rename",
            "set_len",
        ],
        "the rule itself: files are recognised before they are touched",
    ),
    (
        "codegen/src/owned.rs",
        &["OpenOptions::new", "remove_file", "rename"],
        "the rule itself: files are recognised before they are touched",
    ),
    (
        "codegen/cli/src/main.rs",
        &["File::create_new", "remove_file", "rename"],
        "the file that `--output` names; its part is created exclusively",
    ),
    (
        "runtime/charts/src/output.rs",
        &["fs::write"],
        "a library function for the file that its caller names",
    ),
    (
        "runtime/data/src/write.rs",
        &["File::create"],
        "a library function for the file that its caller names",
    ),
    (
        "runtime/web/bindings/src/main.rs",
        &["fs::write"],
        "a step of the build of the web page, for files that the step before it wrote",
    ),
];

/// Calls that create, replace, cut or remove files, outside of tests.
#[derive(Default)]
struct Calls(BTreeSet<String>);

/// Functions that are known by their name alone.
const NAMES: [&str; 7] = [
    "hard_link",
    "remove_dir",
    "remove_dir_all",
    "remove_file",
    "rename",
    "set_len",
    "set_permissions",
];

/// Functions that are known together with their type or module.
const PATHS: [&str; 6] = [
    "File::create",
    "File::create_new",
    "File::options",
    "OpenOptions::new",
    "fs::copy",
    "fs::write",
];

impl Calls {
    /// Notes functions that are imported from `fs`.
    fn import(&mut self, tree: &syn::UseTree) {
        let name = match tree {
            syn::UseTree::Name(name) => name.ident.to_string(),
            syn::UseTree::Rename(renamed) => renamed.ident.to_string(),
            syn::UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.import(tree));
                return;
            }
            syn::UseTree::Path(_) | syn::UseTree::Glob(_) => return,
        };
        let path = format!("fs::{name}");
        if NAMES.contains(&name.as_str()) {
            self.0.insert(name);
        } else if PATHS.contains(&path.as_str()) {
            self.0.insert(path);
        }
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let list = attribute.meta.require_list();
        attribute.path().is_ident("cfg")
            && list.is_ok_and(|list| list.tokens.to_string().starts_with("test"))
    })
}

impl<'ast> Visit<'ast> for Calls {
    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        if !is_test(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let segments: Vec<String> = path
            .segments
            .iter()
            .map(|own| own.ident.to_string())
            .collect();
        if let [.., above, name] = &segments[..] {
            let whole = format!("{above}::{name}");
            if PATHS.contains(&whole.as_str()) {
                self.0.insert(whole);
            }
        }
        if let Some(name) = segments
            .last()
            .filter(|name| NAMES.contains(&name.as_str()))
        {
            self.0.insert(name.clone());
        }
        visit::visit_path(self, path);
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        let name = call.method.to_string();
        let is_path = ["set_len", "set_permissions"].contains(&name.as_str());
        if is_path {
            self.0.insert(name);
        }
        visit::visit_expr_method_call(self, call);
    }

    fn visit_use_path(&mut self, path: &'ast syn::UsePath) {
        // A function that is imported would be called by its name alone, or by another one.
        if path.ident == "fs" {
            self.import(&path.tree);
        }
        visit::visit_use_path(self, path);
    }
}

/// Adds the Rust files of all `src` folders below a folder.
fn sources(folder: &Path, is_within: bool, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the repository can be read") {
        let path = entry.expect("the repository can be read").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let is_source = is_within || name == "src";
        if path.is_dir() && !["target", "tests", ".git", "node_modules"].contains(&&*name) {
            sources(&path, is_source, found);
        } else if is_within && name.ends_with(".rs") && name != "tests.rs" {
            found.push(path);
        }
    }
}

fn calls_in(text: &str) -> BTreeSet<String> {
    let mut calls = Calls::default();
    calls.visit_file(&syn::parse_file(text).expect("the source is Rust"));
    calls.0
}

#[test]
fn only_few_places_replace_or_remove_files() {
    let root = fixture("../..");
    let mut files = Vec::new();
    for folder in ["benches", "codegen", "examples", "runtime"] {
        sources(&root.join(folder), false, &mut files);
    }
    assert!(files.len() > 500, "{}", files.len());
    let mut found = BTreeMap::new();
    for file in files {
        let calls = calls_in(&fs::read_to_string(&file).expect("it can be read"));
        if !calls.is_empty() {
            let path = file.strip_prefix(&root).expect("it is below the root");
            found.insert(path.to_string_lossy().replace('\\', "/"), calls);
        }
    }
    let allowed = ALLOWED.iter().map(|(file, calls, _)| {
        let calls = calls.iter().map(|call| (*call).to_owned());
        ((*file).to_owned(), calls.collect::<BTreeSet<_>>())
    });
    let allowed: BTreeMap<_, _> = allowed.collect();
    assert_eq!(
        found, allowed,
        "files are created, replaced and removed by `owned.rs` alone (docs/contributing.md)"
    );
}

#[test]
fn the_search_finds_calls_and_leaves_out_tests() {
    for (text, expected) in [
        ("fn f() { std::fs::write(a, b); }", &["fs::write"][..]),
        ("use std::fs::remove_file as gone;", &["remove_file"]),
        ("use std::{fs::{self, rename}, io};", &["rename"]),
        (
            "fn f() { fs::remove_file(a).or_else(fs::remove_dir_all); }",
            &["remove_dir_all", "remove_file"],
        ),
        (
            "fn f() { File::options().append(true); OpenOptions::new(); }",
            &["File::options", "OpenOptions::new"],
        ),
        (
            "fn f(file: File) { file.set_len(0); list.truncate(2); }",
            &["set_len"],
        ),
        ("use std::fs::write;", &["fs::write"]),
        (
            "#[cfg(test)] mod tests { fn f() { fs::write(a, b); } }",
            &[],
        ),
    ] {
        let calls: Vec<String> = calls_in(text).into_iter().collect();
        assert_eq!(calls, expected, "{text}");
    }
}
