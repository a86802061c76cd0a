//! The tree of a command: read from a file, or shipped with the program.

use std::io::Read;
use std::path::PathBuf;

use branched_pendulum::Positions;
use branched_pendulum::system::Model;
use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};

use crate::Failure;
use crate::constants::KnownConstants;
use crate::frame::command_line::parts;
use crate::frame::{Input, Job};
use crate::shipped::{self, SHIPPED, Shipped};

/// Options that name a tree.
#[derive(Clone, Debug, clap::Args, PartialEq)]
pub struct TreeArguments {
    /// The tree.
    #[arg(
        long,
        value_name = "FILE|NAME",
        default_value = "paper",
        help = format!(
            "the tree: a text file with its description, `-` for standard input, or a shipped one:\n{}",
            shipped::names()
        )
    )]
    pub tree: String,
    /// values of parameters of the description, in SI units
    #[arg(long, value_name = "NAME=VALUE[,..]", value_parser = assignments)]
    // By its full path, clap takes each for one value.
    pub set: Vec<::std::vec::Vec<(String, f64)>>,
    /// file with constants of the tree: a table of names and values (JSON), as written by
    /// `identify`, or the run.json of a run. Values by `--set` take precedence. Offsets of links in
    /// it apply where angles are read
    #[arg(long, value_name = "FILE")]
    pub parameters: Option<PathBuf>,
}

/// A tree, with the description and files that it comes from.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Name for titles: the name of the shipped tree or of the file.
    pub name: String,
    /// Text of the description as it was read.
    pub text: String,
    /// The tree.
    pub tree: PendulumTree,
    /// Files that were read to create the tree.
    pub inputs: Vec<Input>,
}

/// A description that was read, with the given values of its parameters.
#[derive(Clone, Debug)]
pub struct Described {
    /// Name for titles: the name of the shipped tree or of the file.
    pub name: String,
    /// Text of the description as it was read.
    pub text: String,
    /// The description.
    pub description: TreeDescription,
    /// Values by `--set`.
    pub set: Vec<(String, f64)>,
    /// Default values: those of `--parameters`, and those of a shipped tree.
    pub defaults: Vec<(String, f64)>,
    /// Offsets of the links' angles from `--parameters`, in rad.
    pub offsets: Vec<(String, f64)>,
    /// Files that were read to create the tree.
    pub inputs: Vec<Input>,
}

impl TreeArguments {
    /// Reads the tree.
    ///
    /// # Errors
    /// [`Failure::NoTree`] if there is no such file or shipped tree; [`Failure::Tree`] with all
    /// mistakes of the description, for unknown parameters and for values that are not physical;
    /// [`Failure::Parameters`].
    pub fn read(&self) -> Result<Subject, Failure> {
        self.described()?.read()
    }

    /// Reads the description; parameters may remain without values.
    ///
    /// # Errors
    /// [`Failure::NoTree`], [`Failure::Parameters`], and [`Failure::Tree`] with all mistakes of the
    /// description.
    pub fn described(&self) -> Result<Described, Failure> {
        let text = match self.shipped() {
            Some(shipped) => shipped.text.to_owned(),
            None => self.text()?,
        };
        self.described_as(text)
    }

