//! The program for Taylor coefficients of the motion.
//!
//! The recurrences of the runtime contain the equation of motion except for its constants: those of
//! the articulated recursion, which determine the mass matrix and its centrifugal terms, and
//! gravity. All other terms are a separate program.

use super::entry_list::EntryList;
use super::lower::Environment;
use super::{ValueId, scale};
use crate::exact::Rational;
use crate::functions::{Argument, Purpose};
use crate::mechanics::expression::{Expr, Role, SymbolId};
use crate::mechanics::{Frame, Mechanics, Trigonometric};
use crate::scene::{LinkId, Scene};

/// Outputs of the entry point; each list has one value per link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaylorOutputs {
    /// Sines of the angles.
    pub sines: Vec<ValueId>,
    /// Cosines of the angles.
    pub cosines: Vec<ValueId>,
    /// Diagonal of the mass matrix.
    pub inertias: Vec<ValueId>,
    /// First moment of the mass that the link carries, along and across the link; zero for the
    /// root, whose pivot does not move with it.
    pub moments: [Vec<ValueId>; 2],
    /// Position of the link's pivot on its parent, along and across; zero for the root.
    pub attachments: [Vec<ValueId>; 2],
    /// Coefficients of gravity's torque: of the sine and of the cosine of the angle.
    pub weights: [Vec<ValueId>; 2],
    /// All other terms of the equation of motion.
    pub bias: Vec<ValueId>,
}

impl TaylorOutputs {
    /// Splits the outputs of the entry point: `links` values of each kind, then the rest.
    pub(crate) fn of(outputs: &[ValueId], links: usize) -> Self {
        let mut lists = outputs.chunks(links);
        let mut next = || lists.next().unwrap_or_default().to_vec();
        Self {
            sines: next(),
            cosines: next(),
            inertias: next(),
            moments: [next(), next()],
            attachments: [next(), next()],
            weights: [next(), next()],
            bias: next(),
        }
    }

    /// Returns the values with which an expansion starts: sines, then cosines.
    pub(crate) fn roots(&self) -> Vec<ValueId> {
        [&self.sines, &self.cosines]
            .into_iter()
            .flatten()
            .copied()
            .collect()
    }

    fn list(&self) -> Vec<ValueId> {
        let Self {
            sines,
            cosines,
            inertias,
            moments: [moments, lateral_moments],
            attachments: [attachments, lateral_attachments],
            weights: [weights, lateral_weights],
            bias,
        } = self;
        let state = [sines, cosines, inertias, moments, lateral_moments];
        let rest = [attachments, lateral_attachments, weights, lateral_weights];
        let lists = state.into_iter().chain(rest).chain([bias]);
        lists.flatten().copied().collect()
    }
}

impl EntryList<'_, '_> {
    pub(super) fn taylor(&mut self, scene: &Scene, mechanics: &Mechanics) {
        let frame = &mechanics.absolute;
        let mut environment = Environment::new(frame, Argument::Theta, Some(Argument::Omega), None);
        let zero = self.lowering.builder.integer(0);
        let zeros = || vec![zero; frame.coordinates.len()];
        let mut outputs = TaylorOutputs {
            sines: Vec::new(),
            cosines: Vec::new(),
            inertias: Vec::new(),
            moments: [zeros(), zeros()],
            attachments: [zeros(), zeros()],
            weights: [zeros(), zeros()],
            bias: Vec::new(),
        };
        (outputs.sines, outputs.cosines) = self.sines_and_cosines(frame);
        for (link, bias) in frame.bias.iter().enumerate() {
            let joint = &mechanics.articulation.joints[scene.links[link].orbit.0];
            let inertia = self.lowering.expr(&mut environment, &joint.inertia);
            outputs.inertias.push(inertia);
            for component in (0..2).filter(|_| link > 0) {
                let mut at = |expr| self.lowering.expr(&mut environment, expr);
                outputs.moments[component][link] = at(&joint.moment[component]);
                outputs.attachments[component][link] = at(&joint.pivot[component]);
            }
            let mut rest = Vec::new();
            for term in bias.terms() {
                if is_centrifugal(mechanics, term) {
                    continue;
                }
                match gravity(mechanics, frame, term, link) {
                    Some((function, constant)) => {
                        let constant = self.lowering.expr(&mut environment, &constant);
                        let place = &mut outputs.weights[function as usize][link];
                        *place = self.lowering.builder.add(*place, constant);
                    }
                    None => rest.push(term.clone()),
                }
            }
            let rest = match rest.len() {
                0 => Expr::zero(),
                1 => rest.remove(0),
                _ => Expr::Sum(rest),
            };
            let rest = self.lowering.expr(&mut environment, &rest);
            outputs.bias.push(rest);
        }
        self.choose_units(scene, &mut outputs);
        let mut list = outputs.list();
        // The recurrence of a sine or cosine needs both.
        let builder = &mut self.lowering.builder;
        for id in builder.needed(&outputs.bias) {
            list.extend(builder.partner(id));
        }
        self.push(Purpose::TaylorCoefficients, list);
    }

    /// Returns the sines and cosines of all angles, with names.
    fn sines_and_cosines(&mut self, frame: &Frame) -> (Vec<ValueId>, Vec<ValueId>) {
        let names = self.lowering.coordinate_names(frame);
        let builder = &mut self.lowering.builder;
        let named = names.iter().enumerate().map(|(link, name)| {
            let angle = builder.input(Argument::Theta, link);
            let (sine, cosine) = (builder.sin(angle), builder.cos(angle));
            (
                builder.name(sine, &format!("sin_{name}")),
                builder.name(cosine, &format!("cos_{name}")),
            )
        });
        named.unzip()
    }

