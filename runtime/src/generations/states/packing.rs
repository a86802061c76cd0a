//! How the numbers that are computed in step stand in memory.

use core::marker::PhantomData;

use crate::scalar::Scalar;
use crate::scalar::register::Register;

/// Values of one or several states, stored among plain numbers.
pub(in crate::generations) trait Packing {
    /// What models and memory consist of.
    type Number: Scalar;
    /// What is computed with.
    type Value: Scalar;
    /// Numbers in a value.
    const COUNT: usize;

    /// A number for each state.
    fn splat(number: Self::Number) -> Self::Value;

    /// The value that these numbers are; NaN where there are too few.
    fn read(numbers: &[Self::Number]) -> Self::Value;

    /// Writes its numbers.
    fn write(value: Self::Value, numbers: &mut [Self::Number]);
}

/// A value is one number, in the model's own scalar.
pub(in crate::generations) struct Alone<T>(PhantomData<T>);

impl<T: Scalar> Packing for Alone<T> {
    type Number = T;
    type Value = T;

    const COUNT: usize = 1;

    #[inline(always)]
    fn splat(number: T) -> T {
        number
    }

    #[inline(always)]
    fn read(numbers: &[T]) -> T {
        match numbers.first() {
            Some(number) => *number,
            None => T::from_f64(f64::NAN),
        }
    }

    #[inline(always)]
    fn write(value: T, numbers: &mut [T]) {
        if let Some(number) = numbers.first_mut() {
            *number = value;
        }
    }
}

/// A value is a register, of a model in its lanes' numbers.
pub(in crate::generations) struct Packed<R>(PhantomData<R>);

impl<R: Register> Packing for Packed<R> {
    type Number = R::Lane;
    type Value = R;

    const COUNT: usize = R::LANES;

    #[inline(always)]
    fn splat(number: R::Lane) -> R {
        R::splat(number)
    }

    #[inline(always)]
    fn read(numbers: &[R::Lane]) -> R {
        match R::load(numbers) {
            Some(value) => value,
            None => R::from_f64(f64::NAN),
        }
    }

    #[inline(always)]
    fn write(value: R, numbers: &mut [R::Lane]) {
        value.store(numbers);
    }
}

/// Rows of `N` values.
pub(in crate::generations) struct Rows<'a, T>(pub(in crate::generations) &'a mut [T]);

impl<T: Scalar> Rows<'_, T> {
    #[inline(always)]
    pub(in crate::generations) fn load<P: Packing<Number = T>, const N: usize>(
        &self,
        row: usize,
    ) -> [P::Value; N] {
        let start = row * N * P::COUNT;
        let numbers = self.0.get(start..start + N * P::COUNT).unwrap_or_default();
        let mut values = [P::Value::from_f64(f64::NAN); N];
        for (i, value) in values.iter_mut().enumerate() {
            *value = P::read(numbers.get(i * P::COUNT..).unwrap_or_default());
        }
        values
    }

    #[inline(always)]
    pub(in crate::generations) fn store<P: Packing<Number = T>, const N: usize>(
        &mut self,
        row: usize,
        values: [P::Value; N],
    ) {
        let start = row * N * P::COUNT;
        let Some(numbers) = self.0.get_mut(start..start + N * P::COUNT) else {
            return;
        };
        for (i, value) in values.into_iter().enumerate() {
            P::write(value, numbers.get_mut(i * P::COUNT..).unwrap_or_default());
        }
    }
}

/// A constant row in each state.
#[inline(always)]
pub(in crate::generations) fn splat<P: Packing, const N: usize>(
    numbers: &[P::Number; N],
) -> [P::Value; N] {
    let mut values = [P::Value::from_f64(0.0); N];
    for i in 0..N {
        values[i] = P::splat(numbers[i]);
    }
    values
}
