//! Computes the sines, cosines and joint motions that the equations use, before the recursion.

use super::block::SubtreeBlock;
use super::columns::{Columns, load_front};
use super::generation::Generation;
use super::prefetch::prefetch;
use super::shared::Shared;
use super::sweep::Sweep;
use crate::scalar::Scalar;
use crate::simd::{Kernel, Simd};

/// Input of the computation of sines, cosines and joint motions of a block.
pub(super) struct Motions<'a, 'b, T> {
    pub(super) sweep: &'a mut Sweep<'b, T, T>,
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    /// External torques on the links, if there are any.
    pub(super) torques: Option<&'a [T]>,
    /// Flags of prescribed links (1 or 0), if there are any.
    pub(super) prescribed: Option<&'a [T]>,
    /// Destination of the accelerations, if they are written directly after the upward pass.
    pub(super) alpha: Option<Shared<'a, T>>,
}

impl<T: Scalar> Kernel<T> for Motions<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        let Sweep { block, storage, .. } = self.sweep;
        for (own, whole, length) in block.spans() {
            let (start, rows) = (storage.lead + own, length.max(V::LANES));
            let span = Span {
                theta: self.theta.get(whole..whole + length).unwrap_or_default(),
                omega: self.omega.get(whole..whole + length).unwrap_or_default(),
                sincos: storage.sincos.window(start, rows),
                velocities: storage
                    .velocities
                    .and_then(|column| column.window(start, rows)),
                torques: CallerColumn::of(
                    storage.sizes.forced.then_some(storage.torques),
                    self.torques,
                    [whole, start, rows],
                ),
                prescribed: CallerColumn::of(
                    storage.sizes.prescribed.then_some(storage.prescribed),
                    self.prescribed,
                    [whole, start, rows],
                ),
                ahead: block.ahead(),
                alpha: self.alpha.and_then(|alpha| alpha.from(whole)),
            };
            let _ = span.form::<V>();
        }
    }
}

/// A span of neighbouring links.
struct Span<'a, T> {
    theta: &'a [T],
    omega: &'a [T],
    sincos: Option<Columns<'a, T, 2>>,
    velocities: Option<Columns<'a, T, 1>>,
    /// External torques on the links, if the equations use them.
    torques: Option<CallerColumn<'a, T>>,
    /// Flags of prescribed links (1 or 0), if the equations use them.
    prescribed: Option<CallerColumn<'a, T>>,
    /// Distance to the links that are computed next, whose numbers are prefetched.
    ahead: Option<usize>,
    /// Destination of the accelerations, if they are written directly afterwards.
    alpha: Option<Shared<'a, T>>,
}

/// Numbers of the caller, and the column to which they are copied for the equations.
struct CallerColumn<'a, T> {
    column: Columns<'a, T, 1>,
    /// The caller's numbers; `None` means that all are zero.
    values: Option<&'a [T]>,
}

impl<'a, T: Scalar> CallerColumn<'a, T> {
    /// Selects the numbers of `rows` neighbouring links: from index `whole` on in the caller's
    /// slice, and from index `start` on in the column.
    #[inline(always)]
    fn of(
        column: Option<Columns<'a, T, 1>>,
        values: Option<&'a [T]>,
        [whole, start, rows]: [usize; 3],
    ) -> Option<Self> {
        Some(Self {
            column: column?.window(start, rows)?,
            values: values.map(|values| values.get(whole..).unwrap_or_default()),
        })
    }

    #[inline(always)]
    fn store<V: Simd<T>>(&self, place: usize) -> Option<()> {
        let value = match self.values {
            Some(values) => load_front(values, place),
            None => V::from_f64(0.0),
        };
        self.column.store::<V, 1>(place, &[value])
    }
}

