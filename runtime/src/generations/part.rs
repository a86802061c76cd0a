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

/// Neighbours of a generation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// The first one in the part's own arrays.
    pub(super) own: usize,
    /// The first one in arrays of the whole tree.
    pub(super) whole: usize,
    /// How many there are.
    pub(super) length: usize,
    /// Their first copy of children, likewise, and how far the next copy is.
    pub(super) child_own: usize,
    pub(super) child_whole: usize,
    pub(super) next_own: usize,
    pub(super) next_whole: usize,
}

impl Part<'_> {
    #[inline(always)]
    fn stride(&self) -> usize {
        self.shape.count(self.first).max(1)
    }

    #[inline(always)]
    fn is_whole(&self) -> bool {
        self.width == self.stride()
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

    /// Runs of neighbours in a generation, whose first link stands at `own`.
    #[inline(always)]
    pub(super) fn runs(&self, generation: usize, own: usize) -> impl Iterator<Item = Run> {
        let count = self.count(generation);
        let (length, runs) = match self.is_whole() {
            true => (count, 1),
            false => (self.width, count / self.width.max(1)),
        };
        let (stride, start) = (self.stride(), self.start);
        let whole = self.shape.start(generation);
        let child = self.shape.start(generation + 1);
        let next_whole = self.shape.count(generation);
        (0..runs).map(move |run| Run {
            own: own + run * length,
            whole: whole + start + run * stride,
            length,
            child_own: own + count + run * length,
            child_whole: child + start + run * stride,
            next_own: count,
            next_whole,
        })
    }

    /// All links as runs. Those of a whole tree are neighbours.
    #[inline(always)]
    pub(super) fn all(&self) -> impl Iterator<Item = Run> {
        let whole = self.is_whole().then(|| Run {
            own: 0,
            whole: self.shape.start(self.first),
            length: self.own(self.end),
            child_own: 0,
            child_whole: 0,
            next_own: 0,
            next_whole: 0,
        });
        let parts = match whole {
            Some(_) => self.end..self.end,
            None => self.first..self.end,
        };
        let single = parts.flat_map(|generation| self.runs(generation, self.own(generation)));
        whole.into_iter().chain(single)
    }
}
