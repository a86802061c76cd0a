//! Trees that are scanned one after the other.

use std::f64::consts::TAU;

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum_trees::PendulumTree;

use super::differences_of;
use crate::Failure;
use crate::frame::command_line::parts;
use crate::subject::Subject;

/// A parameter with the values that it takes one after the other, or with the quality factors
/// that it gives.
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

/// Value of a friction at which the decay is looked at, SI units; the decay is proportional.
const TRIAL: f64 = 1e-3;

/// Largest part by which the decay of a viscous friction may differ from proportional.
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

    /// Returns the trees that are scanned, with their labels.
    ///
    /// # Errors
    /// [`Failure::Tree`]; [`Failure::Lacking`] for a parameter that is no viscous friction of the
    /// difference between the copies.
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
        .ok_or_else(|| format!("`{text}` is no `NAME=NUMBER,NUMBER`"))?;
    let value = |part: &str| {
        let value = part.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| format!("`{part}` is not a number"))
    };
    let values: Result<_, String> = parts(values).map(value).collect();
    Ok((name.trim().to_owned(), values?))
}

/// How a viscous friction brakes a small difference at rest.
struct Braking {
    /// Angular frequency of the difference, rad/s.
    frequency: f64,
    /// Decay of its rate by all other friction, 1/s.
    others: f64,
    /// The same by this friction, over the parameter.
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
                    "`--quality`: `{name}` is no friction that brakes a small difference between \
                     the copies"
                ),
            });
        }
        Ok(Self {
            frequency,
            others,
            slope,
        })
    }

    /// Returns the value of the parameter at a quality factor.
    fn value(&self, name: &str, factor: f64) -> Result<f64, Failure> {
        let value = (self.frequency / factor - self.others) / self.slope;
        match value >= 0.0 {
            true => Ok(value),
            false => Err(Failure::Lacking {
                what: format!(
                    "`--quality`: other friction than `{name}` already gives the quality factor \
                     {:.4}, below {factor}",
                    self.frequency / self.others
                ),
            }),
        }
    }
}
