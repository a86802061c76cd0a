//! Format of a cache file: its key (everything that an expansion depends on, called the question),
//! the expansion (the answer) and a checksum.

use crate::invocation;
use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};
use std::collections::hash_map::DefaultHasher;
use std::ffi::OsStr;
use std::fmt::{self, Display, Formatter};
use std::hash::{Hash, Hasher};

/// Identifies the state of this compiler: version, and the build script's hash of the source.
const COMPILER: &str = concat!(
    env!("CARGO_PKG_VERSION"),
    " ",
    env!("BRANCHED_PENDULUM_COMPILER")
);

/// Ending of the file names.
const ENDING: &str = ".expansion";

/// First bytes of each file, before the checksum.
const MARK: &str = "branched-pendulum expansion ";

/// Number of hexadecimal digits of a checksum.
const CODE: usize = 16;

/// Number of bytes of the first line.
pub(super) const HEAD: usize = MARK.len() + CODE + 1;

/// Contents of a cache file: the question (everything that an expansion depends on) and its answer
/// (the expansion), both as text.
pub(super) struct CacheEntry<'a> {
    pub(super) question: &'a str,
    pub(super) expansion: &'a str,
}

impl CacheEntry<'_> {
    /// Returns the name of the file that contains the answer to a question.
    pub(super) fn file_name(question: &str) -> String {
        format!("{:016x}{ENDING}", hash(question))
    }

    /// Returns the temporary name of the file `name` while the process `id` writes it; `number`
    /// counts the files that this process has written.
    pub(super) fn part_name(name: &str, id: u32, number: u64) -> String {
        format!("{name}.{id}-{number}")
    }

    /// Returns true for names that [`file_name`](Self::file_name) and
    /// [`part_name`](Self::part_name) can return.
    pub(super) fn is_name(name: &OsStr) -> bool {
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let Some((code, rest)) = name.to_str().and_then(|name| name.split_once(ENDING)) else {
            return false;
        };
        let part = rest.strip_prefix('.').and_then(|part| part.split_once('-'));
        is_code(code.as_bytes())
            && (rest.is_empty() || part.is_some_and(|(id, number)| digits(id) && digits(number)))
    }

    /// Returns true if the first bytes of a file are those of a cache file.
    pub(super) fn is_head(start: &[u8; HEAD]) -> bool {
        let rest = start.strip_prefix(MARK.as_bytes());
        let code = rest.and_then(|rest| rest.strip_suffix(b"\n"));
        code.is_some_and(is_code)
    }

    /// Reads the answer to `question` from the text of a file. Returns `None` if the file is
    /// damaged or answers another question.
    pub(super) fn answer(text: &str, question: &str) -> Option<TokenStream> {
        let (head, rest) = text.split_once('\n')?;
        let expansion = rest.strip_prefix(question)?.strip_prefix('\n')?;
        let entry = CacheEntry {
            question,
            expansion,
        };
        (head == entry.head()).then(|| expansion.parse().ok())?
    }

    /// Returns the first line of the file, without its line break.
    fn head(&self) -> String {
        let checksum = hash(&(self.question, self.expansion));
        format!("{MARK}{checksum:016x}")
    }
}

/// Returns true if `text` is a hash as file names and first lines contain it: 16 lower-case
/// hexadecimal digits.
fn is_code(text: &[u8]) -> bool {
    let is_digit = |byte: &u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(byte);
    text.len() == CODE && text.iter().all(is_digit)
}

impl Display for CacheEntry<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}\n{}", self.head(), self.question, self.expansion)
    }
}

fn hash(value: &(impl Hash + ?Sized)) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

/// Writes everything that an expansion depends on as text: the state of the compiler, and the
/// tokens one by one. (Tokens printed as a whole do not show groups without delimiters, which
/// macros of the user can produce.)
pub(super) fn question(attribute: &TokenStream, item: &TokenStream) -> String {
    // A crate that has the runtime under another name gets other tokens.
    let runtime = invocation::renamed_runtime().unwrap_or_default();
    let mut text = format!("{COMPILER} {runtime}\n");
    for tokens in [attribute, item] {
        push_tokens(tokens.clone(), &mut text);
        text.push('\n');
    }
    text
}

fn push_tokens(tokens: TokenStream, text: &mut String) {
    // A stack instead of recursion: the depth of these groups has not been checked yet.
    let mut open = vec![(tokens.into_iter(), "")];
    while let Some((level, end)) = open.last_mut() {
        match level.next() {
            None => {
                text.push_str(end);
                text.push(' ');
                open.pop();
            }
            Some(TokenTree::Group(group)) => {
                let (start, end) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::Brace => ("{", "}"),
                    Delimiter::None => ("⟨", "⟩"),
                };
                text.push_str(start);
                text.push(' ');
                open.push((group.stream().into_iter(), end));
            }
            Some(TokenTree::Punct(mark)) => {
                text.push(mark.as_char());
                if mark.spacing() == Spacing::Alone {
                    text.push(' ');
                }
            }
            Some(other) => {
                text.push_str(&other.to_string());
                text.push(' ');
            }
        }
    }
}
