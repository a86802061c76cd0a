//! Functions that a model may have: purpose, name, arguments and result of each.

mod argument;
mod catalogue;
mod derivatives;
mod differentiated;
mod forms;
mod naming;
mod of_link;
mod purpose;

pub use argument::{Argument, ResultShape};
pub use catalogue::is_method;
pub use differentiated::Differentiated;
pub(crate) use forms::{CANONICAL, DRIVE_WEIGHTS};
pub use forms::{
    Cause, Counting, EnergyDefinition, EntryState, LINK_PROPERTIES, NormalFormFunction,
    ObservableForm, PointKind,
};
pub use naming::{Naming, Signature, SliceFunction};
pub use of_link::{BodyFunction, LinkFunction, ScaleFunction};
pub use purpose::Purpose;
