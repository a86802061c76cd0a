//! The command line.

use branched_pendulum::Parametric;
use branched_pendulum_measure::IdentificationError;
use clap::{Parser, ValueEnum};

use super::scene::{Branched, Chain};
use crate::measured_file::MeasuredFile;
use branched_pendulum_program::frame::command_line::{number, parts};

/// Masses, lengths, inertias and friction of a pendulum from its measured motion: a chain of
/// two links, or the paper's pendulum. Prints how well viscous friction, Coulomb friction and
/// quadratic drag explain it, what the angles determine and what they leave open, and how
/// well the motion goes on that was not fitted. Without a file a chain is simulated, whose
/// parameters are known.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "identify", version, verbatim_doc_comment)]
pub struct Arguments {
    /// The file.
    #[command(flatten)]
    pub measured: MeasuredFile,
    /// tree that was measured
    #[arg(long, value_enum, value_name = "TREE", default_value = "chain")]
    pub tree: Tree,
    /// length of the part that is fitted, s from 1 to 1e4; what follows is predicted. Three
    /// quarters of the record without it
    #[arg(long, value_name = "S", value_parser = number(1.0..=1e4, "s"))]
    pub fit: Option<f64>,
    /// laws of friction, one after the other: viscous, coulomb (and viscous), all (and quadratic)
    #[arg(long, value_name = "LAW,...", value_parser = laws, default_value = "viscous,coulomb,all")]
    // By its full path, clap takes it for one value.
    pub laws: ::std::vec::Vec<Law>,
    /// coefficients of friction: of either sign, which tells a law that is not the real one, or no
    /// less than 0
    #[arg(long, value_enum, value_name = "SIGN", default_value = "either")]
    pub friction: Sign,
    /// parameters that are known, in SI units, by name: gravity and, of the link above (1) or below
    /// (2), mass_1, com_1 (distance of the centre of mass), inertia_1 (about it), joint_1 (distance of
    /// the next joint), viscous_1, coulomb_1, quadratic_1, mass_2, com_2, inertia_2, viscous_2,
    /// coulomb_2, quadratic_2
    #[arg(long, value_name = "NAME=VALUE,...", value_parser = settings, default_value = "")]
    pub known: ::std::vec::Vec<(String, f64)>,
    /// values from which others are searched, by the same names, within some 30 %
    #[arg(long, value_name = "NAME=VALUE,...", value_parser = settings, default_value = "")]
    pub start: ::std::vec::Vec<(String, f64)>,
    /// simulated: error of an angle, rad from 1e-6 to 0.1
    #[arg(long, value_name = "RAD", default_value = "1e-3", value_parser = number(1e-6..=0.1, "rad"))]
    pub noise: f64,
    /// simulated: length of the record, s from 5 to 1000
    #[arg(long, value_name = "S", default_value = "40", value_parser = number(5.0..=1e3, "s"))]
    pub duration: f64,
    /// simulated: seed of the noise
    #[arg(long, value_name = "N", default_value = "1")]
    pub seed: u64,
}

/// Trees that can be measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Tree {
    /// Two links, one below the other.
    Chain,
    /// The paper's pendulum: two equal links hang from one.
    Branched,
}

/// Laws of friction, each with those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Law {
    /// Proportional to the rate, in every pivot.
    Viscous,
    /// And Coulomb's, in every pivot.
    Coulomb,
    /// And quadratic drag of every link against the air.
    All,
}

/// Signs that coefficients of friction may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Sign {
    /// Either one.
    Either,
    /// None that drives.
    Nonnegative,
}

impl Tree {
    /// The names of its parameters.
    fn parameters(self) -> &'static [&'static str] {
        match self {
            Self::Chain => <Chain as Parametric<f64>>::PARAMETERS,
            Self::Branched => <Branched as Parametric<f64>>::PARAMETERS,
        }
    }
}

impl Law {
    /// Name of the law in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Viscous => "viscous",
            Self::Coulomb => "and Coulomb",
            Self::All => "and quadratic",
        }
    }
}

impl Default for Arguments {
    fn default() -> Self {
        Self::parse_from(["identify"])
    }
}

impl branched_pendulum_program::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("identify-output");

    /// Names are looked at before any file.
    fn check(&self) -> Result<(), String> {
        self.measured.check()?;
        let parameters = self.tree.parameters();
        let mut given = self.known.iter().chain(&self.start);
        match given.find(|(name, _)| !parameters.contains(&name.as_str())) {
            None => Ok(()),
            Some((name, _)) => Err(IdentificationError::UnknownParameter {
                name: name.clone(),
                parameters: parameters.iter().map(ToString::to_string).collect(),
            }
            .to_string()),
        }
    }
}

fn laws(text: &str) -> Result<Vec<Law>, String> {
    let laws: Result<Vec<Law>, String> =
        parts(text).map(|part| Law::from_str(part, false)).collect();
    match laws {
        Ok(laws) if laws.is_empty() => Err("name one at least".to_owned()),
        Ok(laws) => Ok(laws),
        Err(_) => Err("laws are viscous, coulomb and all".to_owned()),
    }
}

fn settings(text: &str) -> Result<Vec<(String, f64)>, String> {
    let setting = |part: &str| {
        let (name, value) = part.split_once('=')?;
        let value: f64 = value.trim().parse().ok()?;
        value.is_finite().then(|| (name.trim().to_owned(), value))
    };
    let all: Option<Vec<_>> = parts(text).map(setting).collect();
    all.ok_or_else(|| "names with numbers: mass_1=0.12,joint_1=0.27".to_owned())
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, ValueEnum};

    use super::{Arguments, Law, Tree};
    use branched_pendulum_program::frame::command_line::parse_line;

    #[test]
    fn lists_are_read() {
        let line = "swing.csv --columns a,b --laws all --known gravity=9.81,mass_1=0.1";
        let arguments: Arguments = parse_line(line).unwrap();
        assert_eq!(arguments.measured.columns, ["a", "b"]);
        assert_eq!(arguments.laws, [Law::All]);
        let known = [("gravity".to_owned(), 9.81), ("mass_1".to_owned(), 0.1)];
        assert_eq!(arguments.known, known);
        assert!(parse_line::<Arguments>("--known mass_1").is_err());
        assert!(parse_line::<Arguments>("--laws dry").is_err());
    }

    #[test]
    fn names_are_told_by_the_help_and_looked_at_before_any_file() {
        let help = Arguments::command().render_long_help().to_string();
        for tree in [Tree::Chain, Tree::Branched] {
            for name in tree.parameters() {
                assert!(help.contains(name), "{name}");
            }
        }
        for law in Law::value_variants() {
            let name = law.to_possible_value().unwrap();
            assert!(help.contains(name.get_name()));
        }
        for line in [
            "no-such-file.csv --known mass_3=1",
            "no-such-file.csv --start com1=0.1",
            "--tree branched --known g=9.81",
        ] {
            let message = parse_line::<Arguments>(line).unwrap_err().to_string();
            assert!(
                message.contains("the model has no parameter `"),
                "{message}"
            );
            assert!(message.contains("`viscous_2`"), "{message}");
        }
    }
}
