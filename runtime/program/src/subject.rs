//! The tree that a command answers for: read from a file, or one of those that are shipped.

use std::io::Read;
use std::path::PathBuf;

use branched_pendulum::Positions;
use branched_pendulum::sectors::{Sector, Sectors};
use branched_pendulum::system::Model;
use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};

use crate::Failure;
use crate::constants::KnownConstants;
use crate::frame::Job;
use crate::frame::command_line::parts;
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
    /// constants of the tree: a table of names and values (JSON), as `identify` writes it, or the
    /// run.json of a run; `--set` wins over it. Offsets of links in it count where angles are read
    #[arg(long, value_name = "FILE")]
    pub parameters: Option<PathBuf>,
}

/// A tree with where it came from.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Name for titles: that of a shipped tree, or of the file.
    pub name: String,
    /// The description as it was read.
    pub text: String,
    /// The tree.
    pub tree: PendulumTree,
}

/// A description that was read, with the values that are given for its parameters.
#[derive(Clone, Debug)]
pub struct Described {
    /// Name for titles: that of a shipped tree, or of the file.
    pub name: String,
    /// The description as it was read.
    pub text: String,
    /// The description.
    pub description: TreeDescription,
    /// Values by `--set`.
    pub set: Vec<(String, f64)>,
    /// Values where none are set: of `--parameters`, and of a shipped tree.
    pub defaults: Vec<(String, f64)>,
    /// Offsets of links by `--parameters`, rad.
    pub offsets: Vec<(String, f64)>,
}

impl TreeArguments {
    /// Reads the tree.
    ///
    /// # Errors
    /// [`Failure::NoTree`] where there is no such file; [`Failure::Tree`] with all mistakes of the
    /// description, and for values that it has not or no pendulum can have;
    /// [`Failure::Parameters`].
    pub fn read(&self) -> Result<Subject, Failure> {
        self.described()?.read()
    }

    /// Reads the description, without a value for each of its parameters.
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

    /// Returns the description in `text`, in place of that of the tree, whose values are its own
    /// where none are set.
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
        let KnownConstants {
            values: mut defaults,
            offsets,
        } = known.transpose()?.unwrap_or_default();
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
                what: format!("`--set` gives `{name}` twice: name it once"),
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
    /// Returns the tree with the values that are known.
    ///
    /// # Errors
    /// As [`subject`](Self::subject).
    pub fn read(&self) -> Result<Subject, Failure> {
        self.subject(&self.known())
    }

    /// Returns the values that are known: those that are set, and others by default.
    pub fn known(&self) -> Vec<(&str, f64)> {
        let is_set = |name: &str| self.set.iter().any(|(own, _)| own == name);
        let others = self.defaults.iter().filter(|(name, _)| !is_set(name));
        let known = self.set.iter().chain(others);
        known.map(|(name, value)| (name.as_str(), *value)).collect()
    }

    /// Returns the tree with these values of its parameters.
    ///
    /// # Errors
    /// [`Failure::Tree`] for names that it has not, parameters without a value, and values that
    /// no pendulum can have.
    pub fn subject(&self, values: &[(&str, f64)]) -> Result<Subject, Failure> {
        let tree = self.description.tree(values);
        Ok(self.with_tree(tree.map_err(|source| self.refused(source))?))
    }

    /// Returns a tree of the description with its name.
    pub fn with_tree(&self, tree: PendulumTree) -> Subject {
        Subject {
            name: self.name.clone(),
            text: self.text.clone(),
            tree,
        }
    }

    /// Returns a mistake in what is asked of the tree, with its name.
    pub fn refused(&self, source: TreeError) -> Failure {
        Failure::tree(&self.name, source)
    }
}

impl Subject {
    /// Puts the description and the values of its parameters into the record of a run.
    pub fn record(&self, job: &Job) {
        self.record_with(job, Vec::new());
    }

    /// Puts the offsets of links into the record too, rad.
    pub fn record_with(&self, job: &Job, offsets: Vec<(String, f64)>) {
        let description = self.tree.description();
        let value = |name: &str| Some((name.to_owned(), self.tree.value(name)?));
        let values = description.parameters().filter_map(value).collect();
        job.report("description", self.text.as_str());
        job.report("parameters", KnownConstants { values, offsets }.table());
    }

    /// Returns the tree with another value of a parameter.
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
    /// [`Failure::NoLink`], with the names that there are.
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

    /// Returns the links that names mean which commas part, in their order.
    ///
    /// # Errors
    /// [`Failure::NoLink`].
    pub fn all_links_named(&self, names: &str) -> Result<Vec<usize>, Failure> {
        let links = names.split(',').map(|name| self.links_named(name.trim()));
        Ok(links.collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// Returns the copies nearest to the root; none for a tree without copies.
    pub fn first_copies(&self) -> Option<Vec<usize>> {
        let all = self.tree.sectors();
        let first = all.iter().find(|sector| sector.name() != "in_phase")?;
        let weights = first.coordinates().first()?.weights();
        // The differences of a set of copies follow each other; that of the last one has all.
        let is_wider = |sector: &&Sector| {
            let own = sector
                .coordinates()
                .first()
                .map_or(&[][..], |own| own.weights());
            weights
                .iter()
                .all(|(link, _)| own.iter().any(|(other, _)| other == link))
        };
        let widest = all
            .iter()
            .filter(is_wider)
            .filter_map(|sector| sector.coordinates().first());
        let widest = widest.filter(|own| own.weights().iter().any(|(_, weight)| *weight < 0.0));
        let links = widest
            .max_by_key(|own| own.weights().len())?
            .weights()
            .iter();
        Some(links.map(|(link, _)| *link).collect())
    }

    /// Returns the link that each hangs from; of the root none.
    pub fn parents(&self) -> Vec<Option<usize>> {
        let links = 0..self.tree.links();
        links
            .map(|link| self.tree.properties_of(link)?.parent)
            .collect()
    }
}

/// Reads `NAME=VALUE` and lists of these.
pub(crate) fn assignments(text: &str) -> Result<Vec<(String, f64)>, String> {
    let assignment = |part: &str| {
        let pair = part
            .split_once('=')
            .ok_or_else(|| format!("`{part}` is no `NAME=VALUE`"))?;
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
        let subject = Subject { name, text, tree };
        assert_eq!(subject.first_copies().unwrap(), [1, 2, 3]);
        let chain = TreeArguments {
            tree: "chain".to_owned(),
            set: Vec::new(),
            parameters: None,
        };
        assert_eq!(chain.read().unwrap().first_copies(), None);
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
        assert_eq!(subject.first_copies().unwrap(), [1, 2]);
        let error = subject.links_named("twig").unwrap_err().to_string();
        assert_eq!(
            error,
            "there is no link `twig`: the tree has parent, child_1, child_2"
        );
        assert_eq!(subject.tree.value("friction"), Some(1e-5));
    }
}
