//! Docs of the functions that return derivatives by arguments and parameters.

use super::Emission;
use super::docs::wrapped_names;
use crate::functions::{Argument, Differentiated, Naming, Purpose};

impl Emission<'_> {
    /// Returns the documentation of the derivatives of a weighted sum of accelerations.
    pub(super) fn pullback_meaning(&self, of: Purpose) -> Vec<String> {
        let signature = Naming::of(self.scene, self.mechanics).signature(of);
        vec![
            format!(
                "Derivatives of the sum Σ w θ̈ of the accelerations of [`{name}`](Self::{name}), each multiplied by a number w of `weights`: {}.",
                self.places_of_derivatives(&signature.arguments),
                name = signature.name,
            ),
            String::new(),
            format!(
                "There is one array for each of these. A derivative by x is the product of w with a column of the Jacobian matrix, Σ_i w_i ∂θ̈_i/∂x, in the unit of w θ̈ divided by that of x. {}",
                match self.scene.in_loops() {
                    true => VIRTUAL_POWER,
                    false => BACKWARDS,
                }
            ),
        ]
    }

    /// Returns the documentation of the gradient of a function with one number as its result.
    pub(super) fn gradient_meaning(&self, of: Differentiated) -> Vec<String> {
        let signature = Naming::of(self.scene, self.mechanics).signature(of.purpose());
        let whole = match of {
            Differentiated::TruncatedTransfer(..) | Differentiated::ExactTransfer(..) => {
                "the sum of both parts of "
            }
            Differentiated::KineticEnergy
            | Differentiated::PotentialEnergy
            | Differentiated::SubHamiltonian(_)
            | Differentiated::Observable(..) => "",
        };
        vec![
            format!(
                "Derivatives of {whole}[`{name}`](Self::{name}): {}.",
                self.places_of_derivatives(&signature.arguments),
                name = signature.name,
            ),
            String::new(),
            format!(
                "There is one array for each of these. A derivative by x has the unit of the function divided by that of x. {BACKWARDS}"
            ),
        ]
    }

    /// Names what the derivatives are taken by, in the order of the returned arrays.
    fn places_of_derivatives(&self, arguments: &[Argument]) -> String {
        let places = arguments
            .iter()
            .filter(|argument| **argument != Argument::Time);
        let places: Vec<String> = places
            .map(|argument| format!("by `{}`", argument.name()))
            .collect();
        let parameters = self.scene.parameters.iter();
        let parameters: Vec<&str> = parameters.map(|own| own.name.as_str()).collect();
        let last = match parameters.is_empty() {
            true => "by the parameters, of which this model has none".to_owned(),
            false => {
                let names = wrapped_names(&parameters);
                format!("by the parameters {}", names.trim_end_matches('.'))
            }
        };
        format!("{}, and {last}", places.join(", "))
    }
}

/// Method and cost of derivatives.
const BACKWARDS: &str = "All are computed in one pass from the results back to the arguments (reverse mode: Griewank and Walther, Evaluating Derivatives, 2008, chapter 3). The cost includes that of the function itself.";

/// Method and cost of derivatives of trees in loops.
const VIRTUAL_POWER: &str = "A change δ of the state or of a constant changes the sum by λ·δ(Q − M θ̈ − b) with M λ = w, which is a change of the virtual power of all forces along λ. Two solves of the equations of motion and one pass from the root to the leaves and back compute all derivatives, the function itself included. O(links), and O(1) for each constant that depends on a parameter.";
