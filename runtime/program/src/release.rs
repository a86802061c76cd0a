//! Where and how fast a tree starts.

use branched_pendulum::system::{Model, State};

use crate::Failure;
use crate::frame::command_line::parts;
use crate::subject::Subject;

/// Options that say how a tree starts.
#[derive(Clone, Debug, clap::Args, PartialEq)]
pub struct ReleaseArguments {
    /// angles at the start from the vertical, degrees: of all links in their order, or of those
    /// named, others being where they rest; a name without the number of a copy is all copies;
    /// `apart`: 45° of the first link and less, a different angle, of each other one, from rest
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "DEG,..|NAME=DEG,..",
        default_value = "0",
        allow_hyphen_values = true
    )]
    pub start: String,
    /// angular velocities at the start, degrees/s, written alike; those not named are zero
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "DEG/S,..|NAME=DEG/S,..",
        default_value = "0",
        allow_hyphen_values = true
    )]
    pub rates: String,
}

impl ReleaseArguments {
    /// Names of the options.
    pub const OPTIONS: [&str; 2] = ["start", "rates"];

    /// Returns the state at the start.
    ///
    /// # Errors
    /// [`Failure::Start`] for what is no list of numbers, or one of another length than there are
    /// links, [`Failure::NoLink`], and [`Failure::Equilibrium`] where the place of links that are
    /// not named is not found.
    pub fn state(&self, subject: &Subject) -> Result<State<f64>, Failure> {
        let rest = |subject: &Subject| {
            let zeros = vec![0.0; subject.tree.links()];
            Ok(subject.tree.equilibrium(&zeros)?)
        };
        let zeros = |subject: &Subject| Ok(vec![0.0; subject.tree.links()]);
        let mut values = match self.start.trim() {
            APART => apart(rest(subject)?),
            start => of_links(subject, "--start", start, rest)?,
        };
        values.extend(of_links(subject, "--rates", &self.rates, zeros)?);
        Ok(State::new(0.0, values))
    }
}

/// The start of links that are all at angles of their own.
pub(crate) const APART: &str = "apart";

/// Turns links from where they rest, by at most 45°: multiples of the golden ratio, of which
/// no two have equal fractions, keep them apart.
fn apart(mut rest: Vec<f64>) -> Vec<f64> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    for (link, angle) in rest.iter_mut().enumerate() {
        let fraction = (link as f64 * GOLDEN).fract();
        *angle += std::f64::consts::FRAC_PI_4 * (1.0 - 2.0 * fraction);
    }
    rest
}

/// A number for each link, given in degrees.
fn of_links(
    subject: &Subject,
    option: &'static str,
    text: &str,
    others: impl Fn(&Subject) -> Result<Vec<f64>, Failure>,
) -> Result<Vec<f64>, Failure> {
    let links = subject.tree.links();
    let wrong = |what: String| Failure::Start { option, what };
    let number = |text: &str| match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number.to_radians()),
        _ => Err(wrong(format!("`{text}` is not a number"))),
    };
    if text.contains('=') {
        let mut values = others(subject)?;
        for part in parts(text) {
            let Some((name, value)) = part.split_once('=') else {
                return Err(wrong(format!(
                    "`{part}` is no NAME=DEG beside others that are"
                )));
            };
            let value = number(value)?;
            for link in subject.links_named(name.trim())? {
                values[link] = value;
            }
        }
        return Ok(values);
    }
    let values: Vec<f64> = parts(text).map(number).collect::<Result<_, _>>()?;
    match values.len() {
        0 => Err(wrong("no number".to_owned())),
        1 => Ok(vec![values[0]; links]),
        count if count == links => Ok(values),
        count => {
            let names = subject.tree.names().join(", ");
            Err(wrong(format!("{count} numbers for {links} links: {names}")))
        }
    }
}
