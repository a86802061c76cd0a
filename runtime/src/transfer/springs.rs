//! Springs between links that are not parent and child, sector by sector.

use alloc::{collections::BTreeMap, vec::Vec};

use super::constants::rounded;
use super::shape::{BlockShape, SectorColumn, SymmetricShape};
use crate::scalar::{Double, Scalar, at};
use crate::spring_dampers::{SpringDamper, SpringDampers};

/// Energy of the springs between links, as a sum over sectors; each term depends on the coordinates
/// of one sector only.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SectorSprings<T> {
    /// Stiffness (N m) of each symmetric coordinate: Σ κ (w_a − w_b)²/Σ w², with the weights w of
    /// the two links that a spring of stiffness κ connects. Empty without springs.
    single: Vec<T>,
    /// Spring strains that depend on several coordinates of a sector, or have a rest angle.
    strains: Vec<SectorStrain<T>>,
}

/// Part of a spring's strain that belongs to one sector: u = Σ c θ − ρ, with weights c and rest
/// angle ρ. Its energy is ½ κ u².
#[derive(Clone, Debug, PartialEq)]
struct SectorStrain<T> {
    /// Index of the sector's first coordinate.
    first: usize,
    stiffness: T,
    rest: T,
    /// Weights c of the angles in the strain, by link.
    weights: Vec<(usize, T)>,
}

/// No springs.
impl<T> Default for SectorSprings<T> {
    fn default() -> Self {
        Self {
            single: Vec::new(),
            strains: Vec::new(),
        }
    }
}

/// Contribution of a symmetric coordinate to the strain of a spring: index of the coordinate, its
/// sector, and its weight.
struct Term<'s> {
    index: usize,
    block: &'s BlockShape,
    column: &'s SectorColumn,
    weight: Double,
}

impl<T: Scalar> SectorSprings<T> {
    /// Sorts the springs by sector. Returns `None` if they couple sectors, or if a spring is
    /// relaxed only when copies differ. Springs of several pairs of links may together leave the
    /// sectors uncoupled.
    pub(super) fn of(
        shape: &SymmetricShape,
        spring_dampers: &SpringDampers<Double>,
    ) -> Option<Self> {
        let zero = Double::from_f64(0.0);
        let list = spring_dampers.iter();
        let springs: Vec<_> = list.filter(|own| own.spring != zero).collect();
        if springs.is_empty() {
            return Some(Self::default());
        }
        let mut single = alloc::vec![zero; shape.links()];
        let mut strains = Vec::new();
        let mut across = BTreeMap::new();
        for own in springs {
            let terms = terms(shape, &own);
            if own.rest != zero && !terms.iter().all(|term| term.block.is_mean) {
                return None;
            }
            for sector in terms.chunk_by(|a, b| a.block.first == b.block.first) {
                match sector {
                    [term] if own.rest == zero => {
                        let square = term.weight * term.weight;
                        single[term.index] += own.spring * square / norm(term.column);
                    }
                    terms => strains.push(SectorStrain::of(&own, terms)),
                }
            }
            add_products_across(own.spring, &terms, &mut across);
        }
        let is_coupling = |[sum, size]: &[Double; 2]| sum.high().abs() > 1e-12 * size.high();
        if across.values().any(is_coupling) {
            return None;
        }
        Some(Self {
            single: single.into_iter().map(rounded).collect(),
            strains,
        })
    }

    pub(super) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> SectorSprings<S> {
        let strains = self.strains.iter().map(|own| SectorStrain {
            first: own.first,
            stiffness: convert(own.stiffness),
            rest: convert(own.rest),
            weights: own
                .weights
                .iter()
                .map(|&(link, weight)| (link, convert(weight)))
                .collect(),
        });
        SectorSprings {
            single: self.single.iter().copied().map(&convert).collect(),
            strains: strains.collect(),
        }
    }

