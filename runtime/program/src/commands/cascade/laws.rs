//! Exponents of Kolmogorov's argument over the scales of finished runs.

use branched_pendulum::analysis::statistics::{Estimate, jackknife};

/// Exponent of Π ℓ_s in the hypothesis, with the flux Π and the length ℓ_s.
pub(super) const KOLMOGOROV: f64 = 2.0 / 3.0;

/// Results for one scale of a finished run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ScaleOfRun {
    /// Number of the scale.
    pub(super) scale: usize,
    /// Number of generations from that of the scale to the youngest.
    pub(super) generations: usize,
    /// Length of a link, m.
    pub(super) length: f64,
    /// Mass of the links that differ, of the oldest generation alone, in kg.
    pub(super) mass: f64,
    /// Mass of these links with everything that hangs from them, kg.
    pub(super) subtrees: f64,
    /// Energy, J.
    pub(super) energy: Estimate,
    /// Power that friction removes at this scale and all younger ones, in W.
    pub(super) flux: f64,
    /// Error bar of the flux, W.
    pub(super) flux_error: f64,
    /// Energy of the scale in thermal equilibrium at the same total energy, in J.
    pub(super) equilibrium: Option<f64>,
    /// Flatness of the distribution of W into this scale and all younger ones.
    pub(super) flatness: Option<Estimate>,
}

/// A definition of the mass M_s of a scale: its name, and the mass in kg.
pub(super) type MassOfScale = (&'static str, fn(&ScaleOfRun) -> f64);

/// Mass of the subtrees at the branchings of the scale.
pub(super) const OF_SUBTREES: MassOfScale = ("M of subtrees", |row| row.subtrees);

/// Mass of the oldest links that differ.
pub(super) const OF_GENERATION: MassOfScale = ("M of the generation", |row| row.mass);

/// Mass of the oldest links that differ, once for each generation that moves in the scale. In a binary
/// tree whose masses halve this is the mass of the subtrees.
pub(super) const OF_EACH_GENERATION: MassOfScale =
    ("M of the generation times generations", |row| {
        row.mass * row.generations as f64
    });

impl ScaleOfRun {
    /// Π ℓ_s, W m.
    pub(super) fn flux_length(&self) -> f64 {
        self.flux * self.length
    }

    /// Returns the energy divided by that of the hypothesis with the mass [`OF_EACH_GENERATION`].
    pub(super) fn compensated(&self) -> f64 {
        let (_, mass) = OF_EACH_GENERATION;
        self.energy.value / (mass(self).cbrt() * self.flux_length().powf(KOLMOGOROV))
    }
}

/// Returns the exponent a of E_s/M_s^{1/3} ∝ (Π ℓ_s)^a by weighted least squares, with an error bar
/// that includes the misfit; `None` for fewer than three scales, or without error bars.
pub(super) fn exponent(rows: &[ScaleOfRun], (_, mass): MassOfScale) -> Option<Estimate> {
    let measured = rows.iter().all(|row| row.energy.error > 0.0);
    if rows.len() < 3 || !measured {
        return None;
    }
    let points = rows.iter().map(|row| {
        let y = (row.energy.value / mass(row).cbrt()).ln();
        let weight = (row.energy.value / row.energy.error).powi(2);
        (row.flux_length().ln(), y, weight)
    });
    let points: Vec<(f64, f64, f64)> = points.collect();
    let sum = |value: &dyn Fn(&(f64, f64, f64)) -> f64| points.iter().map(value).sum::<f64>();
    let total = sum(&|(_, _, w)| *w);
    let (x, y) = (
        sum(&|(x, _, w)| w * x) / total,
        sum(&|(_, y, w)| w * y) / total,
    );
    let spread = sum(&|(own, _, w)| w * (own - x).powi(2));
    let slope = sum(&|(own, value, w)| w * (own - x) * (value - y)) / spread;
    let misfit = sum(&|(own, value, w)| w * (value - y - slope * (own - x)).powi(2));
    let misfit = (misfit / (points.len() - 2) as f64).max(1.0);
    Some(Estimate {
        value: slope,
        error: (misfit / spread).sqrt(),
    })
}

/// Returns the exponents a and b of E_s = C M_s^a (Π ℓ_s)^b with one constant C for all runs, by least
/// squares of the logarithms over the scales of constant flux of each run, `ranges`. The error bars
/// are from leaving out one run after the other; `None` for fewer than four runs with three scales.
pub(super) fn joint_exponents(
    ranges: &[&[ScaleOfRun]],
    (_, mass): MassOfScale,
) -> Option<[Estimate; 2]> {
    let ranges = ranges.iter().filter(|rows| rows.len() > 2);
    let ranges: Vec<&[ScaleOfRun]> = ranges.copied().collect();
    if ranges.len() < 4 {
        return None;
    }
    let fit = |left_out: Option<usize>| {
        let kept = ranges.iter().enumerate();
        let kept = kept.filter(|(index, _)| Some(*index) != left_out);
        let rows: Vec<[f64; 3]> = kept
            .flat_map(|(_, rows)| rows.iter())
            .map(|row| {
                [
                    mass(row).ln(),
                    row.flux_length().ln(),
                    row.energy.value.ln(),
                ]
            })
            .collect();
        let mean = |axis: usize| rows.iter().map(|row| row[axis]).sum::<f64>() / rows.len() as f64;
        let means = [0, 1, 2].map(mean);
        let sum = |a: usize, b: usize| {
            let products = rows
                .iter()
                .map(|row| (row[a] - means[a]) * (row[b] - means[b]));
            products.sum::<f64>()
        };
        let determinant = sum(0, 0) * sum(1, 1) - sum(0, 1) * sum(0, 1);
        [
            (sum(0, 2) * sum(1, 1) - sum(1, 2) * sum(0, 1)) / determinant,
            (sum(1, 2) * sum(0, 0) - sum(0, 2) * sum(0, 1)) / determinant,
        ]
    };
    let of_mass = jackknife(ranges.len(), |left_out| fit(left_out)[0]).ok()?;
    let of_flux = jackknife(ranges.len(), |left_out| fit(left_out)[1]).ok()?;
    Some([of_mass, of_flux])
}

/// Comparison of two runs of one family, that is, with the same ratios of masses and of lengths.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FamilyPair {
    /// Exponent b of E/(m^{1/3} Π^{2/3}) ∝ ℓ^b, with the mass m of the oldest links that differ.
    pub(super) exponent: Estimate,
    /// Numbers of generations, from the scale to the youngest, at which the runs are compared.
    pub(super) generations: Vec<usize>,
    /// Ratios of mass and of length from one scale to the next.
    ratios: [f64; 2],
}

