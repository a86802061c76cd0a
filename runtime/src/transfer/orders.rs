//! Transfers by orders of the differences (physics (5.3), (5.6), (9.13)).

use alloc::vec::Vec;

use super::exact::fill;
use super::sector::TransferTerms;
use super::{Given, SymmetricTree};
use crate::model::Transfer;
use crate::scalar::{PowerSeries, Scalar};
use crate::system::Workspace;
use crate::transfer_forms::TransferForm;

/// What is counted: powers of a factor ε on the differences.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// On their angles; their momenta stay whole.
    Angle,
    /// On their angles and momenta alike.
    Amplitude,
}

/// A tree in power series of `N` coefficients, which gives the transfers of all orders below
/// `N` at once: [`SymmetricTree::expansion`].
#[derive(Clone, Debug)]
pub struct OrderedTransfers<T, const N: usize> {
    tree: SymmetricTree<PowerSeries<T, N>>,
    /// True for each coordinate that counts as small.
    small: Vec<bool>,
    workspace: Workspace<PowerSeries<T, N>>,
    coordinates: Vec<PowerSeries<T, N>>,
    momenta: Vec<PowerSeries<T, N>>,
}

impl<T: Scalar> SymmetricTree<T> {
    /// Returns the tree expanded in the differences of these sectors, or of all where none is
    /// named by its number, through order `N` − 1.
    #[must_use]
    pub fn expansion<const N: usize>(&self, small: &[usize]) -> OrderedTransfers<T, N> {
        let mut is_small = Vec::with_capacity(self.links());
        for (number, block) in self.shape.blocks.iter().enumerate() {
            let own = !block.is_mean && (small.is_empty() || small.contains(&number));
            is_small.resize(is_small.len() + block.columns.len(), own);
        }
        let zero = PowerSeries::constant(T::from_f64(0.0));
        OrderedTransfers {
            tree: self.cast(PowerSeries::constant),
            coordinates: alloc::vec![zero; is_small.len()],
            momenta: alloc::vec![zero; is_small.len()],
            small: is_small,
            workspace: Workspace::new(),
        }
    }

    /// Writes the transfers into all sectors by a form of W: exact, or cut off at an order, all
    /// differences small. [`Angle(1)`](TransferForm::Angle) is the published form. NaN for
    /// slices of other lengths, and for orders above 15.
    ///
    /// Truncated forms allocate an [`expansion`](Self::expansion) for each call: keep one for
    /// many states. Where copies differ, an order says less: forcing is of the first order of
    /// the differences.
    pub fn transfers(
        &self,
        workspace: &mut Workspace<T>,
        form: TransferForm,
        given: Given<'_, T>,
        transfers: &mut [Transfer<T>],
    ) {
        let (counted, order) = match form {
            TransferForm::Exact => return self.exact_transfers(workspace, given, transfers),
            TransferForm::Angle(order) => (Order::Angle, order as usize),
            TransferForm::Amplitude(order) => (Order::Amplitude, order as usize),
        };
        let mut momenta = alloc::vec![T::from_f64(0.0); self.links()];
        let mut coordinates = momenta.clone();
        self.coordinates(workspace, given, &mut coordinates);
        self.momenta(workspace, given, &mut momenta);
        let state = [&coordinates[..], &momenta];
        match order {
            0..=2 => self.through::<3>(counted, order, state, transfers),
            3..=4 => self.through::<5>(counted, order, state, transfers),
            5..=8 => self.through::<9>(counted, order, state, transfers),
            9..=15 => self.through::<16>(counted, order, state, transfers),
            _ => fill(transfers),
        }
    }

    fn through<const N: usize>(
        &self,
        counted: Order,
        order: usize,
        state: [&[T]; 2],
        transfers: &mut [Transfer<T>],
    ) {
        let mut expansion = self.expansion::<N>(&[]);
        expansion.transfers(counted, order, state, transfers);
    }
}

impl<T: Scalar, const N: usize> OrderedTransfers<T, N> {
    /// Writes the transfers into all sectors through an order, at symmetric coordinates and
    /// their momenta. Allocates the first time. NaN for slices of other lengths, and for orders
    /// that the series do not have.
    ///
    /// Where all differences are small and no copies differ, orders of the amplitude below the
    /// second vanish and are left out, so that their rounding is.
    pub fn transfers(
        &mut self,
        counted: Order,
        order: usize,
        [coordinates, momenta]: [&[T]; 2],
        transfers: &mut [Transfer<T>],
    ) {
        fill(transfers);
        let links = self.small.len();
        let sectors = self.tree.shape.blocks.len();
        let lengths = [coordinates.len(), momenta.len(), transfers.len()];
        if order >= N || lengths != [links, links, sectors] {
            return;
        }
        let zero = T::from_f64(0.0);
        let places = self.coordinates.iter_mut().zip(&mut self.momenta);
        let values = coordinates.iter().zip(momenta);
        for ((small, (q, p)), (&angle, &momentum)) in self.small.iter().zip(places).zip(values) {
            let series = |value: T, is_small: bool| match is_small {
                true => PowerSeries::linear(zero, value),
                false => PowerSeries::constant(value),
            };
            *q = series(angle, *small);
            *p = series(momentum, *small && counted == Order::Amplitude);
        }
        let given = Given::Momenta {
            coordinates: &self.coordinates,
            momenta: &self.momenta,
        };
        let quadratic = counted == Order::Amplitude
            && !self.tree.has_unequal_copies()
            && self.tree.shape.blocks.iter().all(|block| {
                let own = block.first..block.first + block.columns.len();
                block.is_mean
                    || self
                        .small
                        .get(own)
                        .is_some_and(|own| own.iter().all(|s| *s))
            });
        let first = if quadratic { 2 } else { 0 };
        let blocks = &self.tree.shape.blocks;
        let small = &self.small;
        let tree = &self.tree;
        tree.for_each_transfer(&mut self.workspace, given, |number, terms| {
            let is_small = small.get(blocks[number].first).copied().unwrap_or(false);
            let TransferTerms {
                driven,
                kinetic,
                potential,
            } = terms;
            // K is meant through the order and differentiated then: its slope in the
            // differences has one order less.
            let slope = match (counted, is_small) {
                (Order::Angle, true) if order == 0 => zero,
                (Order::Angle, true) => driven.sum(first..=order - 1),
                _ => driven.sum(first..=order),
            };
            transfers[number] = Transfer {
                kinetic: slope + kinetic.sum(first..=order),
                potential: potential.sum(first..=order),
            };
        });
    }
}
