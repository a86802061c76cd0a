//! Files of the cache: a question, its answer, a checksum.

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};
use std::collections::hash_map::DefaultHasher;
use std::fmt::{self, Display, Formatter};
use std::hash::{Hash, Hasher};

/// State of the compiler that this is: the build script's hash of its source.
const COMPILER: &str = concat!(
    env!("CARGO_PKG_VERSION"),
    " ",
    env!("BRANCHED_PENDULUM_COMPILER")
);

/// A question and its answer.
pub(super) struct CacheEntry<'a> {
    pub(super) question: &'a str,
    pub(super) expansion: &'a str,
}

impl CacheEntry<'_> {
    /// Name of the file that answers a question, if there is one.
    pub(super) fn file_name(question: &str) -> String {
        format!("{:016x}.expansion", hash(question))
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
        format!("branched-pendulum expansion {checksum:016x}")
    }
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
