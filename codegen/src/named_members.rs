//! Enums whose members have names in code, and some a meaning in words: one list for all
//! that is said of them.

/// Declares an enum with `ALL`, its members in their order, `name` and `named`. Members with a
/// meaning, as in `Mass = "mass": "mass (kg)"`, have it as their docs and by `meaning`.
macro_rules! named_members {
    (
        $(#[$about:meta])*
        pub enum $name:ident {
            $($(#[$docs:meta])* $member:ident = $text:literal,)+
        }
    ) => {
        $(#[$about])*
        pub enum $name {
            $($(#[$docs])* $member,)+
        }

        impl $name {
            /// All of them, in their order.
            pub const ALL: [Self; [$($text),+].len()] = [$(Self::$member),+];

            /// Name of the member.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$member => $text,)+
                }
            }

            /// Returns the member of that name, if there is one.
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|member| member.name() == name)
            }
        }
    };
    (
        $(#[$about:meta])*
        pub enum $name:ident {
            $($member:ident = $text:literal: $meaning:literal,)+
        }
    ) => {
        $crate::named_members::named_members! {
            $(#[$about])*
            pub enum $name {
                $(#[doc = $meaning] $member = $text,)+
            }
        }

        impl $name {
            /// Meaning of the member in words.
            pub fn meaning(self) -> &'static str {
                match self {
                    $(Self::$member => $meaning,)+
                }
            }
        }
    };
}

pub(crate) use named_members;
