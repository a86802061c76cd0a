//! The catalogue of messages: all that the front end has to say to a user, by the part
//! of a description that it is about. Every one says what is wrong and what to write
//! instead.

use std::fmt;

/// Declares an enum of messages, each with its words: the mistake in a statement that stands
/// on its own, the mistake in the marked tokens, and what to write instead.
macro_rules! messages {
    (
        $(#[$about:meta])*
        $name:ident as $part:ident:
        $(
            $(#[$docs:meta])*
            $message:ident $({ $($field:ident: $kind:ty),+ $(,)? })? =>
                ($text:expr, $label:expr, $hint:expr $(,)?),
        )+
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, PartialEq, Eq)]
        pub enum $name {
            $(
                $(#[$docs])*
                $message $({
                    $(
                        #[doc = "Part of the words."]
                        $field: $kind
                    ),+
                })?,
            )+
        }

        impl $name {
            /// Names of all of them.
            pub const NAMES: &[&str] = &[$(stringify!($message)),+];

            /// The message in words.
            pub(super) fn problem(&self) -> Problem {
                match self {
                    $(Self::$message $({ $($field),+ })? => Problem {
                        text: $text.into(),
                        label: $label.into(),
                        hint: $hint.into(),
                    },)+
                }
            }
        }

        impl From<$name> for super::Message {
            fn from(message: $name) -> Self {
                Self::$part(message)
            }
        }
    };
}

mod output;
mod size;
mod syntax;
mod tree;
mod value;

pub use output::{NoChord, OutputMessage, UnequalUse};
pub use size::SizeMessage;
pub use syntax::SyntaxMessage;
pub use tree::TreeMessage;
pub use value::{Lookalike, ValueMessage};

/// A mistake in a description.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Message {
    /// About its tokens, the struct and the settings.
    Syntax(SyntaxMessage),
    /// About its links and their names.
    Tree(TreeMessage),
    /// About its values and the drive.
    Value(ValueMessage),
    /// About the outputs that it asks for.
    Output(OutputMessage),
    /// About how large it is and what can be derived of it.
    Size(SizeMessage),
}

impl Message {
    /// The message in words.
    pub fn problem(&self) -> Problem {
        match self {
            Self::Syntax(message) => message.problem(),
            Self::Tree(message) => message.problem(),
            Self::Value(message) => message.problem(),
            Self::Output(message) => message.problem(),
            Self::Size(message) => message.problem(),
        }
    }
}

/// A message in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Statement of the mistake that stands on its own.
    pub text: String,
    /// Mistake in the marked tokens.
    pub label: String,
    /// Correction to write instead.
    pub hint: String,
}

/// The name that was probably meant, or else what there is.
fn suggest(nearest: &Option<impl fmt::Display>, otherwise: impl Into<String>) -> String {
    match nearest {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => otherwise.into(),
    }
}

/// Names with commas between them.
fn listed(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}
