//! Search from several starts.

use std::cell::RefCell;

use nalgebra::DMatrix;

use super::error::DesignError;
use super::found::{Design, Side};
use super::problem::{DesignTarget, DesignVariable, Goal};
use super::solver::{Residuals, sum_of_squares};

/// Number of points spread over the bounds: this many, and more for each variable.
const POINTS: usize = 16;
const POINTS_EACH: usize = 8;
/// Number of the best of these points from which a search starts, in addition to the present
/// values.
const STARTS: usize = 4;
/// Weight of the distance from the present values, in widths of the ranges, in a search with more
/// variables than equations; a second search without it follows.
const NEARNESS: f64 = 1e-2;
/// Distance, in widths of the ranges, below which two solutions count as the same.
const SAME: f64 = 1e-3;
/// Singular value, relative to the largest, below which the change of the parameters along its
/// singular vector counts as no change of the quantities.
const RANK: f64 = 1e-6;
/// Gradient relative to the length of the residuals and the largest derivative that counts as zero.
const FLAT: f64 = 1e-5;
/// Distances, in widths of the ranges, at which the quantities are tried beyond the nearest point.
const BEYOND: [f64; 3] = [1e-4, 1e-3, 1e-2];
/// First primes, the bases of the Halton sequence.
const PRIMES: [u32; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];

/// Values of all quantities as a function of the parameters, or the reason why one has no value.
type Quantities<'a> = dyn Fn(&[f64]) -> Result<Vec<f64>, String> + 'a;

/// Search for parameters at which quantities reach their targets.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignSearch {
    variables: Vec<DesignVariable>,
    targets: Vec<DesignTarget>,
}

impl DesignSearch {
    /// Largest number of variables.
    pub const MOST_VARIABLES: usize = PRIMES.len();

    /// Creates a search.
    ///
    /// # Errors
    /// [`DesignError`] for a number that is not finite, bounds that do not ascend, names given twice,
    /// and if there are no variables or no targets.
    pub fn new(
        variables: Vec<DesignVariable>,
        targets: Vec<DesignTarget>,
    ) -> Result<Self, DesignError> {
        if variables.is_empty() || targets.is_empty() {
            return Err(DesignError::Nothing);
        }
        if variables.len() > Self::MOST_VARIABLES {
            return Err(DesignError::TooMany {
                variables: variables.len(),
                most: Self::MOST_VARIABLES,
            });
        }
        let twice = |names: Vec<&String>| {
            let is_again = |&(place, name): &(usize, &&String)| names[..place].contains(name);
            let again = names.iter().enumerate().find(is_again);
            again.map_or(Ok(()), |(_, name)| {
                let name = (*name).clone();
                Err(DesignError::Twice { name })
            })
        };
        twice(variables.iter().map(|own| &own.name).collect())?;
        for DesignVariable {
            name,
            range: [from, to],
            present,
        } in &variables
        {
            let are_finite = [from, to, present].iter().all(|value| value.is_finite());
            if !(are_finite && from < to) {
                return Err(DesignError::Range {
                    name: name.clone(),
                    from: *from,
                    to: *to,
                });
            }
        }
        for DesignTarget { name, goal } in &targets {
            if !goal.value().is_finite() {
                return Err(DesignError::Goal {
                    name: name.clone(),
                    value: goal.value(),
                });
            }
        }
        Ok(Self { variables, targets })
    }

    /// Returns the variables.
    pub fn variables(&self) -> &[DesignVariable] {
        &self.variables
    }

    /// Returns the targets.
    pub fn targets(&self) -> &[DesignTarget] {
        &self.targets
    }

    /// Searches for parameters at which the quantities reach their targets. `quantities` returns the
    /// values of all targets in order, or the reason why one of them has no value.
    ///
    /// # Errors
    /// [`DesignError::Undefined`] if the quantities have no values at any of the starts. Targets that
    /// cannot be reached are not an error: [`Design::is_reached`] is false.
    pub fn run(&self, quantities: &Quantities<'_>) -> Result<Design, DesignError> {
        let first_reason = RefCell::new(None);
        let misses = |place: &[f64]| match quantities(&self.parameters(place)) {
            Ok(values) => self.misses(&values),
            Err(reason) => {
                first_reason.borrow_mut().get_or_insert(reason);
                vec![f64::NAN; self.targets.len()]
            }
        };
        let (present, points) = (self.present(), self.points());
        let all = points
            .iter()
            .map(|place| (sum_of_squares(&misses(place)), place));
        let mut known: Vec<(f64, &Vec<f64>)> = all.filter(|(own, _)| own.is_finite()).collect();
        let starts = [points.len(), points.len() - known.len()];
        if known.is_empty() {
            return Err(DesignError::Undefined {
                starts: points.len(),
                reason: first_reason.take().unwrap_or_default(),
            });
        }
        known.sort_by(|one, other| one.0.total_cmp(&other.0));
        let is_start = |(index, (_, place)): &(usize, &(f64, &Vec<f64>))| {
            *index < STARTS || **place == points[0]
        };
        let chosen = known.iter().enumerate().filter(is_start);
        let residuals = Residuals { of: &misses };
        let near = |place: &[f64]| {
            let away = place.iter().zip(&present);
            let away = away.map(|(own, present)| NEARNESS * (own - present));
            misses(place).into_iter().chain(away).collect()
        };
        let is_open = self.variables.len() > self.equations().count();
        let found = chosen.map(|(_, (_, start))| match is_open {
            true => residuals.minimise(&Residuals { of: &near }.minimise(start)),
            false => residuals.minimise(start),
        });
        let found: Vec<(Vec<f64>, Vec<f64>)> = found
            .map(|place| {
                let own = misses(&place);
                (place, own)
            })
            .collect();
        Ok(self.design(quantities, &residuals, found, starts))
    }

