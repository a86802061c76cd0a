//! Expansions that are kept between builds.
//!
//! An unchanged attribute on an unchanged struct derives nothing and takes no
//! lock: its tokens are read from a file that an earlier build wrote. What is kept
//! is the whole expansion, as text, because everything in it but the struct's own
//! tokens stands at the attribute's place, which text read back does too; the
//! struct's own tokens get their places again ([`placed`]). An attribute with
//! mistakes is read anew each time: its messages have places of their own.
//!
//! A file holds the state of this compiler, the tokens that it answers, their
//! expansion and a checksum. Whatever differs in the first two, or is damaged, is no
//! answer, and is written anew. Other files may stand in the folder: only those with a name
//! and a head of the cache's own are read, replaced, counted or removed, and only where no
//! other user may have written them ([`trust`]): what is kept is compiled.

mod entry;
mod folder;
mod placed;
#[cfg(test)]
mod tests;
mod trust;

use crate::stages;
use entry::CacheEntry;
use folder::Folder;
use proc_macro2::TokenStream;
use std::path::PathBuf;

/// Environment variable with the folder of kept expansions, or `off`.
const VARIABLE: &str = "BRANCHED_PENDULUM_CACHE";

/// A folder of kept expansions.
#[derive(Debug, Clone)]
pub struct ExpansionCache {
    folder: Folder,
}

impl ExpansionCache {
    /// Returns the cache that the build of this process uses: the folder that the
    /// variable `BRANCHED_PENDULUM_CACHE` names, else `branched-pendulum` in cargo's
    /// target folder, else, where no target folder can be told (in an editor), one
    /// beside the lock of derivations. `None` where the variable is `off`.
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

    /// Expands the attribute as [`expand`](crate::expand) does, or answers with the
    /// kept expansion. The tokens are the same in both cases. A folder that cannot
    /// be written, or that others may write, keeps nothing.
    pub fn expand(&self, attribute: TokenStream, item: TokenStream) -> TokenStream {
        let question = entry::question(&attribute, &item);
        let name = CacheEntry::file_name(&question);
        let kept = self.folder.read(&name);
        if let Some(tokens) = kept.and_then(|text| CacheEntry::answer(&text, &question)) {
            return placed::placed(tokens, &item);
        }
        let tokens = match stages(attribute, item.clone()) {
            Ok(stages) => stages.tokens,
            Err((_, tokens)) => return tokens,
        };
        let expansion = tokens.to_string();
        // Read back as a later build will read it, so that both compile the same.
        let Ok(tokens) = expansion.parse() else {
            return tokens;
        };
        let entry = CacheEntry {
            question: &question,
            expansion: &expansion,
        };
        self.folder.write(&name, &entry.to_string());
        placed::placed(tokens, &item)
    }
}
