//! Symbols that observables can use.

use std::collections::BTreeMap;

use super::coordinates::symmetric_coordinates;
use super::observed::{CoordinateIndex, ObservedAtom, Variable, VariableKind};
use crate::report::{Faults, OutputMessage};
use proc_macro2::Span;

use super::{FrictionContact, FrictionLaw, LinkId, ParameterId, PassiveTorques, Quantity, Scene};

/// Meaning of a name in an observable.
pub(super) enum Meaning {
    /// A single quantity.
    One(ObservedAtom),
    /// Both a parameter of the user and a symbol of the scene.
    Several,
}

/// All names with their meanings.
pub(super) struct ObservableSymbols {
    meanings: BTreeMap<String, Meaning>,
    /// Name of the last link, for examples in messages.
    example: String,
}

impl ObservableSymbols {
    /// Collects the symbols of a scene whose tree is complete.
    pub(super) fn of(scene: &Scene) -> Self {
        let mut symbols = Self::without_constants(scene);
        for name in constants(scene) {
            symbols.add(name.clone(), ObservedAtom::Constant(name));
        }
        for (index, parameter) in scene.parameters.iter().enumerate() {
            // A parameter `gravity` in `gravity = gravity` is not ambiguous.
            if !is_gravity(scene, index) {
                let quantity = Quantity::parameter(ParameterId(index));
                symbols.add(parameter.name.clone(), ObservedAtom::Known(quantity));
            }
        }
        symbols
    }

    /// Collects the symbols except constants of the model: coordinates, their velocities and
    /// momenta, energies and gravity.
    fn without_constants(scene: &Scene) -> Self {
        let mut symbols = Self {
            meanings: BTreeMap::new(),
            example: scene
                .links
                .last()
                .map(|l| l.name.clone())
                .unwrap_or_default(),
        };
        for (index, link) in scene.links.iter().enumerate() {
            symbols.coordinate(&link.name, CoordinateIndex::Absolute(index));
        }
        // The mean of a single link is the link's own angle.
        let shared = |(_, coordinate): &(usize, _)| {
            let coordinate: &super::Coordinate = coordinate;
            coordinate.weights.len() > 1
        };
        if !scene.groups.is_empty() {
            let coordinates = symmetric_coordinates(scene);
            for (index, coordinate) in coordinates.into_iter().enumerate().filter(shared) {
                symbols.coordinate(&coordinate.name, CoordinateIndex::Symmetric(index));
            }
        }
        symbols.add("kinetic_energy".into(), ObservedAtom::KineticEnergy);
        symbols.add("potential_energy".into(), ObservedAtom::PotentialEnergy);
        let gravity = ObservedAtom::Known(scene.gravity.clone());
        symbols.add("gravity".into(), gravity);
        symbols
    }

    fn coordinate(&mut self, name: &str, coordinate: CoordinateIndex) {
        for (prefix, kind) in [
            ("theta", VariableKind::Angle),
            ("omega", VariableKind::Velocity),
            ("p", VariableKind::Momentum),
        ] {
            let name = format!("{prefix}_{name}");
            let variable = Variable {
                name: name.clone(),
                kind,
                coordinate,
            };
            self.add(name, ObservedAtom::Variable(variable));
        }
    }

    fn add(&mut self, name: String, atom: ObservedAtom) {
        let meaning = match self.meanings.contains_key(&name) {
            true => Meaning::Several,
            false => Meaning::One(atom),
        };
        self.meanings.insert(name, meaning);
    }

    pub(super) fn get(&self, name: &str) -> Option<&Meaning> {
        self.meanings.get(name)
    }

    pub(super) fn names(&self) -> Vec<&str> {
        self.meanings.keys().map(String::as_str).collect()
    }

    pub(super) fn example(&self) -> &str {
        &self.example
    }

    /// Returns true if the name denotes a quantity that depends on the motion.
    pub(super) fn is_variable(&self, name: &str) -> bool {
        let meaning = self.get(name);
        matches!(meaning, Some(Meaning::One(ObservedAtom::Variable(_))))
    }

    /// Returns true if the name denotes a constant of the model, which has a getter function.
    pub(super) fn is_constant(&self, name: &str) -> bool {
        let meaning = self.get(name);
        matches!(meaning, Some(Meaning::One(ObservedAtom::Constant(_))))
    }
}

/// First words of names that a parameter cannot have.
const FIRST_WORDS: [&str; 5] = ["theta", "omega", "kinetic", "potential", "gravity"];