    /// Chooses the solution nearest to the present values, or the point nearest to the targets, and
    /// describes it.
    fn design(
        &self,
        quantities: &Quantities<'_>,
        residuals: &Residuals<'_>,
        found: Vec<(Vec<f64>, Vec<f64>)>,
        starts: [usize; 2],
    ) -> Design {
        let is_reached = |misses: &[f64]| misses.iter().all(|miss| miss.abs() <= Design::TOLERANCE);
        let present = self.present();
        let mut reached: Vec<&Vec<f64>> = found
            .iter()
            .filter(|(_, misses)| is_reached(misses))
            .map(|(place, _)| place)
            .collect();
        reached.sort_by(|one, other| distance(one, &present).total_cmp(&distance(other, &present)));
        let nearest = found
            .iter()
            .min_by(|(_, one), (_, other)| sum_of_squares(one).total_cmp(&sum_of_squares(other)));
        let nearest = nearest.map_or(&present, |(place, _)| place);
        let place = reached.first().copied().unwrap_or(nearest);
        let parameters = self.parameters(place);
        let values = quantities(&parameters);
        let values = values.unwrap_or_else(|_| vec![f64::NAN; self.targets.len()]);
        let slopes = self.slopes(quantities, place);
        let is_met = !reached.is_empty();
        let open = match is_met {
            true => self.open_directions(&slopes),
            false => Vec::new(),
        };
        let has_slack = is_met && self.equations().count() < self.targets.len();
        let mut others: Vec<Vec<f64>> = Vec::new();
        if open.is_empty() && !has_slack {
            for own in &reached {
                let is_new = |known: &Vec<f64>| distance(known, own) > SAME;
                if is_new(place) && others.iter().all(is_new) {
                    others.push((*own).clone());
                }
            }
        }
        let bounds = place.iter().map(|own| match own {
            0.0 => Some(Side::Lower),
            1.0 => Some(Side::Upper),
            _ => None,
        });
        let bounds: Vec<Option<Side>> = bounds.collect();
        let gradient = gradient(residuals, place);
        let holds = bounds
            .iter()
            .zip(&gradient)
            .map(|(side, slope)| match side {
                Some(Side::Lower) => !is_met && *slope > 0.0,
                Some(Side::Upper) => !is_met && *slope < 0.0,
                None => false,
            });
        let holds: Vec<bool> = holds.collect();
        let widths: Vec<f64> = self.variables.iter().map(DesignVariable::width).collect();
        let by_width = |row: Vec<f64>| {
            let both = row.iter().zip(&widths);
            both.map(|(slope, width)| slope / width).collect()
        };
        Design {
            ends_at: match is_met {
                true => None,
                false => self.end(quantities, place, &gradient, &holds),
            },
            sensitivities: rows(&slopes).map(by_width).collect(),
            others: others.iter().map(|own| self.parameters(own)).collect(),
            open_directions: open,
            is_reached: is_met,
            parameters,
            values,
            bounds,
            holds,
            has_slack,
            starts,
        }
    }

    /// Returns the reason why the quantities have no values beyond the nearest point, if they have
    /// none in the direction in which the sum of squares falls.
    fn end(
        &self,
        quantities: &Quantities<'_>,
        place: &[f64],
        gradient: &[f64],
        holds: &[bool],
    ) -> Option<String> {
        let free = gradient.iter().zip(holds);
        let free: Vec<f64> = free
            .map(|(own, holds)| if *holds { 0.0 } else { *own })
            .collect();
        let length = sum_of_squares(&free).sqrt();
        if length == 0.0 {
            return None;
        }
        BEYOND.iter().find_map(|step| {
            let moved = place.iter().zip(&free);
            let moved = moved.map(|(own, slope)| (own - step * slope / length).clamp(0.0, 1.0));
            quantities(&self.parameters(&moved.collect::<Vec<f64>>())).err()
        })
    }

