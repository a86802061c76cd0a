//! Friction that is not viscous (physics §17). Each of its torques is a separate symbol, which
//! enters the equations of motion as a viscous torque does.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, Role, SymbolId, Symbols};
use super::force_elements::{ElementLinks, ElementWords};
use super::frame::DerivedFrame;
use super::letters;
use super::meaning::{DerivedSource, DerivedTorque};
use super::print::Index;
use crate::exact::Rational;
use crate::scene::{Coordinate, FrictionContact, FrictionLaw, LinkId, PassiveTorques, Quantity};

/// A friction torque D = (A/s + q s) w against the rate w, in a joint or against the ground: speed
/// s = √(w² + ε²), quadratic friction q, and A = C + ΔC/(1 + (w/ϖ)²) with the Coulomb friction C,
/// the excess ΔC of static friction and the Stribeck rate ϖ.
#[derive(Clone, Debug, PartialEq)]
pub struct BrakingTorque {
    /// Symbol D of the friction torque.
    pub symbol: SymbolId,
    /// First and second derivative of the torque by w, for single links only.
    pub slopes: [SymbolId; 2],
    /// Contact at which the torque acts: pivot or ground.
    pub place: FrictionContact,
    /// Link or symmetric coordinate to which the torque belongs.
    pub source: TorqueSource,
}

/// Link or symmetric coordinate to which a friction torque belongs.
#[derive(Clone, Debug, PartialEq)]
pub enum TorqueSource {
    /// The torque on one link, against another link or the ground.
    Link {
        /// Link that the torque brakes if the rate w is positive.
        link: LinkId,
        /// Link on which the opposite torque acts; `None` for the ground.
        against: Option<LinkId>,
        /// Rate w, in the velocities of the frame.
        rate: Expr,
        /// Friction law with the coefficients C, q, ε, ΔC and ϖ.
        law: Box<FrictionLaw<Expr>>,
        /// Symbol of the speed s, used in printed formulas only.
        speed: SymbolId,
    },
    /// Component of the torques of copies in the symmetric coordinate with this index.
    Coordinate(usize),
}

impl FrictionContact {
    /// Returns the index that distinguishes the letters of these symbols.
    fn mark(self) -> &'static str {
        match self {
            Self::Joint => "",
            Self::Ground => "⁰",
        }
    }

    fn latex_mark(self) -> &'static str {
        match self {
            Self::Joint => "",
            Self::Ground => "^{0}",
        }
    }
}

