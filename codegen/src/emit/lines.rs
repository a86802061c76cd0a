//! The `let` lines of a function, before these are assembled to a function body.

use super::gather::Gathered;
use super::names::Locals;
use crate::functions::Argument;
use crate::program::ValueId;
use proc_macro2::TokenStream;

/// Approximate number of lines from which a function is split into parts.
pub(super) const MOST_LINES: usize = 1000;

/// Approximate number of lines up to which the parts of a function are compiled as a whole, which
/// runs faster. The parts of longer functions are compiled separately.
const MOST_INLINED: usize = 3000;

/// Number of characters of tokens per line of formatted code.
const WIDTH: usize = 60;

/// One `let` line.
#[derive(Clone)]
pub(super) struct Line {
    /// Values that the line names.
    pub(super) defines: Vec<ValueId>,
    /// Values that the line uses, named or not.
    pub(super) reads: Vec<ValueId>,
    /// Argument that the line reads as a whole.
    pub(super) whole: Option<Argument>,
    pub(super) tokens: TokenStream,
    /// Estimated number of lines of formatted code.
    pub(super) height: usize,
}

impl Line {
    pub(super) fn new(defines: Vec<ValueId>, reads: Vec<ValueId>, tokens: TokenStream) -> Self {
        Self {
            defines,
            reads,
            whole: None,
            height: tokens.to_string().len().div_ceil(WIDTH),
            tokens,
        }
    }
}

/// The lines of a function, before these are assembled to a function body.
pub(super) struct Written {
    pub(super) lines: Vec<Line>,
    pub(super) locals: Locals,
    pub(super) gathered: Gathered,
    /// True if the body has to be split into parts.
    pub(super) long: bool,
}

/// Returns true if these lines are too many for one function.
pub(super) fn is_long(lines: &[Line]) -> bool {
    height(lines) > MOST_LINES
}

/// Returns true if a function with these lines is compiled as a whole, even if its source is split
/// into parts.
pub(super) fn is_whole(lines: &[Line]) -> bool {
    height(lines) <= MOST_INLINED
}

fn height(lines: &[Line]) -> usize {
    lines.iter().map(|line| line.height).sum()
}
