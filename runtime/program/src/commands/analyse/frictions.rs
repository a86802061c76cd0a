//! Viscous friction that may be missing in the constants of a tree.

use branched_pendulum_trees::{ParameterUse, PendulumTree};

/// A viscous friction coefficient, and the pivots in which it acts.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionCoefficient {
    /// Indices of the nodes in whose pivots it acts.
    pub pivots: Vec<usize>,
    /// The pivots in words.
    pub place: String,
    /// The parameter with its value; `None` if the description has no such parameter.
    parameter: Option<(String, f64)>,
    /// Text to write into the description if there is no parameter.
    otherwise: String,
}

impl FrictionCoefficient {
    /// Returns the command-line option, or the text for the description, that increases the
    /// friction by `lacking` (N m s).
    pub fn option(&self, lacking: f64) -> String {
        match &self.parameter {
            Some((name, value)) => format!("--set {name}={:.3e}", value + lacking),
            None => self.otherwise.clone(),
        }
    }
}

/// Returns the friction coefficients of a tree: one for each friction parameter, and one for each
/// node without such a parameter.
pub fn coefficients(tree: &PendulumTree) -> Vec<FrictionCoefficient> {
    let description = tree.description();
    let mut all: Vec<FrictionCoefficient> = Vec::new();
    for (pivot, node) in description.nodes().iter().enumerate() {
        let is_viscous = |name: &&String| {
            let uses = description.uses_of(name);
            uses == [ParameterUse::ViscousFriction]
        };
        let name = node.friction.iter().find(is_viscous);
        let parameter = name.and_then(|name| Some((name.clone(), tree.value(name)?)));
        let place = match node.links.len() {
            1 => format!("the pivot of `{}`", node.name),
            _ => format!("the pivots of `{}`", node.name),
        };
        let same = all
            .iter_mut()
            .find(|own| parameter.is_some() && own.parameter == parameter);
        if let Some(same) = same {
            same.pivots.push(pivot);
            same.place += &format!(" and {place}");
            continue;
        }
        all.push(FrictionCoefficient {
            pivots: vec![pivot],
            place,
            parameter,
            otherwise: match &node.friction[..] {
                [] => format!("friction of `{}` in the description", node.name),
                parameters => format!("--set {}", parameters.join(", ")),
            },
        });
    }
    all
}
