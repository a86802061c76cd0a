//! The drive (physics §7): a torque on the root and a motion of its pivot, as functions of time.
//!
//! The frame of reference moves with the pivot. In it the pivot's acceleration a acts on every link
//! as the inertial force −m a at its centre of mass. Kinetic energy, potential energy and momenta
//! are therefore those of a tree on a fixed pivot, and the drive is a set of generalized forces
//! Q_i(t, θ).

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, Role, SymbolId};
use super::frame::DerivedFrame;
use super::letters;
use super::meaning::{DerivedDrive, DerivedMotion, Temporal};
use super::print::{latex, text};
use crate::scene::{Signal, SignalAtom, TimeFunction};
use std::collections::BTreeMap;
use std::convert::Infallible;

/// One component of the motion of the root's pivot.
#[derive(Clone, Debug, PartialEq)]
pub struct PivotMotion {
    /// Name of the axis: `x` or `y`.
    pub name: &'static str,
    /// Position of the root's pivot on this axis, in m.
    pub position: Expr,
    /// Acceleration, in m/s²; `None` if it is zero at all times.
    pub acceleration: Option<SymbolId>,
    /// Acceleration in the axes of the equations, in m/s².
    pub inner_acceleration: Expr,
}

/// External torque and forces on the tree.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveTerms {
    /// Definitions of the symbols that depend only on time; each uses only earlier ones.
    pub temporal: BTreeMap<SymbolId, Temporal>,
    /// Torque on the root, in N m.
    pub torque: Option<SymbolId>,
    /// Components of the root's pivot motion that the scene prescribes.
    pub pivot: Vec<PivotMotion>,
    /// Power Σ Q_i ω_i of the drive, in absolute angles, if energies are requested.
    pub power: Option<Expr>,
}

impl DriveTerms {
    /// Returns the symbol of time, if anything depends on it.
    pub fn time(&self) -> Option<SymbolId> {
        let mut symbols = self.temporal.iter();
        symbols.find_map(|(&symbol, meaning)| (*meaning == Temporal::Time).then_some(symbol))
    }
}

