//! Which links are computed together.

use super::runs::Runs;

/// The neighbours of one generation in a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stage {
    /// Copies of this generation under each link of the one before.
    pub(super) copies: usize,
    /// How many links there are, and in the whole tree.
    pub(super) count: usize,
    pub(super) whole_count: usize,
    /// Where the first one stands in the part's arrays of all links, and in those
    /// of links with children.
    pub(super) own: usize,
    pub(super) slot: usize,
    /// Where the generation starts in the whole tree.
    pub(super) whole: usize,
    /// There they are so many runs of neighbours of this length, ...
    pub(super) runs: usize,
    pub(super) length: usize,
    /// ... so far apart.
    pub(super) stride: usize,
    /// Where the generation before starts in the whole tree; none for the root.
    pub(super) above: Option<usize>,
}

/// In arrays of links with children, a generation starts where a register of any
/// width would, and has room for a whole one.
pub(super) const SLOTS: usize = 16;

/// The stages of `width` neighbours in the first of some generations, and of their
/// children, copy by copy, and so on.
///
/// A part has arrays of its own, in which its links stand as if there were no
/// others.
pub(super) fn stages(
    copies: &[usize],
    starts: &[usize],
    counts: &[usize],
    first: usize,
    width: usize,
) -> impl Iterator<Item = Stage> {
    let stride = counts.get(first).copied().unwrap_or(1).max(1);
    let (mut own, mut slot) = (0, 0);
    let rows = copies.iter().zip(starts).zip(counts).enumerate();
    rows.skip(first)
        .map(move |(generation, ((&copies, &whole), &whole_count))| {
            let count = whole_count / stride * width;
            let is_whole = width == stride;
            let stage = Stage {
                copies,
                count,
                whole_count,
                own,
                slot,
                whole,
                runs: if is_whole { 1 } else { count / width.max(1) },
                length: if is_whole { count } else { width },
                stride,
                above: generation
                    .checked_sub(1)
                    .and_then(|above| starts.get(above).copied()),
            };
            own += count;
            slot += count.next_multiple_of(SLOTS);
            stage
        })
}

/// Consecutive generations of the subtrees of neighbouring links.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'a> {
    /// The generations, and where the last one's links have children, these.
    pub(super) stages: &'a [Stage],
    /// How many generations have children.
    pub(super) inner: usize,
    /// Whether there is one more, of leaves.
    pub(super) has_leaves: bool,
    /// The first of the neighbours, counted in its generation.
    pub(super) start: usize,
    pub(super) width: usize,
    /// Whether its results are written once it has gone up.
    pub(super) ends: bool,
    /// Its links with children.
    pub(super) runs: &'a Runs,
}

/// Neighbours of a generation: where the first one stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// In the part's own arrays of all links.
    pub(super) own: usize,
    /// In its arrays of links with children.
    pub(super) slot: usize,
    /// In arrays of the whole tree.
    pub(super) whole: usize,
}

impl Part<'_> {
    /// The generations whose links are computed here.
    pub(super) fn own_stages(&self) -> &[Stage] {
        let count = self.inner + usize::from(self.has_leaves);
        self.stages.get(..count).unwrap_or_default()
    }

    /// Number of links.
    pub(super) fn links(&self) -> usize {
        let last = self.own_stages().last();
        last.map_or(0, |last| last.own + last.count)
    }

    /// How many places links with children take, with those of children that are
    /// not computed here.
    pub(super) fn slots(&self) -> usize {
        let count = self.stages.len() - usize::from(self.has_leaves);
        let last = self.stages.get(..count).and_then(<[Stage]>::last);
        last.map_or(0, |last| last.slot + last.count.next_multiple_of(SLOTS))
    }

    /// Whether it takes all links of its generations.
    #[inline(always)]
    pub(super) fn is_whole(&self) -> bool {
        let first = self.stages.first();
        first.is_none_or(|first| first.stride == self.width)
    }

    /// How far the links of the next part are, where this one is not the whole.
    #[inline(always)]
    pub(super) fn ahead(&self) -> Option<usize> {
        (!self.is_whole()).then_some(self.width)
    }

    /// Where the first link of a run stands.
    #[inline(always)]
    pub(super) fn place(&self, stage: &Stage, run: usize) -> Place {
        let own = run * stage.length;
        Place {
            own: stage.own + own,
            slot: stage.slot + own,
            whole: stage.whole + self.start + run * stage.stride,
        }
    }

    /// All links in spans of neighbours: where one starts in the part's own arrays
    /// and in the whole tree's, and how many there are. A whole tree is one.
    #[inline(always)]
    pub(super) fn spans(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let whole = self.is_whole();
        let stages = match whole {
            true => self.stages.get(..1).unwrap_or_default(),
            false => self.own_stages(),
        };
        let links = self.links();
        stages.iter().flat_map(move |stage| {
            (0..stage.runs).map(move |run| {
                let Place { own, whole: at, .. } = self.place(stage, run);
                (own, at, if whole { links } else { stage.length })
            })
        })
    }
}
