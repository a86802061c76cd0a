//! The scales of a large tree block by block: neighbours of one generation with all below
//! them have columns of their own, which stay in the cache while all scales are taken
//! through them.

use core::marker::PhantomData;

use super::columns::{
    CARRIED, DRAG, DRIVE, FLOW, FRICTION, GAIN, MOTION, OUTSIDE, PIVOT, SHIFT, ScaleColumns,
};
use super::shape::ScaleShape;
use super::{ByScale, ScaleEquations, Wanted, field};
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::block::WIDEST;
use crate::tree::memory::take;

/// Columns of which a block has a copy.
const COPIED: [usize; 10] = [
    MOTION,
    MOTION + 1,
    MOTION + 2,
    GAIN,
    GAIN + 1,
    GAIN + 2,
    FRICTION,
    DRAG,
    DRIVE,
    OUTSIDE,
];

/// Parts of which it has.
const PARTS: [usize; 6] = [
    field::MOMENT,
    field::MOMENT + 1,
    field::OMEGA,
    field::RISE,
    field::SIDE,
    field::SPRING,
];

/// Values that a link hands its children along a flow.
const HANDED_DOWN: [usize; 4] = [PIVOT, PIVOT + 1, SHIFT + 2, SHIFT + 3];

/// Numbers of neighbours that are kept for each scale.
#[derive(Clone, Copy)]
struct Kept {
    columns: &'static [usize],
    /// Place of the first of so many neighbours in a column of the tree.
    slot: usize,
    count: usize,
    /// Place among all that is kept for a scale, and how much that is.
    place: usize,
    each: usize,
}

impl Kept {
    fn end(self) -> usize {
        self.place + self.columns.len() * self.count
    }

    /// Places of some neighbours among all that is kept.
    fn range(self, scale: usize, index: usize, start: usize, length: usize) -> [usize; 2] {
        let place = scale * self.each + self.place + index * self.count + start;
        [place, place + length]
    }

    /// Keeps the numbers of some neighbours, of columns where they start at a slot.
    fn keep<T: Scalar>(
        self,
        kept: &mut [T],
        columns: &mut ScaleColumns<'_, T>,
        scale: usize,
        [start, length, slot]: [usize; 3],
    ) {
        for (index, &column) in self.columns.iter().enumerate() {
            let numbers = columns.part_mut(column, slot, length);
            let [place, end] = self.range(scale, index, start, numbers.len());
            if let Some(place) = kept.get_mut(place..end) {
                place.copy_from_slice(numbers);
            }
        }
    }

    /// Keeps all numbers, of columns of the tree.
    fn keep_all<T: Scalar>(self, kept: &mut [T], columns: &mut ScaleColumns<'_, T>, scale: usize) {
        self.keep(kept, columns, scale, [0, self.count, self.slot]);
    }

    /// Brings all back.
    fn recall_all<T: Scalar>(self, kept: &[T], columns: &mut ScaleColumns<'_, T>, scale: usize) {
        self.recall(kept, columns, scale, [0, self.count, self.slot]);
    }

    /// Brings the numbers of some neighbours back.
    fn recall<T: Scalar>(
        self,
        kept: &[T],
        columns: &mut ScaleColumns<'_, T>,
        scale: usize,
        [start, length, slot]: [usize; 3],
    ) {
        for (index, &column) in self.columns.iter().enumerate() {
            let numbers = columns.part_mut(column, slot, length);
            let [place, end] = self.range(scale, index, start, numbers.len());
            if let Some(place) = kept.get(place..end) {
                numbers.copy_from_slice(place);
            }
        }
    }
}

/// Values that are kept at a cut.
#[derive(Clone, Copy)]
struct Cut {
    /// Handed up by the first generation below the cut.
    up: Kept,
    /// Handed down by the last one above it.
    down: Kept,
    /// Changes of velocities of all links above.
    shifts: Kept,
}

impl Cut {
    fn new(shape: &ScaleShape, generation: usize) -> Self {
        let (below, above) = (shape.at(generation), shape.at(generation - 1));
        let kept = |columns: &'static [usize], slot: usize, count: usize, place: usize| Kept {
            columns,
            slot,
            count,
            place,
            each: 0,
        };
        let mut up = kept(&[CARRIED, CARRIED + 1], below.slot, below.count, 0);
        let mut down = kept(&HANDED_DOWN, above.slot, above.count, up.end());
        let mut shifts = kept(&[SHIFT, SHIFT + 1], 0, below.slot, down.end());
        let each = shifts.end();
        for kept in [&mut up, &mut down, &mut shifts] {
            kept.each = each;
        }
        Self { up, down, shifts }
    }
}

