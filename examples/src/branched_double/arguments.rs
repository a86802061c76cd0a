//! The command line: what can be asked, and what to say to what cannot.

use std::fmt;
use std::path::PathBuf;

use super::apparatus::Friction;
use super::argument_error::ArgumentError;

/// What the user asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// To run the experiment.
    Run(Arguments),
    /// To see the help.
    Help,
}

/// The numbers in which trajectories are integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// `f32`, some 7 digits.
    Single,
    /// `f64`, some 16 digits.
    Double,
}

impl Precision {
    /// The tolerance where none is given: what the type can hold with some
    /// digits to spare.
    fn tolerance(self) -> f64 {
        match self {
            Self::Single => 1e-5,
            Self::Double => 1e-12,
        }
    }

    /// The least tolerance: some ten times the rounding error of a number.
    /// Below, steps only get shorter, in the end too short to be taken.
    fn least_tolerance(self) -> f64 {
        match self {
            Self::Single => 1e-6,
            Self::Double => 2e-15,
        }
    }
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Single => "f32",
            Self::Double => "f64",
        })
    }
}

/// All options of the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Arguments {
    /// Initial angles of the parent link, degrees, ascending.
    pub angles_deg: Vec<f64>,
    /// θ_d at the release, rad.
    pub disturbance: f64,
    /// Time that is observed, s.
    pub duration: f64,
    /// Friction in the joints.
    pub friction: Friction,
    /// Samples per second.
    pub rate: f64,
    /// Numbers to integrate in.
    pub precision: Precision,
    /// Relative tolerance of an integration step.
    pub tolerance: f64,
    /// Folder for tables and charts.
    pub output: PathBuf,
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            angles_deg: vec![39.5, 45.0, 46.4, 47.6, 47.8, 48.6],
            disturbance: 0.01,
            duration: 32.0,
            friction: Friction::default(),
            rate: 100.0,
            precision: Precision::Double,
            tolerance: Precision::Double.tolerance(),
            output: PathBuf::from("branched-double-output"),
        }
    }
}

pub(super) const ANGLES: &str = "--angles";
const DISTURBANCE: &str = "--disturbance";
pub(super) const DURATION: &str = "--duration";
const FRICTION_ROOT: &str = "--friction-root";
const FRICTION_CHILDREN: &str = "--friction-children";
pub(super) const RATE: &str = "--rate";
pub(super) const PRECISION: &str = "--precision";
const TOLERANCE: &str = "--tolerance";
const OUTPUT: &str = "--output";
const HELP_OPTION: &str = "--help";

/// All options, as the help lists them.
pub const OPTIONS: [&str; 10] = [
    ANGLES,
    DISTURBANCE,
    DURATION,
    FRICTION_ROOT,
    FRICTION_CHILDREN,
    RATE,
    PRECISION,
    TOLERANCE,
    OUTPUT,
    HELP_OPTION,
];

/// Most samples of one run: a million rows are some 600 MB of memory and disk.
pub(super) const MOST_SAMPLES: f64 = 1e6;

/// Least samples per second: below, the samples miss the motion of the links.
const LEAST_RATE: f64 = 10.0;

impl Arguments {
    /// Number of intervals between samples; the samples are one more.
    pub fn intervals(&self) -> usize {
        // `parse` holds the product between 1 and a million; a rounding error
        // must not cost the last sample.
        (self.duration * self.rate * (1.0 + f64::EPSILON)) as usize
    }

    /// Absolute tolerance of an integration step, in rad and rad/s. It decides
    /// how small a θ_d keeps its relative accuracy; in single precision it must
    /// not be lost in the rounding errors of angles and rates of order one.
    pub fn absolute_tolerance(&self) -> f64 {
        let share = match self.precision {
            Precision::Single => 0.1,
            Precision::Double => 1e-3,
        };
        share * self.tolerance
    }

    /// Time of a sample, s.
    pub fn sample_time(&self, index: usize) -> f64 {
        index as f64 / self.rate
    }

