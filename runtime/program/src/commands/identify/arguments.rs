//! The command line.

use clap::{Parser, ValueEnum};

use branched_pendulum_measure::identification::Frequency;

use crate::frame::command_line::{number, parts};
use crate::frame::{Charts, RecordOptions};
use crate::measured_file::MeasuredFile;
use crate::motion::MethodArguments;
use crate::release::{APART, ReleaseArguments};
use crate::subject::TreeArguments;

/// Finds masses, lengths, inertias and friction of a pendulum (the parameters that its description
/// names) from its measured motion, or from measured frequencies of small motions. Prints how well
/// viscous friction, Coulomb friction and quadratic drag explain the motion, which parameters the
/// angles determine and which they leave open, and how well the part of the motion that was not
/// fitted is predicted. Without a file, measurements are simulated with known parameters.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(
    name = "branched-pendulum identify",
    version,
    verbatim_doc_comment,
    mut_arg("tree", |tree| tree.default_value("double-pendulum")),
    mut_arg("start", |start| start.default_value(APART))
)]
pub struct Arguments {
    /// The file.
    #[command(flatten)]
    pub measured: MeasuredFile,
    /// The measured tree, with the known values of its parameters.
    #[command(flatten)]
    pub tree: TreeArguments,
    /// parameters that are looked for, in SI units, each from within some 30 % of its GUESS, or of
    /// the value that a shipped tree has; friction without either from 0. Others have the values
    /// that `--set` or the tree gives. Without it all are looked for that `--set` does not give,
    /// but for gravity
    #[arg(long, value_name = "NAME[=GUESS][,..]", value_parser = guesses)]
    // By its full path, clap takes each for one value.
    pub unknown: Vec<::std::vec::Vec<(String, Option<f64>)>>,
    /// measured frequency of a small motion, Hz, with its standard error and the number of its
    /// mode: 1 is the slowest, as `modes` lists them. Without numbers they are as many as the modes
    /// that oscillate, in any order. Beside a FILE each datum weighs by its error; without one they
    /// are fitted alone, and nothing is simulated
    #[arg(long, value_name = "HZ:ERROR[@MODE][,..]", value_parser = frequencies)]
    // By its full path, clap takes each for one value.
    pub frequency: Vec<::std::vec::Vec<Frequency>>,
    /// length of the part of the record that is fitted, in s from 1 to 1e4; the rest is predicted.
    /// Three quarters of the record by default
    #[arg(long, value_name = "S", value_parser = number(1.0..=1e4, "s"))]
    pub fit: Option<f64>,
    /// friction laws to fit, one after the other: viscous, coulomb (and viscous), all (and
    /// quadratic)
    #[arg(long, value_name = "LAW,...", value_parser = laws, default_value = "viscous,coulomb,all")]
    // By its full path, clap takes it for one value.
    pub laws: ::std::vec::Vec<Law>,
    /// sign of friction coefficients: either sign, where a negative result shows that the law is
    /// wrong, or not negative
    #[arg(long, value_enum, value_name = "SIGN", default_value = "either")]
    pub friction: Sign,
    /// How a simulated tree starts.
    #[command(flatten)]
    pub release: ReleaseArguments,
    /// How the motion is integrated if it is simulated.
    #[command(flatten)]
    pub method: MethodArguments,
    /// simulation: standard deviation of an angle's error, rad from 1e-6 to 0.1
    #[arg(long, value_name = "RAD", default_value = "1e-3", value_parser = number(1e-6..=0.1, "rad"))]
    pub noise: f64,
    /// simulation: length of the record, s from 5 to 1000
    #[arg(long, value_name = "S", default_value = "40", value_parser = number(5.0..=1e3, "s"))]
    pub duration: f64,
    /// simulation: pictures per second, 1 to 1e4
    #[arg(long, value_name = "HZ", default_value = "100", value_parser = number(1.0..=1e4, "Hz"))]
    pub rate: f64,
    /// seed of all random numbers
    #[arg(long, value_name = "N", default_value = "1")]
    pub seed: u64,
}

