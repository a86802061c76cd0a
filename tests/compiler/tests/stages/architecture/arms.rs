//! A match over an enum of this repository lists every variant: an arm `_` would hide the places
//! that a new variant concerns.

use branched_pendulum_compiler_tests::source::fixture;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, ExprMatch, Item, ItemEnum, ItemImpl, ItemUse, Pat, Type, UseTree};

/// Enums whose matches ask about the form of a term, as `if let` does: most operations concern a
/// few forms, and all others stay as they are.
const TERMS: &[&str] = &[
    "ConstantOp",
    "Expr",
    "ExpressionKind",
    "ObservedAtom",
    "Op",
    "Temporal",
    "Trigonometric",
];

/// An enum of the repository.
struct Known {
    /// Package that defines it.
    package: PathBuf,
    /// True if other packages cannot list its variants.
    non_exhaustive: bool,
}

/// Rust files of a package, except its tests.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("it can be read").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            if !["target", "node_modules", "tests", "fuzz"].contains(&name.as_ref()) {
                sources(&path, found);
            }
        } else if path.extension().is_some_and(|extension| extension == "rs") && name != "tests.rs"
        {
            found.push(path);
        }
    }
}

/// The folder of the nearest manifest.
fn package(file: &Path) -> PathBuf {
    let mut folders = file.ancestors().skip(1);
    let found = folders.find(|folder| folder.join("Cargo.toml").exists());
    found.expect("every file belongs to a package").to_owned()
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let meta = &attribute.meta;
        meta.path().is_ident("cfg")
            && meta
                .require_list()
                .is_ok_and(|list| list.tokens.to_string() == "test")
    })
}

/// Collects the enums of a file.
struct Enums<'a> {
    package: PathBuf,
    found: &'a mut BTreeMap<String, Vec<Known>>,
}

impl<'ast> Visit<'ast> for Enums<'_> {
    fn visit_item_enum(&mut self, item: &'ast ItemEnum) {
        let attributes = item.attrs.iter();
        let mut attributes = attributes.map(|attribute| attribute.path());
        let known = Known {
            package: self.package.clone(),
            non_exhaustive: attributes.any(|path| path.is_ident("non_exhaustive")),
        };
        self.found
            .entry(item.ident.to_string())
            .or_default()
            .push(known);
    }
}

/// Looks for arms that forget variants.
struct Arms<'a> {
    enums: &'a BTreeMap<String, Vec<Known>>,
    package: PathBuf,
    /// Types of the enclosing implementations.
    own: Vec<String>,
    /// Names under which the file uses enums, if not their own.
    renamed: BTreeMap<String, String>,
    found: Vec<usize>,
}

impl Arms<'_> {
    /// Adds the enum and the variant that a pattern names to those of its position.
    fn name(&self, pattern: &Pat, position: usize, named: &mut BTreeSet<(usize, String, String)>) {
        let path = match pattern {
            Pat::Or(or) => {
                return or
                    .cases
                    .iter()
                    .for_each(|case| self.name(case, position, named));
            }
            Pat::Reference(reference) => return self.name(&reference.pat, position, named),
            Pat::Paren(inner) => return self.name(&inner.pat, position, named),
            Pat::Ident(ident) => {
                if let Some((_, inner)) = &ident.subpat {
                    self.name(inner, position, named);
                }
                return;
            }
            Pat::Tuple(tuple) => {
                let elements = tuple.elems.iter().enumerate();
                return elements
                    .for_each(|(index, own)| self.name(own, 10 * position + index + 1, named));
            }
            Pat::TupleStruct(own) if own.path.segments.len() == 1 => {
                // `Some(…)`, `Ok(…)`.
                return own
                    .elems
                    .iter()
                    .for_each(|inner| self.name(inner, position, named));
            }
            Pat::TupleStruct(own) => &own.path,
            Pat::Struct(own) => &own.path,
            Pat::Path(own) => &own.path,
            _ => return,
        };
        let segments: Vec<String> = path
            .segments
            .iter()
            .map(|own| own.ident.to_string())
            .collect();
        let [.., kind, variant] = segments.as_slice() else {
            return;
        };
        let kind = match kind.as_str() {
            "Self" => self.own.last().unwrap_or(kind),
            _ => self.renamed.get(kind).unwrap_or(kind),
        };
        let listable = self.enums.get(kind).is_some_and(|all| {
            all.iter().any(|known| known.package == self.package)
                || all.iter().all(|known| !known.non_exhaustive)
        });
        if listable && !TERMS.contains(&kind.as_str()) {
            named.insert((position, kind.clone(), variant.clone()));
        }
    }
}