    fn shipped(&self) -> Option<&'static Shipped> {
        SHIPPED.iter().find(|shipped| shipped.name == self.tree)
    }

    /// Returns the description `text` instead of the tree's own; parameters that are not set have
    /// the tree's default values.
    ///
    /// # Errors
    /// [`Failure::Parameters`], and [`Failure::Tree`] with all mistakes of the description.
    pub fn described_as(&self, text: String) -> Result<Described, Failure> {
        let shipped = self.shipped();
        let shipped = shipped.map_or([].as_slice(), |shipped| shipped.values);
        let description = TreeDescription::parse(&text);
        let description =
            description.map_err(|error| Failure::tree(&self.tree, TreeError::from(error)))?;
        let known = self.parameters.as_deref();
        let known = known.map(|path| KnownConstants::read(path, &description));
        let known = known.transpose()?.unwrap_or_default();
        let mut inputs = vec![Input::of_text(&self.tree, &text)];
        inputs.extend(self.parameters.as_deref().map(|path| known.input(path)));
        let KnownConstants {
            values: mut defaults,
            offsets,
        } = known;
        for &(name, value) in shipped {
            if defaults.iter().all(|(own, _)| own != name) {
                defaults.push((name.to_owned(), value));
            }
        }
        let set = self.set.concat();
        let is_again = |(place, (name, _)): &(usize, &(String, f64))| {
            set.iter().take(*place).any(|(other, _)| other == name)
        };
        if let Some((_, (name, _))) = set.iter().enumerate().find(is_again) {
            return Err(Failure::Lacking {
                what: format!("`--set` gives `{name}` twice: give it once"),
            });
        }
        let name = match std::path::Path::new(&self.tree).file_name() {
            Some(name) => name.to_string_lossy().into_owned(),
            None => self.tree.clone(),
        };
        Ok(Described {
            name,
            text,
            description,
            set,
            defaults,
            offsets,
            inputs,
        })
    }

    fn text(&self) -> Result<String, Failure> {
        let mut text = String::new();
        let read = match self.tree.as_str() {
            "-" => std::io::stdin().read_to_string(&mut text).map(|_| text),
            path => std::fs::read_to_string(path),
        };
        read.map_err(|source| Failure::NoTree {
            name: self.tree.clone(),
            shipped: shipped::names(),
            source,
        })
    }
}

impl Described {
    /// Records the files that were read for the description as inputs of the run.
    ///
    /// # Errors
    /// [`Failure::Changed`] if the run repeats another one that read a different content.
    pub fn note(&self, job: &Job) -> Result<(), Failure> {
        note(&self.inputs, job)
    }

    /// Returns the tree with the known values of its parameters.
    ///
    /// # Errors
    /// As [`subject`](Self::subject).
    pub fn read(&self) -> Result<Subject, Failure> {
        self.subject(&self.known())
    }

    /// Returns the known values of the parameters: those that are set, and default values for
    /// others.
    pub fn known(&self) -> Vec<(&str, f64)> {
        let is_set = |name: &str| self.set.iter().any(|(own, _)| own == name);
        let others = self.defaults.iter().filter(|(name, _)| !is_set(name));
        let known = self.set.iter().chain(others);
        known.map(|(name, value)| (name.as_str(), *value)).collect()
    }

    /// Returns the tree for these values of its parameters.
    ///
    /// # Errors
    /// [`Failure::Tree`] for unknown parameters, parameters without a value, and values that are
    /// not physical.
    pub fn subject(&self, values: &[(&str, f64)]) -> Result<Subject, Failure> {
        let tree = self.description.tree(values);
        Ok(self.with_tree(tree.map_err(|source| self.refused(source))?))
    }

    /// Returns a copy of this subject with another tree, and the same name, text and input files.
    pub fn with_tree(&self, tree: PendulumTree) -> Subject {
        Subject {
            name: self.name.clone(),
            text: self.text.clone(),
            tree,
            inputs: self.inputs.clone(),
        }
    }

    /// Returns the error that the tree does not support a request, with the tree's name.
    pub fn refused(&self, source: TreeError) -> Failure {
        Failure::tree(&self.name, source)
    }
}

/// Records files as inputs of a run.
fn note(inputs: &[Input], job: &Job) -> Result<(), Failure> {
    inputs.iter().try_for_each(|input| job.input(input.clone()))
}

impl Subject {
    /// Writes the description, the values of its parameters and the files that were read to the
    /// record of a run.
    ///
    /// # Errors
    /// [`Failure::Changed`] if the run repeats another one that read a different content.
    pub fn record(&self, job: &Job) -> Result<(), Failure> {
        self.record_with(job, Vec::new())
    }

    /// Also writes the offsets of the links' angles (rad) to the record of a run.
    ///
    /// # Errors
    /// As [`record`](Self::record).
    pub fn record_with(&self, job: &Job, offsets: Vec<(String, f64)>) -> Result<(), Failure> {
        note(&self.inputs, job)?;
        let description = self.tree.description();
        let value = |name: &str| Some((name.to_owned(), self.tree.value(name)?));
        let values = description.parameters().filter_map(value).collect();
        job.report("description", self.text.as_str());
        job.report("parameters", KnownConstants { values, offsets }.table());
        Ok(())
    }

