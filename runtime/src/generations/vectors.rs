//! The registers of each instruction set, by how many numbers there are.

use core::marker::PhantomData;

use super::vector::{SliceKernel, Vector, Vectors};
use crate::scalar::dispatch::{RegisterKernel, run_in_registers};
#[cfg(target_arch = "x86_64")]
use crate::scalar::register::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};
use crate::scalar::register::{Fused, Register};
use crate::scalar::{InstructionSet, Lane, Lanes};

/// A widest register, and what goes with it for fewer numbers: the same
/// arithmetic, so that a number has the same bits in any company.
#[derive(Clone, Copy, Debug)]
pub struct With<R>(PhantomData<R>);

/// Computes over slices of `f64` or `f32` in the widest registers of the
/// machine.
pub(crate) fn run<T: Lane, K: SliceKernel<T>>(kernel: K) {
    run_in_registers(
        InstructionSet::widest(),
        InRegisters(kernel, PhantomData::<T>),
    );
}

struct InRegisters<K, T>(K, PhantomData<T>);

impl<T: Lane, K: SliceKernel<T>> RegisterKernel<T> for InRegisters<K, T> {
    type Output = ();

    #[inline(always)]
    fn run<R: Register<Lane = T>>(self) {
        self.0.run::<R::Vectors>();
    }
}

impl<T: Lane, const N: usize> Vectors<T> for With<Lanes<T, N>> {
    type Wide = Lanes<T, N>;
    type Narrow = T;
    type One = T;
}

macro_rules! vector {
    ($register:ty: $lane:ty) => {
        impl Vector<$lane> for $register {
            const LANES: usize = <Self as Register>::LANES;

            #[inline(always)]
            fn load(slice: &[$lane], at: usize) -> Self {
                match slice.get(at..).and_then(<Self as Register>::load) {
                    Some(numbers) => numbers,
                    None => <Self as Register>::splat(<$lane>::NAN),
                }
            }

            #[inline(always)]
            fn store(self, slice: &mut [$lane], at: usize) {
                if let Some(place) = slice.get_mut(at..) {
                    Register::store(self, place);
                }
            }

            #[inline(always)]
            fn splat(value: $lane) -> Self {
                Register::splat(value)
            }
        }
    };
}

vector!(Fused<f64>: f64);
vector!(Fused<f32>: f32);

#[cfg(target_arch = "x86_64")]
macro_rules! widest {
    ($wide:ty: $lane:ty, $narrow:ty, $one:ty) => {
        vector!($wide: $lane);

        impl Vectors<$lane> for With<$wide> {
            type Wide = $wide;
            type Narrow = $narrow;
            type One = $one;
        }
    };
}

#[cfg(target_arch = "x86_64")]
widest!(F64x8: f64, F64x4, Fused<f64>);
#[cfg(target_arch = "x86_64")]
widest!(F64x4: f64, Fused<f64>, Fused<f64>);
#[cfg(target_arch = "x86_64")]
widest!(F64x2: f64, f64, f64);
#[cfg(target_arch = "x86_64")]
widest!(F32x16: f32, F32x8, Fused<f32>);
#[cfg(target_arch = "x86_64")]
widest!(F32x8: f32, Fused<f32>, Fused<f32>);
#[cfg(target_arch = "x86_64")]
widest!(F32x4: f32, f32, f32);
