//! Parts of a quantity in all scales: means of copies, and differences of the copies from their
//! mean, computed from the youngest generation upwards.

use super::shape::ScaleShape;
use crate::scalar::Scalar;
use crate::simd::{Simd, WIDEST};
use crate::tree::columns::load_front;

/// Splits the values of one generation into their parts in all scales. The values are overwritten
/// with the means.
///
/// The mean of k copies x_c is computed as x_1 + Σ (x_c − x_1)/k, and the parts are the differences
/// from it. For equal copies they are exactly zero.
#[inline(always)]
pub(super) fn split<T: Scalar, V: Simd<T>>(
    shape: &ScaleShape,
    generation: usize,
    values: &mut [T],
    parts: &mut [T],
) {
    for scale in (0..=generation).rev() {
        let count = shape.values(scale);
        let start = shape.part(scale, generation);
        let period = shape.period(scale, generation);
        let Some(own) = parts.get_mut(start..start + period + WIDEST) else {
            return;
        };
        match scale {
            0 => {
                if let (Some(part), Some(&mean)) = (own.first_mut(), values.first()) {
                    *part = mean;
                }
            }
            _ => branch::<T, V>(shape.at(scale).copies, count, values, own),
        }
        // The values repeat from the start.
        for place in count..period + WIDEST {
            let value = own.get(place - count).copied();
            if let (Some(place), Some(value)) = (own.get_mut(place), value) {
                *place = value;
            }
        }
    }
}

/// Splits the values of the copies into their mean and the differences from it, for all branchings
/// in a generation.
#[inline(always)]
fn branch<T: Scalar, V: Simd<T>>(copies: usize, count: usize, values: &mut [T], parts: &mut [T]) {
    let parents = count / copies.max(1);
    let mut parent = 0;
    while parent + V::LANES <= parents {
        means::<T, V>(copies, parents, parent, values, parts);
        parent += V::LANES;
    }
    while parent < parents {
        means::<T, V::One>(copies, parents, parent, values, parts);
        parent += 1;
    }
}

/// Returns the means of the copies for a register of links, and writes the differences of the
/// copies from their mean.
#[inline(always)]
fn means<T: Scalar, V: Simd<T>>(
    copies: usize,
    parents: usize,
    parent: usize,
    values: &mut [T],
    parts: &mut [T],
) {
    let each = V::from_f64(1.0) / V::from_f64(copies.max(1) as f64);
    let first: V = load_front(values, parent);
    let mut sum = V::from_f64(0.0);
    for copy in 1..copies {
        sum = sum + (load_front::<T, V>(values, copy * parents + parent) - first);
    }
    let mean = sum * each;
    for copy in 0..copies {
        let place = copy * parents + parent;
        let part = (load_front::<T, V>(values, place) - first) - mean;
        part.store(parts.get_mut(place..).unwrap_or_default());
    }
    (first + mean).store(values.get_mut(parent..).unwrap_or_default());
}
