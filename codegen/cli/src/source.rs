//! Finding the attributed structs of a source file, and replacing them by their expansions.

use proc_macro2::TokenStream;
use quote::ToTokens;
use std::ops::Range;
use std::path::Path;
use syn::spanned::Spanned;
use syn::visit::Visit;

/// A struct with the attribute: the tokens that the macro would receive, and their span.
pub(crate) struct AttributedStruct {
    pub(crate) attribute: TokenStream,
    pub(crate) item: TokenStream,
    pub(crate) range: Range<usize>,
}

/// Collects the attributed structs, and the imports that the expanded file does not need.
#[derive(Default)]
pub(crate) struct Finder {
    pub(crate) found: Vec<AttributedStruct>,
    pub(crate) edits: Vec<(Range<usize>, String)>,
}

impl<'ast> Visit<'ast> for Finder {
    fn visit_item_struct(&mut self, item: &'ast syn::ItemStruct) {
        let position = item.attrs.iter().position(|attribute| {
            attribute
                .path()
                .segments
                .last()
                .is_some_and(|segment| segment.ident == "branched_pendulum")
        });
        if let Some(position) = position {
            let mut item = item.clone();
            let range = item.span().byte_range();
            let attribute = match item.attrs.remove(position).meta {
                syn::Meta::List(list) => list.tokens,
                _ => TokenStream::new(),
            };
            self.found.push(AttributedStruct {
                attribute,
                item: item.into_token_stream(),
                range,
            });
        }
    }

    /// Collects imports that the expanded file does not need: `use
    /// branched_pendulum::branched_pendulum;` names an item that is missing without the feature
    /// `macros`, and `use branched_pendulum::prelude::*;` may be there for the attribute alone.
    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let mut tree = &item.tree;
        let mut last = None;
        while let syn::UseTree::Path(path) = tree {
            last = Some(&path.ident);
            tree = &path.tree;
        }
        let range = item.span().byte_range();
        match tree {
            syn::UseTree::Name(name) if name.ident == "branched_pendulum" => {
                self.edits.push((range, String::new()));
            }
            syn::UseTree::Glob(_) if last.is_some_and(|name| name == "prelude") => {
                let allow = "#[allow(unused_imports)]\n".to_owned();
                self.edits.push((range.start..range.start, allow));
            }
            _ => {}
        }
    }
}

/// Returns the source with its replacements, below a line that names the source file.
pub(crate) fn replace(
    source: &str,
    mut replacements: Vec<(Range<usize>, String)>,
    path: &Path,
) -> String {
    replacements.sort_by_key(|(range, _)| range.start);
    let name = path.file_name().map_or_else(
        || path.display().to_string(),
        |n| n.to_string_lossy().into_owned(),
    );
    let mut text = format!(
        "// Expanded from {name} by `cargo branched-pendulum` {}. Do not edit.\n",
        env!("CARGO_PKG_VERSION")
    );
    let mut at = 0;
    for (range, replacement) in replacements {
        text.push_str(source.get(at..range.start).unwrap_or_default());
        text.push_str(&replacement);
        at = range.end;
        // Removing a region also removes its line break.
        let rest = source.get(at..).unwrap_or_default();
        if replacement.is_empty() && rest.starts_with('\n') {
            at += 1;
        }
    }
    text.push_str(source.get(at..).unwrap_or_default());
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text
}