    /// Returns the same tree with another value of one parameter.
    ///
    /// # Errors
    /// [`Failure::Tree`].
    pub fn with(&self, name: &str, value: f64) -> Result<PendulumTree, Failure> {
        let with = self.tree.with(name, value);
        with.map_err(|source| Failure::tree(&self.name, source))
    }

    /// Returns the links that `name` means: the link of that name, or all copies of it, whose
    /// names end with numbers.
    ///
    /// # Errors
    /// [`Failure::NoLink`], with the names of all links.
    pub fn links_named(&self, name: &str) -> Result<Vec<usize>, Failure> {
        let names = self.tree.names();
        if let Some(link) = names.iter().position(|own| own == name) {
            return Ok(vec![link]);
        }
        let is_copy = |own: &String| {
            let rest = own
                .strip_prefix(name)
                .and_then(|rest| rest.strip_prefix('_'));
            rest.is_some_and(|rest| rest.chars().all(|c| c == '_' || c.is_ascii_digit()))
        };
        let copies: Vec<usize> = (0..names.len())
            .filter(|&link| is_copy(&names[link]))
            .collect();
        match copies.is_empty() {
            false => Ok(copies),
            true => Err(Failure::NoLink {
                name: name.to_owned(),
                links: names.join(", "),
            }),
        }
    }

    /// Returns the links for a list of names, separated by commas, in order.
    ///
    /// # Errors
    /// [`Failure::NoLink`].
    pub fn all_links_named(&self, names: &str) -> Result<Vec<usize>, Failure> {
        let links = names.split(',').map(|name| self.links_named(name.trim()));
        Ok(links.collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// Returns the link that each hangs from; of the root none.
    pub fn parents(&self) -> Vec<Option<usize>> {
        let links = 0..self.tree.links();
        links
            .map(|link| self.tree.properties_of(link)?.parent)
            .collect()
    }
}

/// Parses `NAME=VALUE`, or a list of such assignments.
pub(crate) fn assignments(text: &str) -> Result<Vec<(String, f64)>, String> {
    let assignment = |part: &str| {
        let pair = part
            .split_once('=')
            .ok_or_else(|| format!("`{part}` is not `NAME=VALUE`"))?;
        let value = pair
            .1
            .trim()
            .parse::<f64>()
            .ok()
            .filter(|value| value.is_finite());
        let value = value.ok_or_else(|| format!("`{}` is not a number", pair.1))?;
        Ok((pair.0.trim().to_owned(), value))
    };
    parts(text).map(assignment).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shipped_trees_are_trees() {
        for shipped in &SHIPPED {
            let arguments = TreeArguments {
                tree: shipped.name.to_owned(),
                set: Vec::new(),
                parameters: None,
            };
            let subject = arguments.read().unwrap();
            assert_eq!(subject.parents().iter().filter(|p| p.is_none()).count(), 1);
        }
    }

    #[test]
    fn all_copies_of_the_first_set_are_found() {
        let text = "gravity = 9.81, stem: rod(mass = 1, length = 1) [
            twig: rod(mass = 0.1, length = 0.5) * 3, stone: rod(mass = 0.3, length = 0.1)
        ]";
        let tree = PendulumTree::parse(text).unwrap();
        let (name, text) = (String::new(), String::new());
        let subject = Subject {
            name,
            text,
            tree,
            inputs: Vec::new(),
        };
        assert_eq!(subject.tree.first_copies().unwrap(), [1, 2, 3]);
        let chain = TreeArguments {
            tree: "chain".to_owned(),
            set: Vec::new(),
            parameters: None,
        };
        assert_eq!(chain.read().unwrap().tree.first_copies(), None);
    }

    #[test]
    fn copies_are_named_together() {
        let arguments = TreeArguments {
            tree: "paper".to_owned(),
            set: vec![assignments("friction=1e-5").unwrap()],
            parameters: None,
        };
        let subject = arguments.read().unwrap();
        assert_eq!(subject.links_named("child").unwrap(), [1, 2]);
        assert_eq!(subject.links_named("child_2").unwrap(), [2]);
        assert_eq!(subject.tree.first_copies().unwrap(), [1, 2]);
        let error = subject.links_named("twig").unwrap_err().to_string();
        assert_eq!(
            error,
            "there is no link `twig`: the tree has parent, child_1, child_2"
        );
        assert_eq!(subject.tree.value("friction"), Some(1e-5));
    }
}
