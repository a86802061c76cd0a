#![forbid(unsafe_code)]
#![allow(dead_code, unused_imports)]
// In front of every source that the test gives to the compiler.
use branched_pendulum::emitted::{Part, Simd, outlined};
use branched_pendulum::scalar::{Dual, InstructionSet, Lane, Lanes, Real, Scalar};
use branched_pendulum::system::Workspace;
use branched_pendulum::tree::{LinkEquations, LinkMotion, SmallTree, Tree};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Equations of links, with these copies.
macro_rules! equations {
    ($name:ident: $copies:expr) => {
        equations!($name: $copies, 5);
    };
    ($name:ident: $copies:expr, $response:expr) => {
        #[derive(Clone, Copy)]
        struct $name;

        impl LinkEquations for $name {
            type Constants<V: Scalar> = [V; 1];
            type Response<V: Scalar> = [V; $response];
            type Sums<V: Scalar> = [V; $response];
            type Elimination<V: Scalar> = [V; 3];
            type Carried<V: Scalar> = [V; 2];
            const COPIES: &'static [usize] = $copies;
            const NAMES: &'static [&'static str] = &["a", "b", "c"];
            const JOINTS: bool = false;
            const TORQUE: bool = false;
            fn leaf<V: Scalar>(_: &[V; 1], link: LinkMotion<V>) -> [V; $response] {
                [link.sine; $response]
            }
            fn attach<V: Scalar>(
                _: &[V; 1],
                _: LinkMotion<V>,
                response: [V; $response],
            ) -> [V; $response] {
                response
            }
            fn inner<V: Scalar>(
                _: &[V; 1],
                link: LinkMotion<V>,
                below: [V; $response],
            ) -> ([V; $response], [V; 3]) {
                (below, [link.sine; 3])
            }
            fn pivot<V: Scalar>(_: &[V; 1], _: LinkMotion<V>, carried: [V; 2]) -> [V; 2] {
                carried
            }
            fn accelerate<V: Scalar>(
                _: &[V; 1],
                link: LinkMotion<V>,
                _: [V; 3],
                pivot: [V; 2],
            ) -> (V, [V; 2]) {
                (link.sine, pivot)
            }
            fn accelerate_leaf<V: Scalar>(_: &[V; 1], link: LinkMotion<V>, _: [V; 2]) -> V {
                link.sine
            }
        }
    };
}

/// Evaluates a tree by rule.
fn evaluate<E: LinkEquations>() {
    let tree = Tree::<E, f64>::new(vec![0.0; 3], [0.0, 1.0]);
    let mut alpha = [0.0; 5];
    tree.accelerations_with(
        &mut Workspace::new(),
        None,
        &[0.1; 5],
        &[0.0; 5],
        &mut alpha,
    );
}

/// A number of one's own.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Own(f64);

macro_rules! operator {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl $trait for Own {
            type Output = Own;
            fn $function(self, other: Own) -> Own {
                Own(self.0 $operator other.0)
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);
impl Neg for Own {
    type Output = Own;
    fn neg(self) -> Own {
        Own(-self.0)
    }
}

/// Makes it a scalar, with more functions than every scalar needs.
macro_rules! own_scalar {
    ($($more:tt)*) => {
        impl Scalar for Own {
            fn from_f64(value: f64) -> Own {
                Own(value)
            }
            fn sin_cos(self) -> (Own, Own) {
                (Own(self.0.sin()), Own(self.0.cos()))
            }
            fn sqrt(self) -> Own {
                Own(self.0.sqrt())
            }
            $($more)*
        }
    };
}

/// Says that it is so many numbers of another kind, which make up a chunk.
macro_rules! own_simd {
    ($number:ident, $lanes:expr, $chunk:ty) => {
        impl Simd<$number> for Own {
            type One = $number;
            type Mask = bool;
            type Chunk = $chunk;
            const LANES: usize = $lanes;
            fn mask(meant: impl Fn(usize) -> bool) -> bool {
                meant(0)
            }
            fn choose(self, other: Own, mask: bool) -> Own {
                if mask { self } else { other }
            }
            fn larger_size(self, _: Own) -> Own {
                self
            }
            fn splat(value: $number) -> Own {
                Own(value.into())
            }
            fn rotate_lanes(self, _: usize) -> Own {
                self
            }
            fn tile_lanes(self, _: usize) -> Own {
                self
            }
        }
    };
}

/// A part that computes squares of any numbers.
struct Squares;

impl<S: Scalar> Part<0, [S; 4]> for Squares {
    type Output = [S; 4];
    fn part(&self, numbers: [S; 4]) -> [S; 4] {
        numbers.map(|x| x * x)
    }
}
