//! The registers of each instruction set, by how many numbers there are.

use core::marker::PhantomData;
#[cfg(target_arch = "x86_64")]
use core::slice::from_raw_parts_mut;

use super::vector::{SliceKernel, Vector, Vectors, last, words_behind, words_repeated};
use crate::scalar::dispatch::{RegisterKernel, run_in_registers};
#[cfg(target_arch = "x86_64")]
use crate::scalar::register::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};
use crate::scalar::{InstructionSet, Lane, Lanes};
use crate::simd::{Fused, Register, Simd};

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

/// The same in the registers of one instruction set, or of the widest that there
/// is.
#[cfg(test)]
pub(super) fn run_in<T: Lane, K: SliceKernel<T>>(set: InstructionSet, kernel: K) {
    run_in_registers(set, InRegisters(kernel, PhantomData::<T>));
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
    type Long = Lanes<T, N>;
    type One = T;
}

macro_rules! vector {
    ($register:ident: $lane:ty, $words:literal) => {
        #[allow(unsafe_code)]
        impl Vector<$lane> for $register {
            const LANES: usize = <Self as Simd<$lane>>::LANES;

            #[inline(always)]
            fn load(slice: &[$lane], at: usize) -> Self {
                match slice.get(at..).and_then(<Self as Simd<$lane>>::load) {
                    Some(numbers) => numbers,
                    None => Self::from_array(last(slice, at)),
                }
            }

            #[inline(always)]
            fn store(self, slice: &mut [$lane], at: usize) {
                match slice.get_mut(at..) {
                    Some(rest) if rest.len() >= <Self as Simd<$lane>>::LANES => {
                        Simd::<$lane>::store(self, rest);
                    }
                    Some(rest) => self.store_some(rest),
                    None => {}
                }
            }

            #[inline(always)]
            unsafe fn read(start: *const $lane) -> Self {
                // SAFETY: the caller's. The type is transparent, and a register is
                // made of its lanes. They need not lie where registers would.
                unsafe { start.cast::<Self>().read_unaligned() }
            }

            #[inline(always)]
            unsafe fn write(self, start: *mut $lane) {
                // SAFETY: likewise.
                unsafe { start.cast::<Self>().write_unaligned(self) }
            }

            #[inline(always)]
            unsafe fn write_some(self, start: *mut $lane, count: usize) {
                // SAFETY: likewise.
                self.store_some(unsafe { from_raw_parts_mut(start, count) });
            }

            #[inline(always)]
            fn splat(value: $lane) -> Self {
                <Self as Simd<$lane>>::splat(value)
            }

            #[inline(always)]
            fn behind(self, first: usize) -> Self {
                const LANES: usize = <$register as Simd<$lane>>::LANES;
                static WORDS: [[u32; $words]; LANES] = words_behind();
                self.permuted(&WORDS[first % LANES])
            }

            #[inline(always)]
            fn repeat(self, count: usize) -> Self {
                const LANES: usize = <$register as Simd<$lane>>::LANES;
                static WORDS: [[u32; $words]; LANES] = words_repeated();
                self.permuted(&WORDS[count.wrapping_sub(1) % LANES])
            }
        }
    };
    (fused $lane:ty) => {
        #[allow(unsafe_code)]
        impl Vector<$lane> for Fused<$lane> {
            const LANES: usize = 1;

            #[inline(always)]
            fn load(slice: &[$lane], at: usize) -> Self {
                Self(<$lane as Vector<$lane>>::load(slice, at))
            }

            #[inline(always)]
            fn store(self, slice: &mut [$lane], at: usize) {
                Vector::<$lane>::store(self.0, slice, at);
            }

            #[inline(always)]
            unsafe fn read(start: *const $lane) -> Self {
                // SAFETY: the caller's. The type is transparent, and a register is
                // made of its lanes. They need not lie where registers would.
                unsafe { start.cast::<Self>().read_unaligned() }
            }

            #[inline(always)]
            unsafe fn write(self, start: *mut $lane) {
                // SAFETY: likewise.
                unsafe { start.cast::<Self>().write_unaligned(self) }
            }

            #[inline(always)]
            unsafe fn write_some(self, _start: *mut $lane, _count: usize) {}

            #[inline(always)]
            fn splat(value: $lane) -> Self {
                Self(value)
            }

            #[inline(always)]
            fn behind(self, _first: usize) -> Self {
                self
            }

            #[inline(always)]
            fn repeat(self, _count: usize) -> Self {
                self
            }
        }
    };
}

vector!(fused f64);
vector!(fused f32);

#[cfg(target_arch = "x86_64")]
macro_rules! widest {
    ($wide:ident: $lane:ty, $words:literal, $long:ty, $one:ty) => {
        vector!($wide: $lane, $words);

        impl Vectors<$lane> for With<$wide> {
            type Wide = $wide;
            type Long = $long;
            type One = $one;
        }
    };
}

#[cfg(target_arch = "x86_64")]
widest!(F64x8: f64, 16, F64x8, Fused<f64>);
#[cfg(target_arch = "x86_64")]
widest!(F64x4: f64, 8, F64x4, Fused<f64>);
#[cfg(target_arch = "x86_64")]
widest!(F64x2: f64, 4, f64, f64);
#[cfg(target_arch = "x86_64")]
widest!(F32x16: f32, 16, F32x16, Fused<f32>);
#[cfg(target_arch = "x86_64")]
widest!(F32x8: f32, 8, F32x8, Fused<f32>);
#[cfg(target_arch = "x86_64")]
widest!(F32x4: f32, 4, f32, f32);
