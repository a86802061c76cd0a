//! A macro for enums whose members have names in code, and some of them a description in words: one
//! list defines both.

/// Declares an enum with `ALL`, its members in order, and the methods `name` and `named`. If
/// members have a meaning, as in `Mass = "mass": "mass (kg)"`, it becomes their docs and the result
/// of `meaning`.
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
            /// All members, in order of declaration.
            pub const ALL: [Self; [$($text),+].len()] = [$(Self::$member),+];

            /// Returns the name of the member in code.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$member => $text,)+
                }
            }

            /// Returns the member with the given name, if there is one.
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
            /// Returns the meaning of the member in words.
            pub fn meaning(self) -> &'static str {
                match self {
                    $(Self::$member => $meaning,)+
                }
            }
        }
    };
}

pub(crate) use named_members;
