//! Which links are computed together.

/// The number of links of every generation, and where each one starts; last,
/// where they end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape<'a> {
    pub(super) counts: &'a [usize],
    pub(super) starts: &'a [usize],
}

impl Shape<'_> {
    #[inline(always)]
    pub(super) fn count(&self, generation: usize) -> usize {
        self.counts.get(generation).copied().unwrap_or(0)
    }

    pub(super) fn start(&self, generation: usize) -> usize {
        self.starts.get(generation).copied().unwrap_or(0)
    }
}

/// Consecutive generations of the subtrees of neighbouring links.
///
/// A part has arrays of its own, in which its links stand as if there were no
/// others: first `width` neighbours of the generation `first`, then their
/// children, copy by copy, and so on. In every generation of the whole tree,
/// they are runs of `width` neighbours, `stride` apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'a> {
    pub(super) shape: Shape<'a>,
    /// The generations from `first` to before `end`.
    pub(super) first: usize,
    pub(super) end: usize,
    /// The first of the neighbours, counted in its generation.
    pub(super) start: usize,
    pub(super) width: usize,
}

/// Neighbours of a generation: where the first one stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) first: Place,
    /// How many there are.
    pub(super) length: usize,
    /// The first copy of the first one's children.
    pub(super) child: Place,
    /// How far the next copy is in the part's own arrays, and in the whole tree's.
    pub(super) next_own: usize,
    pub(super) next_whole: usize,
}

/// Where a link stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// In the part's own arrays of all links.
    pub(super) own: usize,
    /// In its arrays of links with children.
    pub(super) slot: usize,
    /// In arrays of the whole tree.
    pub(super) whole: usize,
}

impl Place {
    #[inline(always)]
    pub(super) fn plus(self, own: usize, whole: usize) -> Self {
        Self {
            own: self.own + own,
            slot: self.slot + own,
            whole: self.whole + whole,
        }
    }
}

/// In arrays of links with children, a generation starts where a register of any
/// width would, and has room for a whole one.
pub(super) const SLOTS: usize = 16;

impl Part<'_> {
    #[inline(always)]
    fn stride(&self) -> usize {
        self.shape.count(self.first).max(1)
    }

    #[inline(always)]
    fn is_whole(&self) -> bool {
        self.width == self.stride()
    }

    /// How far the links of the next part are, where this one is not the whole.
    #[inline(always)]
    pub(super) fn ahead(&self) -> Option<usize> {
        (!self.is_whole()).then_some(self.width)
    }

    /// Of so many links of the whole tree, those of the part.
    #[inline(always)]
    fn share(&self, links: usize) -> usize {
        match self.is_whole() {
            true => links,
            false => links / self.stride() * self.width,
        }
    }

    /// Number of the part's links in a generation.
    #[inline]
    pub(super) fn count(&self, generation: usize) -> usize {
        self.share(self.shape.count(generation))
    }

    /// The first link of a generation in the part's own arrays; of the one
    /// behind its last, their length.
    #[inline(always)]
    pub(super) fn own(&self, generation: usize) -> usize {
        self.share(
            self.shape
                .start(generation)
                .saturating_sub(self.shape.start(self.first)),
        )
    }

    /// The first link of a generation in the part's own arrays of links with
    /// children; of the one behind the last of these, their length.
    #[inline(always)]
    pub(super) fn slot(&self, generation: usize) -> usize {
        // A whole register more for each generation above.
        let above = generation.saturating_sub(self.first);
        self.own(generation).next_multiple_of(SLOTS) + above * SLOTS
    }

    /// Where the first link of a generation stands.
    #[inline(always)]
    pub(super) fn place(&self, generation: usize) -> Place {
        Place {
            own: self.own(generation),
            slot: self.slot(generation),
            whole: self.shape.start(generation) + self.start,
        }
    }

    /// Runs of neighbours in a generation.
    #[inline(always)]
    pub(super) fn runs(&self, generation: usize) -> impl Iterator<Item = Run> {
        let count = self.count(generation);
        let (length, runs) = match self.is_whole() {
            true => (count, 1),
            false => (self.width, count / self.width.max(1)),
        };
        let (first, child) = (self.place(generation), self.place(generation + 1));
        let (stride, next_whole) = (self.stride(), self.shape.count(generation));
        (0..runs).map(move |run| Run {
            first: first.plus(run * length, run * stride),
            length,
            child: child.plus(run * length, run * stride),
            next_own: count,
            next_whole,
        })
    }

    /// All links in spans of neighbours: where one starts in the part's own arrays
    /// and in the whole tree's, and how many there are. A whole tree is one.
    #[inline(always)]
    pub(super) fn spans(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let whole = self.is_whole().then(|| {
            let start = self.shape.start(self.first);
            (0, start, self.own(self.end))
        });
        let generations = match whole {
            Some(_) => self.end..self.end,
            None => self.first..self.end,
        };
        let runs = generations.flat_map(|generation| self.runs(generation));
        whole
            .into_iter()
            .chain(runs.map(|run| (run.first.own, run.first.whole, run.length)))
    }
}