/// Friction laws; each includes the ones before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Law {
    /// Viscous friction, proportional to the angular velocity, in every pivot.
    Viscous,
    /// And Coulomb's, in every pivot.
    Coulomb,
    /// Quadratic drag of every link against the air, in addition.
    All,
}

/// Signs that friction coefficients may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Sign {
    /// Either one.
    Either,
    /// None that drives.
    Nonnegative,
}

impl Law {
    /// Returns the name of the law in tables.
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

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("identify-output");
    const CHARTS: Charts = Charts::OverTime;

    fn followed(&self) -> Option<f64> {
        self.measured.file.is_none().then_some(self.duration)
    }

    fn of_records() -> RecordOptions {
        let own = ["noise", "duration", "rate"];
        RecordOptions {
            measured: MeasuredFile::OPTIONS.to_vec(),
            simulated: [
                &own[..],
                &ReleaseArguments::OPTIONS,
                &MethodArguments::OPTIONS,
            ]
            .concat(),
            instead: Some("frequency"),
            of_both: vec!["fit", "laws", "seed", "show"],
        }
    }

    fn check(&self) -> Result<(), String> {
        self.measured.check()
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

fn frequencies(text: &str) -> Result<Vec<Frequency>, String> {
    let wrong = |part: &str| {
        format!(
            "`{part}` is not a frequency with its standard error, both in Hz and positive: write \
             `0.88:0.005`, or `0.88:0.005@1` for mode 1, the slowest"
        )
    };
    let frequency = |part: &str| {
        let (datum, mode) = match part.split_once('@') {
            Some((datum, mode)) => (datum, Some(mode.trim().parse::<usize>().ok()?)),
            None => (part, None),
        };
        let number = |text: &str| text.trim().parse::<f64>().ok();
        let positive = |value: &f64| value.is_finite() && *value > 0.0;
        let (hertz, deviation) = datum.split_once(':')?;
        Some(Frequency {
            hertz: number(hertz).filter(positive)?,
            deviation: number(deviation).filter(positive)?,
            mode,
        })
    };
    let all = parts(text).map(|part| frequency(part).ok_or_else(|| wrong(part)));
    all.collect()
}

fn guesses(text: &str) -> Result<Vec<(String, Option<f64>)>, String> {
    let guess = |part: &str| {
        let Some((name, guess)) = part.split_once('=') else {
            return Some((part.to_owned(), None));
        };
        let guess: f64 = guess.trim().parse().ok()?;
        guess
            .is_finite()
            .then(|| (name.trim().to_owned(), Some(guess)))
    };
    let all: Option<Vec<_>> = parts(text).map(guess).collect();
    all.ok_or_else(|| "names, with guesses or without: mass_1=0.12,joint_1".to_owned())
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, ValueEnum};

    use super::{Arguments, Law};
    use crate::frame::command_line::parse_line;

    #[test]
    fn lists_are_read() {
        let line =
            "swing.csv --columns a,b --laws all --set gravity=9.81 --unknown a=2,b --unknown c";
        let arguments: Arguments = parse_line(line).unwrap();
        assert_eq!(arguments.measured.columns, ["a", "b"]);
        assert_eq!(arguments.laws, [Law::All]);
        assert_eq!(arguments.tree.tree, "double-pendulum");
        assert_eq!(arguments.tree.set, [[("gravity".to_owned(), 9.81)]]);
        let names = [("a", Some(2.0)), ("b", None), ("c", None)];
        let names = names.map(|(name, guess)| (name.to_owned(), guess));
        assert_eq!(arguments.unknown.concat(), names);
        assert!(parse_line::<Arguments>("--set mass_1").is_err());
        assert!(parse_line::<Arguments>("--unknown mass_1=heavy").is_err());
        assert!(parse_line::<Arguments>("--laws dry").is_err());
    }

    #[test]
    fn laws_are_told_by_the_help() {
        let help = Arguments::command().render_long_help().to_string();
        for law in Law::value_variants() {
            let name = law.to_possible_value().unwrap();
            assert!(help.contains(name.get_name()));
        }
    }
}
