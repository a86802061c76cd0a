//! Which modules of a package name which.

use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemMod, ItemUse, UseTree, Visibility};

/// Path of a module or item within its package; empty at the root.
pub(super) type ModulePath = Vec<String>;

/// The modules that each module names, and by which names.
pub(super) type NamedModules = BTreeMap<ModulePath, BTreeMap<ModulePath, BTreeSet<String>>>;

/// What the file of a module says of others.
#[derive(Default)]
struct ModuleSource {
    named: Vec<ModulePath>,
    /// Re-exports: from names to what they stand for.
    exported: BTreeMap<String, ModulePath>,
}

/// The source of a package, without its tests.
pub(super) struct PackageSource {
    modules: BTreeMap<ModulePath, ModuleSource>,
}

impl PackageSource {
    /// Reads all files below a folder.
    ///
    /// # Panics
    /// If one cannot be read or is not Rust.
    pub(super) fn read(root: &Path) -> Self {
        let mut files = Vec::new();
        sources(root, &mut files);
        let paths: BTreeMap<ModulePath, PathBuf> = files
            .into_iter()
            .map(|file| (module_path(root, &file), file))
            .collect();
        let known: BTreeSet<&ModulePath> = paths.keys().collect();
        let modules = paths.iter().map(|(path, file)| {
            let text = fs::read_to_string(file).expect("it is text");
            let syntax = syn::parse_file(&text).expect("it is Rust");
            let mut reader = Reader {
                at: path.clone(),
                known: &known,
                found: ModuleSource::default(),
            };
            reader.visit_file(&syntax);
            (path.clone(), reader.found)
        });
        Self {
            modules: modules.collect(),
        }
    }

    /// The modules, the root left out.
    pub(super) fn modules(&self) -> impl Iterator<Item = &ModulePath> {
        self.modules.keys().filter(|path| !path.is_empty())
    }

    /// Which modules each module names, itself left out: where what it names is defined, not
    /// where it is exported again.
    pub(super) fn named(&self) -> NamedModules {
        let modules = self.modules.iter().map(|(path, module)| {
            let mut found: BTreeMap<ModulePath, BTreeSet<String>> = BTreeMap::new();
            for named in &module.named {
                let home = self.home(named, 8);
                if home != *path {
                    let name = named.last().cloned().unwrap_or_default();
                    found.entry(home).or_default().insert(name);
                }
            }
            (path.clone(), found)
        });
        modules.collect()
    }

    /// The module that defines an item, through at most so many re-exports.
    fn home(&self, item: &[String], exports: usize) -> ModulePath {
        for length in 0..item.len() {
            let (module, rest) = item.split_at(length);
            let Some(source) = self.modules.get(module) else {
                continue;
            };
            let is_module = self.modules.contains_key(&item[..=length]);
            if let (false, Some(origin), Some(exports)) = (
                is_module,
                source.exported.get(&rest[0]),
                exports.checked_sub(1),
            ) {
                return self.home(&[origin, &rest[1..]].concat(), exports);
            }
        }
        let modules = (0..=item.len()).rev().map(|length| &item[..length]);
        let module = modules
            .into_iter()
            .find(|path| self.modules.contains_key(*path));
        module.unwrap_or_default().to_vec()
    }
}

/// Source files below a folder, tests of their own and programs left out.
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

fn module_path(root: &Path, file: &Path) -> ModulePath {
    let path = file.strip_prefix(root).expect("it is below");
    let parts = path.with_extension("");
    let mut path: ModulePath = parts
        .iter()
        .map(|part| part.to_string_lossy().into_owned())
        .collect();
    if path
        .last()
        .is_some_and(|last| last == "mod" || last == "lib")
    {
        path.pop();
    }
    path
}

/// Collects the paths of one file.
struct Reader<'k> {
    at: ModulePath,
    known: &'k BTreeSet<&'k ModulePath>,
    found: ModuleSource,
}

