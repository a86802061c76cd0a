//! Pieces of a tree, in which energies by scale are computed one after the other. A small tree is
//! one piece. A large tree is divided at a generation into the part above it and blocks, each of
//! which is some neighbouring links of that generation with everything below them. All scales are
//! computed for one block before the next, so that its numbers stay in the cache.

use super::columns::{BIAS, PIVOT, SHIFT, ScaleColumns, WORKING};
use super::shape::ScaleShape;
use super::{ByScale, ScaleEquations};
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::memory::take;

/// The pieces of a tree.
pub(super) struct Pieces {
    /// The whole tree; if it is divided, the part above the blocks together with the blocks' first
    /// generation.
    above: ScaleShape,
    /// Shape of a block, and the index of its first generation in the tree; `None` if the tree is
    /// not divided.
    block: Option<(ScaleShape, usize)>,
}

impl Pieces {
    /// Divides a tree into pieces. Returns `None` if it has too many generations.
    pub(super) fn new(copies: &[usize], shape: &ScaleShape) -> Option<Self> {
        let Some((cut, width)) = shape.cut() else {
            let (above, block) = (*shape, None);
            return Some(Self { above, block });
        };
        let above = copies.get(..=cut)?.iter().copied();
        let below = copies.get(cut..)?.iter().enumerate();
        let below = below.map(|(number, &copies)| if number == 0 { width } else { copies });
        Some(Self {
            above: ScaleShape::new(above)?,
            block: Some((ScaleShape::new(below)?, cut)),
        })
    }

    /// Workspace lengths: first for the links above the blocks (per scale, shared, and two per link
    /// and scale), then for one block.
    fn buffer_lens(&self, scales: usize) -> [[usize; 2]; 2] {
        let lengths = |column: usize, sets: usize| [sets * WORKING * column, 2 * scales * column];
        match &self.block {
            Some((block, _)) => [lengths(self.above.column, scales), lengths(block.column, 1)],
            None => [lengths(self.above.column, 1), [0; 2]],
        }
    }

    /// Returns the total workspace length, in numbers, for all scales.
    pub(super) fn workspace_len(&self, scales: usize) -> usize {
        self.buffer_lens(scales).as_flattened().iter().sum()
    }
}

/// Links of consecutive generations in one piece of a tree.
pub(super) struct Layers<'p> {
    /// Shape of the piece, which determines the positions of its numbers in columns.
    pub(super) own: &'p ScaleShape,
    /// Index of the first generation in the tree, and number of generations that are computed.
    pub(super) first: usize,
    pub(super) count: usize,
    /// Index of the first link within its generation of the tree, and the number of links of that
    /// generation.
    start: usize,
    stride: usize,
}

impl Layers<'_> {
    /// Returns the positions of a generation's links for the upward pass, register by register.
    #[inline(always)]
    pub(super) fn upwards(
        &self,
        tree: &ScaleShape,
        generation: usize,
        period: usize,
    ) -> RegisterPositions {
        self.register_positions(tree, generation, period, self.own.at(generation).count)
    }

    /// Returns the positions of a generation's links for the downward pass, in registers of
    /// neighbours whose parents are neighbours too.
    #[inline(always)]
    pub(super) fn downwards(&self, tree: &ScaleShape, generation: usize) -> RegisterPositions {
        let above = self.own.at(generation.saturating_sub(1)).count;
        self.register_positions(tree, generation, 1, above)
    }

    #[inline(always)]
    fn register_positions(
        &self,
        tree: &ScaleShape,
        generation: usize,
        period: usize,
        all: usize,
    ) -> RegisterPositions {
        let (width, count) = (self.own.at(0).count, self.own.at(generation).count);
        let first = tree.at(self.first + generation).slot;
        let (length, apart) = match width == self.stride {
            true => (all, all),
            false => (width, self.stride),
        };
        RegisterPositions {
            next: RegisterPosition {
                slot: first + self.start,
                number: 0,
                part: self.start % period,
                parent: 0,
                left: length,
            },
            strips: count / length,
            length,
            apart,
            first,
            period,
            parents: self.own.at(generation.saturating_sub(1)).count,
        }
    }
}

/// Position of a register of neighbouring links of one generation.
#[derive(Clone, Copy)]
pub(super) struct RegisterPosition {
    /// Index of the first link in columns of the tree.
    pub(super) slot: usize,
    /// Index of the first link in its generation of the piece.
    pub(super) number: usize,
    /// Index of the first link's part among the parts of its generation in a scale.
    pub(super) part: usize,
    /// Index of the first link's parent in its generation of the piece.
    pub(super) parent: usize,
    /// Number of neighbouring links from the first one on.
    pub(super) left: usize,
}

/// Iterator over the positions of registers of neighbouring links, strip by strip.
pub(super) struct RegisterPositions {
    next: RegisterPosition,
    /// Number of remaining strips, length of each, and distance between them in columns of the
    /// tree.
    strips: usize,
    length: usize,
    apart: usize,
    /// Index of the generation's first link in columns of the tree.
    first: usize,
    period: usize,
    /// Number of links of the generation before.
    parents: usize,
}

