//! Lie transforms that remove the monomials of a Hamiltonian which are not resonant.

use super::resonance::Resonance;
use crate::scalar::{Exponents, TermSum, Terms, Truncation};

/// Result of the Lie transforms, by degree.
#[derive(Clone, Debug)]
pub(super) struct Normalised {
    /// Kept terms of the Hamiltonian.
    pub(super) hamiltonian: Vec<Terms>,
    /// Generators of the transforms, one for each degree: the flow of i X for a generator X.
    pub(super) generators: Vec<Terms>,
}

/// Modes of the complex coordinates, and a function that decides which monomials are kept.
pub(super) struct Lie<'a, K> {
    pub(super) in_phase: usize,
    pub(super) differences: usize,
    pub(super) frequencies: &'a [f64],
    pub(super) keeps: K,
}

/// Derivatives of the generator of a canonical transformation by all variables, from which Poisson
/// brackets with the generator are computed.
struct Derivatives {
    /// Derivatives by the complex conjugate coordinates; those by the coordinates are in the next
    /// field.
    by_conjugates: Vec<Terms>,
    by_coordinates: Vec<Terms>,
}

impl<K: Fn(&Resonance) -> bool> Lie<'_, K> {
    fn modes(&self) -> usize {
        self.in_phase + self.differences
    }

    pub(super) fn truncation(&self, degree: u32) -> Truncation {
        let n = self.modes();
        let own = self.in_phase..n;
        Truncation::by_degree(degree).limited(own.clone().chain(own.map(|j| n + j)), 2)
    }

    pub(super) fn resonance(&self, exponents: Exponents) -> Resonance {
        Resonance::of(exponents, self.in_phase, self.differences)
    }

    /// Normalises a Hamiltonian degree by degree. With H₂ = Σ ω_j z_j w_j the transform exp(L_χ) of
    /// χ = i h/(n·ω) z^j w^k removes the monomial h z^j w^k, n = j − k.
    pub(super) fn normalise(&self, by_degree: &[Terms]) -> Normalised {
        let mut hamiltonian = by_degree.to_vec();
        let degree = hamiltonian.len().saturating_sub(1) as u32;
        let mut generators = vec![Terms::default(); hamiltonian.len()];
        for own in 3..=degree {
            let place = own as usize;
            let mut kept = Vec::new();
            let mut removed = Vec::new();
            for (exponents, value) in hamiltonian[place].iter() {
                let resonance = self.resonance(exponents);
                match resonance.is_zero() || (self.keeps)(&resonance) {
                    true => kept.push((exponents, value)),
                    false => {
                        let divisor = resonance.mismatch(self.frequencies);
                        removed.push((exponents, value / divisor));
                    }
                }
            }
            let generator: Terms = removed.into_iter().collect();
            if !generator.is_empty() {
                let derivatives = self.derivatives(&generator);
                hamiltonian = self.transformed(&hamiltonian, &derivatives, own, 1.0);
                hamiltonian[place] = kept.into_iter().collect();
            }
            generators[place] = generator;
        }
        Normalised {
            hamiltonian,
            generators,
        }
    }

    /// Returns the transform exp(±L_χ) f of a function f, by degree, for a generator χ of one
    /// degree.
    fn transformed(
        &self,
        by_degree: &[Terms],
        derivatives: &Derivatives,
        generator: u32,
        sign: f64,
    ) -> Vec<Terms> {
        let raised = generator as usize - 2;
        let mut result: Vec<Terms> = by_degree.to_vec();
        let mut term = by_degree.to_vec();
        for order in 1.. {
            let mut next = vec![Terms::default(); term.len()];
            for (place, own) in term.iter().enumerate() {
                if let Some(target) = next.get_mut(place + raised).filter(|_| !own.is_empty()) {
                    let factor = sign / f64::from(order);
                    *target = self.bracket(own, derivatives, factor, (place + raised) as u32);
                }
            }
            if next.iter().all(Terms::is_empty) {
                break;
            }
            for (sum, own) in result.iter_mut().zip(&next) {
                *sum = sum.plus(own, 1.0);
            }
            term = next;
        }
        result
    }

    fn derivatives(&self, generator: &Terms) -> Derivatives {
        let n = self.modes();
        Derivatives {
            by_conjugates: (n..2 * n).map(|own| generator.derivative(own)).collect(),
            by_coordinates: (0..n).map(|own| generator.derivative(own)).collect(),
        }
    }

    /// Returns `factor` times the Poisson bracket {f, i X} = Σ ∂f/∂z_j ∂X/∂w_j − ∂f/∂w_j ∂X/∂z_j,
    /// with {z_j, w_j} = −i.
    fn bracket(&self, of: &Terms, with: &Derivatives, factor: f64, degree: u32) -> Terms {
        let (n, truncation) = (self.modes(), self.truncation(degree));
        let mut sum = TermSum::default();
        for j in 0..n {
            let by_coordinate = of.derivative(j);
            sum.add_product(&by_coordinate, &with.by_conjugates[j], factor, &truncation);
            let by_conjugate = of.derivative(n + j);
            sum.add_product(&by_conjugate, &with.by_coordinates[j], -factor, &truncation);
        }
        sum.into_terms()
    }

    /// Returns the normal coordinate z_j as a polynomial of the coordinates before the
    /// transforms, by degree. Only monomials that `keeps` accepts are followed.
    pub(super) fn coordinate(
        &self,
        mode: usize,
        normalised: &Normalised,
        keeps: &dyn Fn(Exponents) -> bool,
    ) -> Vec<Terms> {
        let mut by_degree = vec![Terms::default(); normalised.hamiltonian.len() - 1];
        by_degree[1] = Terms::monomial(Exponents::of_variable(mode), 1.0);
        let generators = normalised.generators.iter().enumerate().rev();
        for (degree, generator) in generators.filter(|(_, own)| !own.is_empty()) {
            let own = generator.filtered(keeps);
            let derivatives = self.derivatives(&own);
            by_degree = self.transformed(&by_degree, &derivatives, degree as u32, -1.0);
        }
        by_degree
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEGREE: u32 = 7;
    const FREQUENCIES: [f64; 3] = [1.0, 2.02, 1.53];

    /// Keeps f_1 + f_2 = 2 d_1 and 2 f_1 = f_2.
    fn keeps(resonance: &Resonance) -> bool {
        resonance.mismatch(&FREQUENCIES).abs() < 0.1
    }

    fn lie() -> Lie<'static, fn(&Resonance) -> bool> {
        Lie {
            in_phase: 2,
            differences: 1,
            frequencies: &FREQUENCIES,
            keeps,
        }
    }

    /// Real terms of any degree and even powers of the difference, which are symmetric under a
    /// reversal of time.
    fn hamiltonian() -> Vec<Terms> {
        let mut seed = 17_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let mut by_degree = vec![Terms::default(); 3];
        by_degree[2] = (0..3)
            .map(|j| {
                let [z, w] = [j, 3 + j].map(Exponents::of_variable);
                (z.times(w), FREQUENCIES[j])
            })
            .collect();
        let mut all = vec![Exponents::default()];
        for degree in 1..=DEGREE {
            let next = all.iter().flat_map(|own| {
                let last = (0..6).rev().find(|j| own.of(*j) > 0).unwrap_or(0);
                (last..6).map(|j| own.times(Exponents::of_variable(j)))
            });
            all = next.collect();
            let of_difference = |own: &Exponents| own.of(2) + own.of(5);
            let conjugate = |own: Exponents| {
                (0..6).fold(Exponents::default(), |product, j| {
                    let variable = Exponents::of_variable((j + 3) % 6);
                    (0..own.of(j)).fold(product, |product, _| product.times(variable))
                })
            };
            let own = all
                .iter()
                .filter(|own| [0, 2].contains(&of_difference(own)));
            let terms = own.flat_map(|own| {
                let value = random();
                [(*own, value), (conjugate(*own), value)]
            });
            let terms: Terms = terms.collect();
            if degree > 2 {
                by_degree.push(terms);
            }
        }
        by_degree
    }

    /// Sum over degrees of the Poisson bracket {f, g}/(−i) of polynomials of all coordinates.
    fn bracket(one: &[Terms], other: &[Terms], degree: u32) -> Terms {
        let to = lie().truncation(degree);
        let mut sum = TermSum::default();
        for (f, g) in one.iter().flat_map(|f| other.iter().map(move |g| (f, g))) {
            for j in 0..3 {
                sum.add_product(&f.derivative(j), &g.derivative(3 + j), 1.0, &to);
                sum.add_product(&f.derivative(3 + j), &g.derivative(j), -1.0, &to);
            }
        }
        sum.into_terms()
    }

    /// Normal coordinates z_j, then their conjugates.
    fn coordinates(normalised: &Normalised) -> Vec<Vec<Terms>> {
        let own = |mode: usize| lie().coordinate(mode, normalised, &|_| true);
        (0..6).map(own).collect()
    }

    fn largest(terms: &Terms) -> f64 {
        terms
            .iter()
            .fold(0.0, |most, (_, value)| value.abs().max(most))
    }

    #[test]
    fn the_transform_is_symplectic() {
        let normalised = lie().normalise(&hamiltonian());
        let all = coordinates(&normalised);
        let scale = all.iter().flatten().map(largest).fold(0.0, f64::max);
        assert!(scale > 10.0, "{scale}");
        for i in 0..6 {
            for j in 0..6 {
                let unit = match (i, j) {
                    _ if j == i + 3 => 1.0,
                    _ if i == j + 3 => -1.0,
                    _ => 0.0,
                };
                let one = Terms::monomial(Exponents::default(), unit);
                let own = bracket(&all[i], &all[j], DEGREE - 2);
                // The difference's own coordinates are linear in it: squares are not known.
                let is_known = |own: Exponents| {
                    let of_both = i % 3 == 2 && j % 3 == 2;
                    !of_both || own.of(2) + own.of(5) == 0
                };
                let own = own.filtered(is_known);
                let error = largest(&own.plus(&one, -1.0)) / scale;
                assert!(error < 1e-12, "{i} {j}: {error:e}");
            }
        }
    }

    #[test]
    fn kept_terms_of_the_normal_coordinates_are_the_hamiltonian() {
        let hamiltonian = hamiltonian();
        let normalised = lie().normalise(&hamiltonian);
        let all = coordinates(&normalised);
        let joined: Vec<Terms> = all
            .iter()
            .map(|own| {
                own.iter()
                    .fold(Terms::default(), |sum, part| sum.plus(part, 1.0))
            })
            .collect();
        let to = lie().truncation(DEGREE);
        let mut sum = TermSum::default();
        for (exponents, value) in normalised.hamiltonian.iter().flat_map(Terms::iter) {
            let one = Terms::monomial(Exponents::default(), value);
            let product = (0..6).fold(one, |product, j| {
                (0..exponents.of(j)).fold(product, |product, _| product.times(&joined[j], &to))
            });
            sum.add_terms(&product, 1.0);
        }
        let sum = sum.into_terms();
        let scale = joined.iter().map(largest).fold(0.0, f64::max);
        for own in &hamiltonian {
            for (exponents, value) in own.iter() {
                let error = (sum.coefficient(exponents) - value).abs() / scale;
                assert!(error < 1e-12, "{exponents:?}: {error:e}");
            }
        }
    }

    #[test]
    fn the_normalised_hamiltonian_commutes_with_actions_up_to_kept_terms() {
        let normalised = lie().normalise(&hamiltonian());
        let kept = normalised.hamiltonian.iter().flat_map(Terms::iter);
        let [resonant, rest]: [Vec<_>; 2] = {
            let (one, two) = kept.partition(|(own, _)| !lie().resonance(*own).is_zero());
            [one, two]
        };
        assert!(!resonant.is_empty());
        assert!(
            resonant
                .iter()
                .all(|(own, _)| keeps(&lie().resonance(*own)))
        );
        let rest = [rest.into_iter().collect::<Terms>()];
        let action = |j: usize| {
            let both = Exponents::of_variable(j).times(Exponents::of_variable(3 + j));
            Terms::monomial(both, 1.0)
        };
        for j in 0..3 {
            assert!(bracket(&rest, &[action(j)], DEGREE).is_empty());
        }
        // All kept terms commute with the combination that is orthogonal to both resonances.
        let resonant = [resonant.into_iter().collect::<Terms>()];
        let weights = [1.0, 2.0, 1.5];
        let combined = (0..3).fold(Terms::default(), |sum, j| sum.plus(&action(j), weights[j]));
        assert!(largest(&bracket(&resonant, &[combined], DEGREE)) < 1e-12);
        assert!(largest(&bracket(&resonant, &[action(2)], DEGREE)) > 0.1);
    }
}
