//! Hamiltonian of a model near its equilibrium, in complex normal coordinates.

use std::f64::consts::TAU;

use super::NormalFormError;
use super::subspace::MotionSubspace;
use crate::analysis::Modes;
use crate::scalar::{Exponents, Polynomial, Scalar, TermSum, Terms, Truncation};
use crate::system::{Energy, Model};

/// Largest relative coupling between blocks of the mass and stiffness matrices that counts as
/// rounding.
const COUPLED: f64 = 1e-9;

/// Largest coefficient that counts as rounding, relative to the largest one of the same degree.
const ROUNDING: f64 = 1e-15;

/// Hamiltonian in the complex normal coordinates z_j = (x_j + i y_j)/√2 and their conjugates:
/// variable j is z_j, variable n + j its conjugate. All coefficients are real, because the energy
/// does not change when all velocities are reversed.
#[derive(Clone, Debug)]
pub(super) struct ExpandedHamiltonian {
    /// Angular frequencies in rad/s: first those of the in-phase modes, then those of the
    /// differences.
    pub(super) frequencies: Vec<f64>,
    /// Matrix from the coordinates of the subspace to the normal coordinates x: row j gives x_j.
    pub(super) to_normal: Vec<Vec<f64>>,
    /// Coordinates of the subspace for each x_j = 1: `shapes[j][i]` is coordinate i.
    pub(super) shapes: Vec<Vec<f64>>,
    /// Terms of the Hamiltonian (J), by degree.
    pub(super) by_degree: Vec<Terms>,
}

/// Kinetic and potential energy as functions of real variables: coordinates, then their rates.
struct Energies<'a, M> {
    model: &'a M,
    rest: &'a [f64],
    subspace: &'a MotionSubspace,
}

impl<M: Energy<Polynomial>> Energies<'_, M> {
    /// Expands both energies as polynomials in variables of which each coordinate is a linear
    /// combination: `columns[j][i]` is the factor of variable j in coordinate i.
    fn expand(&self, columns: &[Vec<f64>], scales: &[f64], truncation: Truncation) -> [Terms; 2] {
        let n = columns.len();
        let energies = Polynomial::expand(2 * n, truncation, |variables| {
            let (positions, rates) = variables.split_at(n);
            let of_links = |values: &[Polynomial], scales: &dyn Fn(usize) -> f64, start: &[f64]| {
                let start = (0..self.subspace.links).map(|link| start.get(link).copied());
                let start = start.map(|start| Polynomial::from_f64(start.unwrap_or(0.0)));
                let mut links: Vec<Polynomial> = start.collect();
                for (i, direction) in self.subspace.directions.iter().enumerate() {
                    let parts = values.iter().zip(columns).enumerate();
                    let parts = parts.filter(|(_, (_, column))| column[i] != 0.0);
                    let coordinate = parts.fold(Polynomial::from_f64(0.0), |sum, (j, own)| {
                        sum + *own.0 * Polynomial::from_f64(own.1[i] * scales(j))
                    });
                    for (link, weight) in direction {
                        links[*link] = links[*link] + coordinate * Polynomial::from_f64(*weight);
                    }
                }
                links
            };
            let theta = of_links(positions, &|j| scales[j], self.rest);
            let omega = of_links(rates, &|_| 1.0, &[]);
            vec![
                self.model.kinetic_energy_of(&theta, &omega),
                self.model.potential_energy_of(&theta),
            ]
        });
        let mut energies = energies.into_iter();
        [(); 2].map(|()| energies.next().unwrap_or_default())
    }
}

