//! Names that functions are called after.

use super::{Argument, ResultShape};

/// Name, arguments and result of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Name of the function.
    pub name: String,
    /// Arguments in order.
    pub arguments: Vec<Argument>,
    /// Shape of the result.
    pub shape: ResultShape,
}

/// Names that the functions of a model are called after, and lengths of their arrays.
#[derive(Clone, Debug)]
pub struct Naming {
    /// True if there is a drive: functions of all forces take the time then.
    pub driven: bool,
    /// True if there are straight dampers: the power of friction depends on the angles then.
    pub damped_by_angle: bool,
    /// Number of links.
    pub links: usize,
    /// Number of sectors.
    pub sectors: usize,
    /// Ends of the names of functions about one difference, transfer by transfer.
    pub places: Vec<String>,
    /// Sets of prescribed links: their names, and the number of links in each.
    pub prescribed: Vec<(String, usize)>,
    /// Names of observables, and whether symmetric coordinates are their variables.
    pub observables: Vec<(String, bool)>,
    /// Names of the sectors of small differences.
    pub transverse: Vec<String>,
}

impl Naming {
    /// The names of a model about which nothing is known: stars stand for what a
    /// description tells.
    pub(super) fn any() -> Self {
        let star = || "*".to_owned();
        Self {
            driven: false,
            damped_by_angle: false,
            links: 0,
            sectors: 0,
            places: vec![star()],
            prescribed: vec![(star(), 0)],
            observables: Vec::new(),
            transverse: vec![star()],
        }
    }
}
