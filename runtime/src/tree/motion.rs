//! Sines, cosines and joint motions that equations read, formed before the recursion.

use super::block::SubtreeBlock;
use super::columns::{Columns, load_front};
use super::generation::Generation;
use super::prefetch::prefetch;
use super::shared::Shared;
use super::sweep::Sweep;
use crate::scalar::Scalar;
use crate::simd::{Kernel, Simd};

/// Sines and cosines of a block's angles, and its velocities.
pub(super) struct Motions<'a, 'b, T> {
    pub(super) sweep: &'a mut Sweep<'b, T, T>,
    pub(super) theta: &'a [T],
    pub(super) omega: &'a [T],
    /// Torques from outside; none where there are none.
    pub(super) torques: Option<&'a [T]>,
    /// Which links are held; none where none is.
    pub(super) held: Option<&'a [T]>,
    /// Where results are written once the block has gone up.
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
                torques: Given::of(
                    storage.sizes.forced.then_some(storage.torques),
                    self.torques,
                    [whole, start, rows],
                ),
                held: Given::of(
                    storage.sizes.held.then_some(storage.held),
                    self.held,
                    [whole, start, rows],
                ),
                ahead: block.ahead(),
                alpha: self.alpha.and_then(|alpha| alpha.from(whole)),
            };
            let _ = span.form::<V>();
        }
    }
}

/// Neighbours.
struct Span<'a, T> {
    theta: &'a [T],
    omega: &'a [T],
    sincos: Option<Columns<'a, T, 2>>,
    velocities: Option<Columns<'a, T, 1>>,
    /// Torques from outside, where equations read them.
    torques: Option<Given<'a, T>>,
    /// Held links, where equations read these as well.
    held: Option<Given<'a, T>>,
    /// How far the links are that come next.
    ahead: Option<usize>,
    /// The results, where they are written next.
    alpha: Option<Shared<'a, T>>,
}

/// Numbers that the caller hands over, and where equations read them.
struct Given<'a, T> {
    column: Columns<'a, T, 1>,
    /// None for zeros.
    values: Option<&'a [T]>,
}

impl<'a, T: Scalar> Given<'a, T> {
    /// Numbers of neighbours, from one place in the tree on and from one in the column, in so
    /// many rows.
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
    /// Two vectors at a time, for while the result of one operation is awaited the
    /// other keeps the processor busy. The last ones overlap those before.
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
                    if let Some(held) = &self.held {
                        held.store::<V>(places[i])?;
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

/// Forms joint angles and rates of a block; `parents` has the place of each link's
/// parent in a tree of any shape, and nothing otherwise.
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

/// Where a link of a block stands: there, in the tree and in its generation.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkPlace {
    pub(super) own: usize,
    pub(super) place: usize,
    number: usize,
    above: Option<(usize, usize)>,
}

impl LinkPlace {
    /// Returns the place of the parent, but for the root; in a tree of any shape these
    /// are the parents of all.
    #[inline(always)]
    pub(super) fn parent(&self, parents: &[u32]) -> Option<usize> {
        match self.above {
            Some((above, count)) => Some(above + self.number % count.max(1)),
            None if self.place > 0 => parents.get(self.place).map(|&parent| parent as usize),
            None => None,
        }
    }
}

/// The links of a block, span by span.
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
    pub(super) fn next(&mut self) -> Option<LinkPlace> {
        let generation = self.generations.first()?;
        let own = generation.own + self.span * generation.length + self.index;
        let within = self.span * generation.stride + self.index * generation.step;
        let number = self.start + within;
        let link = LinkPlace {
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
