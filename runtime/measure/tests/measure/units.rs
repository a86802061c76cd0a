//! Modules of the library whose unit tests need private items, compiled here with the part of the
//! library that they use, so that the tests do not compile the whole library again.

#![allow(dead_code, unreachable_pub)]

#[path = "../../src/spectrum/fit.rs"]
mod fit;
#[path = "../../src/spectrum/trend.rs"]
mod trend;
#[path = "../../src/spectrum/window.rs"]
mod window;

use window::Window;
