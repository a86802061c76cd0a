//! Signatures of functions that return derivatives of other functions.

use super::naming::{Naming, Signature, arrays};
use super::{Argument, Differentiated, Purpose};

/// Declares the functions that have a gradient, each with the fields of its purpose.
macro_rules! with_gradient {
    ($($function:ident $(($($field:ident),+))?;)+) => {
        impl Differentiated {
            /// Returns the function with a purpose; `None` if its gradient cannot be requested.
            pub fn of(purpose: Purpose) -> Option<Self> {
                $(if let Purpose::$function $(($($field),+))? = purpose {
                    return Some(Self::$function $(($($field),+))?);
                })+
                None
            }

            /// Returns the purpose of the function.
            pub fn purpose(self) -> Purpose {
                match self {
                    $(Self::$function $(($($field),+))? => {
                        Purpose::$function $(($($field),+))?
                    })+
                }
            }
        }
    };
}

with_gradient! {
    KineticEnergy;
    PotentialEnergy;
    SubHamiltonian(transfer);
    TruncatedTransfer(transfer, counting, order);
    ExactTransfer(transfer, state);
    Observable(number, form);
}

impl Naming {
    /// Returns the signature of the derivatives of a weighted sum of a function's results.
    pub(super) fn pullback(&self, of: Purpose) -> Signature {
        let mut signature = self.derivatives(of, "pullback");
        signature.arguments.push(Argument::Weights);
        signature
    }

    /// Returns the signature of the derivatives of a function with one number as its result.
    pub(super) fn gradient(&self, of: Differentiated) -> Signature {
        self.derivatives(of.purpose(), "gradient")
    }

    /// Returns the signature of a function that returns derivatives by all arguments except the
    /// time, and by the parameters: an array for each argument, and one for the parameters.
    fn derivatives(&self, of: Purpose, kind: &str) -> Signature {
        let Signature {
            name, arguments, ..
        } = self.signature(of);
        let places = arguments
            .iter()
            .filter(|argument| **argument != Argument::Time);
        let shape = arrays(places.map(|_| self.links).chain([self.parameters]));
        Signature {
            name: format!("{name}_{kind}"),
            arguments,
            shape,
        }
    }
}