impl Derivation<'_> {
    /// Returns the work function W(t, θ), whose gradient at fixed time is the generalized forces of
    /// the drive: W = τ θ_root − a_x X − a_y Y. Here (X, Y) is the first moment of mass Σ m_l r_l
    /// minus its value at zero angles, so that Q_i = τ ∂θ_root/∂θ_i − Σ_l m_l a·∂r_l/∂θ_i.
    pub(super) fn drive_work(&mut self, angles: &[SymbolId]) -> Formula {
        let (torque, [x, y]) = self.drive_signals();
        let mut work = Vec::new();
        if !torque.is_zero() {
            work.push(&torque * &Formula::symbol(angles[0]));
        }
        if !x.is_zero() || !y.is_zero() {
            for ((along, lateral), &angle) in self.mass_moments(angles).iter().zip(angles) {
                let (cos, sin) = (self.cos(angle), self.sin(angle));
                let fall = &Formula::integer(1) - &Formula::symbol(cos);
                let sin = Formula::symbol(sin);
                let to_side = &(along * &sin) - &(lateral * &fall);
                let upwards = &(along * &fall) + &(lateral * &sin);
                work.push(-(&x * &to_side));
                work.push(-(&y * &upwards));
            }
        }
        work.into_iter().sum()
    }

    /// Returns the torque on the root and the acceleration of its pivot, in the axes of the
    /// equations, as symbols; absent ones are zero.
    pub(super) fn drive_signals(&mut self) -> (Formula, [Formula; 2]) {
        let mut accelerations = [Formula::zero(), Formula::zero()];
        let Some(scene) = self.scene.drive.as_ref() else {
            return (Formula::zero(), accelerations);
        };
        if let Some(torque) = &scene.torque {
            let value = self.signal(torque);
            self.drive.torque = self.given("drive_torque", "τ", "\\tau", value);
        }
        let axes = [("x", &scene.x), ("y", &scene.y)];
        for ((name, signal), place) in axes.into_iter().zip(&mut accelerations) {
            let Some(signal) = signal else { continue };
            let position = self.signal(signal);
            let velocity = self.time_derivative(&position);
            let acceleration = self.time_derivative(&velocity).expand();
            let code = format!("pivot_acceleration_{name}");
            let symbol = self.given(
                &code,
                &format!("a_{name}"),
                &format!("a_{{{name}}}"),
                acceleration,
            );
            let outer = symbol.map_or_else(Formula::zero, Formula::symbol);
            *place = match name {
                "y" => self.upwards(outer),
                _ => outer,
            };
            self.drive.pivot.push(DerivedMotion {
                name,
                position,
                acceleration: symbol,
                inner_acceleration: place.clone(),
            });
        }
        let torque = self.drive.torque;
        (
            torque.map_or_else(Formula::zero, Formula::symbol),
            accelerations,
        )
    }

    /// Returns the first moment of the mass that each link carries about the link's pivot, along
    /// and across the link.
    fn mass_moments(&mut self, angles: &[SymbolId]) -> Vec<(Formula, Formula)> {
        let total = self.heights(angles, |derivation, link| derivation.quantity(&link.mass));
        let mut moments = Vec::new();
        for (index, &angle) in angles.iter().enumerate() {
            let orbit = self.orbit_name(index);
            let (cos, sin) = (self.cos(angle), self.sin(angle));
            let slope = |function| total.derivative(function).expand();
            let (along, lateral) = (-slope(cos), slope(sin));
            let meaning = format!("mass that `{orbit}` carries times its lever");
            let along = self.lettered(letters::MOMENT, &[&orbit], &meaning, along);
            let meaning = format!("mass that `{orbit}` carries times its lateral lever");
            let lateral = self.lettered(letters::LATERAL_MOMENT, &[&orbit], &meaning, lateral);
            moments.push((along, lateral));
        }
        moments
    }

    /// Defines a named function of time; returns `None` if it is zero.
    fn given(&mut self, code: &str, text: &str, latex: &str, value: Formula) -> Option<SymbolId> {
        if value.is_zero() {
            return None;
        }
        let symbol = self.symbols.intern(Role::Temporal, code, text, latex);
        self.drive.temporal.insert(symbol, Temporal::Given(value));
        Some(symbol)
    }

    /// Converts a function of time to a formula in t, sines and cosines.
    fn signal(&mut self, signal: &Signal) -> Formula {
        let mut atom = |atom: &SignalAtom| match atom {
            SignalAtom::Constant(value) => self.quantity(value),
            SignalAtom::Time => Formula::symbol(self.time()),
            SignalAtom::Function(function, argument) => {
                let argument = self.signal(argument).expand();
                if argument.is_zero() {
                    return Formula::integer(i64::from(*function == TimeFunction::Cos));
                }
                let (sin, cos) = self.rotation_in_time(&argument);
                Formula::symbol(match function {
                    TimeFunction::Sin => sin,
                    TimeFunction::Cos => cos,
                })
            }
        };
        let Ok(formula) = Formula::of(signal, &mut |own| Ok(atom(own)), &Ok::<_, Infallible>);
        formula
    }

    fn time(&mut self) -> SymbolId {
        let time = self.symbols.intern(Role::Temporal, "time", "t", "t");
        self.drive.temporal.insert(time, Temporal::Time);
        time
    }

    /// Creates symbols for sine and cosine of a function of time.
    fn rotation_in_time(&mut self, argument: &Formula) -> (SymbolId, SymbolId) {
        let known = self.drive.rotations.iter().find(|(a, ..)| a == argument);
        if let Some(&(_, sin, cos)) = known {
            return (sin, cos);
        }
        let expr = argument.to_expr(&self.symbols);
        let plain = text(&expr, &self.symbols);
        let tex = latex(&expr, &self.symbols);
        let mut make = |function: &str| {
            self.symbols.intern(
                Role::Temporal,
                &format!("{function}_drive"),
                &format!("{function}({plain})"),
                &format!("\\{function}\\left({tex}\\right)"),
            )
        };
        let (sin, cos) = (make("sin"), make("cos"));
        let temporal = &mut self.drive.temporal;
        temporal.insert(sin, Temporal::Sin(argument.clone()));
        temporal.insert(cos, Temporal::Cos(argument.clone()));
        self.drive.rotations.push((argument.clone(), sin, cos));
        (sin, cos)
    }

    /// Returns the derivative d/dt of a function of time. The chain rule covers all sines and
    /// cosines in it.
    fn time_derivative(&self, formula: &Formula) -> Formula {
        formula
            .symbols()
            .into_iter()
            .filter_map(|symbol| {
                let slope = match self.drive.temporal.get(&symbol)? {
                    Temporal::Time => Formula::integer(1),
                    Temporal::Sin(argument) => {
                        let cos = Formula::symbol(self.partner(symbol)?);
                        &cos * &self.time_derivative(argument)
                    }
                    Temporal::Cos(argument) => {
                        let sin = Formula::symbol(self.partner(symbol)?);
                        -(&sin * &self.time_derivative(argument))
                    }
                    Temporal::Given(value) => self.time_derivative(value),
                };
                Some(&formula.derivative(symbol) * &slope)
            })
            .sum()
    }

    /// Returns the cosine that has the same argument as a sine, or the sine that has the same
    /// argument as a cosine.
    fn partner(&self, symbol: SymbolId) -> Option<SymbolId> {
        self.drive.rotations.iter().find_map(|&(_, sin, cos)| {
            (sin == symbol)
                .then_some(cos)
                .or((cos == symbol).then_some(sin))
        })
    }

    /// Returns the drive as plain data, with its power in the given frame.
    pub(super) fn plain_drive(&self, frame: Option<&DerivedFrame>) -> Option<DriveTerms> {
        self.scene.drive.as_ref()?;
        let DerivedDrive {
            temporal,
            rotations: _,
            torque,
            pivot,
            friction: _,
        } = &self.drive;
        let expr = |formula: &Formula| formula.to_expr(&self.symbols);
        let plain = |meaning: &Temporal<Formula>| match meaning {
            Temporal::Time => Temporal::Time,
            Temporal::Sin(argument) => Temporal::Sin(expr(argument)),
            Temporal::Cos(argument) => Temporal::Cos(expr(argument)),
            Temporal::Given(value) => Temporal::Given(expr(value)),
        };
        let frame = frame.filter(|_| self.scene.requests.energies);
        let power = |frame: &DerivedFrame| {
            let forces = frame.drive_forces(self);
            let terms = forces.iter().zip(&frame.velocities);
            expr(&terms.map(|(force, &v)| force * &Formula::symbol(v)).sum())
        };
        Some(DriveTerms {
            temporal: temporal.iter().map(|(&s, m)| (s, plain(m))).collect(),
            torque: *torque,
            pivot: pivot
                .iter()
                .map(|motion| PivotMotion {
                    name: motion.name,
                    position: expr(&motion.position),
                    acceleration: motion.acceleration,
                    inner_acceleration: expr(&motion.inner_acceleration),
                })
                .collect(),
            power: frame.map(power),
        })
    }

    /// Returns the power −2 R of friction and drag, with Rayleigh's function R. `None` without
    /// friction and drag, if energies are not requested, or if no external force feeds them.
    pub(super) fn total_friction_power(&self) -> Option<Expr> {
        let requests = &self.scene.requests;
        let fed = self.scene.drive.is_some() || requests.forces;
        let friction = &self.drive.friction;
        let wanted = requests.energies && fed && !friction.is_zero();
        wanted.then(|| friction.to_expr(&self.symbols))
    }
}
