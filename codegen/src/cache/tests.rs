use super::entry::{CacheEntry, question};
use super::{ExpansionCache, respan};
use crate::{expand, layout};
use proc_macro2::TokenStream;
use quote::quote;
use std::fs;
use std::path::{Path, PathBuf};

/// A temporary folder of one test, removed at the end.
struct Own(PathBuf);

impl Own {
    fn new(name: &str) -> Self {
        let id = std::process::id();
        Self(std::env::temp_dir().join(format!("expansions-{id}-{name}")))
    }

    fn cache(&self) -> ExpansionCache {
        ExpansionCache::in_folder(self.0.clone())
    }

    /// Writes the file that answers a question, with write permission for this user only.
    fn plant(&self, question: &str, entry: &CacheEntry<'_>) -> PathBuf {
        let path = self.0.join(CacheEntry::file_name(question));
        fs::create_dir_all(&self.0).unwrap();
        fs::write(&path, entry.to_string()).unwrap();
        mode(&self.0, 0o700);
        mode(&path, 0o600);
        path
    }

    fn files(&self) -> Vec<PathBuf> {
        let entries = fs::read_dir(&self.0).into_iter().flatten();
        entries.map(|entry| entry.unwrap().path()).collect()
    }
}

/// Sets the permissions of a file, on systems that have them.
fn mode(path: &Path, mode: u32) {
    #[cfg(unix)]
    fs::set_permissions(path, std::os::unix::fs::PermissionsExt::from_mode(mode)).unwrap();
    #[cfg(not(unix))]
    let _ = (path, mode);
}

impl Drop for Own {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn attribute() -> TokenStream {
    quote!(gravity = 9.80665, rod: rod(mass = m, length = 1))
}

fn item() -> TokenStream {
    quote! {
        #[doc = " A rod."]
        #[derive(Debug)]
        pub(crate) struct Rod;
    }
}

#[test]
fn kept_and_new_expansions_are_those_without_a_cache() {
    let own = Own::new("equal");
    let plain = layout(expand(attribute(), item())).unwrap();
    for _ in 0..2 {
        let tokens = own.cache().expand(attribute(), item());
        assert_eq!(layout(tokens).unwrap(), plain);
        assert_eq!(own.files().len(), 1);
    }
}

#[test]
fn what_is_kept_is_the_answer_and_nothing_is_derived() {
    let own = Own::new("answer");
    let question = question(&attribute(), &item());
    // No derivation returns these tokens.
    let entry = CacheEntry {
        question: &question,
        expansion: "fn kept() {}",
    };
    let path = own.plant(&question, &entry);
    let planted = quote!(
        fn kept() {}
    )
    .to_string();
    let tokens = own.cache().expand(attribute(), item());
    assert_eq!(tokens.to_string(), planted);

    // A file that other users may have written is never compiled.
    #[cfg(unix)]
    for (at, open, shut) in [(&path, 0o666, 0o600), (&own.0, 0o777, 0o700)] {
        mode(at, open);
        let derived = own.cache().expand(attribute(), item());
        assert_ne!(derived.to_string(), planted);
        mode(at, shut);
        assert_eq!(fs::read_to_string(&path).unwrap(), entry.to_string());
    }
    assert_eq!(own.cache().expand(attribute(), item()).to_string(), planted);

    // Other tokens, or another compiler, are another question.
    let other = own
        .cache()
        .expand(quote!(gravity = 1, rod: rod(mass = m, length = 1)), item());
    assert_ne!(other.to_string(), tokens.to_string());
    let older = question.replacen(env!("BRANCHED_PENDULUM_COMPILER"), "0123456789abcdef", 1);
    assert_ne!(older, question);
    let entry = CacheEntry {
        question: &older,
        expansion: "fn kept() {}",
    };
    own.plant(&question, &entry);
    let tokens = own.cache().expand(attribute(), item());
    assert_ne!(tokens.to_string(), planted);
}

#[test]
fn groups_that_macros_make_are_part_of_the_question() {
    let sum = proc_macro2::Group::new(proc_macro2::Delimiter::None, quote!(1 + 1));
    let product = |length: TokenStream| quote!(gravity = 2 * #length);
    let (grouped, plain) = (product(quote!(#sum)), product(quote!(1 + 1)));
    assert_ne!(question(&grouped, &item()), question(&plain, &item()));
}

#[test]
fn damaged_files_are_no_answer_and_are_written_anew() {
    let own = Own::new("damaged");
    let plain = own.cache().expand(attribute(), item()).to_string();
    let files = own.files();
    let [path] = files.as_slice() else {
        panic!("{files:?}")
    };
    let whole = fs::read_to_string(path).unwrap();
    let (head, _) = whole.split_once('\n').unwrap();
    let damages = [
        format!("{head}\n"),
        whole[..whole.len() / 2].to_owned(),
        whole.replacen("Rod", "Rot", 3),
        whole.replace("mul", "nul") + " ",
        whole.replacen(&head[head.len() - 8..], "01234567", 1),
    ];
    for damaged in damages {
        fs::write(path, &damaged).unwrap();
        assert_eq!(own.cache().expand(attribute(), item()).to_string(), plain);
        assert_eq!(fs::read_to_string(path).unwrap(), whole);
    }
    // Without the first line the file may belong to another program.
    for foreign in [&b"\xff\xfe"[..], b"", &whole.as_bytes()[10..]] {
        fs::write(path, foreign).unwrap();
        assert_eq!(own.cache().expand(attribute(), item()).to_string(), plain);
        assert_eq!(fs::read(path).unwrap(), foreign);
    }
    let mut bytes = whole.into_bytes();
    bytes.truncate(200);
    bytes.push(0xff);
    fs::write(path, bytes).unwrap();
    assert_eq!(own.cache().expand(attribute(), item()).to_string(), plain);
}

#[test]
fn many_threads_share_one_folder() {
    let own = Own::new("threads");
    let plain = layout(expand(attribute(), item())).unwrap();
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..3 {
                    let tokens = own.cache().expand(attribute(), item());
                    assert_eq!(layout(tokens).unwrap(), plain);
                    for file in own.files() {
                        let text = fs::read(&file).unwrap_or_default();
                        let _ = fs::write(file, &text[..text.len() / 2]);
                    }
                }
            });
        }
    });
}

