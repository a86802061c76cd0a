//! Sectors in the form used by the evaluation: the weights of each symmetric coordinate, and the
//! sparsity pattern of each sector's block of the mass matrix.

use alloc::vec::Vec;

use super::pattern::MatrixPattern;
use crate::scalar::Scalar;
use crate::sectors::{Sector, SectorCoordinate};

/// Structure of the sectors of a tree, independent of the tree's constants.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SymmetricShape {
    pub(super) pattern: MatrixPattern,
    pub(super) parents: Vec<Option<usize>>,
    pub(super) sectors: Vec<Sector>,
    pub(super) blocks: Vec<BlockShape>,
}

/// Structure of a sector's block of the mass matrix.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BlockShape {
    /// Index of the sector's first coordinate.
    pub(super) first: usize,
    /// Entries between the sector's coordinates.
    pub(super) pattern: MatrixPattern,
    pub(super) columns: Vec<SectorColumn>,
    /// True if this is the sector of the means.
    pub(super) is_mean: bool,
}

/// A symmetric coordinate: the weights with which it enters the angles of the links.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SectorColumn {
    pub(super) weights: Vec<(usize, f64)>,
    /// Sum of the squared weights.
    pub(super) norm: f64,
    /// True if the parents of the coordinate's links belong to the same sector.
    pub(super) is_below: bool,
}

impl SymmetricShape {
    /// Creates the structure from the parent of each link and the sectors. Returns `None` if there
    /// are no links, if a link comes before its parent, or if the sectors are not those of a tree
    /// with this many links.
    pub(super) fn new(parents: Vec<Option<usize>>, sectors: &[Sector]) -> Option<Self> {
        let links = parents.len();
        let behind = |(link, parent): (usize, &Option<usize>)| parent.is_none_or(|p| p < link);
        if parents.is_empty() || !parents.iter().enumerate().all(behind) {
            return None;
        }
        let mut blocks: Vec<BlockShape> = Vec::with_capacity(sectors.len());
        // For each link, the coordinate of the last sector in which it occurred.
        let mut own = alloc::vec![(usize::MAX, 0); links];
        let mut first = 0;
        for (number, sector) in sectors.iter().enumerate() {
            let mut columns = Vec::with_capacity(sector.coordinates().len());
            let mut above = Vec::with_capacity(sector.coordinates().len());
            for (index, coordinate) in sector.coordinates().iter().enumerate() {
                let &(link, _) = coordinate.weights().first()?;
                let parent = *parents.get(link)?;
                let parent = parent.and_then(|parent| own.get(parent));
                let parent = parent.filter(|(sector, _)| *sector == number);
                let parent = parent.map(|(_, coordinate)| *coordinate);
                for (link, _) in coordinate.weights() {
                    *own.get_mut(*link)? = (number, index);
                }
                above.push(parent);
                columns.push(SectorColumn::new(coordinate, parent.is_some()));
            }
            blocks.push(BlockShape {
                first,
                pattern: MatrixPattern::new(above.into_iter()),
                columns,
                is_mean: number == 0,
            });
            first += sector.coordinates().len();
        }
        (first == links).then(|| Self {
            pattern: MatrixPattern::new(parents.iter().copied()),
            parents,
            sectors: sectors.to_vec(),
            blocks,
        })
    }

    /// Returns the number of links.
    #[inline(always)]
    pub(super) fn links(&self) -> usize {
        self.parents.len()
    }

    /// Returns the number of rows and the number of off-diagonal entries of the largest block.
    pub(super) fn largest_block(&self) -> [usize; 2] {
        let blocks = self.blocks.iter().map(|block| &block.pattern);
        blocks.fold([0; 2], |[rows, entries], own| {
            [rows.max(own.rows()), entries.max(own.entries())]
        })
    }
}

impl SectorColumn {
    fn new(coordinate: &SectorCoordinate, is_below: bool) -> Self {
        Self {
            weights: balanced(coordinate.weights()),
            norm: coordinate.norm(),
            is_below,
        }
    }

    /// Iterates over the links of the coordinate and their weights.
    #[inline(always)]
    pub(super) fn iter<T: Scalar>(&self) -> impl Iterator<Item = (usize, T)> {
        self.weights
            .iter()
            .map(|&(link, weight)| (link, T::from_f64(weight)))
    }

    /// Returns Σ weight · value.
    #[inline(always)]
    pub(super) fn sum<T: Scalar>(&self, value: impl Fn(usize) -> T) -> T {
        let own = self.iter();
        own.fold(T::from_f64(0.0), |sum, (link, weight): (usize, T)| {
            sum + weight * value(link)
        })
    }
}

/// Sorts weights so that their partial sums stay small: equal values cancel before sums of many of
/// them are rounded, so that differences of equal numbers are exactly zero.
fn balanced(weights: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let (above, below): (Vec<_>, Vec<_>) = weights
        .iter()
        .copied()
        .partition(|(_, weight)| *weight > 0.0);
    let (mut above, mut below) = (above.into_iter(), below.into_iter());
    let mut sum = 0.0;
    let next = || {
        let own = match sum > 0.0 {
            true => below.next().or_else(|| above.next()),
            false => above.next().or_else(|| below.next()),
        }?;
        sum += own.1;
        Some(own)
    };
    core::iter::from_fn(next).collect()
}

impl BlockShape {
    /// Iterates over the links of the sector, with the index of their coordinate and their weight.
    #[inline(always)]
    pub(super) fn links<T: Scalar>(&self) -> impl Iterator<Item = (usize, usize, T)> {
        let columns = self.columns.iter().enumerate();
        columns.flat_map(|(index, column)| {
            let own = column.iter();
            own.map(move |(link, weight)| (index, link, weight))
        })
    }

    /// Iterates over pairs of a link and an ancestor that both belong to the sector: index of the
    /// entry, link and ancestor.
    #[inline(always)]
    pub(super) fn pairs<'a>(
        &'a self,
        tree: &'a MatrixPattern,
    ) -> impl Iterator<Item = (usize, usize, usize)> {
        let columns = self.columns.iter().enumerate();
        columns.flat_map(move |(index, column)| {
            let depth = self.pattern.upwards(index).count();
            column.weights.iter().flat_map(move |&(link, _)| {
                let above = tree.upwards(link).take(depth);
                above.map(move |(place, above)| (place, link, above))
            })
        })
    }
}