impl Derivation<'_> {
    /// Creates the friction torques of all links, and names their constants.
    pub(super) fn braking_torques(&mut self, velocities: &[SymbolId]) -> Vec<DerivedTorque> {
        let mut torques = Vec::new();
        let scene = self.scene;
        for element in scene.force_elements() {
            for place in FrictionContact::ALL {
                let law = element.passive.law(place);
                if law.is_none() {
                    continue;
                }
                self.name_law(&element.words, place, law);
                let source = match (place, element.part) {
                    (FrictionContact::Joint, part @ ElementLinks::Pivot(link)) => {
                        DerivedSource::Link {
                            link: LinkId(link),
                            rate: self.element_rate(part, velocities),
                        }
                    }
                    (FrictionContact::Ground, ElementLinks::Pivot(link)) => DerivedSource::Link {
                        link: LinkId(link),
                        rate: Formula::symbol(velocities[link]),
                    },
                    (_, part @ ElementLinks::Pair(number, _)) => DerivedSource::Pair {
                        number,
                        rate: self.element_rate(part, velocities),
                    },
                };
                let names = self.element_names(element.part);
                torques.push(self.torque_called(&names, place, source));
            }
        }
        torques
    }

    fn torque_called(
        &mut self,
        names: &[impl AsRef<str>],
        place: FrictionContact,
        source: DerivedSource,
    ) -> DerivedTorque {
        let mark = place.mark();
        let code = match place {
            FrictionContact::Joint => "braking",
            FrictionContact::Ground => "braking_ground",
        };
        let mark_latex = place.latex_mark();
        let mut intern = |suffix: &str, prime: &str, latex_prime: &str| {
            let code = format!("{code}{suffix}");
            let text = format!("D{mark}{prime}");
            let latex = format!("D{mark_latex}{latex_prime}");
            self.indexed_by(Role::Derived, [&code, &text, &latex], names)
        };
        DerivedTorque {
            symbol: intern("", "", ""),
            slopes: [
                intern("_slope", "′", "{}'"),
                intern("_curvature", "″", "{}''"),
            ],
            place,
            source,
        }
    }

    /// Names the constants of a force element's friction law, and returns them.
    pub(super) fn name_law(
        &mut self,
        element: &ElementWords,
        place: FrictionContact,
        law: &FrictionLaw,
    ) -> FrictionLaw<Formula> {
        let index = Index::of(&element.constants);
        let (mark, latex_mark) = (place.mark(), place.latex_mark());
        let what = match place {
            FrictionContact::Joint => format!("friction {}", element.place),
            FrictionContact::Ground => format!("drag {} against the ground", element.owner),
        };
        let mut values = law
            .effective(Quantity::is_zero)
            .into_constants()
            .into_iter();
        FrictionLaw::NAMES.map(|constant| {
            let (Some(Some(value)), Some(word)) = (values.next(), constant.words[place as usize])
            else {
                return Formula::zero();
            };
            let value = self.quantity(value);
            let [letter, latex] = constant.letters;
            self.constant(
                &format!("{word}_{}", index.code),
                &format!("{letter}{mark}_{}", index.text),
                &format!("{latex}{latex_mark}_{{\\mathrm{{{}}}}}", index.latex),
                &format!("{}{what}", constant.meaning),
                constant.unit,
                value,
            )
        })
    }

    /// Returns the passive torques of an orbit (equal copies of a link) or of a spring-damper, as
    /// named constants; absent ones are zero.
    pub(super) fn passive_constants(&self, names: &[impl AsRef<str>]) -> PassiveTorques<Expr> {
        let index = &Index::of(names).text;
        PassiveTorques {
            friction: self.named_constant(letters::FRICTION.text, index),
            drag: self.named_constant(letters::DRAG.text, index),
            spring: self.named_constant(letters::SPRING.text, index),
            rest: self.named_constant(letters::REST.text, index),
            laws: FrictionContact::ALL.map(|place| self.law_constants(index, place)),
        }
    }

    fn law_constants(&self, index: &str, place: FrictionContact) -> FrictionLaw<Expr> {
        FrictionLaw::NAMES.map(|constant| {
            let [letter, _] = constant.letters;
            self.named_constant(&format!("{letter}{}", place.mark()), index)
        })
    }

    fn named_constant(&self, letter: &str, index: &str) -> Expr {
        let found = self.symbols.find(&format!("{letter}_{index}"));
        let found = found.filter(|id| self.constants.contains_key(id));
        found.map_or_else(Expr::zero, Expr::Symbol)
    }

    /// Transforms the torques of equal copies to symmetric coordinates, like their angles: link =
    /// mean + Σ weight · difference. Returns the new torques and the replacements for those of the
    /// links. Sums over copies of equal terms then vanish before any number is rounded.
    pub(super) fn symmetric_torques(
        &mut self,
        torques: &[DerivedTorque],
        coordinates: &[Coordinate],
    ) -> (Vec<DerivedTorque>, Vec<(SymbolId, Formula)>) {
        let (mut found, mut replacements) = (Vec::new(), Vec::new());
        for place in FrictionContact::ALL {
            for (index, coordinate) in coordinates.iter().enumerate() {
                let (orbit, _) = coordinate.kind.orbit_and_difference();
                let first = self.scene.orbits[orbit].links[0];
                if !self.scene.links[first.0].passive.law(place).is_none() {
                    let source = DerivedSource::Coordinate(index);
                    found.push(self.torque_called(&[&coordinate.name], place, source));
                }
            }
        }
        for torque in torques {
            let DerivedSource::Link { link, .. } = &torque.source else {
                continue;
            };
            let members = found.iter().filter_map(|member: &DerivedTorque| {
                let DerivedSource::Coordinate(index) = member.source else {
                    return None;
                };
                let mut weights = coordinates[index].weights.iter();
                let (_, weight) = weights.find(|(own, _)| own == link)?;
                let is_same = member.place == torque.place;
                is_same.then(|| &Formula::integer(*weight) * &Formula::symbol(member.symbol))
            });
            replacements.push((torque.symbol, members.sum()));
        }
        (found, replacements)
    }

    /// Returns the deviation of a friction torque, or of its slope, caused by the deviation of its
    /// rate; zero for other symbols.
    pub(super) fn braking_change(
        &self,
        frame: &DerivedFrame,
        symbol: SymbolId,
        change_of: impl Fn(&Formula) -> Formula,
    ) -> Formula {
        for torque in &frame.torques {
            if let DerivedSource::Link { rate, .. } | DerivedSource::Pair { rate, .. } =
                &torque.source
            {
                let [slope, curvature] = torque.slopes;
                for (own, slope) in [(torque.symbol, slope), (slope, curvature)] {
                    if own == symbol {
                        return &Formula::symbol(slope) * &change_of(rate);
                    }
                }
            }
        }
        Formula::zero()
    }

    /// Returns the friction torques of a frame as plain data.
    pub(super) fn plain_torques(&mut self, torques: &[DerivedTorque]) -> Vec<BrakingTorque> {
        let torques = torques.iter().map(|torque| {
            let source = match &torque.source {
                DerivedSource::Link { link, rate } => {
                    let parent = self.scene.links[link.0].parent;
                    let is_in_pivot = torque.place == FrictionContact::Joint;
                    let ends = (*link, parent.filter(|_| is_in_pivot));
                    let constants = [self.orbit_name(link.0)];
                    let name = self.scene.links[link.0].name.clone();
                    self.plain_source(torque.place, rate, ends, &constants, &[name])
                }
                DerivedSource::Pair { number, rate } => {
                    let pair = self.pairs[*number].pair;
                    let [link, against] = pair.links;
                    let constants = self.scene.spring_damper_names(pair.spring_damper);
                    let names = self.pair_names(pair);
                    let ends = (link, Some(against));
                    self.plain_source(torque.place, rate, ends, &constants, &names)
                }
                DerivedSource::Coordinate(index) => TorqueSource::Coordinate(*index),
            };
            BrakingTorque {
                symbol: torque.symbol,
                slopes: torque.slopes,
                place: torque.place,
                source,
            }
        });
        torques.collect()
    }

    fn plain_source(
        &mut self,
        place: FrictionContact,
        rate: &Formula,
        (link, against): (LinkId, Option<LinkId>),
        constants: &[String],
        names: &[String],
    ) -> TorqueSource {
        let law = self.law_constants(&Index::of(constants).text, place);
        let rate = self.expr(rate);
        TorqueSource::Link {
            link,
            against,
            speed: self.speed(names, &rate, &law.width),
            rate,
            law: Box::new(law),
        }
    }

    /// Returns a symbol for √(w² + ε²), for printed formulas.
    fn speed(&mut self, names: &[String], rate: &Expr, width: &Expr) -> SymbolId {
        let is_name = matches!(rate, Expr::Symbol(_));
        let spelt = |print: fn(&Expr, &Symbols) -> String| {
            let [rate, width] = [rate, width].map(|expr| print(expr, &self.symbols));
            match is_name {
                true => [rate, width],
                false => [format!("({rate})"), width],
            }
        };
        let ([rate, width], [latex_rate, latex_width]) = (spelt(super::text), spelt(super::latex));
        self.symbols.intern(
            Role::Derived,
            &format!("speed_{}", Index::of(names).code),
            &format!("√({rate}² + {width}²)"),
            &format!("\\sqrt{{{latex_rate}^2 + {latex_width}^2}}"),
        )
    }
}

