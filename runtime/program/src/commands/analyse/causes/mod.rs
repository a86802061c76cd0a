//! Usual causes of an energy budget that does not close: a table that must be interpreted
//! differently, or unknown friction.
//!
//! Each change of the interpretation is tried separately. If none closes the budget, those that
//! remove most of the gap are tried together with every other change.

mod change;
mod marks;
mod node;
mod readings;
mod unknowns;
mod unreadable;
mod words;

use branched_pendulum_data::Table;

pub use self::change::{Cause, Change, Kind};
use self::node::Node;
use self::readings::leaving_out;
pub use self::unreadable::with_remedy;
use super::arguments::Arguments;
use super::source::Source;
use super::subject::MeasuredTree;
use super::verdict::Verdict;
use super::wrong_pictures;
use crate::Failure;
use crate::frame::Progress;
use crate::measured_file::MeasuredLinks;

/// Number of interpretations that are combined with others, if none closes the budget alone.
const FIRSTS: usize = 6;
/// Number of interpretations without wrong pictures that are always combined with others.
const PICTURES: usize = 2;
/// Smallest fraction of the gap that a cause must remove to be mentioned if it does not close the
/// budget.
const MOST: f64 = 0.5;

/// Result of a search for causes of a gap in the energy budget.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CauseSearch {
    /// Causes that close the budget, the best one first.
    pub closing: Vec<Cause>,
    /// If no cause closes the budget: those that remove most of the gap, a single one and a pair.
    pub partial: Vec<Cause>,
    /// Kinds that were tried.
    pub tried: Vec<&'static str>,
    /// Time intervals of pictures that leap out of the motion, in s.
    pub leaps: Vec<[f64; 2]>,
}

impl CauseSearch {
    /// Returns true if the budget closes, or nearly closes, by another interpretation of the same
    /// rows.
    pub fn is_misread(&self) -> bool {
        const NEARLY: f64 = 0.9;
        let nearly = self.partial.iter().find(|cause| cause.share > NEARLY);
        let cause = self.closing.first().or(nearly);
        cause.is_some_and(|cause| cause.keeps_rows)
    }
}

/// A record whose energy budget does not close.
pub struct Unclosed<'a> {
    /// Command-line options with which the record was read and its motion estimated.
    pub arguments: &'a Arguments,
    /// The pendulum.
    pub subject: &'a MeasuredTree,
    /// The table.
    pub table: &'a Table,
    /// The links whose angles the table contains.
    pub hung: &'a MeasuredLinks,
    /// Reading of the record.
    pub source: &'a Source,
    /// The verdict.
    pub verdict: Verdict,
}

