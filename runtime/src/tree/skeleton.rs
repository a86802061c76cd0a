//! Parts of a tree that do not depend on its equations: topology, constants, order of computation.

use alloc::vec::Vec;

use super::layout::EvaluationMemory;
use super::memory::{Sizes, line, odd_lines};
use super::partition::Policy;
use super::plan::Plan;
use crate::scalar::Scalar;
use crate::scalar::kind::compiled_once;
use crate::simd::WIDEST;

/// Topology and constants of a tree, and the order in which it is computed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Skeleton<T> {
    /// Plan for the evaluation of one state, and plan for many states in lanes.
    pub(super) plan: Plan,
    pub(super) states: Plan,
    pub(super) sizes: Sizes,
    /// Constants: one row per generation, or one column per constant with the links in the order of
    /// the plan.
    pub(super) constants: Vec<T>,
    /// Columns of constants with the links in the order for many states in lanes; empty for a tree
    /// by generations, whose rows serve both purposes.
    pub(super) of_states: Vec<T>,
    /// Acceleration of the root's pivot relative to free fall.
    pub(super) root: [T; 2],
    threads: usize,
    pub(super) layout: EvaluationMemory,
    /// Workspace length, in numbers, for the evaluation of one state.
    pub(super) buffer: usize,
}

impl<T: Scalar> Skeleton<T> {
    /// Creates a tree with one row of constants per generation.
    pub(super) fn by_generation(
        copies: &[usize],
        sizes: Sizes,
        constants: Vec<T>,
        root: [T; 2],
        threads: usize,
    ) -> Self {
        let plan = Plan::new(copies, Policy::ONE_STATE);
        let states = Plan::new(copies, Policy::STATES);
        Self::new(
            [plan, states],
            sizes,
            [constants, Vec::new()],
            root,
            threads,
        )
    }

    /// Creates a tree from one row of constants per link.
    pub(super) fn by_link(parents: &[u32], sizes: Sizes, rows: &[T], root: [T; 2]) -> Self {
        let plans =
            [Policy::ONE_STATE, Policy::STATES].map(|policy| Plan::by_height(parents, policy));
        let constants = plans.each_ref().map(|plan| columns(plan, sizes, rows));
        Self::new(plans, sizes, constants, root, 1)
    }

    fn new(
        [plan, states]: [Plan; 2],
        sizes: Sizes,
        [constants, of_states]: [Vec<T>; 2],
        root: [T; 2],
        threads: usize,
    ) -> Self {
        let layout = EvaluationMemory::new::<T>(&plan, sizes);
        Self {
            buffer: layout.workspace_len::<T>(&plan, sizes, threads),
            layout,
            plan,
            states,
            sizes,
            constants,
            of_states,
            root,
            threads,
        }
    }

    pub(super) fn threads(&self) -> usize {
        self.threads
    }

    pub(super) fn set_threads(&mut self, threads: usize) {
        self.threads = threads;
        self.buffer = self
            .layout
            .workspace_len::<T>(&self.plan, self.sizes, threads);
    }

    /// Returns this tree with a root that is not accelerated and with zeros in some `columns` of
    /// constants.
    pub(super) fn at_rest_without(&self, columns: &[usize]) -> Self {
        let zero = T::from_f64(0.0);
        let mut own = self.clone();
        own.root = [zero; 2];
        let width = self.sizes.constants.max(1);
        for numbers in [&mut own.constants, &mut own.of_states] {
            let length = (numbers.len() / width).max(1);
            for (place, number) in numbers.iter_mut().enumerate() {
                let column = match self.sizes.by_link {
                    true => place / length,
                    false => place % width,
                };
                if columns.contains(&column) {
                    *number = zero;
                }
            }
        }
        own
    }

    /// Returns this tree with constants of another scalar type.
    pub(super) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Skeleton<S> {
        let constants = [&self.constants, &self.of_states];
        Skeleton::new(
            [self.plan.clone(), self.states.clone()],
            self.sizes,
            constants.map(|numbers| numbers.iter().map(|&x| convert(x)).collect()),
            self.root.map(&convert),
            self.threads,
        )
    }
}

/// Converts rows of constants of all links to columns, with the links in the order of a plan.
fn columns<T: Scalar>(plan: &Plan, sizes: Sizes, rows: &[T]) -> Vec<T> {
    let length = odd_lines(line::<T>(), plan.links() + WIDEST);
    let mut columns = alloc::vec![T::from_f64(0.0); sizes.constants * length];
    if let Some(width) = core::num::NonZeroUsize::new(sizes.constants) {
        let rows: Vec<&[T]> = rows.chunks(width.get()).collect();
        for (column, numbers) in columns.chunks_mut(length).enumerate() {
            for (number, &link) in numbers.iter_mut().zip(&plan.order) {
                let row = rows.get(link as usize);
                if let Some(&value) = row.and_then(|row| row.get(column)) {
                    *number = value;
                }
            }
        }
    }
    columns
}

compiled_once! {
    /// Function pointer to [`Skeleton::by_generation`].
    pub(super) ByGeneration<T> = Skeleton::by_generation:
        fn(&[usize], Sizes, Vec<T>, [T; 2], usize) -> Skeleton<T>
}

compiled_once! {
    /// Function pointer to [`Skeleton::by_link`].
    pub(super) ByLink<T> = Skeleton::by_link:
        fn(&[u32], Sizes, &[T], [T; 2]) -> Skeleton<T>
}
