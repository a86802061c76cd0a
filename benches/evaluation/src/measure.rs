//! The contenders and the clock.

use std::hint::black_box;

use branched_pendulum::Pendulum;
use branched_pendulum::batch::Batch;
use branched_pendulum::scalar::Lane;
use branched_pendulum_timing::{Pass, Times, in_warm_turns};

use super::articulated::Articulated;
use super::by_hand::ByHand;
use super::dense::Dense;
use super::scenes::{factorization, recursion};
use super::states::{Layouts, SEEDS, random};
use super::table::{self, Link};

/// Approximate number of values in one pass; they fit into the second-level cache. It is not a
/// multiple of the page size, so that arrays do not compete for the same lines of the first-level
/// cache.
const NUMBERS: usize = 6000;

/// Names of the compared implementations, in the order of the columns.
pub const CONTENDERS: [&str; 10] = [
    "sines of std",
    "factorization",
    "recursion",
    "batch, fact.",
    "batch, rec.",
    "f32, fact.",
    "f32, rec.",
    "by hand",
    "table",
    "dense",
];

/// Median times for one state of one scene in ns, in the order of [`CONTENDERS`]; `None` if there
/// is nothing to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The scene.
    pub scene: &'static str,
    /// Number of its links.
    pub links: usize,
    /// The times.
    pub times: [Option<f64>; CONTENDERS.len()],
}

/// Measures all scenes: medians of `repeats` passes. The implementations are timed alternately, so
/// that a change of the processor's clock affects all of them.
#[must_use]
pub fn all(repeats: usize) -> Vec<Row> {
    macro_rules! solves {
        ($links:literal, $scene:ident) => {{
            let mut passes = Passes::default();
            passes[1] = Some(one_by_one::<$links>(factorization::$scene::new()));
            passes[2] = Some(one_by_one::<$links>(recursion::$scene::new()));
            passes
        }};
        ($links:literal, $scene:ident, batches) => {{
            use factorization::$scene as Factorization;
            use recursion::$scene as Recursion;
            let mut passes = solves!($links, $scene);
            passes[3] = Some(doubles::<$links>(Factorization::default()));
            passes[4] = Some(doubles::<$links>(Recursion::default()));
            passes[5] = Some(singles::<$links>(Factorization::default()));
            passes[6] = Some(singles::<$links>(Recursion::default()));
            passes
        }};
    }
    let mut paper = solves!(3, Paper, batches);
    paper[7] = Some(by_hand());
    let tree = |generations| table::tree(generations);
    vec![
        row::<3>("paper", paper, &table::paper(), repeats),
        row::<7>("tree", solves!(7, Tree7, batches), &tree(3), repeats),
        row::<15>("tree", solves!(15, Tree15, batches), &tree(4), repeats),
        row::<31>("tree", solves!(31, Tree31, batches), &tree(5), repeats),
        row::<127>("tree", solves!(127, Tree127), &tree(7), repeats),
    ]
}

