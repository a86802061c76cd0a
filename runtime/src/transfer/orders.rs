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

    /// Returns the transfers by a form of W, exact or cut off at an order, all differences small,
    /// with the memory that they take. [`Angle(1)`](TransferForm::Angle) is the published form.
    /// None for orders above 15.
    ///
    /// Where copies differ, an order says less: forcing is of the first order of the differences.
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

    /// Writes the transfers into all sectors by a form of W ([`by_form`](Self::by_form)). NaN for
    /// slices of other lengths, and for orders above 15.
    ///
    /// Truncated forms allocate an [`expansion`](Self::expansion) for each call: keep what
    /// [`by_form`](Self::by_form) returns for many states.
    pub fn transfers(
        &self,
        workspace: &mut Workspace<T>,
        form: TransferForm,
        given: Given<'_, T>,
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

/// Transfers by one form of W, with memory that is kept: [`SymmetricTree::by_form`].
#[derive(Clone, Debug)]
pub struct TransfersByForm<'a, T> {
    tree: &'a SymmetricTree<T>,
    /// None of the exact form.
    expansion: Option<(Order, usize, Expansion<T>)>,
    workspace: Workspace<T>,
}

/// Series of as many coefficients as an order takes.
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

    /// Writes the transfers into all sectors at symmetric coordinates and their momenta.
    /// Allocates the first time. NaN for slices of other lengths.
    pub fn transfers(&mut self, [coordinates, momenta]: [&[T]; 2], transfers: &mut [Transfer<T>]) {
        let state = [coordinates, momenta];
        let Some((counted, order, expansion)) = &mut self.expansion else {
            let given = Given::Momenta {
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
        self.set_state(counted, [coordinates, momenta]);
        let given = Given::Momenta {
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
            // K is meant through the order and differentiated then: its slope in the
            // differences has one order less.
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

    /// Takes the state as series: what counts as small is linear.
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

    /// Returns true if the first two orders vanish.
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
