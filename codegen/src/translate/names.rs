//! Names of values in a function.

use std::collections::{BTreeMap, BTreeSet};

use crate::functions::Argument;

use crate::program::{Entry, ValueId};

/// Reserved words of the languages, and functions that the translated code calls.
#[rustfmt::skip]
const TAKEN: &[&str] = &[
    "abstract", "and", "as", "assert", "async", "auto", "await", "baremodule", "begin", "break",
    "case", "catch", "char", "class", "const", "continue", "cos", "def", "default", "del", "do",
    "double", "elif", "else", "elseif", "end", "enum", "except", "export", "extern", "false",
    "finally", "float", "for", "from", "function", "global", "goto", "if", "im", "import", "in",
    "inline", "int", "is", "isa", "j0", "j1", "jn", "k", "lambda", "let", "local", "long", "macro",
    "module", "mutable", "nonlocal", "not", "np", "or", "out", "parameters", "pass", "pi",
    "primitive", "quote", "raise", "register", "restrict", "return", "short", "signed", "sin",
    "sizeof", "sqrt", "static", "struct", "switch", "time", "true", "try", "type", "typedef",
    "union", "unsigned", "using", "void", "volatile", "where", "while", "with", "y0", "y1", "yield",
    "yn",
];

/// Names and texts of the values of one function.
pub(super) struct Names {
    texts: BTreeMap<ValueId, String>,
    used: BTreeSet<String>,
}

impl Names {
    pub(super) fn new(entry: &Entry) -> Self {
        let mut names = Self {
            texts: BTreeMap::new(),
            used: TAKEN.iter().map(|word| (*word).to_owned()).collect(),
        };
        for argument in &entry.arguments {
            let name = names.argument(*argument);
            names.used.insert(name);
        }
        names
    }

    /// Returns the name of an argument; if there are several sectors or sets, their arguments are
    /// numbered.
    pub(super) fn argument(&self, argument: Argument) -> String {
        let name = argument.name();
        match argument {
            Argument::Difference(number)
            | Argument::DifferenceRate(number)
            | Argument::Prescribed(number) => format!("{name}_{number}"),
            Argument::Time
            | Argument::Theta
            | Argument::Omega
            | Argument::AbsoluteMomenta
            | Argument::Coordinates
            | Argument::Rates
            | Argument::Momenta
            | Argument::Forces
            | Argument::Alpha
            | Argument::Weights
            | Argument::Actions
            | Argument::SmallDifferences
            | Argument::SmallRates
            | Argument::Torques
            | Argument::SmallTorques
            | Argument::Absolute
            | Argument::Symmetric
            | Argument::Constants
            | Argument::Body
            | Argument::Motion
            | Argument::Response
            | Argument::Sums
            | Argument::Elimination
            | Argument::Carried
            | Argument::Pivot
            | Argument::Given(_) => name.to_owned(),
        }
    }

    /// Sets the text by which a value is referred to.
    pub(super) fn is(&mut self, id: ValueId, text: String) {
        self.texts.insert(id, text);
    }

    /// Assigns a variable name to a value: `wanted`, if that name is free.
    pub(super) fn own(&mut self, id: ValueId, wanted: Option<&String>) -> String {
        let ascii = wanted.filter(|name| name.is_ascii());
        let stem = ascii.cloned().unwrap_or_else(|| format!("v{}", id.0));
        let mut name = stem.clone();
        let mut number = 2;
        while self.used.contains(&name) {
            name = format!("{stem}_{number}");
            number += 1;
        }
        self.used.insert(name.clone());
        self.texts.insert(id, name.clone());
        name
    }

    /// Returns the text by which a value is referred to.
    pub(super) fn of(&self, id: ValueId) -> String {
        match self.texts.get(&id) {
            Some(text) => text.clone(),
            None => unreachable!("operands come first"),
        }
    }
}