type Passes = [Option<Pass<'static>>; CONTENDERS.len()];

/// States in one pass.
#[must_use]
pub fn states_of(links: usize) -> usize {
    // A multiple of all lanes: remainders are tested, not timed.
    (NUMBERS / links.max(1)).next_multiple_of(16)
}

fn count<const N: usize>() -> usize {
    states_of(N)
}

fn inputs<const N: usize>() -> (Layouts, Layouts) {
    (
        random(SEEDS[0], N, count::<N>(), std::f64::consts::PI),
        random(SEEDS[1], N, count::<N>(), 9.0),
    )
}

fn arrays<const N: usize>(layouts: &Layouts) -> Vec<[f64; N]> {
    layouts
        .by_state
        .iter()
        .map(|state| std::array::from_fn(|i| state[i]))
        .collect()
}

fn row<const N: usize>(
    scene: &'static str,
    mut passes: Passes,
    links: &[Link],
    repeats: usize,
) -> Row {
    passes[0] = Some(Box::new(sines::<N>()));
    let mut table = Articulated::new(links);
    passes[8] = Some(Box::new(states::<N>(move |theta, omega, alpha| {
        table.accelerations(theta, omega, alpha);
    })));
    let mut dense = Dense::new(links);
    passes[9] = Some(Box::new(states::<N>(move |theta, omega, alpha| {
        dense.accelerations(theta, omega, alpha);
    })));
    // The system's sines by themselves: they have branches, which the processor
    // learns from pass to pass where nothing comes between. New angles take 17 ns
    // each instead of 10: the ratios are to the least that they can take.
    let (sines, others) = passes.split_at_mut(1);
    let measured = [sines, others].map(|contenders| {
        let mut present: Vec<&mut Pass<'_>> = contenders.iter_mut().flatten().collect();
        in_warm_turns(repeats, &mut present)
    });
    let mut medians = measured.iter().flatten().map(Times::median);
    let time = |pass: &Option<Pass<'_>>| {
        let seconds = pass.as_ref().and_then(|_| medians.next());
        seconds.map(|seconds| 1e9 * seconds / count::<N>() as f64)
    };
    let times = passes.each_ref().map(time);
    Row {
        scene,
        links: N,
        times,
    }
}

/// Creates a pass that evaluates only the standard library's sine and cosine of all angles.
fn sines<const N: usize>() -> impl FnMut() + 'static {
    let theta = arrays::<N>(&inputs::<N>().0);
    let mut sums = vec![[0.0; N]; theta.len()];
    move || {
        let sums = black_box(&mut sums).as_flattened_mut();
        for (theta, sum) in black_box(&theta).as_flattened().iter().zip(sums) {
            let (sine, cosine) = theta.sin_cos();
            *sum = sine + cosine;
        }
    }
}

/// Creates a pass over one state after the other; the processor may overlap their computations.
fn states<const N: usize>(
    mut evaluate: impl FnMut(&[f64; N], &[f64; N], &mut [f64; N]) + 'static,
) -> impl FnMut() + 'static {
    let (theta, omega) = inputs::<N>();
    let (theta, omega) = (arrays::<N>(&theta), arrays::<N>(&omega));
    let mut alpha = vec![[0.0; N]; theta.len()];
    move || {
        let states = black_box(&theta).iter().zip(black_box(&omega));
        for ((theta, omega), alpha) in states.zip(black_box(&mut alpha)) {
            evaluate(theta, omega, alpha);
        }
    }
}

fn by_hand() -> Pass<'static> {
    let model = ByHand::default();
    Box::new(states::<3>(move |theta, omega, alpha| {
        *alpha = model.accelerations(theta, omega);
    }))
}

fn one_by_one<const N: usize>(model: impl Pendulum<f64> + 'static) -> Pass<'static> {
    Box::new(states::<N>(move |theta, omega, alpha| {
        model.accelerations_into(0.0, theta, omega, alpha);
    }))
}

fn doubles<const N: usize>(model: impl Pendulum<f64> + 'static) -> Pass<'static> {
    Box::new(batch::<N, _, _>(model, |x| x))
}

fn singles<const N: usize>(model: impl Pendulum<f32> + 'static) -> Pass<'static> {
    Box::new(batch::<N, _, _>(model, |x| x as f32))
}

fn batch<const N: usize, P, T>(model: P, convert: fn(f64) -> T) -> impl FnMut() + 'static
where
    P: Pendulum<T> + 'static,
    T: Lane,
{
    let (theta, omega) = inputs::<N>();
    let columns = |layouts: &Layouts| -> Vec<Vec<T>> {
        let column = |column: &Vec<f64>| column.iter().map(|&x| convert(x)).collect();
        layouts.by_link.iter().map(column).collect()
    };
    let (theta, omega) = (columns(&theta), columns(&omega));
    let mut alpha = vec![vec![T::from_f64(0.0); count::<N>()]; N];
    move || {
        let done = Batch::new(&model).accelerations(
            T::from_f64(0.0),
            black_box(&theta),
            black_box(&omega),
            black_box(&mut alpha),
        );
        debug_assert!(done.is_ok());
    }
}
