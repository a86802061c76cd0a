//! Initial angles and angular velocities.

use branched_pendulum::analysis::Equilibrium;
use branched_pendulum::system::{Model, State};

use crate::Failure;
use crate::frame::command_line::parts;
use crate::subject::Subject;

/// Command-line options for the initial state of a tree.
#[derive(Clone, Debug, clap::Args, PartialEq)]
pub struct ReleaseArguments {
    /// angles at the start from the vertical, degrees: of all links in their order, or of the
    /// named links, while all others have their angles in the stable equilibrium; a name without
    /// the number of a copy means all copies; `apart`: 45° for the first link, and a different,
    /// smaller angle from the equilibrium for each other one
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "DEG,..|NAME=DEG,..",
        default_value = "0",
        allow_hyphen_values = true
    )]
    pub start: String,
    /// angular velocities at the start, degrees/s, in the same form; those of other links are zero
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
    /// [`Failure::Start`] if the option is not a list of one number per link, [`Failure::NoLink`]
    /// for an unknown link, and [`Failure::Equilibrium`] if the equilibrium angles of links that
    /// are not named cannot be found.
    pub fn state(&self, subject: &Subject) -> Result<State<f64>, Failure> {
        let rest = |subject: &Subject| Ok(subject.rest()?);
        let zeros = |subject: &Subject| Ok(vec![0.0; subject.tree.links()]);
        let mut values = match self.start.trim() {
            APART => apart(rest(subject)?),
            start => of_links(subject, "--start", start, rest)?,
        };
        values.extend(of_links(subject, "--rates", &self.rates, zeros)?);
        Ok(State::new(0.0, values))
    }
}

/// Command-line option that selects the equilibrium of a tree.
#[derive(Clone, Debug, clap::Args, PartialEq)]
pub struct RestArguments {
    /// angles from the vertical from which the tree descends to its equilibrium, degrees: of all
    /// links in their order, or of the named links, while all others are zero; a name without the
    /// number of a copy means all copies
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "DEG,..|NAME=DEG,..",
        default_value = "0",
        allow_hyphen_values = true
    )]
    pub start: String,
}

impl RestArguments {
    /// Returns the stable equilibrium to which the tree descends from the given angles.
    ///
    /// # Errors
    /// [`Failure::Start`], [`Failure::NoLink`] and [`Failure::Equilibrium`].
    pub fn rest(&self, subject: &Subject) -> Result<Equilibrium, Failure> {
        let zeros = |subject: &Subject| Ok(vec![0.0; subject.tree.links()]);
        let start = of_links(subject, "--start", &self.start, zeros)?;
        Ok(subject.tree.stable_equilibrium(&start)?)
    }
}

/// Word for a start in which no two links have the same angle relative to equilibrium.
pub(crate) const APART: &str = "apart";

/// Returns angles that differ from the equilibrium angles by at most 45°. The differences are
/// proportional to fractional parts of multiples of the golden ratio, so that no two are equal.
fn apart(mut rest: Vec<f64>) -> Vec<f64> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    for (link, angle) in rest.iter_mut().enumerate() {
        let fraction = (link as f64 * GOLDEN).fract();
        *angle += std::f64::consts::FRAC_PI_4 * (1.0 - 2.0 * fraction);
    }
    rest
}

/// Parses one number per link, given in degrees; `others` returns the values of links that are not
/// named.
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
                    "`{part}` must have the form NAME=DEG, like the others"
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
