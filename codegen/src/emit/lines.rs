//! The `let` lines of a function before it is put together.

use super::gather::Gathered;
use super::names::Locals;
use crate::functions::Argument;
use crate::program::ValueId;
use proc_macro2::TokenStream;

/// A function of about more lines than this is written in parts.
pub(super) const MOST_LINES: usize = 1000;

/// The parts of a function of about more lines than this are compiled one by
/// one; those of a shorter one as the whole that they are, which runs faster.
const MOST_INLINED: usize = 3000;

/// Characters of tokens on a line of formatted code.
const WIDTH: usize = 60;

/// One `let` line.
#[derive(Clone)]
pub(super) struct Line {
    /// The values that it names.
    pub(super) defines: Vec<ValueId>,
    /// Values that it is formed from, named or not.
    pub(super) reads: Vec<ValueId>,
    /// An argument that it reads as a whole.
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

/// A function before it is put together.
pub(super) struct Written {
    pub(super) lines: Vec<Line>,
    pub(super) locals: Locals,
    pub(super) gathered: Gathered,
    /// True if the body is to be written in parts.
    pub(super) long: bool,
}

/// Returns true if these lines are too many for one function.
pub(super) fn is_long(lines: &[Line]) -> bool {
    height(lines) > MOST_LINES
}

/// Returns true if a function of these lines is compiled as a whole, in parts
/// or not.
pub(super) fn is_whole(lines: &[Line]) -> bool {
    height(lines) <= MOST_INLINED
}

fn height(lines: &[Line]) -> usize {
    lines.iter().map(|line| line.height).sum()
}
