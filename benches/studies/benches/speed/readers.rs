//! Accelerations of free motion through closures that read a state, and as a function of slices like
//! every other function of a model. `docs/DESIGN.md` gives the reason for both.

use std::hint::black_box;

use branched_pendulum::batch::Batch;
use branched_pendulum::prelude::*;
use branched_pendulum::system::{At, Computes, LinkName, MotionKind, SliceFunction, Workspace};
use branched_pendulum::{Model, Scalar};
use branched_pendulum_studies::scenes::{BranchedDouble, Rods, ThirtyOneRods};
use branched_pendulum_timing::{Contender, compared};

/// Number of states in one pass.
const STATES: usize = 1024;

/// Number of turns.
const ROUNDS: usize = 40;

/// Accelerations as a function of slices.
struct FreeMotion;

impl SliceFunction for FreeMotion {
    const ARGUMENTS: usize = 2;
    const RESULTS: usize = 1;
    const MOTION: Option<MotionKind> = Some(MotionKind::Free);
}

/// A model whose accelerations are also a function of slices.
struct Sliced<P>(P);

impl<T: Scalar, P: Pendulum<T>> Model<T> for Sliced<P> {
    type Of<S: Scalar> = Sliced<P::Of<S>>;

    const KNOWN_LINKS: Option<usize> = P::KNOWN_LINKS;

    fn links(&self) -> usize {
        self.0.links()
    }

    fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
        self.0.link_name(index)
    }

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        Sliced(self.0.cast(convert))
    }
}

impl<T: Scalar, P: Pendulum<T>> Pendulum<T> for Sliced<P> {
    #[inline(always)]
    fn evaluate(
        &self,
        time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        self.0.evaluate(time, theta, omega, alpha);
    }
}

impl<T: Scalar, P: Pendulum<T>> Computes<FreeMotion, T> for Sliced<P> {
    type On<S: Scalar> = Sliced<P::Of<S>>;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S> {
        self.cast(convert)
    }

    #[inline(always)]
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        let ([theta, omega], [alpha]) = (given, results) else {
            return;
        };
        let lengths = [theta.len(), omega.len(), alpha.len()];
        if lengths != [self.links(); 3] {
            return alpha.fill(T::from_f64(f64::NAN));
        }
        let write = |link: usize, value| alpha[link] = value;
        self.evaluate(at.time, |link| theta[link], |link| omega[link], write);
    }
}

/// Returns the number of a link in a state, of the given size.
fn number(link: usize, state: usize, size: f64) -> f64 {
    size * (((7 * link + state) % 64) as f64 / 11.0 - 3.0)
}

fn compare<P: Pendulum<f64> + 'static>(name: &str, pendulum: P) {
    let (model, links) = (Sliced(pendulum), 0..P::KNOWN_LINKS.unwrap_or_default());
    let columns = |size| -> Vec<Vec<f64>> {
        let column = |link| (0..STATES).map(|state| number(link, state, size)).collect();
        links.clone().map(column).collect()
    };
    let states = |size| -> Vec<Vec<f64>> {
        let state = |state| {
            links
                .clone()
                .map(|link| number(link, state, size))
                .collect()
        };
        (0..STATES).map(state).collect()
    };
    let (theta, omega) = (columns(1.0), columns(2.0));
    let (angles, velocities) = (states(1.0), states(2.0));
    let mut results = [columns(0.0), columns(0.0)];
    let [read, sliced] = &mut results;
    let (mut of_readers, mut of_slices) = (Batch::new(&model), Batch::new(&model));
    let batches = vec![
        Contender::new("batch, readers", STATES as f64, || {
            let written = of_readers.accelerations(0.0, &theta, &omega, read);
            black_box(written).expect("equal lengths");
        }),
        Contender::new("batch, slices", STATES as f64, || {
            let given: [&[Vec<f64>]; 2] = [&theta, &omega];
            let written = of_slices.compute(FreeMotion, At::time(0.0), given, [&mut sliced[..]]);
            black_box(written).expect("equal lengths");
        }),
    ];
    println!("{name}: a state\n{}", compared(ROUNDS, batches));
    assert_eq!(results[0], results[1], "equal bits");
    let given = [&angles[..], &velocities[..]];
    let through_readers = one_by_one(&model, given, |workspace, [theta, omega], alpha| {
        model.accelerations_with(workspace, 0.0, theta, omega, alpha);
    });
    let through_slices = one_by_one(&model, given, |workspace, given, alpha| {
        let at = At::time(0.0);
        Computes::<FreeMotion, f64>::compute_with(&model, workspace, at, &given, &mut [alpha]);
    });
    let alone = vec![
        Contender::new("one state, readers", STATES as f64, through_readers),
        Contender::new("one state, slices", STATES as f64, through_slices),
    ];
    println!("{}", compared(ROUNDS, alone));
}

/// Creates a pass that computes all states one by one.
fn one_by_one<'a>(
    model: &impl Model<f64>,
    [angles, velocities]: [&'a [Vec<f64>]; 2],
    compute: impl Fn(&mut Workspace<f64>, [&[f64]; 2], &mut [f64]) + 'a,
) -> impl FnMut() + 'a {
    let (mut workspace, mut alpha) = (Workspace::new(), vec![0.0; model.links()]);
    move || {
        for (theta, omega) in black_box(angles).iter().zip(velocities) {
            compute(&mut workspace, [theta, omega], &mut alpha);
            black_box(&mut alpha);
        }
    }
}

pub(crate) fn run() {
    compare("3 links", BranchedDouble::new());
    compare("7 links", Rods::new());
    compare("31 links", ThirtyOneRods::new());
}
