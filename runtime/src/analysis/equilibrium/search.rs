//! Search for stable equilibria: descent of the potential energy.

use super::EquilibriumError;
use super::potential::{Equilibrium, PotentialEnergy, Stability};
use super::stiffness::{Factored, Stiffness};

/// Most steps of a descent.
const MOST_STEPS: usize = 400;

/// Largest change of an angle in one step, in rad.
const LONGEST_STEP: f64 = 0.5;

/// Change of an angle (rad) below which a Newton step need not decrease the energy, because the
/// energy shows its own rounding there.
const NEAR: f64 = 1e-6;

/// Changes of an angle (rad) by which the search leaves a point at which the energy has no
/// derivatives.
const ASIDE: [f64; 3] = [1e-3, 0.03, 0.3];

/// Distance (rad) below which two equilibria count as the same.
const SAME: f64 = 1e-5;

/// Largest number of angles for which other minima are searched for from random starts.
const MOST_SEARCHED: usize = 32;

/// Finds the stable equilibrium to which the potential energy descends from `start`: by Newton's
/// method with steps that lower the energy, and from a saddle in a direction in which the energy
/// falls.
///
/// # Errors
///
/// [`EquilibriumError`] if energy or derivatives are not finite, and if the descent does not end,
/// as for an attraction whose energy has no lower bound.
pub fn stable_equilibrium(
    potential: &impl PotentialEnergy,
    start: &[f64],
) -> Result<Equilibrium, EquilibriumError> {
    let mut theta = start.to_vec();
    let mut asides = ASIDE.iter();
    // Where the ends of a line meet, its torque has no direction.
    while !is_smooth(potential, &theta) {
        let size = asides.next().ok_or(EquilibriumError::NotFinite)?;
        for (link, angle) in theta.iter_mut().enumerate() {
            *angle = start[link] + size * (2.0 * quasi_random(link, 0) - 1.0);
        }
    }
    descend(potential, theta)
}

/// Finds stable equilibria: first the one to which the energy descends from zero angles, then
/// others by ascending energy. For at most 32 angles it also descends from 16 to 64 random starts,
/// and for any number of angles from the saddle near zero in both directions. Minima with small
/// basins of attraction may be missed. Of neutral equilibria with equal energies, which usually form
/// one continuum, only the first one found is listed. Last comes the unstable equilibrium that
/// Newton's method finds from zero angles, if it finds one.
///
/// # Errors
///
/// As [`stable_equilibrium`], if no descent ends.
pub fn equilibria(potential: &impl PotentialEnergy) -> Result<Vec<Equilibrium>, EquilibriumError> {
    let n = potential.angles();
    let zeros = vec![0.0; n];
    let first = stable_equilibrium(potential, &zeros);
    let mut found: Vec<Equilibrium> = first.iter().cloned().collect();
    let saddle = newton(potential, &zeros).filter(|own| own.stability == Stability::Unstable);
    if let Some(saddle) = &saddle
        && let Factored::Indefinite(direction) = factored(potential, &saddle.theta)
    {
        for sign in [1.0, -1.0] {
            let away: Vec<f64> = direction.iter().map(|part| sign * part).collect();
            let left = leave(potential, &saddle.theta, &away);
            let other = left.and_then(|theta| descend(potential, theta).ok());
            found.extend(other);
        }
    }
    let starts = match n <= MOST_SEARCHED {
        true => (16 + 4 * n).min(64),
        false => 0,
    };
    for number in 0..starts {
        let angle = |link| core::f64::consts::PI * (2.0 * quasi_random(link, number) - 1.0);
        let start: Vec<f64> = (0..n).map(angle).collect();
        found.extend(stable_equilibrium(potential, &start).ok());
    }
    let energies = found.iter().map(|own| own.energy.abs());
    let scale = energies.fold(0.0, f64::max);
    // Neutral equilibria of one energy are samples of a continuum.
    let is_known = |own: &Equilibrium, other: &Equilibrium| {
        let neutral = [own, other]
            .iter()
            .all(|own| own.stability == Stability::Neutral);
        distance(&other.theta, &own.theta) <= SAME
            || neutral && (other.energy - own.energy).abs() <= SAME * scale
    };
    let mut distinct: Vec<Equilibrium> = Vec::new();
    for mut own in found {
        unwind(potential, &mut own);
        if !distinct.iter().any(|other| is_known(&own, other)) {
            distinct.push(own);
        }
    }
    let Some((_, others)) = distinct.split_first_mut() else {
        return Err(first.err().unwrap_or(EquilibriumError::NotFinite));
    };
    others.sort_by(|a, b| a.energy.total_cmp(&b.energy));
    // At the onset of buckling rounding decides on the sign of the stiffness.
    let is_new = |saddle: &Equilibrium| {
        distinct
            .iter()
            .all(|own| distance(&own.theta, &saddle.theta) > 1e2 * SAME)
    };
    let saddle = saddle.filter(is_new);
    distinct.extend(saddle);
    Ok(distinct)
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    let differences = one.iter().zip(other).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// Removes whole turns from the angles of links, unless a spring distinguishes them.
fn unwind(potential: &impl PotentialEnergy, own: &mut Equilibrium) {
    use core::f64::consts::{PI, TAU};
    for link in 0..own.theta.len() {
        let angle = own.theta[link];
        if angle.abs() > PI + SAME {
            own.theta[link] = angle - TAU * (angle / TAU).round();
            let energy = potential.energy(&own.theta);
            let (torques, _) = potential.torques_and_stiffness(&own.theta);
            let (before, stiffness) = potential.torques_and_stiffness(&{
                let mut theta = own.theta.clone();
                theta[link] = angle;
                theta
            });
            // The energy may be zero there, but not the stiffness, which has the same unit.
            let scale = own.energy.abs() + stiffness.row_sums().into_iter().sum::<f64>();
            let is_same = (energy - own.energy).abs() <= 1e-9 * scale
                && distance(&torques, &before) <= 1e-9 * scale;
            if !is_same {
                own.theta[link] = angle;
            }
        }
    }
}

/// Largest number of angles for which Newton's method solves dense linear equations.
const MOST_DENSE: usize = 256;

/// Returns a quasi-random number from 0 to 1: a multiple of the square root of a prime. Together
/// these fill a cube evenly.
fn quasi_random(link: usize, number: usize) -> f64 {
    const PRIMES: [f64; 8] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0];
    let turn = PRIMES[link % PRIMES.len()].sqrt() * (1 + link / PRIMES.len()) as f64;
    ((number + 1) as f64 * turn + 0.381_966 * link as f64).fract()
}