    /// Reads the arguments that follow the program's name.
    ///
    /// # Errors
    /// [`ArgumentError`], the first one found.
    pub fn parse(words: impl IntoIterator<Item = String>) -> Result<Request, ArgumentError> {
        let mut arguments = Self::default();
        let mut tolerance = None;
        let mut seen: Vec<&str> = Vec::new();
        let mut words = words.into_iter();
        while let Some(word) = words.next() {
            let (name, joined) = match word.split_once('=') {
                Some((name, value)) => (name, Some(value.to_owned())),
                None => (word.as_str(), None),
            };
            let name = if name == "-h" { HELP_OPTION } else { name };
            let Some(&option) = OPTIONS.iter().find(|&&option| option == name) else {
                return Err(ArgumentError::unknown(name));
            };
            if option == HELP_OPTION {
                return Ok(Request::Help);
            }
            if seen.contains(&option) {
                return Err(ArgumentError::Repeated { option });
            }
            seen.push(option);
            let value = joined.or_else(|| words.next());
            let value = value.filter(|value| !value.is_empty() && !value.starts_with("--"));
            let value = value.ok_or(ArgumentError::MissingValue { option })?;
            let number = || read_number(option, &value);
            match option {
                ANGLES => arguments.angles_deg = read_angles(&value)?,
                DISTURBANCE => {
                    arguments.disturbance = within(option, number()?, -1.5..=1.5, "rad")?;
                }
                DURATION => arguments.duration = within(option, number()?, 1.0..=1e5, "s")?,
                FRICTION_ROOT => {
                    arguments.friction.root = within(option, number()?, 0.0..=1.0, "N m s")?;
                }
                FRICTION_CHILDREN => {
                    arguments.friction.children = within(option, number()?, 0.0..=1.0, "N m s")?;
                }
                RATE => arguments.rate = within(option, number()?, LEAST_RATE..=1e5, "Hz")?,
                PRECISION => arguments.precision = read_precision(&value)?,
                TOLERANCE => tolerance = Some(number()?),
                _ => arguments.output = PathBuf::from(value),
            }
        }
        let precision = arguments.precision;
        arguments.tolerance = match tolerance {
            Some(value) => within(TOLERANCE, value, precision.least_tolerance()..=1e-2, "")?,
            None => precision.tolerance(),
        };
        let samples = arguments.duration * arguments.rate;
        if samples > MOST_SAMPLES {
            return Err(ArgumentError::TooManySamples { samples });
        }
        Ok(Request::Run(arguments))
    }
}

fn read_number(option: &'static str, value: &str) -> Result<f64, ArgumentError> {
    match value.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(ArgumentError::NotANumber {
            option,
            value: value.to_owned(),
        }),
    }
}

fn within(
    option: &'static str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    unit: &'static str,
) -> Result<f64, ArgumentError> {
    if range.contains(&value) {
        return Ok(value);
    }
    Err(ArgumentError::OutOfRange {
        option,
        value,
        low: *range.start(),
        high: *range.end(),
        unit,
    })
}

fn read_angles(value: &str) -> Result<Vec<f64>, ArgumentError> {
    let mut angles = Vec::new();
    for part in value.split(',') {
        for angle in read_range(part)? {
            let angle = within(ANGLES, angle, -180.0..=180.0, "degrees")?;
            if angles.contains(&angle) {
                return Err(ArgumentError::RepeatedAngle { angle });
            }
            angles.push(angle);
        }
    }
    angles.sort_by(f64::total_cmp);
    Ok(angles)
}

/// Most angles of one range.
const MOST_ANGLES: f64 = 10_000.0;

/// An angle, or those of a range `FROM:TO:STEP`, both ends included.
fn read_range(part: &str) -> Result<Vec<f64>, ArgumentError> {
    let numbers = part.split(':').map(|number| read_number(ANGLES, number));
    let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
    let [from, to, step] = *numbers else {
        return match *numbers {
            [angle] => Ok(vec![angle]),
            _ => Err(ArgumentError::NotARange { value: part.into() }),
        };
    };
    // A step may miss the end by rounding.
    let steps = ((to - from) / step + 1e-9).floor();
    if !(0.0..MOST_ANGLES).contains(&steps) {
        return Err(ArgumentError::NotARange { value: part.into() });
    }
    // Decimals as they would be written: 40.3, not 40.300000000000004.
    let rounded = |angle: f64| (angle * 1e9).round() / 1e9;
    let numbers = (0..=steps as u32).map(f64::from);
    Ok(numbers
        .map(|number| rounded(from + number * step))
        .collect())
}

