//! Macro for error enums that defines each variant together with its message.

/// Declares an error enum. Each variant has a message, which may contain its fields. A tuple
/// variant needs a name for its value.
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
            // A message need not contain all fields of its variant.
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