impl RegisterPositions {
    #[inline(always)]
    pub(super) fn next(&mut self, lanes: usize) -> Option<RegisterPosition> {
        if self.strips == 0 {
            return None;
        }
        let (place, next) = (self.next, &mut self.next);
        if place.left > lanes {
            next.slot += lanes;
            next.number += lanes;
            next.parent += lanes;
            next.left -= lanes;
            next.part += lanes;
            if next.part >= self.period {
                next.part -= self.period;
            }
        } else {
            self.strips -= 1;
            next.slot = place.slot + place.left + (self.apart - self.length);
            next.number = place.number + place.left;
            next.parent = next.number % self.parents;
            next.left = self.length;
            next.part = (next.slot - self.first) % self.period;
        }
        Some(place)
    }
}

/// One visit of a piece of a tree: the passes through it that are made for all scales.
#[derive(Clone, Copy)]
struct BlockVisit {
    /// If the piece is a block: the index of its first link in its generation.
    block: Option<usize>,
    /// True if the visit includes an upward pass that computes bias forces.
    eliminates: bool,
    /// True if the visit includes a downward pass that computes the flow.
    flows: bool,
    /// True if the visit includes an upward pass that computes slopes and sums of products.
    ends: bool,
}

impl BlockVisit {
    /// Returns visit number `turn` of a tree with `blocks` blocks, whose first generations have
    /// `width` neighbouring links. A large tree is visited upwards through the blocks, up and down
    /// above them, then downwards through the blocks and upwards above them. The blocks repeat
    /// their upward pass, which takes less time than storing its results.
    fn number(turn: usize, blocks: usize, width: usize) -> Self {
        let of = |block, eliminates, flows, ends| Self {
            block,
            eliminates,
            flows,
            ends,
        };
        match turn {
            _ if blocks == 0 => of(None, true, true, true),
            up if up < blocks => of(Some(up * width), true, false, false),
            above if above == blocks => of(None, true, true, false),
            down if down <= 2 * blocks => of(Some((down - blocks - 1) * width), true, true, true),
            _ => of(None, false, false, true),
        }
    }
}

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    /// Computes the quantities of all scales of the tree.
    // One loop, because the functions that it calls are inlined and long.
    #[inline(always)]
    pub(super) fn all_scales<V: Simd<T>>(&mut self, pieces: &Pieces) {
        let (blocks, width) = match &pieces.block {
            Some((block, cut)) => {
                let width = block.at(0).count;
                (self.shape.at(*cut).count / width, width)
            }
            None => (0, 1),
        };
        let turns = if blocks == 0 { 1 } else { 2 * blocks + 2 };
        for turn in 0..turns {
            self.visit::<V>(pieces, BlockVisit::number(turn, blocks, width));
        }
    }

    #[inline(always)]
    fn visit<V: Simd<T>>(&mut self, pieces: &Pieces, turn: BlockVisit) {
        let scales = self.shape.count();
        let working = core::mem::take(&mut self.working);
        let mut buffer = &mut *working;
        let [[sets, flows], [inner, block_flows]] = (pieces.buffer_lens(scales))
            .map(|buffer_lens| buffer_lens.map(|length| take(&mut buffer, length)));
        let (below, cut) = match &pieces.block {
            Some((block, cut)) => (block, *cut),
            None => (&pieces.above, scales),
        };
        let (piece, flows) = match turn.block {
            Some(start) => {
                let piece = Layers {
                    own: below,
                    first: cut,
                    count: scales - cut,
                    start,
                    stride: self.shape.at(cut).count,
                };
                (piece, block_flows)
            }
            None => {
                let piece = Layers {
                    own: &pieces.above,
                    first: 0,
                    count: cut,
                    start: 0,
                    stride: 1,
                };
                (piece, flows)
            }
        };
        let mut flows = ScaleColumns {
            numbers: flows,
            length: piece.own.column,
        };
        let set = WORKING * pieces.above.column;
        let kept = sets.len() / set.max(1);
        for scale in 0..scales {
            let start = scale % kept.max(1) * set;
            let mut above = ScaleColumns {
                numbers: sets.get_mut(start..start + set).unwrap_or_default(),
                length: pieces.above.column,
            };
            let mut inner = ScaleColumns {
                numbers: &mut *inner,
                length: below.column,
            };
            let width = below.at(0).count;
            if let (Some(start), true) = (turn.block, turn.flows) {
                let parents = pieces.above.at(cut - 1);
                let from = (parents.slot + start % parents.count, width);
                inner.copy_two(PIVOT, 0, &above, from);
                inner.copy_two(SHIFT + 2, 0, &above, from);
            }
            let own = match turn.block {
                Some(_) => &mut inner,
                None => &mut above,
            };
            if turn.eliminates {
                self.eliminate::<V>(&piece, own, scale);
            }
            if turn.flows {
                self.flow::<V>(&piece, own, &mut flows, scale);
            }
            if turn.ends {
                self.slopes::<V>(&piece, own, &mut flows, scale);
            }
            if let Some(start) = turn.block {
                let place = pieces.above.at(cut).slot + start;
                above.copy_two(BIAS, place, &inner, (0, width));
            }
        }
        if turn.ends {
            self.products::<V>(&piece, &flows);
        }
        self.working = working;
    }
}