impl Reader<'_> {
    /// The path from the package's root of one that is written here; none of another package's.
    fn absolute(&self, path: &[String]) -> Option<ModulePath> {
        let (first, rest) = path.split_first()?;
        let mut module = self.at.clone();
        let mut rest = rest;
        match first.as_str() {
            "crate" => module.clear(),
            "self" => {}
            "super" => {
                module.pop();
                while let Some(("super", further)) = rest
                    .split_first()
                    .map(|(name, further)| (name.as_str(), further))
                {
                    module.pop();
                    rest = further;
                }
            }
            // A module declared here.
            child => {
                module.push(child.to_owned());
                if !self.known.contains(&module) {
                    return None;
                }
            }
        }
        Some([&module, rest].concat())
    }

    fn name(&mut self, path: &[String]) {
        self.found.named.extend(self.absolute(path));
    }

    /// Paths in the tokens of a macro, which are no syntax yet.
    fn tokens(&mut self, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let is_colon = |token: Option<&TokenTree>| matches!(token, Some(TokenTree::Punct(p)) if p.as_char() == ':');
        for (place, token) in tokens.iter().enumerate() {
            match token {
                TokenTree::Group(group) => self.tokens(group.stream()),
                TokenTree::Ident(ident) if ident == "crate" => {
                    let before = place.checked_sub(1).and_then(|before| tokens.get(before));
                    if matches!(before, Some(TokenTree::Punct(p)) if p.as_char() == '$') {
                        continue;
                    }
                    let mut path = vec!["crate".to_owned()];
                    let mut next = place + 1;
                    while is_colon(tokens.get(next)) && is_colon(tokens.get(next + 1)) {
                        let Some(TokenTree::Ident(name)) = tokens.get(next + 2) else {
                            break;
                        };
                        path.push(name.to_string());
                        next += 3;
                    }
                    self.name(&path);
                }
                _ => {}
            }
        }
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if !is_test(item) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        // A module within a file belongs to the file.
        self.at.push(module.ident.to_string());
        visit::visit_item_mod(self, module);
        self.at.pop();
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        let mut paths = Vec::new();
        spread(&item.tree, &mut Vec::new(), &mut paths);
        for (path, name) in paths {
            match item.vis {
                Visibility::Inherited => self.name(&path),
                _ => {
                    let origin = self.absolute(&path);
                    self.found
                        .exported
                        .extend(origin.map(|origin| (name, origin)));
                }
            }
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names = path
            .segments
            .iter()
            .map(|segment| segment.ident.to_string());
        let names: Vec<String> = names.collect();
        if names.len() > 1 && path.leading_colon.is_none() {
            self.name(&names);
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, invoked: &'ast syn::Macro) {
        self.tokens(invoked.tokens.clone());
    }
}

/// The paths of a `use`, each with the name that it has here.
fn spread(tree: &UseTree, before: &mut Vec<String>, paths: &mut Vec<(Vec<String>, String)>) {
    match tree {
        UseTree::Path(path) => {
            before.push(path.ident.to_string());
            spread(&path.tree, before, paths);
            before.pop();
        }
        UseTree::Group(group) => {
            for item in &group.items {
                spread(item, before, paths);
            }
        }
        UseTree::Glob(_) => paths.push((before.clone(), "*".to_owned())),
        UseTree::Name(name) if name.ident == "self" => {
            let own = before.last().cloned().unwrap_or_default();
            paths.push((before.clone(), own));
        }
        UseTree::Name(name) => {
            let name = name.ident.to_string();
            paths.push((
                [before.as_slice(), std::slice::from_ref(&name)].concat(),
                name,
            ));
        }
        UseTree::Rename(renamed) => {
            let path = [before.as_slice(), &[renamed.ident.to_string()]].concat();
            paths.push((path, renamed.rename.to_string()));
        }
    }
}

fn is_test(item: &Item) -> bool {
    let attributes: &[Attribute] = match item {
        Item::Mod(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        _ => &[],
    };
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute
                .parse_args::<syn::Ident>()
                .is_ok_and(|condition| condition == "test")
    })
}
