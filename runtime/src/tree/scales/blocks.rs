//! The pieces of a tree that scales are taken through: all of it, or of a large tree
//! what is above a generation, and blocks of neighbours of that generation with all below
//! them. What is formed along a scale stays in the cache while all scales are taken
//! through a block.

use super::columns::{BIAS, PIVOT, SHIFT, ScaleColumns, WORKING};
use super::shape::ScaleShape;
use super::{ByScale, ScaleEquations};
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::memory::take;

/// The pieces of a tree.
pub(super) struct Pieces {
    /// The tree, or what is above the blocks and their first generation.
    above: ScaleShape,
    /// The shape of a block, and the number of its first generation in the tree.
    block: Option<(ScaleShape, usize)>,
}

impl Pieces {
    /// None where there are too many generations.
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

    /// Numbers that are formed above the blocks, or in a tree without any: along each
    /// scale by itself, which blocks need later, or along one after the other; and two for
    /// each link and scale. Then those in a block.
    fn rooms(&self, scales: usize) -> [[usize; 2]; 2] {
        let room = |column: usize, sets: usize| [sets * WORKING * column, 2 * scales * column];
        match &self.block {
            Some((block, _)) => [room(self.above.column, scales), room(block.column, 1)],
            None => [room(self.above.column, 1), [0; 2]],
        }
    }

    /// Returns how many numbers are formed along all scales.
    pub(super) fn room(&self, scales: usize) -> usize {
        self.rooms(scales).as_flattened().iter().sum()
    }
}

/// Links of consecutive generations.
pub(super) struct Layers<'p> {
    /// The generations as they stand in the piece's own columns.
    pub(super) own: &'p ScaleShape,
    /// Number of the first one in the tree, and how many are computed.
    pub(super) first: usize,
    pub(super) count: usize,
    /// The first link in the first generation, and how many links that has in the tree.
    start: usize,
    stride: usize,
}

impl Layers<'_> {
    /// Places of the links of a generation on the way up: of all neighbours.
    #[inline(always)]
    pub(super) fn upwards(&self, tree: &ScaleShape, generation: usize, period: usize) -> Places {
        self.places(tree, generation, period, self.own.at(generation).count)
    }

    /// Places on the way down: of neighbours whose parents are neighbours.
    #[inline(always)]
    pub(super) fn downwards(&self, tree: &ScaleShape, generation: usize) -> Places {
        let above = self.own.at(generation.saturating_sub(1)).count;
        self.places(tree, generation, 1, above)
    }

    #[inline(always)]
    fn places(&self, tree: &ScaleShape, generation: usize, period: usize, all: usize) -> Places {
        let (width, count) = (self.own.at(0).count, self.own.at(generation).count);
        let first = tree.at(self.first + generation).slot;
        let (length, apart) = match width == self.stride {
            true => (all, all),
            false => (width, self.stride),
        };
        Places {
            next: Place {
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

/// A place among the links of a generation.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// In columns of the tree.
    pub(super) slot: usize,
    /// In the generation of the piece.
    pub(super) number: usize,
    /// Of the link's part among those of its generation in a scale.
    pub(super) part: usize,
    /// Of the parent in its generation of the piece.
    pub(super) parent: usize,
    /// Number of neighbours from here on.
    pub(super) left: usize,
}

/// Places of registers of neighbours, strip by strip.
pub(super) struct Places {
    next: Place,
    /// Number of strips that are left, length of each, and from one to the next in columns
    /// of the tree.
    strips: usize,
    length: usize,
    apart: usize,
    /// Where the generation starts in columns of the tree.
    first: usize,
    period: usize,
    /// Number of links of the generation above.
    parents: usize,
}

impl Places {
    #[inline(always)]
    pub(super) fn next(&mut self, lanes: usize) -> Option<Place> {
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

/// Which ways scales are taken through a piece, one after the other.
#[derive(Clone, Copy)]
struct Turn {
    /// The piece is a block that starts with this link of its generation.
    block: Option<usize>,
    /// Up: bias forces.
    eliminates: bool,
    /// Down: the flow.
    flows: bool,
    /// Up: slopes, and sums of products.
    ends: bool,
}

impl Turn {
    /// The turns of a tree of so many blocks, each of so many neighbours: of a large one up
    /// through the blocks, up and down above them, then down through them and up above
    /// them. There the way up is taken again: that takes less time than to write down what
    /// it forms.
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
    /// Takes all scales through the tree.
    // One loop: what it calls is inlined, and long.
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
            self.turn::<V>(pieces, Turn::number(turn, blocks, width));
        }
    }

    #[inline(always)]
    fn turn<V: Simd<T>>(&mut self, pieces: &Pieces, turn: Turn) {
        let scales = self.shape.count();
        let working = core::mem::take(&mut self.working);
        let mut room = &mut *working;
        let [[sets, flows], [inner, block_flows]] =
            (pieces.rooms(scales)).map(|rooms| rooms.map(|length| take(&mut room, length)));
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
