//! Straight springs between copies, sector by sector.
//!
//! A spring κ of zero rest length between points at the distance r from the common pivot of two
//! copies has the energy ½ κ r² |e^{iθ_a} − e^{iθ_b}|². If the same spring connects every two of
//! the k copies under one link, the sum is ½ k κ r² |[e^{iθ}]_s|² in each sector s of their
//! differences, and zero in all others (physics (19.10)). It has the form of gravity's ½ G |[1 −
//! e^{iθ}]_s|², with k κ r² instead of G.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::constants::rounded;
use super::shape::{SectorColumn, SymmetricShape};
use crate::scalar::{Double, Scalar};

/// Identical straight springs, of zero rest length and without dampers, between the same point of
/// every two copies of a node under one link.
#[derive(Clone, Debug, PartialEq)]
pub struct ChordSpring<T> {
    /// Indices of all copies under the link.
    pub copies: Vec<usize>,
    /// κ r² in J: the stiffness times the squared distance of the points from the pivot.
    pub strength: T,
}

/// Straight springs between the same points of copies.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chords<T> {
    /// k κ r² in J (k copies, stiffness κ, distance r from the pivot), by the index of the
    /// coordinate. Empty without such springs.
    by_coordinate: Vec<T>,
    /// Pairs of copies connected by a spring, with κ r² in J (stiffness κ, distance r from the
    /// pivot).
    pairs: Vec<([usize; 2], T)>,
}

/// No springs.
impl<T> Default for Chords<T> {
    fn default() -> Self {
        Self {
            by_coordinate: Vec::new(),
            pairs: Vec::new(),
        }
    }
}

impl<T: Scalar> Chords<T> {
    /// Converts springs between copies to energies by sector. Returns `None` if the links are not
    /// all copies under one link.
    pub(super) fn of(shape: &SymmetricShape, springs: &[ChordSpring<Double>]) -> Option<Self> {
        if springs.is_empty() {
            return Some(Self::default());
        }
        let mut by_coordinate = alloc::vec![Double::from_f64(0.0); shape.links()];
        let mut pairs = Vec::new();
        for ChordSpring { copies, strength } in springs {
            let &first = copies.first()?;
            let columns = || own_differences(shape, first);
            let of_columns: BTreeSet<usize> = columns()
                .flat_map(|(_, column)| column.weights.iter().map(|(link, _)| *link))
                .collect();
            let is_whole = of_columns == copies.iter().copied().collect();
            if !is_whole || of_columns.len() != copies.len() {
                return None;
            }
            for (coordinate, _) in columns() {
                by_coordinate[coordinate] += Double::from_f64(copies.len() as f64) * *strength;
            }
            for (place, &a) in copies.iter().enumerate() {
                let others = copies[place + 1..].iter();
                pairs.extend(others.map(|&b| ([a, b], rounded(*strength))));
            }
        }
        Some(Self {
            by_coordinate: by_coordinate.into_iter().map(rounded).collect(),
            pairs,
        })
    }

    pub(super) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Chords<S> {
        let pairs = self.pairs.iter();
        Chords {
            by_coordinate: self.by_coordinate.iter().copied().map(&convert).collect(),
            pairs: pairs
                .map(|&(links, strength)| (links, convert(strength)))
                .collect(),
        }
    }

    /// Returns k κ r² of the springs on a coordinate, which is added to the constant G of gravity,
    /// if there are such springs.
    #[inline(always)]
    pub(super) fn spring_term(&self, coordinate: usize) -> Option<T> {
        self.by_coordinate.get(coordinate).copied()
    }

    /// Adds the derivatives of the springs' energy by the angles of the links to `slopes`.
    #[inline(always)]
    pub(super) fn add_slopes(&self, [sines, cosines]: [&[T]; 2], slopes: &mut [T]) {
        for &([a, b], strength) in &self.pairs {
            let slope = strength * (sines[a] * cosines[b] - cosines[a] * sines[b]);
            slopes[a] = slopes[a] + slope;
            slopes[b] = slopes[b] - slope;
        }
    }

    /// Returns the potential energy of the springs, in J.
    #[inline(always)]
    pub(super) fn energy(&self, [sines, cosines]: [&[T]; 2]) -> T {
        let half = T::from_f64(0.5);
        let pairs = self.pairs.iter();
        pairs.fold(T::from_f64(0.0), |sum, &([a, b], strength)| {
            let [x, y] = [cosines[a] - cosines[b], sines[a] - sines[b]];
            sum + half * strength * (x * x + y * y)
        })
    }
}

/// Iterates over the coordinates that are differences between a link and the other copies under the
/// same parent: their indices and columns.
fn own_differences(
    shape: &SymmetricShape,
    link: usize,
) -> impl Iterator<Item = (usize, &SectorColumn)> {
    let blocks = shape.blocks.iter().filter(|block| !block.is_mean);
    let columns = blocks.flat_map(|block| (block.first..).zip(&block.columns));
    columns.filter(move |(_, column)| {
        let mut links = column.weights.iter().map(|(link, _)| *link);
        !column.is_below && links.any(|own| own == link)
    })
}
