//! Catalogue of all error messages of the front end, grouped by the part of a description that they
//! are about. Every message states the mistake and what to write instead.

use std::fmt;

/// Declares an enum of messages, each with three texts: the mistake in a complete statement
/// (`text`), the mistake as a label of the marked tokens (`label`), and what to write instead
/// (`hint`).
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
            /// Names of all messages of this enum.
            pub const NAMES: &[&str] = &[$(stringify!($message)),+];

            /// Returns the texts of the message.
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
    /// Mistake in the tokens of the description, the struct or the settings.
    Syntax(SyntaxMessage),
    /// Mistake in the links or their names.
    Tree(TreeMessage),
    /// Mistake in the values or the drive.
    Value(ValueMessage),
    /// Mistake in the requested outputs.
    Output(OutputMessage),
    /// The tree is too large, or its equations cannot be derived.
    Size(SizeMessage),
}

impl Message {
    /// Returns the texts of the message.
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

/// Texts of a message, in the parts that the compiler prints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Complete statement of the mistake.
    pub text: String,
    /// Label of the marked tokens, which states the mistake briefly.
    pub label: String,
    /// Correction to write instead.
    pub hint: String,
}

/// Returns a hint that suggests the name `nearest`, or else the hint `otherwise`.
fn suggest(nearest: &Option<impl fmt::Display>, otherwise: impl Into<String>) -> String {
    match nearest {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => otherwise.into(),
    }
}

/// Joins names with commas.
fn listed(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}
