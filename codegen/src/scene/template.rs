//! Templates: one link for all its copies, its body known.

use proc_macro2::Span;

use super::Offset;
use super::bodies::Body;
use super::passive::PassiveTorques;
use super::rule::Code;
use super::values::Values;

/// Most links that a scene may have, copies included.
pub(super) const MAX_LINKS: usize = 4096;

/// A link of the description, for all its copies that are equal.
#[derive(Debug)]
pub(super) struct Template {
    pub(super) name: String,
    /// The node of the description: one for all generations of a rule.
    pub(super) node: String,
    pub(super) span: Span,
    /// An earlier template.
    pub(super) parent: Option<usize>,
    /// Copies under each copy of the parent.
    pub(super) copies: usize,
    /// Number of this copy among those of its node, where they differ: then each has a
    /// template of its own.
    pub(super) number: Option<usize>,
    /// Template of the first copy of the node; its own index where copies are equal.
    pub(super) origin: usize,
    pub(super) body: Body,
    /// The pivot on the parent; zero for the root.
    pub(super) pivot: Offset,
    pub(super) passive: PassiveTorques,
}

/// The templates and values that are built up on the way through the
/// description.
#[derive(Default)]
pub(super) struct TreeBuilder {
    /// Parents before children, depth first.
    pub(super) templates: Vec<Template>,
    pub(super) values: Values,
    /// The rule that the whole tree is, where it is one.
    pub(super) whole: Option<WholeRule>,
}

/// A rule for the whole tree.
#[derive(Clone, Copy)]
pub(super) struct WholeRule {
    pub(super) branching: usize,
    pub(super) code: Option<Code>,
    pub(super) span: Span,
}