impl ExpandedHamiltonian {
    pub(super) fn of<M>(
        model: &M,
        rest: &[f64],
        subspace: &MotionSubspace,
        degree: u32,
    ) -> Result<Self, NormalFormError>
    where
        M: Model<f64>,
        M::Of<Polynomial>: Energy<Polynomial>,
    {
        let n = subspace.directions.len();
        let energies = Energies {
            model: &model.cast(Polynomial::from_f64),
            rest,
            subspace,
        };
        let unit = |j: usize| (0..n).map(|i| f64::from(u8::from(i == j))).collect();
        let units: Vec<Vec<f64>> = (0..n).map(unit).collect();
        let small = energies.expand(&units, &vec![1.0; n], Truncation::by_degree(2));
        let (mass, modes) = linear_modes(&small, subspace)?;
        let frequencies: Vec<f64> = modes.iter().map(|(frequency, _)| *frequency).collect();
        if let Some(mode) = frequencies.iter().position(|frequency| *frequency == 0.0) {
            return Err(NormalFormError::NoFrequency(mode + 1));
        }
        let columns: Vec<Vec<f64>> = modes.into_iter().map(|(_, shape)| shape).collect();
        let scales: Vec<f64> = frequencies.iter().map(|own| own.sqrt().recip()).collect();
        let differences = subspace.in_phase..n;
        let limits = |degree: u32| {
            let limited = differences
                .clone()
                .chain(differences.clone().map(|j| n + j));
            Truncation::by_degree(degree).limited(limited, 2)
        };
        let [kinetic, potential] = energies.expand(&columns, &scales, limits(degree));
        let inverse = inverse_mass(&kinetic, n, limits(degree - 2));
        let mut hamiltonian = TermSum::default();
        for (exponents, value) in potential.iter() {
            hamiltonian.add(exponents, value);
        }
        // ½ Pᵀ M⁻¹ P with P_j = √ω_j y_j.
        let momentum = |j: usize| Exponents::of_variable(n + j);
        for (i, row) in inverse.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let factor = 0.5 * (frequencies[i] * frequencies[j]).sqrt();
                let both = momentum(i).times(momentum(j));
                for (exponents, value) in entry.iter() {
                    let all = exponents.times(both);
                    if limits(degree).limited_part(all) <= 2 {
                        hamiltonian.add(all, factor * value);
                    }
                }
            }
        }
        let complex = complex_coordinates(&hamiltonian.into_terms(), n);
        if !complex.iter().all(|(_, value)| value.is_finite()) {
            return Err(NormalFormError::NotFinite);
        }
        let to_normal = (0..n).map(|j| {
            let row = (0..n).map(|i| {
                let sum = (0..n).map(|l| columns[j][l] * mass[l][i]).sum::<f64>();
                sum * frequencies[j].sqrt()
            });
            row.collect()
        });
        Ok(Self {
            to_normal: to_normal.collect(),
            shapes: columns
                .iter()
                .zip(&scales)
                .map(|(column, scale)| column.iter().map(|part| part * scale).collect())
                .collect(),
            by_degree: by_degree(&complex, degree, &frequencies),
            frequencies,
        })
    }
}

/// Mass matrix, and angular frequency and shape of each mode.
type MassAndModes = (Vec<Vec<f64>>, Vec<(f64, Vec<f64>)>);

fn linear_modes(
    [kinetic, potential]: &[Terms; 2],
    subspace: &MotionSubspace,
) -> Result<MassAndModes, NormalFormError> {
    let n = subspace.directions.len();
    let second = |terms: &Terms, first: usize| -> Vec<Vec<f64>> {
        let variable = |i: usize| Exponents::of_variable(first + i);
        let entry = |i: usize, j: usize| {
            let value = terms.coefficient(variable(i).times(variable(j)));
            if i == j { 2.0 * value } else { value }
        };
        (0..n)
            .map(|i| (0..n).map(|j| entry(i, j)).collect())
            .collect()
    };
    let (mass, stiffness) = (second(kinetic, n), second(potential, 0));
    let torques: Vec<f64> = (0..n)
        .map(|i| -potential.coefficient(Exponents::of_variable(i)))
        .collect();
    let mut modes = Vec::with_capacity(n);
    for block in [0..subspace.in_phase, subspace.in_phase..n] {
        if block.is_empty() {
            continue;
        }
        let part = |matrix: &[Vec<f64>]| -> Vec<Vec<f64>> {
            let rows = matrix.iter().take(block.end).skip(block.start);
            rows.map(|row| row[block.clone()].to_vec()).collect()
        };
        let own = Modes::at_rest(&part(&mass), &part(&stiffness), &torques[block.clone()])?;
        for (frequency, shape) in own.frequencies_hz.iter().zip(own.shapes) {
            let mut whole = vec![0.0; n];
            whole[block.clone()].copy_from_slice(&shape);
            modes.push((TAU * frequency, whole));
        }
    }
    for matrix in [&mass, &stiffness] {
        let largest = matrix
            .iter()
            .flatten()
            .fold(0.0_f64, |most, own| most.max(own.abs()));
        let mixed = matrix.iter().take(subspace.in_phase);
        let mixed = mixed.flat_map(|row| row.iter().skip(subspace.in_phase));
        if mixed.fold(0.0_f64, |most, own| most.max(own.abs())) > COUPLED * largest {
            return Err(NormalFormError::Coupled);
        }
    }
    Ok((mass, modes))
}

