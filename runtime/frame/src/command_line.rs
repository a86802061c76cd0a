//! Reading of the command line: numbers with their ranges, `--output` and `--repeat`.

use std::ffi::OsString;
use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command, Id, Parser, value_parser};
use serde_json::{Map, Value};

use super::figures::{Charts, Figures, TimeSpan};
use super::input::{INPUTS, Input};
use super::sweep::Shard;

/// The options of a program, without the options that all programs have.
pub trait Arguments: Parser {
    /// Default folder of results; `None` if the program writes files only on request.
    const FOLDER: Option<&'static str>;

    /// Kinds of charts that the program draws.
    const CHARTS: Charts = Charts::None;

    /// Returns the duration of the motion in s, if the options alone determine it: charts cannot
    /// show later times.
    fn followed(&self) -> Option<f64> {
        None
    }

    /// Returns the shard of the run that is computed, if it is not the whole run.
    fn shard(&self) -> Option<Shard> {
        None
    }

    /// Returns the options that depend on whether a record is measured or simulated; empty if the
    /// program has no such record.
    fn of_records() -> RecordOptions {
        RecordOptions::default()
    }

    /// Compares options with each other.
    ///
    /// # Errors
    /// A message about two options that exclude each other.
    fn check(&self) -> Result<(), String> {
        Ok(())
    }
}

/// Names of the options of a program whose record is measured if a [`FILE`] is given, and simulated
/// otherwise. Each list has no meaning for the other kind of record. One option can replace a
/// record.
#[derive(Clone, Debug, Default)]
pub struct RecordOptions {
    /// Options that apply only to a file of measurements.
    pub measured: Vec<&'static str>,
    /// Options of a simulated record.
    pub simulated: Vec<&'static str>,
    /// The option that replaces a record if it is given without a file; no record is simulated
    /// then.
    pub instead: Option<&'static str>,
    /// Options that apply to measured and to simulated records, and have no meaning without a
    /// record.
    pub of_both: Vec<&'static str>,
}

/// Name of the command-line argument for a file of measurements.
pub const FILE: &str = "file";

impl RecordOptions {
    /// Returns an error for options that do not apply to the kind of record in use. Default values
    /// do not count as given.
    fn check(&self, command: &Command, matches: &ArgMatches) -> Result<(), String> {
        let is_of = |id: &Id, options: &[&str]| options.contains(&id.as_str());
        let given = |options: &[&str]| {
            let mut all = command.get_arguments();
            let given =
                all.find(|own| is_of(own.get_id(), options) && is_given(matches, own.get_id()))?;
            Some(given.get_long().unwrap_or(given.get_id().as_str()))
        };
        let is_measured = matches!(matches.try_contains_id(FILE), Ok(true));
        let instead = self.instead.filter(|_| !is_measured);
        let instead = instead.filter(|own| is_given(matches, &Id::from(*own)));
        if let Some(instead) = instead {
            let of_records = [&self.simulated[..], &self.of_both].concat();
            if let Some(option) = given(&of_records) {
                return Err(format!(
                    "--{option} applies to a record of the motion, but --{instead} replaces the \
                     record: name the file of a record, or leave out --{option}"
                ));
            }
        }
        match is_measured {
            true => given(&self.simulated).map(|option| {
                format!(
                    "--{option} applies to a simulated record, but a file of measurements is \
                     given: leave out one of the two"
                )
            }),
            false => given(&self.measured).map(|option| {
                format!(
                    "--{option} applies to a file of measurements, but no file is given: name \
                     the file, or leave out --{option}"
                )
            }),
        }
        .map_or(Ok(()), Err)
    }
}

fn is_given(matches: &ArgMatches, id: &Id) -> bool {
    matches.value_source(id.as_str()) == Some(ValueSource::CommandLine)
}

/// Names of the options that all programs have: the folder of results, and a run to repeat.
const OUTPUT: &str = "output";
const REPEAT: &str = "repeat";
/// Names of the options of programs that draw charts.
const FIGURE_WIDTH: &str = "figure-width";
const SHOW: &str = "show";

/// A parsed command line.
#[derive(Debug)]
pub struct CommandLine<A> {
    /// The options of the program.
    pub arguments: A,
    /// The folder of results, if one is given.
    pub output: Option<PathBuf>,
    /// Settings of the charts.
    pub figures: Figures,
    /// Values of all options as text, including defaults, for `run.json`.
    pub values: Map<String, Value>,
    /// Files that the repeated run has read; empty if no run is repeated.
    pub recorded: Vec<Input>,
}

