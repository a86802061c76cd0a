//! Files of the cache: a question, its answer, a checksum.

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};
use std::collections::hash_map::DefaultHasher;
use std::ffi::OsStr;
use std::fmt::{self, Display, Formatter};
use std::hash::{Hash, Hasher};

/// State of the compiler that this is: the build script's hash of its source.
const COMPILER: &str = concat!(
    env!("CARGO_PKG_VERSION"),
    " ",
    env!("BRANCHED_PENDULUM_COMPILER")
);

/// End of the names of files.
const ENDING: &str = ".expansion";

/// Start of files, before the checksum.
const MARK: &str = "branched-pendulum expansion ";

/// Digits of a checksum.
const CODE: usize = 16;

/// Bytes of the first line.
pub(super) const HEAD: usize = MARK.len() + CODE + 1;

/// A question and its answer.
pub(super) struct CacheEntry<'a> {
    pub(super) question: &'a str,
    pub(super) expansion: &'a str,
}

impl CacheEntry<'_> {
    /// Name of the file that answers a question, if there is one.
    pub(super) fn file_name(question: &str) -> String {
        format!("{:016x}{ENDING}", hash(question))
    }

    /// Name of a file while process `id` writes it as its `number`-th.
    pub(super) fn part_name(name: &str, id: u32, number: u64) -> String {
        format!("{name}.{id}-{number}")
    }

    /// Returns true for names that the two functions above give.
    pub(super) fn is_name(name: &OsStr) -> bool {
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let Some((code, rest)) = name.to_str().and_then(|name| name.split_once(ENDING)) else {
            return false;
        };
        let part = rest.strip_prefix('.').and_then(|part| part.split_once('-'));
        is_code(code.as_bytes())
            && (rest.is_empty() || part.is_some_and(|(id, number)| digits(id) && digits(number)))
    }

    /// Returns true if a file starts as those of the cache do.
    pub(super) fn is_head(start: &[u8; HEAD]) -> bool {
        let rest = start.strip_prefix(MARK.as_bytes());
        let code = rest.and_then(|rest| rest.strip_suffix(b"\n"));
        code.is_some_and(is_code)
    }

    /// Reads the answer to `question` from a file's text; `None` if the file is
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

    /// First line of the file.
    fn head(&self) -> String {
        let checksum = hash(&(self.question, self.expansion));
        format!("{MARK}{checksum:016x}")
    }
}

/// Returns true for a number as names and heads hold it.
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

/// All that an expansion depends on, as text: the state of the compiler, and the
/// tokens one by one, since their text alone does not show groups without
/// delimiters, which macros of the user's make.
pub(super) fn question(attribute: &TokenStream, item: &TokenStream) -> String {
    let mut text = format!("{COMPILER}\n");
    for tokens in [attribute, item] {
        push_tokens(tokens.clone(), &mut text);
        text.push('\n');
    }
    text
}

fn push_tokens(tokens: TokenStream, text: &mut String) {
    // Without recursion: nothing has looked at the depth of these groups yet.
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