/// Inverts the matrix M of K = ½ vᵀ M v, whose entries are polynomials in the positions, by
/// Gauss–Jordan elimination.
fn inverse_mass(kinetic: &Terms, n: usize, truncation: Truncation) -> Vec<Vec<Terms>> {
    let mut entries = vec![Vec::new(); n * n];
    for (exponents, value) in kinetic.iter() {
        let first = (0..n).find_map(|i| Some((i, exponents.without(n + i)?)));
        let second =
            first.and_then(|(i, rest)| (i..n).find_map(|j| Some((i, j, rest.without(n + j)?))));
        if let Some((i, j, rest)) = second {
            let value = if i == j { 2.0 * value } else { value };
            entries[i * n + j].push((rest, value));
            if i != j {
                entries[j * n + i].push((rest, value));
            }
        }
    }
    let entries: Vec<Terms> = entries.into_iter().map(Terms::from_iter).collect();
    let inverse = Polynomial::expand(n, truncation, |_| {
        let [zero, one] = [0.0, 1.0].map(Polynomial::from_f64);
        let mut rows: Vec<Vec<Polynomial>> = (0..n)
            .map(|i| {
                let own = (0..n).map(|j| Polynomial::from_terms(&entries[i * n + j]));
                let unit = (0..n).map(|j| if i == j { one } else { zero });
                own.chain(unit).collect()
            })
            .collect();
        for pivot in 0..n {
            let inverse = one / rows[pivot][pivot];
            let own: Vec<Polynomial> = rows[pivot].iter().map(|value| *value * inverse).collect();
            for (i, row) in rows.iter_mut().enumerate() {
                if i == pivot {
                    row.clone_from(&own);
                    continue;
                }
                let factor = row[pivot];
                for (value, pivot_value) in row.iter_mut().zip(&own).skip(pivot) {
                    *value = *value - factor * *pivot_value;
                }
            }
        }
        rows.into_iter()
            .flat_map(|row| row.into_iter().skip(n))
            .collect()
    });
    inverse.chunks(n.max(1)).map(<[Terms]>::to_vec).collect()
}

/// Replaces x_j = (z_j + w_j)/√2 and y_j = (z_j − w_j)/(i √2) in a polynomial that is even in all
/// y together.
fn complex_coordinates(real: &Terms, n: usize) -> Terms {
    let sign = |exponents: Exponents| {
        let rates: u32 = (n..2 * n).map(|variable| exponents.of(variable)).sum();
        if rates % 4 == 2 { -1.0 } else { 1.0 }
    };
    let signed = real
        .iter()
        .map(|(exponents, value)| (exponents, sign(exponents) * value));
    let signed: Terms = signed.collect();
    (0..n).fold(signed, |terms, j| {
        let [z, w] = [j, n + j].map(Exponents::of_variable);
        let mut sum = TermSum::default();
        for (exponents, value) in terms.iter() {
            let [a, b] = [exponents.of(j), exponents.of(n + j)];
            let own = (0..a + b).fold(exponents, |rest, _| {
                rest.without(j)
                    .or_else(|| rest.without(n + j))
                    .unwrap_or(rest)
            });
            // (z + w)^a (z − w)^b, by powers of w.
            let factors = (0..a).map(|_| 1.0).chain((0..b).map(|_| -1.0));
            let mut powers = vec![0.5_f64.powf(0.5 * f64::from(a + b))];
            for factor in factors {
                powers.push(0.0);
                for k in (1..powers.len()).rev() {
                    powers[k] += factor * powers[k - 1];
                }
            }
            for (k, power) in powers.iter().enumerate() {
                let of_z = (k..(a + b) as usize).fold(own, |all, _| all.times(z));
                sum.add((0..k).fold(of_z, |all, _| all.times(w)), value * power);
            }
        }
        sum.into_terms()
    })
}

/// Sorts terms by degree and removes those that are rounding errors; degree 2 is Σ ω_j z_j w_j.
fn by_degree(terms: &Terms, degree: u32, frequencies: &[f64]) -> Vec<Terms> {
    let n = frequencies.len();
    let quadratic = frequencies.iter().enumerate().map(|(j, frequency)| {
        let [z, w] = [j, n + j].map(Exponents::of_variable);
        (z.times(w), *frequency)
    });
    let quadratic: Terms = quadratic.collect();
    let mut all = vec![Terms::default(), Terms::default(), quadratic];
    for degree in 3..=degree {
        let own = terms.filtered(|exponents| exponents.degree() == degree);
        let largest = own
            .iter()
            .fold(0.0_f64, |most, (_, value)| most.max(value.abs()));
        let kept = own
            .iter()
            .filter(|(_, value)| value.abs() > ROUNDING * largest);
        all.push(kept.collect());
    }
    all
}