impl FrictionLaw<Expr> {
    /// Returns A = C + ΔC/(1 + (w/ϖ)²), the torque of Coulomb and static friction at high speed, as
    /// a formula.
    fn strength(&self, rate: &Expr) -> Expr {
        if self.excess.is_zero() {
            return self.coulomb.clone();
        }
        let power = |base: &Expr, exponent| Expr::Power(Box::new(base.clone()), exponent);
        let ratio = Expr::Product(vec![power(rate, 2), power(&self.stribeck, -2)]);
        let sum = Expr::Sum(vec![Expr::Number(Rational::one()), ratio]);
        let excess = Expr::Product(vec![self.excess.clone(), power(&sum, -1)]);
        match self.coulomb.is_zero() {
            true => excess,
            false => Expr::Sum(vec![self.coulomb.clone(), excess]),
        }
    }
}

impl BrakingTorque {
    /// Returns the torque of one link as a formula, (A/s + q s) w; `None` for a symmetric
    /// coordinate.
    pub fn formula(&self) -> Option<Expr> {
        let TorqueSource::Link {
            rate, law, speed, ..
        } = &self.source
        else {
            return None;
        };
        let speed = Expr::Symbol(*speed);
        let mut parts = Vec::new();
        let strength = law.strength(rate);
        if !strength.is_zero() {
            let inverse = Expr::Power(Box::new(speed.clone()), -1);
            parts.push(Expr::Product(vec![strength, inverse]));
        }
        if !law.quadratic.is_zero() {
            parts.push(Expr::Product(vec![law.quadratic.clone(), speed]));
        }
        let mut factors = match parts.len() {
            1 => parts.remove(0).factors().to_vec(),
            _ => vec![Expr::Sum(parts)],
        };
        factors.insert(1, rate.clone());
        Some(Expr::Product(factors))
    }
}