#[test]
fn mistakes_are_never_kept_and_no_folder_is_no_mistake() {
    let own = Own::new("mistakes");
    let wrong = quote!(gravity = 9.8, rod: rod(mass = -1, length = 1));
    let tokens = own.cache().expand(wrong, item()).to_string();
    assert!(tokens.contains("compile_error"), "{tokens}");
    assert_eq!(own.files().len(), 0);

    // A file instead of the folder.
    fs::write(&own.0, "").unwrap();
    let tokens = own.cache().expand(attribute(), item());
    let plain = layout(expand(attribute(), item())).unwrap();
    assert_eq!(layout(tokens).unwrap(), plain);
    fs::remove_file(&own.0).unwrap();
}

#[test]
fn the_structs_own_tokens_keep_their_places() {
    // With spans, as in a file.
    let item: TokenStream = "#[derive(Clone)]\n#[doc = \"text\"]\npub(crate)\nstruct Rod;"
        .parse()
        .unwrap();
    let kept = quote! {
        #[derive(Clone)] #[doc = "text"] #[doc = "more"] pub(crate) struct Rod { a: f64 }
        impl Rod { fn new(parameters: RodParameters) -> Rod {} }
    };
    let mut lines = Vec::new();
    collect(respan::respan(kept.clone(), &item), &mut lines);
    let own = [
        "derive:1",
        "Clone:1",
        "doc:2",
        "crate:3",
        "Rod:4",
        "RodParameters:4",
    ];
    for word in own {
        assert!(lines.iter().any(|line| line == word), "{word}: {lines:?}");
    }
    assert_eq!(lines.iter().filter(|line| *line == "Rod:4").count(), 3);
    assert!(lines.iter().any(|line| line == "parameters:1"));
    assert_eq!(
        respan::respan(kept.clone(), &item).to_string(),
        kept.to_string()
    );
}

/// Collects identifiers with their lines. Tokens of `quote!` are on line 1, as is the text of a
/// stored file that is read back.
fn collect(tokens: TokenStream, lines: &mut Vec<String>) {
    for token in tokens {
        match token {
            proc_macro2::TokenTree::Group(group) => collect(group.stream(), lines),
            proc_macro2::TokenTree::Ident(word) => {
                lines.push(format!("{word}:{}", word.span().start().line));
            }
            _ => {}
        }
    }
}
