//! Trees that are scanned one after the other, with varied parameters.

use std::f64::consts::TAU;

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum_trees::PendulumTree;

use crate::Failure;
use crate::commands::differences::differences_of;
use crate::frame::command_line::parts;
use crate::subject::Subject;

/// A parameter with the values that it takes one after the other, or with the quality factors that
/// determine these values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Varied {
    name: String,
    by: By,
}

#[derive(Clone, Debug, PartialEq)]
enum By {
    Values(Vec<f64>),
    QualityFactors(Vec<f64>),
}

/// Value of a friction parameter (SI units) at which the decay rate is computed; the decay is
/// proportional to it.
const TRIAL: f64 = 1e-3;

/// Largest relative deviation of the decay rate from proportionality to a viscous friction.
const PROPORTIONAL: f64 = 1e-9;

impl Varied {
    /// Reads `NAME=VALUE,VALUE`.
    pub(super) fn values(text: &str) -> Result<Self, String> {
        let (name, values) = read(text)?;
        let by = By::Values(values);
        Ok(Self { name, by })
    }

    /// Reads `NAME=Q,Q`.
    pub(super) fn quality_factors(text: &str) -> Result<Self, String> {
        let (name, values) = read(text)?;
        match values.iter().find(|value| **value < 1.0) {
            Some(value) => Err(format!("a quality factor is at least 1, not {value}")),
            None => Ok(Self {
                name,
                by: By::QualityFactors(values),
            }),
        }
    }

    /// Returns the trees to scan, with their labels.
    ///
    /// # Errors
    /// [`Failure::Tree`]; [`Failure::Lacking`] if the parameter is not a viscous friction that acts
    /// on the difference between the copies.
    pub(super) fn trees(
        &self,
        subject: &Subject,
        copies: &Copies,
    ) -> Result<Vec<(String, PendulumTree)>, Failure> {
        let with = |label: String, value: f64| Ok((label, subject.with(&self.name, value)?));
        let name = &self.name;
        match &self.by {
            By::Values(values) => {
                let trees = values.iter();
                let trees = trees.map(|value| with(format!("{name} = {value}"), *value));
                trees.collect()
            }
            By::QualityFactors(factors) => {
                let braking = Braking::of(subject, name, copies)?;
                let without = std::iter::once(with(format!("{name} = 0"), 0.0));
                let trees = factors.iter().map(|&factor| {
                    let value = braking.value(name, factor)?;
                    with(format!("Q = {factor}, {name} = {value:.3e}"), value)
                });
                without.chain(trees).collect()
            }
        }
    }
}

fn read(text: &str) -> Result<(String, Vec<f64>), String> {
    let (name, values) = text
        .split_once('=')
        .ok_or_else(|| format!("`{text}` is not `NAME=NUMBER,NUMBER`"))?;
    let value = |part: &str| {
        let value = part.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| format!("`{part}` is not a number"))
    };
    let values: Result<_, String> = parts(values).map(value).collect();
    Ok((name.trim().to_owned(), values?))
}

/// Effect of a viscous friction on a small difference about equilibrium.
struct Braking {
    /// Angular frequency of the difference, rad/s.
    frequency: f64,
    /// Decay rate of the difference's velocity caused by all other friction, in 1/s.
    others: f64,
    /// Increase of the decay rate with this friction, per unit of the parameter.
    slope: f64,
}

impl Braking {
    fn of(subject: &Subject, name: &str, copies: &Copies) -> Result<Self, Failure> {
        let at = |value: f64| {
            let tree = subject.with(name, value)?;
            let differences = differences_of(&tree, copies, Vec::new(), 1.0)?;
            Ok::<_, Failure>([differences.decay(), TAU * differences.growth().frequency_hz])
        };
        let [[others, frequency], [once, _], [twice, _]] = [at(0.0)?, at(TRIAL)?, at(2.0 * TRIAL)?];
        let slope = (once - others) / TRIAL;
        let is_proportional = (twice - others) / (2.0 * TRIAL * slope) - 1.0;
        if !(slope > 0.0 && is_proportional.abs() < PROPORTIONAL) {
            return Err(Failure::Lacking {
                what: format!(
                    "`--quality`: `{name}` is not a friction coefficient that damps a small \
                     difference between the copies"
                ),
            });
        }
        Ok(Self {
            frequency,
            others,
            slope,
        })
    }

    /// Returns the value of the parameter at which the difference has a given quality factor.
    fn value(&self, name: &str, factor: f64) -> Result<f64, Failure> {
        let value = (self.frequency / factor - self.others) / self.slope;
        match value >= 0.0 {
            true => Ok(value),
            false => Err(Failure::Lacking {
                what: format!(
                    "`--quality`: without the friction `{name}`, the quality factor is already \
                     {:.4}, which is below {factor}",
                    self.frequency / self.others
                ),
            }),
        }
    }
}