fn is_smooth(potential: &impl PotentialEnergy, theta: &[f64]) -> bool {
    let (torques, stiffness) = potential.torques_and_stiffness(theta);
    let is_finite = potential.energy(theta).is_finite() && stiffness.is_finite();
    is_finite && torques.iter().all(|torque| torque.is_finite())
}

fn factored(potential: &impl PotentialEnergy, theta: &[f64]) -> Factored {
    potential.torques_and_stiffness(theta).1.factor()
}

/// Returns the angles `theta` (rad) as an equilibrium if each torque is at most as large as a
/// change of the angles by `missed` (rad) would make it.
pub fn equilibrium_at(
    potential: &impl PotentialEnergy,
    theta: &[f64],
    missed: f64,
) -> Option<Equilibrium> {
    let (torques, stiffness) = potential.torques_and_stiffness(theta);
    let mut both = torques.iter().zip(stiffness.row_sums());
    // NaN is no rest.
    let is_at_rest = both.all(|(torque, sum)| torque.abs() <= missed * sum);
    is_at_rest.then(|| classified(potential, theta.to_vec()))
}

/// Determines the stability of an equilibrium at the given angles.
fn classified(potential: &impl PotentialEnergy, theta: Vec<f64>) -> Equilibrium {
    let stability = match factored(potential, &theta) {
        Factored::Indefinite(_) => Stability::Unstable,
        Factored::Definite(factors) if factors.is_neutral() => Stability::Neutral,
        Factored::Definite(_) => Stability::Stable,
    };
    Equilibrium {
        energy: potential.energy(&theta),
        theta,
        stability,
    }
}

/// Finds an equilibrium of any stability by Newton's method; `None` if it does not converge.
fn newton(potential: &impl PotentialEnergy, start: &[f64]) -> Option<Equilibrium> {
    let rows = |theta: &[f64]| {
        let (torques, stiffness) = potential.torques_and_stiffness(theta);
        Ok((stiffness.to_rows(), torques))
    };
    // Without torques nothing has to be solved.
    let (torques, _) = potential.torques_and_stiffness(start);
    let theta = match torques.iter().all(|torque| *torque == 0.0) {
        true => start.to_vec(),
        false if start.len() <= MOST_DENSE => super::equilibrium_of_torques(start, rows).ok()?,
        false => return None,
    };
    Some(classified(potential, theta))
}

/// A step that decreases the energy, and its kind.
enum Step {
    /// Newton's step, at angles where the energy is convex.
    Newton(Vec<f64>),
    /// Along smaller energy.
    Downhill(Vec<f64>),
    /// Away from a saddle.
    Escape(Vec<f64>),
}

