//! Cache of expansions between builds.
//!
//! An unchanged attribute on an unchanged struct needs neither a derivation nor the lock: its
//! tokens are read from a file that an earlier build wrote. The file contains the whole expansion
//! as text. Text that is read back has the span of the attribute, which is the correct span of all
//! tokens except those of the struct; these get their spans back from the struct ([`respan`]). An
//! attribute with mistakes is expanded anew each time, because its messages have spans too.
//!
//! A file holds the state of this compiler, the tokens that were expanded, their expansion and a
//! checksum. A file that is damaged, or differs in the first two, is ignored and written anew.
//! Other files may be in the folder: only files with a name and a first line of this cache are
//! read, replaced, counted or removed, and only if no other user may have written them ([`trust`]),
//! because kept tokens are compiled.

mod entry;
mod folder;
mod respan;
#[cfg(test)]
mod tests;
mod trust;

use crate::stages;
use entry::CacheEntry;
use folder::Folder;
use proc_macro2::TokenStream;
use std::path::PathBuf;

/// Environment variable that names the folder of stored expansions; the value `off` disables the
/// cache.
const VARIABLE: &str = "BRANCHED_PENDULUM_CACHE";

/// A folder of kept expansions.
#[derive(Debug, Clone)]
pub struct ExpansionCache {
    folder: Folder,
}

impl ExpansionCache {
    /// Returns the cache for the build of this process. Its folder is given by the variable
    /// `BRANCHED_PENDULUM_CACHE`; by default it is `branched-pendulum` in Cargo's target folder or,
    /// if no target folder is found (in an editor), a folder next to the lock file of derivations.
    /// Returns `None` if the variable is `off`.
    pub fn of_this_build() -> Option<Self> {
        let named = std::env::var_os(VARIABLE).filter(|value| !value.is_empty());
        match named {
            Some(value) if value == "off" => None,
            Some(value) => Some(Self::in_folder(value.into())),
            None => folder::of_this_build().map(Self::in_folder),
        }
    }

    /// Returns the cache in a folder, which need not exist.
    pub fn in_folder(path: PathBuf) -> Self {
        let folder = Folder::new(path);
        Self { folder }
    }

    /// Returns the stored expansion of the attribute, or expands it like [`expand`](crate::expand)
    /// and stores the result. The tokens are identical in both cases. Nothing is stored in a folder
    /// that cannot be written, or that other users may write to.
    pub fn expand(&self, attribute: TokenStream, item: TokenStream) -> TokenStream {
        let question = entry::question(&attribute, &item);
        let name = CacheEntry::file_name(&question);
        let kept = self.folder.read(&name);
        if let Some(tokens) = kept.and_then(|text| CacheEntry::answer(&text, &question)) {
            return respan::respan(tokens, &item);
        }
        let tokens = match stages(attribute, item.clone()) {
            Ok(stages) => stages.tokens().clone(),
            Err((_, tokens)) => return tokens,
        };
        let expansion = tokens.to_string();
        // Parsed from text as a later build will parse it, so that both builds compile identical
        // tokens.
        let Ok(tokens) = expansion.parse() else {
            return tokens;
        };
        let entry = CacheEntry {
            question: &question,
            expansion: &expansion,
        };
        self.folder.write(&name, &entry.to_string());
        respan::respan(tokens, &item)
    }
}
