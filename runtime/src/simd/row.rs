//! Arrays of fixed length.

mod sealed {
    pub trait Sealed {}

    impl<V, const N: usize> Sealed for [V; N] {}
}

/// An array whose number of values is part of its type. Sealed: other crates cannot implement it.
pub trait Row<V>: Copy + AsRef<[V]> + AsMut<[V]> + sealed::Sealed {
    /// Number of values.
    const LENGTH: usize;

    /// Returns an array filled with `value`.
    #[doc(hidden)]
    fn filled(value: V) -> Self;

    /// Returns the first values of a slice, or `None` if it is too short.
    #[doc(hidden)]
    fn first_of(values: &[V]) -> Option<&Self>;

    /// Returns the last values of a slice, or `None` if it is too short.
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
