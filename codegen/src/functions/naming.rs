//! Names that occur in function names, and array lengths of a model.

use super::{Argument, ResultShape};

/// Name, arguments and result type of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Name of the function.
    pub name: String,
    /// Arguments in order.
    pub arguments: Vec<Argument>,
    /// Shape of the result.
    pub shape: ResultShape,
}

/// A function on slices, from which the runtime's `Computes` derives all forms of the function. Its
/// argument slices have the names of the arguments of the model's function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SliceFunction {
    /// Name of the function in the module `functions` of the runtime crate.
    pub name: &'static str,
    /// Name of the index argument, if several functions of a model share the name.
    pub index: Option<&'static str>,
    /// Names of the slices to which it writes results.
    pub results: &'static [&'static str],
}

impl Signature {
    /// Returns the names of the arguments that are arrays.
    pub fn slices(&self) -> impl Iterator<Item = &'static str> {
        let arrays = self.arguments.iter();
        let arrays = arrays.filter(|argument| **argument != Argument::Time);
        arrays.map(|argument| argument.name())
    }
}

/// Names that occur in the function names of a model, and the lengths of its arrays.
#[derive(Clone, Debug)]
pub struct Naming {
    /// True if there is a drive: functions of all forces then take the time.
    pub driven: bool,
    /// True if there are straight dampers: the power of friction then depends on the angles.
    pub damped_by_angle: bool,
    /// Number of links.
    pub links: usize,
    /// Number of parameters.
    pub parameters: usize,
    /// Number of sectors.
    pub sectors: usize,
    /// Endings of the names of functions of one difference, one per transfer.
    pub places: Vec<String>,
    /// Sets of prescribed links: name of each, and the number of its links.
    pub prescribed: Vec<(String, usize)>,
    /// Names of observables; true if their variables are symmetric coordinates.
    pub observables: Vec<(String, bool)>,
    /// Names of the sectors of small differences.
    pub transverse: Vec<String>,
}

impl Naming {
    /// Returns the naming of an unknown model: stars stand for the names that a description would
    /// give.
    pub(super) fn any() -> Self {
        let star = || "*".to_owned();
        Self {
            driven: false,
            damped_by_angle: false,
            links: 0,
            parameters: 0,
            sectors: 0,
            places: vec![star()],
            prescribed: vec![(star(), 0)],
            observables: Vec::new(),
            transverse: vec![star()],
        }
    }
}

/// Returns the shape of a result of at most four arrays with these lengths.
pub(super) fn arrays(lengths: impl IntoIterator<Item = usize>) -> ResultShape {
    let mut all = [None; 4];
    for (place, length) in all.iter_mut().zip(lengths) {
        *place = Some(length);
    }
    ResultShape::Arrays(all)
}
