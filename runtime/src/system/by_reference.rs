//! Traits of models and systems, for references to them.

/// Implements a trait for references to what implements it. Its methods are listed as
/// signatures; all are handed on, those with a default too. Generic ones are not for
/// this macro.
macro_rules! by_reference {
    (impl<T $(: $bound:ident)?> $trait:ident<T> for &P $(where P: ?$sized:ident)? {
        $(const $constant:ident: $kind:ty;)*
        $(static fn $of_type:ident($index:ident: $number:ty) -> $answer:ty;)*
        $(fn $function:ident(&self $(, $argument:ident: $type:ty)*) $(-> $result:ty)?;)*
    }) => {
        impl<T $(: $bound)?, P: $trait<T> $(+ ?$sized)?> $trait<T> for &P {
            $(const $constant: $kind = P::$constant;)*

            $(
                #[inline]
                fn $of_type($index: $number) -> $answer {
                    P::$of_type($index)
                }
            )*

            $(
                #[inline]
                fn $function(&self $(, $argument: $type)*) $(-> $result)? {
                    (**self).$function($($argument),*)
                }
            )*
        }
    };
}

pub(super) use by_reference;