    /// Returns the derivatives of the quantities by the position, one row for each quantity.
    fn slopes(&self, quantities: &Quantities<'_>, place: &[f64]) -> DMatrix<f64> {
        let values = |place: &[f64]| {
            let values = quantities(&self.parameters(place));
            values.unwrap_or_else(|_| vec![f64::NAN; self.targets.len()])
        };
        Residuals { of: &values }.derivatives(place)
    }

    /// Returns independent changes of the parameters that leave the quantities of all equations as
    /// they are.
    fn open_directions(&self, slopes: &DMatrix<f64>) -> Vec<Vec<f64>> {
        let count = self.variables.len();
        // Additional rows of zeros, so that all directions are among the singular vectors.
        let mut equations = DMatrix::zeros(slopes.nrows().max(count), count);
        for (row, goal) in self.equations() {
            let scaled = slopes.row(row) / goal.abs().max(f64::MIN_POSITIVE);
            equations.set_row(row, &scaled);
        }
        if equations.iter().any(|own| !own.is_finite()) {
            return Vec::new();
        }
        let decomposed = equations.svd(false, true);
        let largest = decomposed.singular_values.max();
        let Some(directions) = decomposed.v_t else {
            return Vec::new();
        };
        let all = decomposed.singular_values.iter().enumerate();
        let open = all.filter(|(_, own)| **own <= RANK * largest);
        let in_units = |(row, _): (usize, &f64)| {
            let direction = directions.row(row);
            let largest = direction.amax();
            let both = direction.iter().zip(&self.variables);
            both.map(|(part, own)| part / largest * own.width())
                .collect()
        };
        open.map(in_units).collect()
    }

    /// Returns the targets that are equations, with their values.
    fn equations(&self) -> impl Iterator<Item = (usize, f64)> {
        let all = self.targets.iter().enumerate();
        all.filter_map(|(index, target)| match target.goal {
            Goal::Equal(value) => Some((index, value)),
            Goal::AtLeast(_) | Goal::AtMost(_) => None,
        })
    }

    fn misses(&self, values: &[f64]) -> Vec<f64> {
        let both = self.targets.iter().zip(values);
        both.map(|(target, value)| target.goal.miss(*value))
            .collect()
    }

    /// Returns the parameters at a position within the bounds.
    fn parameters(&self, place: &[f64]) -> Vec<f64> {
        let both = self.variables.iter().zip(place);
        both.map(|(own, place)| match *place {
            1.0 => own.range[1],
            place => own.range[0] + place * own.width(),
        })
        .collect()
    }

    /// Returns the position of the present values, which may be outside the bounds.
    fn present(&self) -> Vec<f64> {
        let all = self.variables.iter();
        all.map(|own| (own.present - own.range[0]) / own.width())
            .collect()
    }

    /// Returns the points at which the quantities are computed before the search: the point within
    /// the bounds that is nearest to the present values, the middle, and points of the Halton
    /// sequence.
    fn points(&self) -> Vec<Vec<f64>> {
        let count = self.variables.len();
        let present = self.present().into_iter().map(|own| own.clamp(0.0, 1.0));
        let spread = (1..=POINTS + POINTS_EACH * count).map(|index| {
            let bases = PRIMES.iter().take(count);
            bases.map(|base| halton(index as u32, *base)).collect()
        });
        let first = [present.collect(), vec![0.5; count]];
        first.into_iter().chain(spread).collect()
    }
}

/// Returns the gradient of half the sum of squared residuals; components that are zero to rounding
/// are zero.
fn gradient(residuals: &Residuals<'_>, place: &[f64]) -> Vec<f64> {
    let own = (residuals.of)(place);
    let derivatives = residuals.derivatives(place);
    let least = FLAT * sum_of_squares(&own).sqrt() * derivatives.amax();
    let columns = derivatives.column_iter().map(|column| {
        let slope: f64 = column
            .iter()
            .zip(&own)
            .map(|(slope, own)| slope * own)
            .sum();
        match slope.abs() > least {
            true => slope,
            false => 0.0,
        }
    });
    columns.collect()
}

fn rows(matrix: &DMatrix<f64>) -> impl Iterator<Item = Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect())
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    let both = one.iter().zip(other);
    both.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Returns an element of the van der Corput sequence: the digits of `index`, mirrored at the point.
fn halton(mut index: u32, base: u32) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0);
    while index > 0 {
        digit /= f64::from(base);
        value += digit * f64::from(index % base);
        index /= base;
    }
    value
}
