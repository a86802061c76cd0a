//! Arrays of numbers.

mod sealed {
    pub trait Sealed {}

    impl<V, const N: usize> Sealed for [V; N] {}
}

/// A fixed number of values: an array, and nothing else. Sealed: other crates cannot
/// implement it.
pub trait Row<V>: Copy + AsRef<[V]> + AsMut<[V]> + sealed::Sealed {
    /// Number of values.
    const LENGTH: usize;

    /// Returns the row that has `value` everywhere.
    #[doc(hidden)]
    fn filled(value: V) -> Self;

    /// Returns the first values of a slice, if it has enough.
    #[doc(hidden)]
    fn first_of(values: &[V]) -> Option<&Self>;

    /// Returns the last values of a slice, if it has enough.
    #[doc(hidden)]
    fn last_of(values: &[V]) -> Option<&Self>;
}

impl<V: Copy, const N: usize> Row<V> for [V; N] {
    const LENGTH: usize = N;

    #[inline(always)]
    fn filled(value: V) -> Self {
        [value; N]
    }

    #[inline(always)]
    fn first_of(values: &[V]) -> Option<&Self> {
        values.first_chunk()
    }

    #[inline(always)]
    fn last_of(values: &[V]) -> Option<&Self> {
        values.last_chunk()
    }
}