fn read_precision(value: &str) -> Result<Precision, ArgumentError> {
    [Precision::Single, Precision::Double]
        .into_iter()
        .find(|precision| precision.to_string() == value)
        .ok_or_else(|| ArgumentError::Precision {
            value: value.to_owned(),
        })
}

#[cfg(test)]
mod tests {
    use super::{Arguments, Precision, Request};

    fn parse(line: &str) -> Result<Request, String> {
        let words = line.split_whitespace().map(str::to_owned);
        Arguments::parse(words).map_err(|error| error.to_string())
    }

    fn run(line: &str) -> Arguments {
        match parse(line).unwrap() {
            Request::Run(arguments) => arguments,
            Request::Help => panic!("not the help"),
        }
    }

    #[test]
    fn every_option_is_read() {
        let arguments = run("--angles 50,-30.5 --disturbance=-1e-3 --duration 5 \
             --friction-root 1e-4 --friction-children 3e-5 --rate 50 \
             --precision f32 --tolerance 1e-5 --output elsewhere");
        assert_eq!(arguments.angles_deg, [-30.5, 50.0]);
        let range = run("--angles 40:40.3:0.1,39.5");
        assert_eq!(range.angles_deg, [39.5, 40.0, 40.1, 40.2, 40.3]);
        assert_eq!(arguments.disturbance, -1e-3);
        assert_eq!(arguments.duration, 5.0);
        assert_eq!(arguments.friction.root, 1e-4);
        assert_eq!(arguments.friction.children, 3e-5);
        assert_eq!(arguments.rate, 50.0);
        assert_eq!(arguments.precision, Precision::Single);
        assert_eq!(arguments.tolerance, 1e-5);
        assert_eq!(arguments.output.to_str(), Some("elsewhere"));
        assert_eq!(arguments.intervals(), 250);
    }

    #[test]
    fn defaults_hold_where_nothing_is_said() {
        assert_eq!(run(""), Arguments::default());
        assert_eq!(run("--precision f32").tolerance, 1e-5);
        assert_eq!(parse("--angles 3 -h"), Ok(Request::Help));
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
            (
                "--Angels 3",
                "there is no option `--Angels`; did you mean `--angles`?",
            ),
            ("--xyz 3", "there is no option `--xyz`"),
            (
                "47.8",
                "there is no option `47.8`; initial angles are given as `--angles 47.8`",
            ),
            ("surprise", "there is no option `surprise`"),
            ("--rate", "`--rate` needs a value"),
            ("--rate --duration 3", "`--rate` needs a value"),
            ("--output=", "`--output` needs a value"),
            ("--rate 50 --rate 50", "`--rate` is given twice"),
            ("--angles 3,4,3", "`--angles` has 3 degrees twice"),
            ("--angles 3,,4", "`--angles` needs a number, but got ``"),
            (
                "--angles 40:48",
                "`40:48` is no range of angles: write `FROM:TO:STEP`, as in `40:48:0.1`, \
                 with at most 10000 steps that lead from one end to the other",
            ),
            (
                "--angles 40:48:-1",
                "`40:48:-1` is no range of angles: write `FROM:TO:STEP`, as in `40:48:0.1`, \
                 with at most 10000 steps that lead from one end to the other",
            ),
            (
                "--duration soon",
                "`--duration` needs a number, but got `soon`",
            ),
            (
                "--duration inf",
                "`--duration` needs a number, but got `inf`",
            ),
            (
                "--angles 200",
                "`--angles` is 200.0, but must be from -180.0 to 180.0 degrees",
            ),
            (
                "--friction-children -1e-5",
                "`--friction-children` is -1e-5, but must be from 0.0 to 1.0 N m s",
            ),
            (
                "--precision f32 --tolerance 1e-9",
                "`--tolerance` is 1e-9, but must be from 1e-6 to 0.01",
            ),
            (
                "--precision f16",
                "`--precision` is `f64` or `f32`, but got `f16`",
            ),
            (
                "--duration 1e5 --rate 1000",
                "`--duration` times `--rate` makes 1e8 samples a run, but 1e6 is the most",
            ),
        ] {
            assert_eq!(parse(line), Err(message.to_owned()), "{line}");
        }
    }
}
