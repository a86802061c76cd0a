//! The command line.

use clap::{Parser, ValueEnum};

use super::apparatus::Friction;
use branched_pendulum_frame::Charts;
use branched_pendulum_frame::command_line::{must_be, number, numbers, plain};

/// Type of the numbers in which trajectories are integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Precision {
    /// some 7 digits
    #[value(name = "f32")]
    Single,
    /// some 16 digits
    #[value(name = "f64")]
    Double,
}

impl Precision {
    /// Returns the smallest accepted tolerance: about ten times the rounding error of a number.
    /// With a smaller one, steps would become too short.
    fn least_tolerance(self) -> f64 {
        match self {
            Self::Single => 1e-6,
            Self::Double => 2e-15,
        }
    }
}

impl std::fmt::Display for Precision {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Single => "f32",
            Self::Double => "f64",
        })
    }
}

/// The paper's branched double pendulum: a parent link with two equal children,
/// released from rest with the children hanging straight down. Does the antiphase
/// mode θ_d = (θ_2 − θ_3)/2 grow, and which energy transfer W feeds it?
///
/// Prints the eigenfrequencies and one row for each initial angle, and writes one
/// CSV file for each angle, the charts as SVG and PNG, and run.json.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-double", version, verbatim_doc_comment)]
pub struct Arguments {
    /// initial angles θ_1(0) of the parent link, degrees from -180 to 180;
    /// FROM:TO:STEP for a range, as in 40:48:0.1; by default the paper's
    #[arg(
        verbatim_doc_comment,
        long = "angles",
        id = "angles",
        value_name = "DEG[,DEG]...",
        default_value = "39.5,45,46.4,47.6,47.8,48.6",
        value_parser = numbers(ANGLES, "degrees"),
        allow_hyphen_values = true
    )]
    // By its full path, clap takes it for one value.
    pub angles_deg: ::std::vec::Vec<f64>,
    /// θ_d(0), rad from -1.5 to 1.5: child 2 starts at +RAD, child 3 at −RAD;
    /// 0.01 is about what remains if one waits, by eye, until the links rest.
    /// The growth factor does not depend on θ_d(0) as long as θ_d is small
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "RAD",
        default_value = "0.01",
        value_parser = number(-1.5..=1.5, "rad"),
        allow_hyphen_values = true
    )]
    pub disturbance: f64,
    /// time observed after the release, s from 1 to 100000; 32 is the span of
    /// the paper's spectrum
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "S",
        default_value = "32",
        value_parser = number(1.0..=1e5, "s")
    )]
    pub duration: f64,
    /// Friction in the joints.
    #[command(flatten)]
    pub friction: Friction,
    /// samples per second in tables and charts, Hz from 10 to 100000
    #[arg(
        long,
        value_name = "HZ",
        default_value = "100",
        value_parser = number(LEAST_RATE..=1e5, "Hz")
    )]
    pub rate: f64,
    /// numbers in which the motion is integrated
    #[arg(long, value_name = "NUMBERS", default_value = "f64")]
    pub precision: Precision,
    /// relative error allowed in one integration step, up to 0.01; for f32 at
    /// least 1e-6, and 1e-5 by default
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "TOL",
        default_value = "1e-12",
        default_value_if("precision", "f32", "1e-5"),
        value_parser = number(0.0..=1e-2, "")
    )]
    pub tolerance: f64,
    /// writes a film of all releases as well, as SVG and as animated PNG
    #[arg(long)]
    pub animate: bool,
}

impl Default for Arguments {
    fn default() -> Self {
        Self::parse_from(["branched-double"])
    }
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("branched-double-output");
    const CHARTS: Charts = Charts::OverTime;

    fn followed(&self) -> Option<f64> {
        Some(self.duration)
    }

    fn check(&self) -> Result<(), String> {
        let tolerances = self.precision.least_tolerance()..=1e-2;
        if !tolerances.contains(&self.tolerance) {
            let (precision, must) = (self.precision, must_be(&tolerances, ""));
            return Err(format!("`--tolerance` for {precision} {must}"));
        }
        let samples = self.duration * self.rate;
        if samples > MOST_SAMPLES {
            let (samples, most) = (plain(samples), plain(MOST_SAMPLES));
            return Err(format!(
                "`--duration` times `--rate` makes {samples} samples a run, but {most} is the most"
            ));
        }
        Ok(())
    }
}

/// Largest number of samples of one run: a million rows take about 600 MB of memory and disk.
const MOST_SAMPLES: f64 = 1e6;

/// Smallest number of samples per second; fewer would not resolve the motion of the links.
const LEAST_RATE: f64 = 10.0;

impl Arguments {
    /// Returns the number of intervals between samples, which is one less than the number of
    /// samples.
    pub fn intervals(&self) -> usize {
        // `check` holds the product between 1 and a million; a rounding error
        // must not cost the last sample.
        (self.duration * self.rate * (1.0 + f64::EPSILON)) as usize
    }

