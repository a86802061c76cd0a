//! Errors of several kinds, each with its message beside it.

/// Declares an error: its kinds as an enum has them, each with the message that it is shown
/// by, which may name the fields. What a kind holds without a field has a name for that.
macro_rules! errors {
    (
        $(#[$about:meta])*
        pub enum $name:ident {
            $(
                $(#[$docs:meta])*
                $kind:ident
                $({ $($(#[$field_docs:meta])* $field:ident: $field_type:ty),+ $(,)? })?
                $(($held:ident: $held_type:ty))?
                => $message:literal,
            )+
        }
    ) => {
        $(#[$about])*
        pub enum $name {
            $(
                $(#[$docs])*
                $kind $({ $($(#[$field_docs])* $field: $field_type),+ })? $(($held_type))?,
            )+
        }

        impl core::fmt::Display for $name {
            // Messages need not name all that a kind holds.
            #[allow(unused_variables)]
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match self {
                    $(Self::$kind $({ $($field),+ })? $(($held))? => write!(f, $message),)+
                }
            }
        }
    };
}

pub(crate) use errors;
