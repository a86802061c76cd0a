//! Templates: one link for all of its copies, with its body.

use proc_macro2::Span;

use super::Offset;
use super::bodies::Body;
use super::passive::PassiveTorques;
use super::rule::Code;
use super::values::Values;

/// Largest number of links of a scene, copies included.
pub(super) const MAX_LINKS: usize = 4096;

/// A link of the description; it represents all of its equal copies.
#[derive(Debug)]
pub(super) struct Template {
    pub(super) name: String,
    /// Name of the node in the description; a generation rule is one node.
    pub(super) node: String,
    pub(super) span: Span,
    /// Index of the parent's template, which comes earlier.
    pub(super) parent: Option<usize>,
    /// Number of copies under each copy of the parent.
    pub(super) copies: usize,
    /// If the copies of a node differ, each has its own template, and this is the number of the
    /// copy.
    pub(super) number: Option<usize>,
    /// Index of the template of the node's first copy; its own index if the copies are equal.
    pub(super) origin: usize,
    pub(super) body: Body,
    /// Pivot on the parent; zero for the root.
    pub(super) pivot: Offset,
    pub(super) passive: PassiveTorques,
}

/// Templates and values collected while the description is read.
#[derive(Default)]
pub(super) struct TreeBuilder {
    /// Templates in depth-first order, each parent before its children.
    pub(super) templates: Vec<Template>,
    pub(super) values: Values,
    /// The rule, if one rule describes the whole tree.
    pub(super) whole: Option<WholeRule>,
}

/// A generation rule that describes the whole tree.
#[derive(Clone, Copy)]
pub(super) struct WholeRule {
    pub(super) branching: usize,
    pub(super) code: Option<Code>,
    pub(super) span: Span,
    /// Number of generations, if one branching of each is open.
    pub(super) open: Option<usize>,
}
