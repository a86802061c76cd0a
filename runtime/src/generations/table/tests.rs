//! Trees in a table in all vectors that the machine has, against links taken one by
//! one.

use alloc::vec::Vec;

use super::super::sweep::tests::{Shape, numbers};
use super::super::vectors::run_in;
use super::{Accelerations, Table};
use crate::generations::Recursion;
use crate::scalar::register::Fused;
use crate::scalar::{InstructionSet, Lane, Real, Scalar};

type Tree<T, const NUMBER: usize> = Table<Shape<NUMBER>, T, 8, 6, 3>;

const fn links<const NUMBER: usize>() -> usize {
    <Shape<NUMBER> as Recursion<8, 6, 6, 3>>::LINKS
}

/// Parents of so many links, depth first: chains of three shapes under a link of the
/// chain before.
fn parents(links: usize) -> &'static [u32] {
    let parent = |link: usize| match link % 5 {
        0 => link / 5 * 4 / 3,
        1 if link > 5 => link - 2,
        _ => link - 1,
    };
    // A link's ancestors alone may be parents of the next: others give their own.
    let mut all: Vec<usize> = Vec::new();
    for link in 0..links {
        let wanted = if link == 0 { 0 } else { parent(link) };
        let mut above = link.saturating_sub(1);
        while above > wanted {
            above = all[above];
        }
        all.push(above);
    }
    let all = all.into_iter().map(|parent| u32::try_from(parent).unwrap());
    all.collect::<Vec<u32>>().leak()
}

fn tree<T: Scalar, const NUMBER: usize>() -> Tree<T, NUMBER> {
    let row = |link: usize| {
        let size = 1.0 + 0.1 * (link % 7) as f64;
        let row = [0.5, 1.5, 0.3, 0.2, 0.4, 0.6, 0.01, 0.02];
        row.map(|number| T::from_f64(number * size))
    };
    let count = links::<NUMBER>();
    let root = [0.0, -9.81].map(T::from_f64);
    Table::new(
        parents(count),
        (0..count).map(row).collect(),
        root,
        Vec::new(),
    )
}

fn evaluated<T: Scalar, const NUMBER: usize>(
    run: impl Fn(Accelerations<'_, Shape<NUMBER>, T, 8, 6, 3>),
) -> Vec<T> {
    let (table, count) = (tree::<T, NUMBER>(), links::<NUMBER>());
    let scalars = |seed, size| -> Vec<T> {
        let numbers = numbers(count, seed, size);
        numbers.into_iter().map(T::from_f64).collect()
    };
    let (theta, omega) = (scalars(1, 3.0), scalars(500, 2.0));
    let mut alpha = scalars(0, f64::NAN);
    let mut buffer = scalars(0, 0.0).repeat(2 + 6 + 3);
    run(Accelerations {
        table: &table,
        drive: None,
        theta: &theta,
        omega: &omega,
        alpha: &mut alpha,
        buffer: &mut buffer,
    });
    alpha
}

fn compare<T: Lane + Real, const NUMBER: usize>(fused: impl Fn(usize) -> T) {
    let in_set = |set| evaluated::<T, NUMBER>(|kernel| run_in(set, kernel));
    let single = evaluated::<T, NUMBER>(|kernel| {
        crate::generations::SliceKernel::run::<crate::generations::Single>(kernel);
    });
    let size = single
        .iter()
        .fold(T::ZERO, |size, alpha| size.max(Real::abs(*alpha)));
    assert!(size.is_finite());
    for set in InstructionSet::ALL {
        if set > InstructionSet::widest() {
            std::println!("skipped: this machine has no {set}");
            continue;
        }
        let own = in_set(set);
        for link in 0..links::<NUMBER>() {
            let (own, one) = match set {
                InstructionSet::Build => (own[link], single[link]),
                _ => (own[link], fused(link)),
            };
            assert!(own == one, "link {link}, {set}: {own} {one}");
            // What fuses rounds otherwise.
            let apart = Real::abs(own - single[link]);
            assert!(apart <= T::from_f64(512.0) * T::EPSILON * size, "{apart}");
        }
    }
}

fn each_scalar<const NUMBER: usize>() {
    fn one<T: Scalar, const NUMBER: usize>() -> Vec<Fused<T>>
    where
        Fused<T>: Scalar,
    {
        evaluated::<Fused<T>, NUMBER>(|kernel| Fused::over_slices(kernel))
    }
    let double = one::<f64, NUMBER>();
    compare::<f64, NUMBER>(|link| double[link].0);
    let single = one::<f32, NUMBER>();
    compare::<f32, NUMBER>(|link| single[link].0);
}

/// Numbers of links below, at and above the lanes of every register.
#[test]
fn vectors_have_the_bits_of_links_one_by_one() {
    each_scalar::<0>();
    each_scalar::<1>();
    each_scalar::<2>();
    each_scalar::<3>();
    each_scalar::<4>();
    each_scalar::<5>();
    each_scalar::<6>();
    each_scalar::<7>();
}
