//! Straight springs between copies, sector by sector.
//!
//! Copies on one pivot, at whose places r a spring κ without length at rest ends, have the energy
//! ½ κ r² |e^{iθ_a} − e^{iθ_b}|². The same spring between every two of the k copies under one link
//! adds ½ k κ r² |[e^{iθ}]_s|² to each sector s of their differences and nothing to others
//! (physics (19.10)). It stands beside gravity's ½ G |[1 − e^{iθ}]_s|² with k κ r² for G.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use super::constants::rounded;
use super::shape::{SectorColumn, SymmetricShape};
use crate::scalar::{Double, Scalar};
use crate::translational::{LinePotential, TranslationalSpringDamper, TranslationalSpringDampers};

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
    /// Returns the springs by sectors.
    ///
    /// # Errors
    /// The index of a line that couples sectors or has no energy of this form.
    pub(super) fn of(
        shape: &SymmetricShape,
        lines: &TranslationalSpringDampers<Double>,
    ) -> Result<Self, usize> {
        let zero = Double::from_f64(0.0);
        let mut pairs: BTreeMap<[usize; 2], (Double, usize)> = BTreeMap::new();
        for (index, line) in lines.iter().enumerate() {
            let (links, strength) = chord(line).ok_or(index)?;
            pairs.entry(links).or_insert((zero, index)).0 += strength;
        }
        if pairs.is_empty() {
            return Ok(Self::default());
        }
        let mut by_coordinate = alloc::vec![zero; shape.links()];
        for (&[first, second], &(strength, index)) in &pairs {
            let columns = || own_differences(shape, first);
            let copies: BTreeSet<usize> = columns()
                .flat_map(|(_, column)| column.weights.iter().map(|(link, _)| *link))
                .collect();
            let has_all = copies.contains(&second)
                && copies.iter().all(|&a| {
                    let others = copies.range(a + 1..);
                    let mut pairs = others.map(|&b| pairs.get(&[a, b]));
                    pairs.all(|own| own.is_some_and(|(own, _)| *own == strength))
                });
            if !has_all {
                return Err(index);
            }
            for (coordinate, _) in columns() {
                by_coordinate[coordinate] = Double::from_f64(copies.len() as f64) * strength;
            }
        }
        Ok(Self {
            by_coordinate: by_coordinate.into_iter().map(rounded).collect(),
            pairs: pairs
                .into_iter()
                .map(|(links, (strength, _))| (links, rounded(strength)))
                .collect(),
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

/// The two links, the first one first, and κ r² of a spring between equal places on one pivot that
/// has neither a length at rest nor a damper.
fn chord(line: &TranslationalSpringDamper<Double>) -> Option<([usize; 2], Double)> {
    let zero = Double::from_f64(0.0);
    let arms = line.arms.iter();
    let mut arms = arms.filter(|arm| [arm.along, arm.lateral] != [zero; 2]);
    let (Some(one), Some(other), None) = (arms.next(), arms.next(), arms.next()) else {
        return None;
    };
    let [
        LinePotential::Spring {
            stiffness,
            rest: None,
        },
    ] = line.potentials[..]
    else {
        return None;
    };
    let opposite = one.along == -other.along && one.lateral == -other.lateral;
    let is_plain = opposite && line.offset == [zero; 2] && line.friction.is_none();
    let square = one.along * one.along + one.lateral * one.lateral;
    let links = [one.link.min(other.link), one.link.max(other.link)];
    is_plain.then_some((links, stiffness * square))
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
