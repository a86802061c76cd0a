//! What tests of the compiler alone share. Nothing here depends on the macro or the runtime,
//! so that a change of the compiler builds itself and its tests, and no more.

pub mod front_end;
pub mod mistakes;
pub mod random;
pub mod source;
