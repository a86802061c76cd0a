//! Macro that implements traits of models and systems for references to them.

/// Implements a trait for references to types that implement it. The methods are listed as
/// signatures; all are forwarded, including methods with a default. Functions that are generic over
/// the scalar are listed after `for`.
macro_rules! by_reference {
    (impl<T $(: $bound:ident)?> $trait:ident<T> for &P $(where P: ?$sized:ident)? {
        $(const $constant:ident: $kind:ty;)*
        $(for fn $of_scalar:ident<$scalar:ident: $kind_of_scalar:ident>(
            $($own:ident: $own_type:ty),*
        );)*
        $(fn $function:ident(&self $(, $argument:ident: $type:ty)*) $(-> $result:ty)?;)*
    }) => {
        impl<T $(: $bound)?, P: $trait<T> $(+ ?$sized)?> $trait<T> for &P {
            $(const $constant: $kind = P::$constant;)*

            $(
                #[inline(always)]
                fn $of_scalar<$scalar: $kind_of_scalar>($($own: $own_type),*) {
                    P::$of_scalar($($own),*)
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