impl<'ast> Visit<'ast> for Arms<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if let Item::Mod(module) = item
            && is_test(&module.attrs)
        {
            return;
        }
        visit::visit_item(self, item);
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        let mut pending = vec![&item.tree];
        while let Some(tree) = pending.pop() {
            match tree {
                UseTree::Path(path) => pending.push(&path.tree),
                UseTree::Group(group) => pending.extend(&group.items),
                UseTree::Rename(rename) => {
                    let (from, to) = (rename.ident.to_string(), rename.rename.to_string());
                    self.renamed.insert(to, from);
                }
                UseTree::Name(_) | UseTree::Glob(_) => {}
            }
        }
    }

    fn visit_item_impl(&mut self, item: &'ast ItemImpl) {
        let name = match &*item.self_ty {
            Type::Path(path) => path.path.segments.last().map(|own| own.ident.to_string()),
            _ => None,
        };
        self.own.push(name.unwrap_or_default());
        visit::visit_item_impl(self, item);
        self.own.pop();
    }

    fn visit_expr_match(&mut self, item: &'ast ExprMatch) {
        let mut named = BTreeSet::new();
        let mut hides = None;
        for arm in &item.arms {
            self.name(&arm.pat, 0, &mut named);
            if matches!(arm.pat, Pat::Wild(_)) && arm.guard.is_none() {
                hides = Some(arm.span().start().line);
            }
        }
        // One variant and `_` is a question about that variant.
        let mut kinds: BTreeMap<(usize, &str), usize> = BTreeMap::new();
        for (position, kind, _) in &named {
            *kinds.entry((*position, kind)).or_default() += 1;
        }
        if let Some(line) = hides
            && kinds.values().any(|&variants| variants > 1)
        {
            self.found.push(line);
        }
        visit::visit_expr_match(self, item);
    }
}

#[test]
fn no_arm_hides_variants_of_our_own_enums() {
    let mut files = Vec::new();
    for folder in ["benches", "codegen", "examples", "runtime"] {
        sources(&fixture("../..").join(folder), &mut files);
    }
    let parsed: Vec<(PathBuf, syn::File)> = files
        .into_iter()
        .map(|file| {
            let text = fs::read_to_string(&file).expect("it is text");
            (file, syn::parse_file(&text).expect("it is Rust"))
        })
        .collect();
    let mut enums = BTreeMap::new();
    for (file, syntax) in &parsed {
        let package = package(file);
        Enums {
            package,
            found: &mut enums,
        }
        .visit_file(syntax);
    }
    let mut wrong = Vec::new();
    for (file, syntax) in &parsed {
        let mut arms = Arms {
            enums: &enums,
            package: package(file),
            own: Vec::new(),
            renamed: BTreeMap::new(),
            found: Vec::new(),
        };
        arms.visit_file(syntax);
        let name = file.display();
        wrong.extend(arms.found.into_iter().map(|line| format!("{name}:{line}")));
    }
    assert!(parsed.len() > 500, "{} files are too few", parsed.len());
    assert!(
        wrong.is_empty(),
        "list the variants instead of `_`:\n{}",
        wrong.join("\n")
    );
}
