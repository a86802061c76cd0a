//! Equal bits in all vectors, alone and beside other states.

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::super::evaluate::accelerations as one_state;
use super::super::small::LinkStates;
use super::super::states::{self, ActingOnStates};
use super::super::sweep::SweepKernel;
use super::super::{LinkEquations, Tree};
use super::equations::{ALL, MIXED, any, by_generation, by_link, links};
use super::{accelerations, drive, motion};
use crate::scalar::{InstructionSet, Lane, Real, Scalar};
use crate::simd::dispatch::{in_widest, or_skip, run_wide};
use crate::simd::{Fused, Kernel, Simd};
use crate::system::Workspace;

fn in_set<E: LinkEquations, T: Lane, const SET: usize>(tree: &Tree<E, T>, links: usize) -> Vec<T> {
    let [theta, omega, torques] = motion(links);
    let mut alpha = alloc::vec![T::from_f64(f64::NAN); links];
    one_state::<T, true>(
        &tree.skeleton,
        |view, way| {
            let kernel = SweepKernel::<E, T>(view, way, PhantomData);
            run_wide(InstructionSet::ALL[SET], kernel);
        },
        Some(drive()),
        LinkStates {
            theta: &theta,
            omega: &omega,
            torques: Some(&torques),
        },
        None,
        &mut alpha,
        &mut Workspace::new(),
    );
    alpha
}

/// States in lanes, of which all but the first are moved to other angles.
struct States<'a, E, T>(&'a Tree<E, T>, usize);

impl<E: LinkEquations, T: Lane> Kernel<T> for States<'_, E, T> {
    /// The first state.
    type Output = Vec<T>;

    #[inline(always)]
    fn run<V: Simd<T>>(self) -> Vec<T> {
        let Self(tree, links) = self;
        let [theta, omega, torques] = motion::<T>(links);
        let mut buffer = alloc::vec![V::from_f64(f64::NAN); tree.workspace_len()];
        let mut alpha = alloc::vec![T::from_f64(f64::NAN); links];
        let drive = drive::<T>();
        let mut offsets = [T::from_f64(0.0); 16];
        for (lane, offset) in offsets.iter_mut().enumerate() {
            *offset = T::from_f64(0.01 * lane as f64);
        }
        let offsets = V::load_front(&offsets);
        let acting = ActingOnStates {
            drive: Some(drive.map(V::splat)),
            torques: &[],
        };
        states::accelerations::<E, T, V>(
            &tree.skeleton,
            acting,
            &mut buffer,
            |link| V::splat(theta[link]) + offsets,
            |link| V::splat(omega[link]),
            |link| [V::splat(torques[link]), V::from_f64(0.0)],
            |link, value| {
                let mut numbers = [T::from_f64(0.0); 16];
                value.store(&mut numbers);
                alpha[link] = numbers[0];
            },
        );
        alpha
    }
}

fn compare<E: LinkEquations, T: Lane + Real>(tree: &Tree<E, T>, count: usize)
where
    Fused<T>: Scalar,
{
    let widest = accelerations(tree, count);
    let avx2 = in_set::<E, T, 1>(tree, count);
    let build = in_set::<E, T, 0>(tree, count);
    let states = in_widest::<T, _>(States(tree, count));
    if InstructionSet::widest() >= InstructionSet::Avx2 {
        // There are such numbers where the machine fuses alone.
        let single: Vec<Fused<T>> = accelerations(&tree.cast(Fused), count);
        for link in 0..count {
            let own = widest[link];
            assert!(
                own == avx2[link],
                "link {link} of {count}: {own} {}",
                avx2[link]
            );
            assert!(
                own == single[link].0,
                "link {link} of {count}: {own} {}",
                single[link].0
            );
            assert!(
                own == states[link],
                "link {link} of {count}: {own} {}",
                states[link]
            );
        }
    } else {
        or_skip(InstructionSet::Avx2);
    }
    // What does not fuse rounds otherwise.
    let sizes = widest.iter().map(|&alpha| Real::abs(alpha));
    let largest = sizes.fold(T::ZERO, |largest, size| largest.max(size));
    let rounding = T::from_f64(256.0) * T::EPSILON * largest;
    for (&own, &other) in widest.iter().zip(&build) {
        assert!(
            own.is_finite() && Real::abs(own - other) <= rounding,
            "{own} {other}"
        );
    }
}

fn each_scalar<const PLACE: usize>() {
    for copies in ALL[PLACE] {
        let count = links(copies).0.len();
        compare(&by_generation::<f64, PLACE>(copies), count);
        compare(&by_generation::<f32, PLACE>(copies), count);
    }
}

#[test]
fn trees_by_generation_have_the_bits_of_links_one_by_one() {
    each_scalar::<0>();
    each_scalar::<1>();
    each_scalar::<2>();
    each_scalar::<3>();
    each_scalar::<4>();
}

#[test]
fn trees_of_any_shape_have_the_bits_of_links_one_by_one() {
    for (count, seed) in [
        (1, 0),
        (2, 0),
        (5, 3),
        (17, 4),
        (64, 1),
        (127, 7),
        (300, 2),
        (600, 8),
        (1500, 5),
    ] {
        let (parents, bodies) = any(count, seed);
        compare(&by_link::<f64>(&parents, &bodies), count);
        compare(&by_link::<f32>(&parents, &bodies), count);
    }
    // A long chain with links aside, whose subtrees are large down to its end.
    let (_, bodies) = any(400, 6);
    let parents: Vec<u32> = (0..400)
        .map(|link: u32| link - link.min(1 + link % 3))
        .collect();
    compare(&by_link::<f64>(&parents, &bodies), 400);
}

#[test]
fn bits_do_not_depend_on_the_number_of_threads() {
    let copies = MIXED[MIXED.len() - 1];
    let count = links(copies).0.len();
    let mut tree = by_generation::<f64, 4>(copies);
    tree.set_threads(core::num::NonZeroUsize::MIN);
    let alone = accelerations(&tree, count);
    for threads in 2..4 {
        tree.set_threads(threads.try_into().unwrap());
        assert!(accelerations(&tree, count) == alone, "{threads} threads");
    }
}
