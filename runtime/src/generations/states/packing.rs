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

    /// The value that these numbers are; none where there are too few.
    fn read(numbers: &[Self::Number]) -> Option<Self::Value>;

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
    fn read(numbers: &[T]) -> Option<T> {
        numbers.first().copied()
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
    fn read(numbers: &[R::Lane]) -> Option<R> {
        R::load(numbers)
    }

    #[inline(always)]
    fn write(value: R, numbers: &mut [R::Lane]) {
        value.store(numbers);
    }
}

/// Rows of `N` values.
pub(in crate::generations) struct Rows<'a, T, const N: usize>(
    pub(in crate::generations) &'a mut [T],
);

impl<T: Scalar, const N: usize> Rows<'_, T, N> {
    /// The first `M` values of a row; none behind the end.
    #[inline(always)]
    pub(in crate::generations) fn load<P: Packing<Number = T>, const M: usize>(
        &self,
        row: usize,
    ) -> Option<[P::Value; M]> {
        let numbers = self.0.get(row * N * P::COUNT..)?.get(..M * P::COUNT)?;
        let mut values = [P::Value::from_f64(0.0); M];
        for (i, value) in values.iter_mut().enumerate() {
            *value = P::read(numbers.get(i * P::COUNT..)?)?;
        }
        Some(values)
    }

    /// Writes these; none behind the end.
    #[inline(always)]
    pub(in crate::generations) fn store<P: Packing<Number = T>, const M: usize>(
        &mut self,
        row: usize,
        values: [P::Value; M],
    ) -> Option<()> {
        let numbers = self.0.get_mut(row * N * P::COUNT..)?;
        let numbers = numbers.get_mut(..M * P::COUNT)?;
        for (i, value) in values.into_iter().enumerate() {
            P::write(value, numbers.get_mut(i * P::COUNT..)?);
        }
        Some(())
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
