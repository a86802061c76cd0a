//! Sectors as the evaluation takes them: columns of coordinates and patterns of blocks.

use alloc::vec::Vec;

use super::constants::rounded;
use super::pattern::Pattern;
use crate::scalar::{Double, Scalar};
use crate::sectors::{Sector, SectorCoordinate};
use crate::spring_dampers::SpringDampers;

/// What a tree's sectors are, whatever its constants.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SymmetricShape {
    pub(super) pattern: Pattern,
    pub(super) parents: Vec<Option<usize>>,
    pub(super) sectors: Vec<Sector>,
    pub(super) blocks: Vec<BlockShape>,
}

/// A sector's block of the mass matrix.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BlockShape {
    /// Index of the sector's first coordinate.
    pub(super) first: usize,
    /// Entries between its coordinates.
    pub(super) pattern: Pattern,
    pub(super) columns: Vec<SectorColumn>,
    /// True for the sector of the means.
    pub(super) is_mean: bool,
}

/// A coordinate.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SectorColumn {
    pub(super) weights: Vec<(usize, f64)>,
    /// Σ weight².
    pub(super) norm: f64,
    /// True if the links that these hang from are of the sector too.
    pub(super) is_below: bool,
}

impl SymmetricShape {
    /// None where a link does not stand behind its parent, or the sectors are not those of a
    /// tree with so many links.
    pub(super) fn new(parents: Vec<Option<usize>>, sectors: &[Sector]) -> Option<Self> {
        let links = parents.len();
        let behind = |(link, parent): (usize, &Option<usize>)| parent.is_none_or(|p| p < link);
        if !parents.iter().enumerate().all(behind) {
            return None;
        }
        let mut blocks: Vec<BlockShape> = Vec::with_capacity(sectors.len());
        // Of each link the coordinate of the last sector that it was met in.
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
                pattern: Pattern::new(above.into_iter()),
                columns,
                is_mean: number == 0,
            });
            first += sector.coordinates().len();
        }
        (first == links).then(|| Self {
            pattern: Pattern::new(parents.iter().copied()),
            parents,
            sectors: sectors.to_vec(),
            blocks,
        })
    }

    /// Number of links.
    #[inline(always)]
    pub(super) fn links(&self) -> usize {
        self.parents.len()
    }

    /// Rows and entries of the largest block.
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

    /// Links and their weights.
    #[inline(always)]
    pub(super) fn iter<T: Scalar>(&self) -> impl Iterator<Item = (usize, T)> {
        self.weights
            .iter()
            .map(|&(link, weight)| (link, T::from_f64(weight)))
    }

    /// Σ weight · value.
    #[inline(always)]
    pub(super) fn sum<T: Scalar>(&self, value: impl Fn(usize) -> T) -> T {
        let own = self.iter();
        own.fold(T::from_f64(0.0), |sum, (link, weight): (usize, T)| {
            sum + weight * value(link)
        })
    }
}

/// Returns weights in an order in which their partial sums stay small: equal values cancel before
/// sums of many of them are rounded, so that differences of equal numbers are zero exactly.
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

/// The stiffness that springs between links give each symmetric coordinate by itself: Σ κ
/// (w_a − w_b)²/Σ w² with the links' weights. None where they couple coordinates, or are at rest
/// where copies differ.
pub(super) fn stiffness<T: Scalar>(
    shape: &SymmetricShape,
    spring_dampers: &SpringDampers<Double>,
) -> Option<Vec<T>> {
    let zero = Double::from_f64(0.0);
    let springs = || spring_dampers.iter().filter(|own| own.spring != zero);
    if springs().any(|own| own.rest != zero) {
        return None;
    }
    let mut found = Vec::with_capacity(shape.links());
    let [mut weights, mut slopes] = [(); 2].map(|()| alloc::vec![zero; shape.links()]);
    for column in shape.blocks.iter().flat_map(|block| &block.columns) {
        weights.fill(zero);
        slopes.fill(zero);
        for (link, weight) in column.iter() {
            *weights.get_mut(link)? = weight;
        }
        for own in springs() {
            let [a, b] = own.links;
            let torque = own.spring * (*weights.get(a)? - *weights.get(b)?);
            let torques = [(a, torque), (b, -torque)];
            for (link, torque) in torques {
                let slope = slopes.get_mut(link)?;
                *slope += torque;
            }
        }
        let pairs = weights.iter().zip(&slopes);
        let norm = Double::from_f64(column.norm);
        let own = pairs.fold(zero, |sum, (&weight, &slope)| sum + weight * slope) / norm;
        // Torques of one coordinate on the others.
        let beyond = |(&weight, &slope): (&Double, &Double)| {
            (slope - own * weight).high().abs() > 1e-12 * own.high().abs()
        };
        let is_mixed = match own == zero {
            true => slopes.iter().any(|slope| *slope != zero),
            false => weights.iter().zip(&slopes).any(beyond),
        };
        if is_mixed {
            return None;
        }
        found.push(rounded(own));
    }
    Some(found)
}

impl BlockShape {
    /// Links of the sector, with the number of their coordinate and their weight.
    #[inline(always)]
    pub(super) fn links<T: Scalar>(&self) -> impl Iterator<Item = (usize, usize, T)> {
        let columns = self.columns.iter().enumerate();
        columns.flat_map(|(index, column)| {
            let own = column.iter();
            own.map(move |(link, weight)| (index, link, weight))
        })
    }

    /// Pairs of a link and one above it that are both of the sector: the place of their entry,
    /// the link and the one above.
    #[inline(always)]
    pub(super) fn pairs<'a>(
        &'a self,
        tree: &'a Pattern,
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