impl Unclosed<'_> {
    /// Tries the usual causes of the gap.
    ///
    /// # Errors
    /// [`Failure::Smoothing`] if the record, as it was read, cannot be smoothed.
    pub fn search(&self, progress: &Progress) -> Result<CauseSearch, Failure> {
        progress.begin("usual causes");
        let root = self.root()?;
        let mut search = CauseSearch::default();
        let wrong = wrong_pictures::stretches(&self.measured(&root), &[]);
        search.leaps = wrong.first().cloned().unwrap_or_default();
        let singles = self.tried(&root, &mut search.tried, progress);
        let mut closing = self.closing(&singles);
        let pairs = match closing.is_empty() {
            true => self.pairs(&root, &singles, progress),
            false => Vec::new(),
        };
        if closing.is_empty() {
            closing = self.closing(&pairs);
        }
        if closing.is_empty() {
            search.partial = self.partial(&root, [&singles, &pairs]);
        }
        search.closing = closing.iter().map(|node| cause(&root, node)).collect();
        Ok(search)
    }

    /// Returns the interpretations that result from one by each kind of change that it does not
    /// contain yet.
    fn tried(&self, node: &Node, kinds: &mut Vec<&'static str>, progress: &Progress) -> Vec<Node> {
        let mut changes = self.readings(node);
        changes.extend(self.tilt(node, false));
        let leaps = self.subject.leaps(node.source.record());
        let wrong = wrong_pictures::stretches(&self.measured(node), &leaps.unwrap_or_default());
        changes.extend(wrong.into_iter().map(|stretches| {
            let words = format!(
                "pictures with wrong or swapped markers are left out {}",
                stretches_in_words(&stretches)
            );
            leaving_out(&node.file, Kind::Pictures, words, &stretches)
        }));
        changes.retain(|change| !node.has(change.kind));
        let mut found = Vec::new();
        let count = changes.len();
        for (index, change) in changes.into_iter().enumerate() {
            let kind = change.kind.words();
            progress.show_message(&format!("{kind} ({} of {count})", index + 1));
            let Some(changed) = self.changed(node, change) else {
                continue;
            };
            if !kinds.contains(&kind) {
                kinds.push(kind);
            }
            found.extend(changed);
        }
        // The equations of motion find friction with the motion.
        if !self.arguments.model && !node.has(Kind::Friction) {
            if !kinds.contains(&Kind::Friction.words()) {
                kinds.push(Kind::Friction.words());
            }
            found.extend(self.with_friction(node));
        }
        found
    }

    /// Combines each of the interpretations that remove most of the gap with every other change,
    /// and returns these combinations.
    fn pairs(&self, root: &Node, singles: &[Node], progress: &Progress) -> Vec<Node> {
        let mut firsts: Vec<&Node> = singles
            .iter()
            .filter(|node| !node.has(Kind::Friction) && self.would_exceed(node))
            .collect();
        firsts.sort_by(|one, other| one.gap().total_cmp(&other.gap()));
        firsts.truncate(FIRSTS);
        // Marks of lost dots and leaps are evidence by themselves, however small a part of the gap
        // they cause. Before they are left out, a tilt or friction that is found is wrong.
        for (kind, most) in [(Kind::Lost, 1), (Kind::Pictures, PICTURES)] {
            let own = singles.iter().filter(|node| node.has(kind));
            let mut own: Vec<&Node> = own.collect();
            own.sort_by(|one, other| one.gap().total_cmp(&other.gap()));
            own.truncate(most);
            own.retain(|node| firsts.iter().all(|first| first.file != node.file));
            firsts.extend(own);
        }
        let mut pairs = Vec::new();
        for first in firsts {
            for pair in self.tried(first, &mut Vec::new(), progress) {
                let is_new = pairs.iter().all(|own: &Node| {
                    own.file != pair.file || own.has(Kind::Friction) != pair.has(Kind::Friction)
                });
                if is_new && pair.file != root.file {
                    pairs.push(pair);
                }
            }
        }
        // A tilt that is found without the friction that is lacking is wrong.
        let tilted = self.tilt(root, true);
        let tilted = tilted
            .and_then(|change| self.changed(root, change))
            .flatten();
        if !self.arguments.model {
            pairs.extend(tilted.and_then(|tilted| self.with_friction(&tilted)));
        }
        // The change that takes more of the gap comes first.
        let alone = |change: &Change| {
            let own = singles
                .iter()
                .filter(|node| node.changes[0].kind == change.kind);
            own.map(Node::gap).fold(f64::INFINITY, f64::min)
        };
        for pair in &mut pairs {
            pair.changes
                .sort_by(|one, other| alone(one).total_cmp(&alone(other)));
        }
        pairs
    }

    /// Returns true if a gap as large as that of the record would exceed the standard deviations of
    /// another interpretation: at most of the times at which it exceeds its own, or by far where
    /// it is large.
    fn would_exceed(&self, node: &Node) -> bool {
        const FAR: f64 = 2.0;
        let (own, other) = (&self.verdict, &node.verdict);
        if node.changes.iter().any(|change| change.kind.leaves_out()) {
            return 2.0 * other.trust.closure < own.trust.closure;
        }
        let pairs = own.closure.iter().zip(&other.closure).skip(1);
        let reported = pairs.filter(|([gap, deviation], _)| gap.abs() > own.allowed * deviation);
        let by_other = reported
            .clone()
            .filter(|([gap, _], [_, deviation])| gap.abs() > other.allowed * deviation);
        let by_far = reported
            .clone()
            .any(|([gap, _], [_, deviation])| gap.abs() > FAR * other.allowed * deviation);
        by_far || 2 * by_other.count() > reported.count()
    }
}

impl Unclosed<'_> {
    /// Returns the interpretations that close the budget, the best one first.
    fn closing<'n>(&self, nodes: &'n [Node]) -> Vec<&'n Node> {
        let mut closing: Vec<&Node> = nodes
            .iter()
            .filter(|node| node.verdict.closes() && self.would_exceed(node))
            .collect();
        // Readings that leave lost dots in are less likely, if there are any. Equations of motion also
        // find friction and smaller error bars: they come behind readings that do without.
        closing.sort_by(|one, other| {
            let [one_key, other_key] =
                [one, other].map(|node| (!node.has(Kind::Lost), node.needs_model));
            let bars = one.verdict.bars.total_cmp(&other.verdict.bars);
            one_key.cmp(&other_key).then(bars)
        });
        closing
    }

    /// Returns from each list the interpretation that removes most of the gap; from the second list
    /// only if it removes more.
    fn partial(&self, root: &Node, lists: [&[Node]; 2]) -> Vec<Cause> {
        let mut found: Vec<Cause> = Vec::new();
        for nodes in lists {
            let reported = nodes.iter().filter(|node| self.would_exceed(node));
            let best = reported.min_by(|one, other| one.gap().total_cmp(&other.gap()));
            let cause = best.map(|node| cause(root, node));
            let least = found.last().map_or(MOST, |before| before.share);
            found.extend(cause.filter(|cause| cause.share > least));
        }
        found
    }
}

/// Returns the cause that an interpretation reveals.
fn cause(root: &Node, node: &Node) -> Cause {
    let share = 1.0 - node.gap() / root.gap();
    Cause::of(&node.changes, node.needs_model, share)
}

/// Stretches of time in words.
pub fn stretches_in_words(stretches: &[[f64; 2]]) -> String {
    let each = stretches
        .iter()
        .map(|[from, to]| format!("from {from} s to {to} s"));
    each.collect::<Vec<_>>().join(", ")
}