/// The shape of a block.
fn below(copies: &[usize], generation: usize, width: usize) -> Option<ScaleShape> {
    let below = copies.get(generation..)?.iter().enumerate();
    ScaleShape::new(below.map(|(number, &copies)| if number == 0 { width } else { copies }))
}

/// Room for the columns of a block and for its parts.
fn block_room(shape: &ScaleShape, scales: usize) -> [usize; 2] {
    [(FLOW + 2 * scales) * shape.column, field::ALL * shape.parts]
}

/// Returns how many numbers are kept at a cut.
pub(super) fn room(copies: &[usize], shape: &ScaleShape, (cut, width): (usize, usize)) -> usize {
    let block = match cut {
        0 => None,
        _ => below(copies, cut, width),
    };
    block.map_or(0, |block| {
        let [columns, parts] = block_room(&block, shape.count());
        columns + parts + shape.count() * Cut::new(shape, cut).up.each
    })
}

/// One way through a part of the tree: which part, and how far.
#[derive(Clone, Copy, PartialEq)]
enum Turn {
    /// Up through a block.
    BlockUp,
    /// Up and down above the blocks.
    Above,
    /// Up, down and up again through a block, of which what is above is known now.
    BlockDown,
    /// Up above the blocks: slopes.
    Last,
    /// All of a tree that is not cut.
    Whole,
}

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    /// Takes all scales through the tree. Of a large one up through the blocks, up and
    /// down above them, then down through them: there the way up is taken again, which
    /// takes less time than to write down what it forms.
    // One loop: what it calls is inlined, and long.
    #[inline(always)]
    pub(super) fn all_scales<V: Simd<T>>(&mut self) {
        let (generation, width) = self.shape.cut();
        let blocks = match generation {
            0 => 0,
            _ => self.shape.at(generation).count / width,
        };
        for turn in 0..(2 * blocks + 2) {
            let (turn, start) = match turn {
                _ if blocks == 0 && turn > 0 => return,
                _ if blocks == 0 => (Turn::Whole, 0),
                up if up < blocks => (Turn::BlockUp, up * width),
                above if above == blocks => (Turn::Above, 0),
                down if down <= 2 * blocks => (Turn::BlockDown, (down - blocks - 1) * width),
                _ => (Turn::Last, 0),
            };
            self.turn::<V>(turn, [generation, start, width]);
        }
    }

    /// Takes all scales through a part of the tree.
    #[inline(always)]
    fn turn<V: Simd<T>>(&mut self, turn: Turn, [generation, start, width]: [usize; 3]) {
        let scales = self.shape.count();
        let cut = (generation > 0).then(|| Cut::new(&self.shape, generation));
        let in_block = matches!(turn, Turn::BlockUp | Turn::BlockDown);
        let mut room = &mut *self.kept;
        let kept = take(&mut room, cut.map_or(0, |cut| scales * cut.up.each));
        let Wanted::Budget(budget) = &mut self.wanted else {
            return;
        };
        let whole = WholeColumns {
            shape: &self.shape,
            generation,
            start,
            width,
        };
        let (block_columns, block_parts);
        let (shape, columns, parts, from) = match below(E::COPIES, generation, width) {
            Some(shape) if in_block => {
                let [columns, parts] = block_room(&shape, scales);
                (block_columns, block_parts) = (take(&mut room, columns), take(&mut room, parts));
                let mut columns = ScaleColumns {
                    length: shape.column,
                    numbers: &mut *block_columns,
                };
                whole.copy_columns(&self.columns, &shape, &mut columns);
                for scale in generation + 1..scales {
                    whole.copy_parts(self.parts, &shape, block_parts, scale);
                }
                (shape, columns, &mut *block_parts, Some(&*self.parts))
            }
            _ => {
                let columns = ScaleColumns {
                    length: self.columns.length,
                    numbers: &mut *self.columns.numbers,
                };
                (self.shape, columns, &mut *self.parts, None)
            }
        };
        let (first, end) = match in_block {
            true => (generation, shape.count()),
            false => (0, self.end),
        };
        let mut piece = ByScale::<E, T> {
            skeleton: self.skeleton,
            columns,
            parts,
            kept: &mut [],
            first,
            end,
            shape,
            drive: self.drive,
            theta: self.theta,
            omega: self.omega,
            torques: self.torques,
            wanted: Wanted::Budget(budget),
            equations: PhantomData,
        };
        for scale in 0..scales {
            let part = scale.saturating_sub(first);
            let columns = &mut piece.columns;
            match (turn, cut) {
                (Turn::BlockDown, Some(Cut { down, .. })) => {
                    let above = [start % down.count, width, 0];
                    down.recall(kept, columns, scale, above);
                }
                (Turn::Above, Some(Cut { up, .. })) => up.recall_all(kept, columns, scale),
                (Turn::Last, Some(Cut { up, shifts, .. })) => {
                    up.recall_all(kept, columns, scale);
                    shifts.recall_all(kept, columns, scale);
                }
                _ => {}
            }
            if let (Some(from), 0) = (from, part) {
                whole.copy_parts(from, &piece.shape, piece.parts, scale);
            }
            if turn != Turn::Last {
                piece.eliminate::<V>(part);
            }
            if matches!(turn, Turn::Above | Turn::Whole) {
                piece.start_at_rest();
            }
            if !matches!(turn, Turn::BlockUp | Turn::Last) {
                piece.flow::<V>(scale);
            }
            if !matches!(turn, Turn::BlockUp | Turn::Above) {
                piece.slopes::<V>(part, scale);
            }
            let columns = &mut piece.columns;
            match (turn, cut) {
                (Turn::BlockUp | Turn::BlockDown, Some(Cut { up, .. })) => {
                    up.keep(kept, columns, scale, [start, width, 0]);
                }
                (Turn::Above, Some(Cut { down, shifts, .. })) => {
                    down.keep_all(kept, columns, scale);
                    shifts.keep_all(kept, columns, scale);
                }
                _ => {}
            }
        }
        if !matches!(turn, Turn::BlockUp | Turn::Above) {
            piece.products::<V>();
        }
    }

    /// Nothing moves the root's pivot along a flow.
    fn start_at_rest(&mut self) {
        for column in HANDED_DOWN {
            let root = self.columns.part_mut(column, 0, 1);
            root.fill(T::from_f64(0.0));
        }
    }
}