/// Returns the ratios of mass and of length from the first scale to the next.
fn ratios(rows: &[ScaleOfRun]) -> Option<[f64; 2]> {
    match rows {
        [one, next, ..] => Some([next.mass / one.mass, next.length / one.length]),
        [] | [_] => None,
    }
}

/// Returns true if two pairs of ratios are equal up to rounding.
fn are_equal(one: [f64; 2], other: [f64; 2]) -> bool {
    let mut pairs = one.iter().zip(other);
    pairs.all(|(a, b)| (a / b - 1.0).abs() < 1e-6)
}

/// Compares the scales of two runs that have the same number of generations from the scale to the
/// youngest. The young end of the tree then acts equally on both scales and cancels.
///
/// The exponent is the mean over the compared scales. Its error bar is the mean of their error bars,
/// because the scales of one run vary together. Returns `None` if the runs are of different families
/// or have no such scales.
pub(super) fn compare(first: &[ScaleOfRun], second: &[ScaleOfRun]) -> Option<FamilyPair> {
    let [ratios, other] = [ratios(first)?, ratios(second)?];
    if !are_equal(ratios, other) {
        return None;
    }
    let reduced =
        |row: &ScaleOfRun| row.energy.value / (row.mass.cbrt() * row.flux.powf(KOLMOGOROV));
    let error = |row: &ScaleOfRun| {
        let flux = KOLMOGOROV * row.flux_error / row.flux;
        (row.energy.error / row.energy.value).hypot(flux)
    };
    let pairs = first.iter().filter_map(|own| {
        let mut others = second.iter();
        let other = others.find(|other| other.generations == own.generations)?;
        let step = (other.length / own.length).ln();
        let found = Estimate {
            value: (reduced(other) / reduced(own)).ln() / step,
            error: (error(own).hypot(error(other)) / step).abs(),
        };
        (own.scale != other.scale).then_some((own.generations, found))
    });
    let pairs: Vec<(usize, Estimate)> = pairs.collect();
    let mean = |value: fn(&Estimate) -> f64| {
        pairs.iter().map(|(_, own)| value(own)).sum::<f64>() / pairs.len() as f64
    };
    (!pairs.is_empty()).then(|| FamilyPair {
        exponent: Estimate {
            value: mean(|own| own.value),
            error: mean(|own| own.error),
        },
        generations: pairs.iter().map(|(number, _)| *number).collect(),
        ratios,
    })
}