/// Parses the command line, whose first word is the program's name.
///
/// # Errors
/// The text to print instead of a run: the help text, or a message about a mistake.
pub fn parse<A: Arguments>(
    words: impl IntoIterator<Item = OsString>,
) -> Result<CommandLine<A>, clap::Error> {
    let mut command = command::<A>();
    let given: Vec<OsString> = words.into_iter().collect();
    let mut matches = command.try_get_matches_from_mut(&given)?;
    let mut recorded = Vec::new();
    if let Some(file) = matches.get_one::<PathBuf>(REPEAT) {
        let (words, inputs) = repeated(&command, &matches, file)
            .map_err(|message| command.error(ErrorKind::ValueValidation, message))?;
        recorded = inputs;
        let name = given.into_iter().take(1);
        matches = command.try_get_matches_from_mut(name.chain(words))?;
    } else {
        // A record restates all values, those by default too.
        let checked = A::of_records().check(&command, &matches);
        checked.map_err(|message| command.error(ErrorKind::ArgumentConflict, message))?;
    }
    let arguments = A::from_arg_matches(&matches).map_err(|error| error.format(&mut command))?;
    let figures = figures::<A>(&matches);
    let shown = figures.shown.zip(arguments.followed());
    let shown = shown.map_or(Ok(()), |(shown, end)| shown.check(0.0, end));
    arguments
        .check()
        .and(shown)
        .map_err(|message| command.error(ErrorKind::ValueValidation, message))?;
    Ok(CommandLine {
        arguments,
        output: matches.get_one(OUTPUT).cloned(),
        figures,
        values: values(&command, &matches),
        recorded,
    })
}

fn command<A: Arguments>() -> Command {
    let path = |name| {
        Arg::new(name)
            .long(name)
            .value_parser(value_parser!(PathBuf))
    };
    let output = path(OUTPUT)
        .value_name("FOLDER")
        .help("where tables, charts and run.json go; files of the same name there\nare replaced")
        .default_values(A::FOLDER);
    let repeat = path(REPEAT)
        .value_name("FILE")
        .help("repeats the run that a run.json records; no other option but --output");
    let own = A::command().args([output, repeat]);
    let width = Arg::new(FIGURE_WIDTH)
        .long(FIGURE_WIDTH)
        .value_name("MM")
        .value_parser(millimetres)
        .help("width of charts as figures of a paper, 66 to 400 mm, with type\nof 7 and 8 points: 85mm is a column of many journals");
    let show = Arg::new(SHOW)
        .long(SHOW)
        .value_name("FROM:TO")
        .value_parser(TimeSpan::read)
        .allow_hyphen_values(true)
        .help("time that charts show, s, as in 2:10; tables have all of it");
    match A::CHARTS {
        Charts::None => own,
        Charts::Any => own.arg(width),
        Charts::OverTime => own.args([width, show]),
    }
}

/// Returns the settings of charts, from those options that the program has.
fn figures<A: Arguments>(matches: &ArgMatches) -> Figures {
    let width = || matches.get_one(FIGURE_WIDTH).copied();
    let shown = || matches.get_one(SHOW).copied();
    Figures {
        width: (A::CHARTS >= Charts::Any).then(width).flatten(),
        shown: (A::CHARTS >= Charts::OverTime).then(shown).flatten(),
    }
}

/// Returns the words of the command line that `file` records, with the output folder of this run,
/// and the files that the recorded run has read.
fn repeated(
    command: &Command,
    matches: &ArgMatches,
    file: &std::path::Path,
) -> Result<(Vec<OsString>, Vec<Input>), String> {
    let ids = command.get_arguments().map(|argument| argument.get_id());
    let mut others = ids.filter(|id| *id != OUTPUT && *id != REPEAT);
    if let Some(id) = others.find(|id| is_given(matches, id)) {
        return Err(format!(
            "`--repeat` takes the value of `{id}` from its file"
        ));
    }
    let shown = file.display();
    let text = std::fs::read(file).map_err(|error| format!("cannot read {shown}: {error}"))?;
    let record: Value = serde_json::from_slice(&text)
        .map_err(|error| format!("{shown} is not a run.json: {error}"))?;
    let program = record["program"].as_str().unwrap_or("nothing");
    if program != command.get_name() {
        return Err(format!("{shown} records a run of {program}"));
    }
    let recorded = record["arguments"].as_object();
    let recorded = recorded.ok_or_else(|| format!("{shown} has no arguments"))?;
    let mut words = Vec::new();
    for (id, value) in recorded {
        let value = value.as_str().unwrap_or_default();
        let argument = command.get_arguments().find(|a| a.get_id() == id.as_str());
        let argument = argument.ok_or_else(|| format!("{shown}: there is no option `{id}`"))?;
        words.extend(match argument.get_long() {
            Some(long) if argument.get_action().takes_values() => {
                Some(format!("--{long}={value}").into())
            }
            Some(long) => (value == "true").then(|| format!("--{long}").into()),
            None => Some(value.into()),
        });
    }
    if let Some(folder) = matches.get_one::<PathBuf>(OUTPUT) {
        words.push("--output".into());
        words.push(folder.into());
    }
    // Records of older versions have none.
    let inputs = match &record[INPUTS] {
        Value::Null => Vec::new(),
        inputs => serde_json::from_value(inputs.clone())
            .map_err(|error| format!("{shown}: `{INPUTS}` cannot be read: {error}"))?,
    };
    Ok((words, inputs))
}