    /// Returns the absolute tolerance of an integration step, in rad and rad/s. It determines down
    /// to which magnitude θ_d keeps its relative accuracy. In single precision it must exceed the
    /// rounding errors of angles and rates of order one.
    pub fn absolute_tolerance(&self) -> f64 {
        let share = match self.precision {
            Precision::Single => 0.1,
            Precision::Double => 1e-3,
        };
        share * self.tolerance
    }

    /// Returns the conditions common to all runs, for a title.
    pub fn conditions(&self) -> String {
        format!(
            "θ_d(0) = {} rad, {}",
            plain(self.disturbance),
            self.friction
        )
    }

    /// Time of a sample, s.
    pub fn sample_time(&self, index: usize) -> f64 {
        index as f64 / self.rate
    }
}

/// Angles of release, degrees.
const ANGLES: std::ops::RangeInclusive<f64> = -180.0..=180.0;

#[cfg(test)]
mod tests {
    use super::{Arguments, Precision};
    use branched_pendulum_frame::command_line::{parse, parse_line};

    fn run(line: &str) -> Arguments {
        parse_line(line).unwrap()
    }

    #[test]
    fn every_option_is_read() {
        let arguments = run("--angles 50,-30.5 --disturbance=-1e-3 --duration 5 \
             --friction-root 1e-4 --friction-children 3e-5 --rate 50 \
             --precision f32 --tolerance 1e-5");
        assert_eq!(arguments.angles_deg, [-30.5, 50.0]);
        let range = run("--angles 40:40.3:0.1,39.5");
        assert_eq!(range.angles_deg, [39.5, 40.0, 40.1, 40.2, 40.3]);
        assert_eq!(run("--angles -3:-2:1").angles_deg, [-3.0, -2.0]);
        assert_eq!(arguments.disturbance, -1e-3);
        assert_eq!(arguments.duration, 5.0);
        assert_eq!(arguments.friction.root, 1e-4);
        assert_eq!(arguments.friction.children, 3e-5);
        assert_eq!(arguments.rate, 50.0);
        assert_eq!(arguments.precision, Precision::Single);
        assert_eq!(arguments.tolerance, 1e-5);
        assert_eq!(arguments.intervals(), 250);
    }

    #[test]
    fn defaults_hold_where_nothing_is_said() {
        assert_eq!(run(""), Arguments::default());
        let folder = |words: &[&str]| {
            let words = ["branched-double"].iter().chain(words).map(Into::into);
            parse::<Arguments>(words).unwrap().output
        };
        assert_eq!(folder(&[]), Some("branched-double-output".into()));
        assert_eq!(folder(&["--output", "elsewhere"]), Some("elsewhere".into()));
        assert_eq!(run("--precision f32").tolerance, 1e-5);
    }

    #[test]
    fn the_last_sample_is_not_lost_to_rounding() {
        for tenths in 10..1000_u32 {
            let arguments = Arguments {
                duration: f64::from(tenths) / 10.0,
                ..Arguments::default()
            };
            assert_eq!(arguments.intervals(), 10 * tenths as usize);
        }
    }

    #[test]
    fn mistakes_are_named() {
        for (line, message) in [
            ("--Angels 3", "unexpected argument '--Angels' found"),
            ("--angels 3", "a similar argument exists: '--angles'"),
            ("surprise", "unexpected argument 'surprise' found"),
            ("--rate", "a value is required for '--rate <HZ>'"),
            (
                "--rate --duration 3",
                "a value is required for '--rate <HZ>'",
            ),
            ("--output=", "a value is required for '--output <FOLDER>'"),
            ("--rate 50 --rate 50", "cannot be used multiple times"),
            ("--angles 3,4,3", "3 degrees stand there twice"),
            ("--angles 3,,4", "`` is not a number; a range is written"),
            (
                "--angles 40-47",
                "`40-47` is not a number; a range is written",
            ),
            ("--angles 40:48", "write `FROM:TO:STEP`, as in `40:48:0.1`"),
            ("--angles 40:48:-1", "with at most 10000 steps"),
            (
                "--duration soon",
                "not a number; it must be from 1 to 100000 s",
            ),
            (
                "--duration inf",
                "not a number; it must be from 1 to 100000 s",
            ),
            ("--angles 200", "200 must be from -180 to 180 degrees"),
            ("--friction-children=-1e-5", "must be from 0 to 1 N m s"),
            (
                "--precision f32 --tolerance 1e-9",
                "`--tolerance` for f32 must be from 1e-6 to 0.01",
            ),
            ("--precision f16", "[possible values: f32, f64]"),
            (
                "--duration 1e5 --rate 1000",
                "`--duration` times `--rate` makes 1e8 samples a run, but 1e6 is the most",
            ),
        ] {
            let error = parse_line::<Arguments>(line).unwrap_err();
            assert!(error.contains(message), "{line}: {error}");
            assert!(error.contains("'--help'"), "{line}: {error}");
        }
    }
}