    /// Returns true if there are no springs.
    pub(super) fn is_empty(&self) -> bool {
        self.single.is_empty()
    }

    /// Adds the derivatives of the springs' energy in one sector by the angles of the links to
    /// `slopes`, and returns that energy (J).
    #[inline(always)]
    pub(super) fn add_slopes(&self, block: &BlockShape, theta: &[T], slopes: &mut [T]) -> T {
        let (zero, half) = (T::from_f64(0.0), T::from_f64(0.5));
        let mut energy = zero;
        if self.is_empty() {
            return energy;
        }
        for (index, column) in block.columns.iter().enumerate() {
            let share = T::from_f64(1.0) / T::from_f64(column.norm);
            let strain = column.sum(|link| theta[link]);
            let torque = at(&self.single, block.first + index) * share * strain;
            energy = energy + half * torque * strain;
            for (link, weight) in column.iter() {
                let weight: T = weight;
                slopes[link] = slopes[link] + weight * torque;
            }
        }
        for own in self.strains.iter().filter(|own| own.first == block.first) {
            let terms = own.weights.iter();
            let angle = terms.fold(zero, |sum, &(link, weight)| sum + weight * theta[link]);
            let strain = angle - own.rest;
            let torque = own.stiffness * strain;
            energy = energy + half * torque * strain;
            for &(link, weight) in &own.weights {
                slopes[link] = slopes[link] + weight * torque;
            }
        }
        energy
    }
}

impl<T: Scalar> SectorStrain<T> {
    fn of(spring: &SpringDamper<Double>, terms: &[Term<'_>]) -> Self {
        let mut weights: BTreeMap<usize, Double> = BTreeMap::new();
        for term in terms {
            let share = term.weight / norm(term.column);
            for (link, weight) in term.column.iter::<Double>() {
                let own = weights.entry(link).or_insert(Double::from_f64(0.0));
                *own += share * weight;
            }
        }
        Self {
            first: terms.first().map_or(0, |term| term.block.first),
            stiffness: rounded(spring.spring),
            rest: rounded(spring.rest),
            weights: weights
                .into_iter()
                .map(|(link, weight)| (link, rounded(weight)))
                .collect(),
        }
    }
}

/// Returns the symmetric coordinates that contribute to the strain of a spring, in ascending order.
fn terms<'s>(shape: &'s SymmetricShape, spring: &SpringDamper<Double>) -> Vec<Term<'s>> {
    let zero = Double::from_f64(0.0);
    let [a, b] = spring.links;
    let coordinates = shape.blocks.iter().flat_map(|block| {
        let columns = block.columns.iter().enumerate();
        columns.map(move |(index, column)| (block, block.first + index, column))
    });
    let terms = coordinates.map(|(block, index, column)| {
        let of = |link: usize| {
            let mut own = column.iter::<Double>();
            own.find(|(known, _)| *known == link)
                .map_or(zero, |(_, weight)| weight)
        };
        Term {
            index,
            block,
            column,
            weight: of(a) - of(b),
        }
    });
    terms.filter(|term| term.weight != zero).collect()
}

fn norm(column: &SectorColumn) -> Double {
    Double::from_f64(column.norm)
}

/// Adds κ w_i w_j, for each pair of coordinates of different sectors, to the sum over all springs,
/// and its magnitude to the sum of magnitudes. Sectors are uncoupled if all sums vanish.
fn add_products_across(
    stiffness: Double,
    terms: &[Term<'_>],
    across: &mut BTreeMap<[usize; 2], [Double; 2]>,
) {
    let zero = Double::from_f64(0.0);
    for (place, one) in terms.iter().enumerate() {
        let others = terms[place + 1..].iter();
        for other in others.filter(|other| other.block.first != one.block.first) {
            let product = stiffness * one.weight * other.weight;
            let [sum, size] = across.entry([one.index, other.index]).or_insert([zero; 2]);
            *sum += product;
            *size += Double::from_f64(product.high().abs());
        }
    }
}