/// Exponents of all families together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FamilyExponents {
    /// Number of families.
    pub(super) count: usize,
    /// Exponent of the length if that of the mass is 1/3: the weighted mean.
    pub(super) length_alone: Estimate,
    /// Exponent of the mass, fitted together with that of the length.
    pub(super) mass: Estimate,
    /// Exponent of the length, fitted together with that of the mass.
    pub(super) length: Estimate,
    /// χ² of the fit of both.
    pub(super) chi_squared: f64,
}

/// Fits E ∝ m^a ℓ^b to one pair of each family, the one with the smallest error bar.
///
/// Between two runs with the ratios μ of masses and λ of lengths the exponent is
/// b + (a − 1/3) ln μ / ln λ: a weighted line. Returns `None` for fewer than three families,
/// or if ln μ / ln λ is the same for all.
pub(super) fn families(pairs: &[FamilyPair]) -> Option<FamilyExponents> {
    let mut best: Vec<&FamilyPair> = Vec::new();
    for pair in pairs {
        match best
            .iter_mut()
            .find(|own| are_equal(own.ratios, pair.ratios))
        {
            Some(own) if pair.exponent.error < own.exponent.error => *own = pair,
            Some(_) => {}
            None => best.push(pair),
        }
    }
    if best.len() < 3 {
        return None;
    }
    let points = best.iter().map(|own| {
        let [mass, length] = own.ratios;
        let weight = own.exponent.error.powi(-2);
        [mass.ln() / length.ln(), own.exponent.value, weight]
    });
    let points: Vec<[f64; 3]> = points.collect();
    let sum = |value: &dyn Fn([f64; 3]) -> f64| points.iter().map(|own| value(*own)).sum::<f64>();
    let total = sum(&|[_, _, w]| w);
    let [x, y] = [sum(&|[x, _, w]| w * x), sum(&|[_, y, w]| w * y)].map(|own| own / total);
    let spread = sum(&|[own, _, w]| w * (own - x).powi(2));
    // Families of one line of ratios cannot tell the two exponents apart.
    if spread < 1e-9 * total {
        return None;
    }
    let slope = sum(&|[own, value, w]| w * (own - x) * (value - y)) / spread;
    Some(FamilyExponents {
        count: points.len(),
        length_alone: Estimate {
            value: y,
            error: total.sqrt().recip(),
        },
        mass: Estimate {
            value: 1.0 / 3.0 + slope,
            error: spread.sqrt().recip(),
        },
        length: Estimate {
            value: y - slope * x,
            error: (total.recip() + x * x / spread).sqrt(),
        },
        chi_squared: sum(&|[own, value, w]| w * (value - y - slope * (own - x)).powi(2)),
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::{
        FamilyPair, KOLMOGOROV, OF_EACH_GENERATION, OF_SUBTREES, ScaleOfRun, compare, exponent,
        families, joint_exponents,
    };
    use branched_pendulum::analysis::statistics::Estimate;

    /// A scale with this energy (J) and flux (W).
    pub(crate) fn row(scale: usize, energy: f64, flux: f64) -> ScaleOfRun {
        ScaleOfRun {
            scale,
            generations: 7 - scale,
            length: 0.7_f64.powi(scale as i32),
            mass: 0.1 * 0.8_f64.powi(scale as i32),
            subtrees: 0.4 * 0.9_f64.powi(scale as i32),
            energy: Estimate {
                value: energy,
                error: 0.01 * energy,
            },
            flux,
            flux_error: 0.01 * flux,
            equilibrium: None,
            flatness: None,
        }
    }

    #[test]
    fn a_spectrum_of_the_two_thirds_law_is_level() {
        let rows = (0..6).map(|scale| {
            let own = row(scale, 1.0, 0.2);
            let energy = 3.0
                * (own.mass * own.generations as f64).cbrt()
                * own.flux_length().powf(2.0 / 3.0);
            row(scale, energy, 0.2)
        });
        let rows: Vec<ScaleOfRun> = rows.collect();
        for own in &rows {
            assert!((own.compensated() - 3.0).abs() < 1e-12);
        }
        let found = exponent(&rows, OF_EACH_GENERATION).unwrap();
        assert!((found.value - 2.0 / 3.0).abs() < 1e-12 && found.error > 0.0);
        assert!(exponent(&rows[..2], OF_EACH_GENERATION).is_none());
    }

    #[test]
    fn exponents_of_mass_and_flux_are_found_from_several_families() {
        let family = |number: i32| {
            let rows = (1..7).map(|scale| {
                let mut own = row(scale, 1.0, 0.2);
                own.length = 0.3 * (0.6 + 0.05 * f64::from(number)).powi(scale as i32);
                own.subtrees = (0.25 + 0.1 * f64::from(number % 3)).powi(scale as i32);
                own.energy.value = 3.0 * own.subtrees.powf(0.4) * own.flux_length().powf(0.5);
                own
            });
            rows.collect()
        };
        let runs: Vec<Vec<ScaleOfRun>> = (0..4).map(family).collect();
        let runs: Vec<&[ScaleOfRun]> = runs.iter().map(Vec::as_slice).collect();
        let [mass, flux] = joint_exponents(&runs, OF_SUBTREES).unwrap();
        assert!((mass.value - 0.4).abs() < 1e-12 && (flux.value - 0.5).abs() < 1e-12);
        assert!(joint_exponents(&runs[..3], OF_SUBTREES).is_none());
    }

    /// Runs of seven and ten generations, whose energies depend on the number of younger ones.
    #[test]
    fn the_young_end_cancels_between_runs_of_other_lengths() {
        let run = |generations: usize, flux: f64| -> Vec<ScaleOfRun> {
            let rows = (2..generations - 3).map(|scale| {
                let mut own = row(scale, 1.0, flux);
                own.generations = generations - scale;
                let end = 1.0 + own.generations as f64;
                own.energy.value =
                    end * own.mass.cbrt() * flux.powf(KOLMOGOROV) * own.length.powf(0.6);
                own.energy.error = 0.01 * own.energy.value;
                own
            });
            rows.collect()
        };
        let found = compare(&run(7, 0.3), &run(10, 0.5)).unwrap();
        assert_eq!(found.generations, [5, 4]);
        assert!((found.exponent.value - 0.6).abs() < 1e-12 && found.exponent.error > 0.0);
        assert!(compare(&run(7, 0.3), &run(7, 0.5)).is_none());
        let mut other = run(10, 0.5);
        other[0].mass *= 1.1;
        assert!(compare(&run(7, 0.3), &other).is_none());
    }

    /// Exponents of mass and length are apart if the families have different ratios. Of a family with
    /// several pairs the one with the smallest error bar counts.
    #[test]
    fn families_tell_the_exponent_of_the_mass_from_that_of_the_length() {
        let pair = |ratios: [f64; 2], error: f64, shift: f64| FamilyPair {
            exponent: Estimate {
                value: 0.7 + (0.4 - 1.0 / 3.0) * ratios[0].ln() / ratios[1].ln() + shift,
                error,
            },
            generations: vec![4],
            ratios,
        };
        let mut pairs = vec![
            pair([0.5, 0.85], 0.05, 0.3),
            pair([0.5, 0.85], 0.02, 0.0),
            pair([0.25, 0.85], 0.04, 0.0),
        ];
        assert!(families(&pairs).is_none());
        pairs.push(pair([0.5, 0.6], 0.03, 0.0));
        let found = families(&pairs).unwrap();
        assert_eq!(found.count, 3);
        assert!((found.mass.value - 0.4).abs() < 1e-12);
        assert!((found.length.value - 0.7).abs() < 1e-12);
        assert!(found.chi_squared < 1e-20 && found.length.error > found.length_alone.error);
    }
}
