//! Energy transfers truncated at an order in the differences between copies (physics (5.3), (5.6),
//! (9.13)).

use alloc::vec::Vec;

use super::exact::fill;
use super::sector::TransferTerms;
use super::{StateInput, SymmetricTree};
use crate::model::Transfer;
use crate::scalar::{PowerSeries, Scalar};
use crate::system::Workspace;
use crate::transfer_forms::TransferForm;

/// Quantities that count as small in an expansion: each carries one factor ε, and the powers of ε
/// are the orders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The difference angles; their momenta do not count as small.
    Angle,
    /// The difference angles and their momenta; both count as small.
    Amplitude,
}

/// Tree whose state is a power series of `N` coefficients, so that the transfers of all orders
/// below `N` are computed at once. Created by [`SymmetricTree::expansion`].
#[derive(Clone, Debug)]
pub struct OrderedTransfers<T, const N: usize> {
    tree: SymmetricTree<PowerSeries<T, N>>,
    /// For each symmetric coordinate, true if it counts as small.
    small: Vec<bool>,
    workspace: Workspace<PowerSeries<T, N>>,
    coordinates: Vec<PowerSeries<T, N>>,
    momenta: Vec<PowerSeries<T, N>>,
}

impl<T: Scalar> SymmetricTree<T> {
    /// Returns the tree expanded up to order `N` − 1 in the differences of the sectors with these
    /// indices; if `small` is empty, of all sectors.
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

    /// Prepares the evaluation of the energy transfers W in one form, exact or truncated at an
    /// order with all differences small, together with their workspace.
    /// [`Angle(1)`](TransferForm::Angle) is the published form. Returns `None` for orders above 15.
    ///
    /// If copies differ, truncation is less meaningful: the forcing is of first order in the
    /// differences.
    #[must_use]
    pub fn by_form(&self, form: TransferForm) -> Option<TransfersByForm<'_, T>> {
        let (counted, order) = match form {
            TransferForm::Exact => return Some(TransfersByForm::exact(self)),
            TransferForm::Angle(order) => (Order::Angle, order as usize),
            TransferForm::Amplitude(order) => (Order::Amplitude, order as usize),
        };
        let expansion = match order {
            0..=2 => Expansion::Through2(self.expansion(&[])),
            3..=4 => Expansion::Through4(self.expansion(&[])),
            5..=8 => Expansion::Through8(self.expansion(&[])),
            9..=15 => Expansion::Through15(self.expansion(&[])),
            _ => return None,
        };
        Some(TransfersByForm {
            tree: self,
            expansion: Some((counted, order, expansion)),
            workspace: Workspace::new(),
        })
    }

    /// Writes the energy transfers W (in watts) into all sectors, in one form
    /// ([`by_form`](Self::by_form)). NaN for slices of a wrong length, and for orders above 15.
    ///
    /// Truncated forms allocate an [`expansion`](Self::expansion) at each call: for many states,
    /// keep the result of [`by_form`](Self::by_form).
    pub fn transfers(
        &self,
        workspace: &mut Workspace<T>,
        form: TransferForm,
        given: StateInput<'_, T>,
        transfers: &mut [Transfer<T>],
    ) {
        if form == TransferForm::Exact {
            return self.exact_transfers(workspace, given, transfers);
        }
        let mut momenta = alloc::vec![T::from_f64(0.0); self.links()];
        let mut coordinates = momenta.clone();
        self.coordinates(workspace, given, &mut coordinates);
        self.momenta(workspace, given, &mut momenta);
        match self.by_form(form) {
            Some(mut own) => own.transfers([&coordinates, &momenta], transfers),
            None => fill(transfers),
        }
    }
}

/// Evaluates the energy transfers W in one form. Holds the workspace for it. Created by
/// [`SymmetricTree::by_form`].
#[derive(Clone, Debug)]
pub struct TransfersByForm<'a, T> {
    tree: &'a SymmetricTree<T>,
    /// Quantities that are small, order, and expansion of a truncated form; `None` for the exact
    /// form.
    expansion: Option<(Order, usize, Expansion<T>)>,
    workspace: Workspace<T>,
}

/// Expansion of a tree, with as many coefficients as the order needs.
#[derive(Clone, Debug)]
enum Expansion<T> {
    Through2(OrderedTransfers<T, 3>),
    Through4(OrderedTransfers<T, 5>),
    Through8(OrderedTransfers<T, 9>),
    Through15(OrderedTransfers<T, 16>),
}

impl<'a, T: Scalar> TransfersByForm<'a, T> {
    fn exact(tree: &'a SymmetricTree<T>) -> Self {
        Self {
            tree,
            expansion: None,
            workspace: Workspace::new(),
        }
    }

    /// Writes the energy transfers (W) into all sectors at symmetric coordinates and their momenta.
    /// Allocates at the first call. NaN for slices of a wrong length.
    pub fn transfers(&mut self, [coordinates, momenta]: [&[T]; 2], transfers: &mut [Transfer<T>]) {
        let state = [coordinates, momenta];
        let Some((counted, order, expansion)) = &mut self.expansion else {
            let given = StateInput::Momenta {
                coordinates,
                momenta,
            };
            let tree = self.tree;
            return tree.exact_transfers(&mut self.workspace, given, transfers);
        };
        match expansion {
            Expansion::Through2(own) => own.transfers(*counted, *order, state, transfers),
            Expansion::Through4(own) => own.transfers(*counted, *order, state, transfers),
            Expansion::Through8(own) => own.transfers(*counted, *order, state, transfers),
            Expansion::Through15(own) => own.transfers(*counted, *order, state, transfers),
        }
    }
}

impl<T: Scalar, const N: usize> OrderedTransfers<T, N> {
    /// Writes the energy transfers (W) into all sectors, truncated at an order, at symmetric
    /// coordinates and their momenta. Allocates at the first call. NaN for slices of a wrong
    /// length, and for orders that the series do not contain.
    ///
    /// If all differences are small and no copies differ, orders of the amplitude below the second
    /// vanish so they are left out together with their rounding errors.
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
        self.set_state(counted, [coordinates, momenta]);
        let given = StateInput::Momenta {
            coordinates: &self.coordinates,
            momenta: &self.momenta,
        };
        let first = if self.is_quadratic(counted) { 2 } else { 0 };
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
            // K is truncated at the order and then differentiated: its slope in the differences has
            // one order less.
            let slope = match (counted, is_small) {
                (Order::Angle, true) if order == 0 => T::from_f64(0.0),
                (Order::Angle, true) => driven.sum(first..=order - 1),
                _ => driven.sum(first..=order),
            };
            transfers[number] = Transfer {
                kinetic: slope + kinetic.sum(first..=order),
                potential: potential.sum(first..=order),
            };
        });
    }

    /// Sets the state. Each coordinate that counts as small becomes a power series with a linear
    /// term only.
    fn set_state(&mut self, counted: Order, [coordinates, momenta]: [&[T]; 2]) {
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
    }

    /// Returns true if the terms of orders 0 and 1 of the transfers vanish.
    fn is_quadratic(&self, counted: Order) -> bool {
        let is_small = |own| {
            let small = self.small.get::<core::ops::Range<usize>>(own);
            small.is_some_and(|own| own.iter().all(|small| *small))
        };
        let mut blocks = self.tree.shape.blocks.iter();
        counted == Order::Amplitude
            && !self.tree.has_unequal_copies()
            && blocks.all(|block| {
                block.is_mean || is_small(block.first..block.first + block.columns.len())
            })
    }
}