/// The tree that a block is part of, and where the block stands there.
struct WholeColumns<'a> {
    shape: &'a ScaleShape,
    generation: usize,
    start: usize,
    width: usize,
}

impl WholeColumns<'_> {
    /// Copies what is known before any scale.
    fn copy_columns<T: Scalar>(
        &self,
        from: &ScaleColumns<'_, T>,
        own: &ScaleShape,
        to: &mut ScaleColumns<'_, T>,
    ) {
        let stride = self.shape.at(self.generation).count;
        for number in 0..own.count() {
            let (own, whole) = (own.at(number), self.shape.at(self.generation + number));
            for run in 0..own.count / self.width {
                let place = whole.slot + run * stride + self.start;
                for column in COPIED {
                    let place = column * from.length + place;
                    let from = from.numbers.get(place..place + self.width);
                    let to = to.part_mut(column, own.slot + run * self.width, self.width);
                    if let Some(from) = from {
                        to.copy_from_slice(from);
                    }
                }
            }
        }
    }

    /// Copies the parts in a scale: of the scales that branch above the block, one takes
    /// the place of the other.
    fn copy_parts<T: Scalar>(&self, whole: &[T], own: &ScaleShape, parts: &mut [T], scale: usize) {
        let part = scale.saturating_sub(self.generation);
        let stride = self.shape.at(self.generation).count;
        for number in part..own.count() {
            let generation = self.generation + number;
            let (from, to) = (self.shape.part(scale, generation), own.part(part, number));
            let repeat = self.shape.period(scale, generation);
            let period = own.period(part, number);
            // Parts that are the same again within the block's neighbours come over and
            // over, others run by run.
            let (first, stride) = match repeat < self.width {
                true => (0, 0),
                false => (self.start % repeat, stride),
            };
            let piece = repeat.min(self.width);
            for field in PARTS {
                let (from, to) = (field * self.shape.parts + from, field * own.parts + to);
                for run in 0..period / piece {
                    let from = from + first + run * stride;
                    let to = to + run * piece;
                    let from = whole.get(from..from + piece);
                    let to = parts.get_mut(to..to + piece);
                    if let (Some(from), Some(to)) = (from, to) {
                        to.copy_from_slice(from);
                    }
                }
                // What comes behind a period is its beginning.
                if let Some(parts) = parts.get_mut(to..to + period + WIDEST) {
                    parts.copy_within(..WIDEST, period);
                }
            }
        }
    }
}