/// Returns the values of all options of the program, as they would be written on a command line.
fn values(command: &Command, matches: &ArgMatches) -> Map<String, Value> {
    let mut values = Map::new();
    for argument in command.get_arguments() {
        let id = argument.get_id().as_str();
        if id == OUTPUT || id == REPEAT {
            continue;
        }
        if let Ok(Some(raw)) = matches.try_get_raw(id) {
            // One that is given several times takes lists, as it is written once.
            let all: Vec<_> = raw.map(|value| value.to_string_lossy()).collect();
            values.insert(id.to_owned(), all.join(",").into());
        }
    }
    values
}

/// Parses a width in millimetres, with or without the unit.
fn millimetres(text: &str) -> Result<f64, String> {
    number(66.0..=400.0, "mm")(text.trim_end_matches("mm"))
}

/// Iterates over the parts of a list that is separated by commas.
pub fn parts(text: &str) -> impl Iterator<Item = &str> {
    let parts = text.split(',').map(str::trim);
    parts.filter(|part| !part.is_empty())
}

/// Returns a parser of numbers within a range, whose messages name the unit.
pub fn number(
    range: RangeInclusive<f64>,
    unit: &'static str,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| match text.trim().parse::<f64>() {
        Ok(number) if range.contains(&number) => Ok(number),
        Ok(number) if number.is_finite() => Err(must_be(&range, unit)),
        _ => Err(format!("not a number; it {}", must_be(&range, unit))),
    }
}

/// Returns a parser of numbers and ranges of numbers, all within a range; the result is sorted.
pub fn numbers(
    range: RangeInclusive<f64>,
    unit: &'static str,
) -> impl Fn(&str) -> Result<Vec<f64>, String> + Clone + Send + Sync + 'static {
    move |text| {
        let gap = if unit.is_empty() { "" } else { " " };
        let mut all = Vec::new();
        for part in text.split(',') {
            for number in read_range(part)? {
                if !range.contains(&number) {
                    return Err(format!("{number} {}", must_be(&range, unit)));
                }
                if all.contains(&number) {
                    return Err(format!("{number}{gap}{unit} stand there twice"));
                }
                all.push(number);
            }
        }
        all.sort_by(f64::total_cmp);
        Ok(all)
    }
}

/// Most numbers of one range.
const MOST_NUMBERS: f64 = 10_000.0;

/// Parses a number, or the numbers of a range `FROM:TO:STEP`, both ends included.
fn read_range(part: &str) -> Result<Vec<f64>, String> {
    let read = |number: &str| match number.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!(
            "`{number}` is not a number; a range is written `FROM:TO:STEP`"
        )),
    };
    let numbers = part.split(':').map(read);
    let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
    let no_range = || {
        format!(
            "`{part}` is not a range: write `FROM:TO:STEP`, as in `40:48:0.1`, with at most \
             10000 steps from one end to the other"
        )
    };
    let [from, to, step] = *numbers else {
        return match *numbers {
            [number] => Ok(vec![number]),
            _ => Err(no_range()),
        };
    };
    // A step may miss the end by rounding.
    let steps = ((to - from) / step + 1e-9).floor();
    if !(0.0..MOST_NUMBERS).contains(&steps) {
        return Err(no_range());
    }
    // Decimals as they would be written: 40.3, not 40.300000000000004.
    let rounded = |number: f64| (number * 1e9).round() / 1e9;
    let numbers = (0..=steps as u32).map(f64::from);
    Ok(numbers
        .map(|number| rounded(from + number * step))
        .collect())
}

/// Describes a range, as in `must be from 0.1 to 1000 s`.
pub fn must_be(range: &RangeInclusive<f64>, unit: &str) -> String {
    let (low, high) = (plain(*range.start()), plain(*range.end()));
    let gap = if unit.is_empty() { "" } else { " " };
    format!("must be from {low} to {high}{gap}{unit}")
}

/// Formats a number, with an exponent if it is very small or large.
pub fn plain(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

/// Parses the command line of a test, without the program's name.
///
/// # Errors
/// The text that would be printed instead of a run.
pub fn parse_line<A: Arguments>(line: &str) -> Result<A, String> {
    let name = A::command().get_name().to_owned();
    let words = std::iter::once(name.as_str()).chain(line.split_whitespace());
    let parsed = parse(words.map(OsString::from));
    parsed
        .map(|line| line.arguments)
        .map_err(|error| error.to_string())
}