    /// Chooses units of length and of mass, which change only the rounding: one rounded constant
    /// less is one error less in long motions. If all constants are known, the unit of length makes
    /// all distances whole numbers, and the unit of mass is the one with the smallest rounding
    /// errors of the others. Otherwise the pivot distance of the last link is 1, and so is its
    /// moment of inertia.
    fn choose_units(&mut self, scene: &Scene, outputs: &mut TaylorOutputs) {
        self.choose_length(scene, outputs);
        let factor = self.factor(scene, outputs);
        let builder = &mut self.lowering.builder;
        let TaylorOutputs {
            sines: _,
            cosines: _,
            inertias,
            moments,
            attachments: _,
            weights,
            bias,
        } = outputs;
        let Some(&unit) = inertias.last() else {
            unreachable!("a tree has links");
        };
        let factor = factor.map(|factor| {
            // Names products with it `inertia_parent_scaled`.
            let number = builder.number(factor);
            builder.called(number, "scaled")
        });
        let constants = [inertias, bias].into_iter().chain(moments).chain(weights);
        for value in constants.flatten() {
            *value = match factor {
                Some(factor) => builder.mul(*value, factor),
                None => builder.div(*value, unit),
            };
        }
    }

    /// Measures lengths in their greatest common measure if they have one, else in the pivot
    /// distance of the last link if there is one.
    fn choose_length(&mut self, scene: &Scene, outputs: &mut TaylorOutputs) {
        let builder = &mut self.lowering.builder;
        let lengths = outputs.attachments.iter().flatten();
        let known: Option<Vec<Rational>> = lengths.map(|&id| builder.exact(id)).collect();
        let length = match known.and_then(|lengths| scale::common_measure(&lengths)) {
            Some(measure) => builder.number(measure),
            None => {
                let last = outputs.attachments.iter().filter_map(|list| list.last());
                let mut usable = last.filter(|length| builder.is_never_zero(**length, scene));
                let Some(&length) = usable.next() else { return };
                length
            }
        };
        let names = [
            ("moment", "attachment"),
            ("lateral_moment", "lateral_attachment"),
        ];
        for (component, (moment, attachment)) in names.into_iter().enumerate() {
            for (link, template) in scene.links.iter().enumerate() {
                let orbit = &scene.orbits[template.orbit.0].name;
                let place = &mut outputs.moments[component][link];
                let value = builder.mul(*place, length);
                *place = builder.called(value, &format!("{moment}_{orbit}"));
                let place = &mut outputs.attachments[component][link];
                let value = builder.div(*place, length);
                *place = builder.called(value, &format!("{attachment}_{orbit}"));
            }
        }
    }

    /// Returns the factor for constants that are all known.
    fn factor(&mut self, scene: &Scene, outputs: &TaylorOutputs) -> Option<Rational> {
        let builder = &mut self.lowering.builder;
        let exact = |id: &ValueId| builder.exact(*id);
        let lists = [&outputs.inertias].into_iter();
        let lists = lists.chain(&outputs.moments).chain(&outputs.weights);
        let mut constants = lists.flatten().map(exact).collect::<Option<Vec<_>>>()?;
        constants.retain(|constant| !constant.is_zero());
        // The elimination of a link without children divides by its inertia.
        let parents: Vec<_> = scene.links.iter().map(|link| link.parent).collect();
        let links = outputs.inertias.iter().enumerate();
        let leaves = links.filter(|(link, _)| !parents.contains(&Some(LinkId(*link))));
        let divisors = leaves.map(|(_, inertia)| exact(inertia));
        scale::factor(&constants, &divisors.collect::<Option<Vec<_>>>()?)
    }
}

/// Function of the angle in a term of gravity.
#[derive(Clone, Copy)]
enum GravityTerm {
    Sine,
    Cosine,
}

/// Returns the function and the constant of a term c sin θ_i or c cos θ_i in the equation of link
/// i.
fn gravity(
    mechanics: &Mechanics,
    frame: &Frame,
    term: &Expr,
    link: usize,
) -> Option<(GravityTerm, Expr)> {
    let angle = frame.coordinates[link];
    let mut found = None;
    let mut constant = Vec::new();
    for factor in term.factors() {
        match factor {
            Expr::Symbol(symbol)
                if found.is_none() && role(mechanics, *symbol) == Role::Trigonometric =>
            {
                found = match mechanics.trigonometry[symbol] {
                    Trigonometric::Sin(a) if a == angle => Some(GravityTerm::Sine),
                    Trigonometric::Cos(a) if a == angle => Some(GravityTerm::Cosine),
                    _ => return None,
                };
            }
            other => {
                let mut is_constant = true;
                other.for_each_symbol(&mut |symbol| {
                    let role = role(mechanics, symbol);
                    is_constant &= matches!(role, Role::Parameter | Role::Constant);
                });
                if !is_constant {
                    return None;
                }
                constant.push(other.clone());
            }
        }
    }
    let constant = match constant.len() {
        0 => Expr::Number(1_i64.into()),
        1 => constant.remove(0),
        _ => Expr::Product(constant),
    };
    Some((found?, constant))
}

/// Returns true if a term contains the square of a velocity. The recurrences compute these terms
/// from the derivatives of the mass matrix.
fn is_centrifugal(mechanics: &Mechanics, term: &Expr) -> bool {
    term.factors().iter().any(|factor| match factor {
        Expr::Power(base, 2) => match base.as_ref() {
            Expr::Symbol(symbol) => role(mechanics, *symbol) == Role::Velocity,
            _ => false,
        },
        _ => false,
    })
}

fn role(mechanics: &Mechanics, symbol: SymbolId) -> Role {
    mechanics.symbols.get(symbol).role
}