/// Returns true if the parameter is the gravitational acceleration and is named `gravity`.
fn is_gravity(scene: &Scene, parameter: usize) -> bool {
    scene.parameters[parameter].name == "gravity"
        && scene.gravity == Quantity::parameter(ParameterId(parameter))
}

/// Reports parameters that are named like an angle, a velocity, an energy or gravity. Two kinds of
/// names are accepted: those of constants of the model, because `inertia = inertia_arm` is clear,
/// and those of momenta, which nobody expects in a drive. In observables, where both meanings are
/// possible, these are refused too.
pub(super) fn check_meanings(scene: &Scene, spans: &[Span], report: &mut Faults) {
    let mut first_words = scene
        .parameters
        .iter()
        .filter_map(|own| own.name.split('_').next());
    if !first_words.any(|word| FIRST_WORDS.contains(&word)) {
        return;
    }
    let symbols = ObservableSymbols::without_constants(scene);
    for (index, (parameter, &span)) in scene.parameters.iter().zip(spans).enumerate() {
        let is_other = match symbols.get(&parameter.name) {
            None => false,
            Some(Meaning::One(ObservedAtom::Variable(variable))) => {
                variable.kind != VariableKind::Momentum
            }
            Some(_) => true,
        };
        if is_other && !is_gravity(scene, index) {
            let name = parameter.name.clone();
            report.error(span, OutputMessage::AmbiguousSymbol { name });
        }
    }
}

/// Returns the names of the model's constants, including constants that are zero.
fn constants(scene: &Scene) -> Vec<String> {
    let mut names = Vec::new();
    let orbit = |link: LinkId| &scene.orbits[scene.links[link.0].orbit.0];
    for own in &scene.orbits {
        let Some(&first) = own.links.first() else {
            continue;
        };
        add_constants(
            scene,
            &own.name,
            &[first],
            |link| &orbit(link).name,
            &mut names,
        );
    }
    if !scene.has_unequal_copies() {
        return names;
    }
    let coordinates = symmetric_coordinates(scene);
    for node in scene.unequal_nodes(&coordinates) {
        let add = |own: &str, names: &mut Vec<String>| {
            add_constants(scene, own, &node.links, |link| &orbit(link).node, names);
        };
        add(&node.name, &mut names);
        for &index in node.coordinates.iter().skip(1) {
            let mut mismatches = Vec::new();
            add(&coordinates[index].name, &mut mismatches);
            names.extend(mismatches.iter().map(|name| format!("mismatch_{name}")));
        }
    }
    names
}

/// Adds the names of the constants of `links`. In these names the links are called `own`; `other`
/// returns the name used for an ancestor.
fn add_constants<'a>(
    scene: &'a Scene,
    own: &str,
    links: &[LinkId],
    other: impl Fn(LinkId) -> &'a String,
    names: &mut Vec<String>,
) {
    for word in ["inertia", "gravity", "lateral_gravity"] {
        names.push(format!("{word}_{own}"));
    }
    type Present = fn(&PassiveTorques) -> bool;
    let torques: [(&str, Present); 4] = [
        ("friction", |own| !own.friction.is_zero()),
        ("drag", |own| !own.drag.is_zero()),
        ("spring", |own| !own.spring.is_zero()),
        ("rest", |own| !own.rest.is_zero()),
    ];
    let passive = || links.iter().map(|link| &scene.links[link.0].passive);
    for (word, is_present) in torques {
        if passive().any(is_present) {
            names.push(format!("{word}_{own}"));
        }
    }
    for place in FrictionContact::ALL {
        for torques in passive() {
            let constants = FrictionLaw::NAMES.into_constants().into_iter();
            let values = torques
                .law(place)
                .effective(Quantity::is_zero)
                .into_constants();
            for (constant, value) in constants.zip(values) {
                if let (Some(word), Some(_)) = (constant.words[place as usize], value) {
                    let name = format!("{word}_{own}");
                    if !names.contains(&name) {
                        names.push(name);
                    }
                }
            }
        }
    }
    let mut above = links.first().and_then(|first| scene.links[first.0].parent);
    while let Some(ancestor) = above {
        let other = other(ancestor);
        names.push(format!("coupling_{own}_{other}"));
        names.push(format!("lateral_coupling_{own}_{other}"));
        above = scene.links[ancestor.0].parent;
    }
}
