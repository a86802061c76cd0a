//! Straight springs between copies, sector by sector.
//!
//! Copies on one pivot, at whose places r a spring κ without length at rest ends, have the energy
//! ½ κ r² |e^{iθ_a} − e^{iθ_b}|². The same spring between every two of the k copies under one link
//! adds ½ k κ r² |[e^{iθ}]_s|² to each sector s of their differences and nothing to others
//! (physics (19.10)). It stands beside gravity's ½ G |[1 − e^{iθ}]_s|² with k κ r² for G.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::constants::rounded;
use super::shape::{SectorColumn, SymmetricShape};
use crate::scalar::{Double, Scalar};

/// The same straight spring, without length at rest and without damper, between equal places of
/// every two copies of a node under one link.
#[derive(Clone, Debug, PartialEq)]
pub struct ChordSpring<T> {
    /// All copies under the link, by their indices.
    pub copies: Vec<usize>,
    /// κ r² (J): the stiffness by the square of the places' distance from the pivot.
    pub strength: T,
}

/// Springs along the chords between equal places of copies.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chords<T> {
    /// k κ r² (J) of coordinates, by their index. Empty without such springs.
    by_coordinate: Vec<T>,
    /// Copies, two by two, with κ r² (J).
    pairs: Vec<([usize; 2], T)>,
}

/// None.
impl<T> Default for Chords<T> {
    fn default() -> Self {
        Self {
            by_coordinate: Vec::new(),
            pairs: Vec::new(),
        }
    }
}

impl<T: Scalar> Chords<T> {
    /// Returns the springs by sectors. None for links that are not all copies under one link.
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

    /// Returns what stands beside G of a coordinate, where there are such springs.
    #[inline(always)]
    pub(super) fn beside_gravity(&self, coordinate: usize) -> Option<T> {
        self.by_coordinate.get(coordinate).copied()
    }

    /// Adds the derivatives of their energy by the angles of the links.
    #[inline(always)]
    pub(super) fn add_slopes(&self, [sines, cosines]: [&[T]; 2], slopes: &mut [T]) {
        for &([a, b], strength) in &self.pairs {
            let slope = strength * (sines[a] * cosines[b] - cosines[a] * sines[b]);
            slopes[a] = slopes[a] + slope;
            slopes[b] = slopes[b] - slope;
        }
    }

    /// Returns their energy.
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

/// The differences of a link and other copies under the same one: coordinates with their indices.
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