impl<T: Scalar> Span<'_, T> {
    /// Computes sines and cosines, two vectors at a time: while one waits for a result, the other
    /// keeps the processor busy. The last vectors overlap those before.
    #[inline(always)]
    fn form<V: Simd<T>>(self) -> Option<()> {
        let (sincos, count) = (self.sincos?, self.theta.len());
        let last = count.saturating_sub(V::LANES);
        let mut index = 0;
        while index < count {
            let places = [index.min(last), (index + V::LANES).min(last)];
            let angles: [V; 2] = places.map(|place| load_front(self.theta, place));
            let (sines, cosines) = V::sin_cos_each(&angles);
            for i in 0..2 {
                sincos.store(places[i], &[sines[i], cosines[i]])?;
                if let Some(velocities) = self.velocities {
                    velocities.store::<V, 1>(places[i], &[load_front(self.omega, places[i])])?;
                }
                if let Some(torques) = &self.torques {
                    torques.store::<V>(places[i])?;
                    if let Some(prescribed) = &self.prescribed {
                        prescribed.store::<V>(places[i])?;
                    }
                }
                if let Some(ahead) = self.ahead {
                    let next = places[i] + ahead;
                    prefetch(self.theta.as_ptr().wrapping_add(next));
                    prefetch(self.omega.as_ptr().wrapping_add(next));
                    if let Some(alpha) = self.alpha {
                        alpha.prefetch(next);
                    }
                }
            }
            index += 2 * V::LANES;
        }
        Some(())
    }
}

/// Computes joint angles and rates of a block. For a tree of any shape, `parents` holds the
/// position of each link's parent; otherwise it is empty.
pub(super) fn joint_motions<T: Scalar>(
    sweep: &mut Sweep<'_, T, T>,
    parents: &[u32],
    theta: impl Fn(usize) -> T,
    omega: impl Fn(usize) -> T,
) {
    let (storage, mut links) = (&sweep.storage, Links::of(sweep.block));
    while let Some(link) = links.next() {
        let (mut angle, mut rate) = (theta(link.place), omega(link.place));
        if let Some(parent) = link.parent(parents) {
            angle = angle - theta(parent);
            rate = rate - omega(parent);
        }
        let _ = storage
            .joint_motions
            .store(storage.lead + link.own, &[angle, rate]);
    }
}

/// Position of a link: its index in the block, in the tree, and in its generation.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkPosition {
    pub(super) own: usize,
    pub(super) place: usize,
    number: usize,
    above: Option<(usize, usize)>,
}

impl LinkPosition {
    /// Returns the index of the link's parent; `None` for the root. For a tree of any shape,
    /// `parents` holds the parents of all links.
    #[inline(always)]
    pub(super) fn parent(&self, parents: &[u32]) -> Option<usize> {
        match self.above {
            Some((above, count)) => Some(above + self.number % count.max(1)),
            None if self.place > 0 => parents.get(self.place).map(|&parent| parent as usize),
            None => None,
        }
    }
}

/// Iterator over the links of a block, span by span.
pub(super) struct Links<'a> {
    generations: &'a [Generation],
    start: usize,
    span: usize,
    index: usize,
}

impl<'a> Links<'a> {
    #[inline(always)]
    pub(super) fn of(block: SubtreeBlock<'a>) -> Self {
        Self {
            generations: block.own_generations(),
            start: block.start,
            span: 0,
            index: 0,
        }
    }

    #[inline(always)]
    pub(super) fn next(&mut self) -> Option<LinkPosition> {
        let generation = self.generations.first()?;
        let own = generation.own + self.span * generation.length + self.index;
        let within = self.span * generation.stride + self.index * generation.step;
        let number = self.start + within;
        let link = LinkPosition {
            own,
            place: generation.whole + number,
            number,
            above: generation.above,
        };
        self.index += 1;
        if self.index >= generation.length {
            (self.index, self.span) = (0, self.span + 1);
            if self.span >= generation.strips {
                self.span = 0;
                self.generations = self.generations.get(1..).unwrap_or_default();
            }
        }
        Some(link)
    }
}