/// Returns the next step from angles with these torques and this stiffness.
fn step(torques: &[f64], stiffness: Stiffness) -> Step {
    let escape = match stiffness.clone().factor() {
        Factored::Definite(factors) => {
            let mut step = torques.to_vec();
            if factors.solve(&mut step) {
                return Step::Newton(step);
            }
            None
        }
        Factored::Indefinite(direction) => Some(direction),
    };
    let mut share = 1e-3;
    let mut downhill = torques.to_vec();
    while share < 1e4 {
        let mut shifted = stiffness.clone();
        shifted.shift(share);
        if let Factored::Definite(factors) = shifted.factor() {
            downhill = torques.to_vec();
            factors.solve(&mut downhill);
            break;
        }
        share *= 4.0;
    }
    match escape {
        Some(direction) if size(&downhill) < NEAR => {
            let fall: f64 = direction.iter().zip(torques).map(|(d, t)| d * t).sum();
            let sign = if fall < 0.0 { -1.0 } else { 1.0 };
            Step::Escape(direction.iter().map(|part| sign * part).collect())
        }
        Some(_) | None => Step::Downhill(downhill),
    }
}

fn size(step: &[f64]) -> f64 {
    step.iter().fold(0.0, |most, part| most.max(part.abs()))
}

/// Moves along a direction until the energy is smaller than at the start; `None` if it does not
/// become smaller.
fn leave(potential: &impl PotentialEnergy, theta: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
    let energy = potential.energy(theta);
    let mut factor = LONGEST_STEP / size(direction);
    while factor * size(direction) > 1e-7 {
        let further: Vec<f64> = after_step(theta, direction, factor);
        if potential.energy(&further) < energy && is_smooth(potential, &further) {
            return Some(further);
        }
        factor *= 0.5;
    }
    None
}

fn after_step(theta: &[f64], step: &[f64], factor: f64) -> Vec<f64> {
    theta
        .iter()
        .zip(step)
        .map(|(angle, part)| angle + factor * part)
        .collect()
}

/// Returns the energy (J) below which a descent from `start` has no end, because an attraction has
/// no lower bound.
fn deepest(potential: &impl PotentialEnergy, start: &[f64]) -> f64 {
    const DEEP: f64 = 1e9;
    let (torques, stiffness) = potential.torques_and_stiffness(start);
    let scales = torques.into_iter().chain(stiffness.row_sums());
    let scale: f64 = scales.map(f64::abs).sum();
    let energy = potential.energy(start);
    energy - DEEP * (energy.abs() + scale)
}

/// Descends to a minimum from angles at which the energy has derivatives.
fn descend(
    potential: &impl PotentialEnergy,
    mut theta: Vec<f64>,
) -> Result<Equilibrium, EquilibriumError> {
    let mut before = f64::INFINITY;
    let deepest = deepest(potential, &theta);
    for _ in 0..MOST_STEPS {
        let (torques, stiffness) = potential.torques_and_stiffness(&theta);
        let is_finite = torques.iter().all(|torque| torque.is_finite());
        if potential.energy(&theta) < deepest {
            return Err(EquilibriumError::NoMinimum { last_step: before });
        }
        if !(is_finite && stiffness.is_finite()) {
            return Err(EquilibriumError::NotFinite);
        }
        let step = match step(&torques, stiffness) {
            Step::Newton(step) => {
                let size = size(&step);
                // Rounding is reached where steps no longer shrink.
                if size == 0.0 || (size < 1e-9 && size >= 0.5 * before) {
                    return Ok(classified(potential, theta));
                }
                before = size;
                if size < NEAR {
                    theta = after_step(&theta, &step, 1.0);
                    continue;
                }
                step
            }
            Step::Downhill(step) => step,
            Step::Escape(direction) => match leave(potential, &theta, &direction) {
                Some(further) => {
                    theta = further;
                    continue;
                }
                // The energy falls by less than its rounding: the onset of buckling.
                None => {
                    let mut found = classified(potential, theta);
                    found.stability = Stability::Neutral;
                    return Ok(found);
                }
            },
        };
        let own = size(&step);
        let Some(further) = leave_downhill(potential, &theta, &step, &torques) else {
            return Err(EquilibriumError::NoMinimum { last_step: own });
        };
        theta = further;
    }
    Err(EquilibriumError::NoMinimum { last_step: before })
}

/// Moves along a step by a length that decreases the energy sufficiently (Armijo's rule).
fn leave_downhill(
    potential: &impl PotentialEnergy,
    theta: &[f64],
    step: &[f64],
    torques: &[f64],
) -> Option<Vec<f64>> {
    let energy = potential.energy(theta);
    let fall: f64 = step
        .iter()
        .zip(torques)
        .map(|(part, torque)| part * torque)
        .sum();
    let mut factor = f64::min(LONGEST_STEP / size(step), 1.0);
    for _ in 0..60 {
        let further = after_step(theta, step, factor);
        let expected = 1e-4 * factor * fall;
        let own = potential.energy(&further);
        let rounding = 8.0 * f64::EPSILON * energy.abs().max(own.abs());
        if own <= energy - expected + rounding && is_smooth(potential, &further) {
            return Some(further);
        }
        factor *= 0.5;
    }
    None
}
