//! List of entry points under construction.

use super::lower::{Environment, Lowering};
use super::{Entry, ValueId};
use crate::functions::{Naming, Purpose};
use crate::mechanics::expression::Expr;
use crate::scene::Scene;

pub(super) struct EntryList<'l, 'm> {
    pub(super) lowering: &'l mut Lowering<'m>,
    pub(super) entries: Vec<Entry>,
    pub(super) naming: Naming,
}

impl<'l, 'm> EntryList<'l, 'm> {
    pub(super) fn new(scene: &Scene, lowering: &'l mut Lowering<'m>) -> Self {
        Self {
            naming: Naming::of(scene, lowering.mechanics),
            lowering,
            entries: Vec::new(),
        }
    }

    /// Adds the entry point for a purpose.
    pub(super) fn push(&mut self, purpose: Purpose, outputs: Vec<ValueId>) {
        let signature = self.naming.signature(purpose);
        self.entries.push(Entry::new(signature, purpose, outputs));
    }

    pub(super) fn exprs(
        &mut self,
        environment: &mut Environment<'_>,
        exprs: &[Expr],
    ) -> Vec<ValueId> {
        exprs
            .iter()
            .map(|expr| self.lowering.expr(environment, expr))
            .collect()
    }
}
