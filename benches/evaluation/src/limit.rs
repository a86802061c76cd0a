//! How close batches are to the limit of the machine's arithmetic: the least time that the products
//! of an evaluation can take.
//!
//! A processor of today computes a product and a sum in one fused operation, so that sums cost
//! nothing next to as many products. A sine with its cosine counts as 19 products, which is what the
//! polynomials of the runtime take.

use std::cell::Cell;
use std::hint::black_box;
use std::ops::{Add, Div, Mul, Neg, Sub};

use branched_pendulum::batch::Batch;
use branched_pendulum::system::{LinkName, Model};
use branched_pendulum::{Pendulum, Scalar};
use branched_pendulum_timing::{Table, least};

use super::measure::Row;
use super::scenes::{factorization, recursion};

/// Products that a sine with its cosine counts as.
const SINE_WITH_COSINE: u64 = 19;

thread_local! {
    /// Products and divisions since the last reset, and sines with their cosines.
    static COUNTS: Cell<[u64; 2]> = const { Cell::new([0; 2]) };
}

fn count(kind: usize) {
    let mut counts = COUNTS.get();
    counts[kind] += 1;
    COUNTS.set(counts);
}

/// A number that counts operations.
#[derive(Clone, Copy, Debug)]
struct Counted(f64);

impl Add for Counted {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Counted {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Counted {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        count(0);
        Self(self.0 * other.0)
    }
}

impl Div for Counted {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        count(0);
        Self(self.0 / other.0)
    }
}

impl Neg for Counted {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Scalar for Counted {
    fn from_f64(value: f64) -> Self {
        Self(value)
    }

    fn sin_cos(self) -> (Self, Self) {
        count(1);
        let (sine, cosine) = self.0.sin_cos();
        (Self(sine), Self(cosine))
    }

    fn sqrt(self) -> Self {
        count(0);
        Self(self.0.sqrt())
    }
}

/// Returns the number of products of one evaluation, in which a division counts as one.
fn products(model: &impl Model<f64>) -> f64 {
    let counted = model.cast(Counted);
    COUNTS.set([0; 2]);
    let angle = |link: usize| Counted(0.1 + 0.01 * link as f64);
    counted.evaluate(Counted(0.0), angle, angle, |_, _| {});
    let [products, sines] = COUNTS.get();
    (products + SINE_WITH_COSINE * sines) as f64
}

/// Number of sums of products that do not depend on each other: more than a processor has under
/// way at a time.
const CHAINS: usize = 12;

/// Length of each sum.
const LENGTH: usize = 256;

/// A model whose accelerations are sums of products: nothing else, and no memory.
struct Chains<T>(T);

impl<T: Scalar> Model<T> for Chains<T> {
    type Of<S: Scalar> = Chains<S>;
    const KNOWN_LINKS: Option<usize> = Some(1);

    fn links(&self) -> usize {
        1
    }

    fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
        (index == 0).then(|| LinkName::listed("chains"))
    }

    #[inline(always)]
    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Chains<S> {
        Chains(convert(self.0))
    }
}

impl<T: Scalar> Pendulum<T> for Chains<T> {
    #[inline(always)]
    fn evaluate(
        &self,
        _time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        mut alpha: impl FnMut(usize, T),
    ) {
        let (factor, addend) = (self.0, omega(0));
        // Equal chains would be computed once.
        let mut chains: [T; CHAINS] =
            std::array::from_fn(|chain| theta(0) + T::from_f64(chain as f64));
        for _ in 0..LENGTH {
            for chain in &mut chains {
                *chain = chain.mul_add(factor, addend);
            }
        }
        let mut sum = chains[0];
        for chain in &chains[1..] {
            sum = sum + *chain;
        }
        alpha(0, sum);
    }
}

/// Returns the least time of a fused operation on one number in registers of the widest
/// instruction set, in ns.
fn fused_operation() -> f64 {
    const STATES: usize = 64;
    let model = Chains(0.5);
    let theta = [(0..STATES).map(|state| state as f64).collect::<Vec<f64>>()];
    let omega = [vec![0.25; STATES]];
    let mut alpha = [vec![0.0; STATES]];
    let mut batch = Batch::new(&model);
    let seconds = least(2000, || {
        // The slices have equal lengths.
        let _ = batch.accelerations(0.0, black_box(&theta), black_box(&omega), &mut alpha);
        black_box(&alpha);
    });
    seconds * 1e9 / (STATES * CHAINS * LENGTH) as f64
}

/// Returns the table of the limits of batches, and of the part of them that was reached.
#[must_use]
pub fn table(rows: &[Row]) -> String {
    let operation = fused_operation();
    macro_rules! products {
        ($($scene:ident)*) => {
            [$([products(&factorization::$scene::new()), products(&recursion::$scene::new())]),*]
        };
    }
    let products = products!(Paper Tree7 Tree15 Tree31 Tree127);
    let table = Table::new([
        "links",
        "products, fact.",
        "limit, ns",
        "reached",
        "products, rec.",
        "limit, ns",
        "reached",
    ]);
    let table = rows
        .iter()
        .zip(products)
        .fold(table, |table, (row, products)| {
            let cells = products.into_iter().zip([row.times[3], row.times[4]]);
            let cells = cells.flat_map(|(products, time)| {
                let limit = products * operation;
                let reached = time.map_or("-".to_owned(), |time| format!("{:.2}", limit / time));
                [products.to_string(), format!("{limit:.2}"), reached]
            });
            table.row(
                [format!("{} {}", row.links, row.scene)]
                    .into_iter()
                    .chain(cells),
            )
        });
    format!(
        "Limit of batches: products of one state (a sine with its cosine as 19), at {operation:.4} ns \
         for\na fused operation on one number, and the part of the limit that batches reach.\n\n{table}"
    )
}
