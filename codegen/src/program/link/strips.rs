//! Constants of trees in loops, by strip: a generation of a rule, or a single link of another tree.

use super::columns::Column;
use super::loop_tree::{LoopTree, StripConstants};
use super::reduced_units::{Unit, Units};
use crate::exact::Rational;
use crate::mechanics::expression::{Expr, SymbolId};
use crate::mechanics::{Joint, LinkBalance};
use crate::program::builder::Builder;
use crate::program::lower::Lowering;
use crate::program::{ConstantId, ValueId};
use crate::scene::{Link, LinkId, PassiveTorques, Scene};

/// All columns of all orbits (equal copies of a link), before equations use them.
pub(super) struct Table {
    pub(super) units: Units,
    /// Constants by orbit, then by column.
    pub(super) rows: Vec<[ValueId; Column::ALL.len()]>,
    /// Apparent gravity −g/l at the root's pivot.
    pub(super) root_gravity: ValueId,
    /// For each orbit, true if its links have no children.
    pub(super) is_leaf: Vec<bool>,
    pub(super) has_several_places: bool,
}

impl Table {
    /// Returns the factor 1/(m l²), which all rows share.
    pub(super) fn per_torque(&self) -> ValueId {
        self.rows[0][Column::PerTorque as usize]
    }

    /// Returns the number that a column contains for all leaves, or for all other links; `None` if
    /// they differ.
    pub(super) fn common(
        &self,
        builder: &Builder,
        leaves: bool,
        column: Column,
    ) -> Option<Rational> {
        let rows = self.rows.iter().zip(&self.is_leaf);
        let rows = rows.filter(|(_, is_leaf)| **is_leaf == leaves);
        shared(builder, rows.map(|(row, _)| row[column as usize]))
    }

    /// Returns the number that all links have in a column, if they share one.
    pub(super) fn common_of_all(&self, builder: &Builder, column: Column) -> Option<Rational> {
        shared(builder, self.rows.iter().map(|row| row[column as usize]))
    }

    /// Returns the number that all links except the root have in a column, if they share one.
    pub(super) fn common_of_children(&self, builder: &Builder, column: Column) -> Option<Rational> {
        shared(
            builder,
            self.rows.iter().skip(1).map(|row| row[column as usize]),
        )
    }
}

/// Returns the number that all values equal, if there is one.
fn shared(builder: &Builder, mut values: impl Iterator<Item = ValueId>) -> Option<Rational> {
    let number = builder.exact(values.next()?)?;
    values
        .all(|value| builder.exact(value).as_ref() == Some(&number))
        .then_some(number)
}

impl Lowering<'_> {
    /// Computes the constants of all orbits of a tree in loops. All become constants of the model,
    /// whichever pass is left out.
    pub(super) fn strip_table(&mut self, scene: &Scene, balance: &LinkBalance) -> Table {
        let off = self.builder.off.take();
        let table = self.orbit_constants(scene, balance);
        self.builder.off = off;
        table
    }

    fn orbit_constants(&mut self, scene: &Scene, balance: &LinkBalance) -> Table {
        let children = super::children(scene);
        let zero = self.builder.integer(0);
        let copies = self.builder.integer(super::copies(scene));
        let (mut given, mut masses) = (Vec::new(), Vec::new());
        let mut has_several_places = false;
        // Parents come before their children, and orbits are in the order of their first link.
        for orbit in &scene.orbits {
            let LinkId(index) = orbit.links[0];
            let link = &scene.links[index];
            let places = self.points_below(scene, &children, index, copies);
            has_several_places |= places.len() > 1;
            let [inertia, along, across, mass] = self.composite(scene, index, balance, &places);
            given.push(Joint {
                inertia,
                moment: [along, across],
                passive: self.passive_values(link),
                pivot: self.values_of(&link.pivot),
            });
            masses.push(match children[index].is_empty() {
                true => zero,
                false => mass,
            });
        }
        let gravity = self.value_of(&scene.gravity);
        let builder = &mut self.builder;
        let units = Units::of(builder, scene, &given, gravity, !has_several_places);
        let is_leaf = scene.orbits.iter();
        let is_leaf: Vec<bool> = is_leaf
            .map(|orbit| children[orbit.links[0].0].is_empty())
            .collect();
        let rows = scene.orbits.iter().enumerate().map(|(number, orbit)| {
            let first_child = children[orbit.links[0].0].first();
            let place = match (has_several_places, first_child) {
                (true, _) => units.links[number].place,
                (false, Some(&child)) => units.links[scene.links[child].orbit.0].place,
                (false, None) => [zero; 2],
            };
            let body = (masses[number], is_leaf[number]);
            row(builder, &units, &units.links[number], body, place)
        });
        let mut rows: Vec<[ValueId; Column::ALL.len()]> = rows.collect();
        let root_gravity = builder.neg(units.gravity);
        if let Some(body) = &self.mechanics.body {
            self.body_columns(scene, balance, body, &units, &mut rows);
        }
        Table {
            rows,
            root_gravity,
            units,
            is_leaf,
            has_several_places,
        }
    }

    /// Returns spring and friction of a link as values.
    fn passive_values(&mut self, link: &Link) -> PassiveTorques<ValueId> {
        // The width of a law that a link does not have is a number, not a constant.
        link.passive.map(|quantity| match quantity.exact() {
            Some(number) if number.is_one() => self.builder.integer(1),
            _ => self.value_of(quantity),
        })
    }

    /// Returns the points from which links hang on this one, with the masses at them that its
    /// constants include.
    fn points_below(
        &mut self,
        scene: &Scene,
        children: &[Vec<usize>],
        index: usize,
        copies: ValueId,
    ) -> Vec<([ValueId; 2], ValueId)> {
        // A link's constants include the masses of leaves only: those of whole subtrees would hide
        // much smaller articulated inertias.
        let mut places: Vec<([ValueId; 2], ValueId)> = Vec::new();
        for &child in &children[index] {
            let child_link = &scene.links[child];
            let place = self.values_of(&child_link.pivot);
            let counted = match children[child].is_empty() {
                true => self.value_of(&child_link.mass),
                false => self.builder.integer(0),
            };
            let counted = self.builder.mul(copies, counted);
            match places.iter_mut().find(|(known, _)| *known == place) {
                Some((_, sum)) => *sum = self.builder.add(*sum, counted),
                None => places.push((place, counted)),
            }
        }
        places
    }

    /// Computes M, h, the lateral moment and S of a link with the given masses on its pivots; the
    /// derived expressions are sums over these.
    pub(super) fn composite(
        &mut self,
        scene: &Scene,
        index: usize,
        balance: &LinkBalance,
        places: &[([ValueId; 2], ValueId)],
    ) -> [ValueId; 4] {
        let link = &scene.links[index];
        let symbols = &balance.symbols;
        let zero = self.builder.integer(0);
        let com = self.values_of(&link.com);
        let body = [self.value_of(&link.mass), self.value_of(&link.inertia)];
        let own = (body, com, [zero; 2], zero);
        let attached = places.iter();
        let attached = attached.map(|&(place, counted)| ([zero; 2], [zero; 2], place, counted));
        let composite = &balance.composite;
        let exprs = [
            &composite.inertia,
            &composite.moment[0],
            &composite.moment[1],
            &composite.mass,
        ];
        let mut sums = [zero; 4];
        for (body, com, place, counted) in std::iter::once(own).chain(attached) {
            let known = [
                (symbols.body[0], body[0]),
                (symbols.body[1], body[1]),
                (symbols.com[0], com[0]),
                (symbols.com[1], com[1]),
                (symbols.place[0], place[0]),
                (symbols.place[1], place[1]),
                (symbols.counted, counted),
            ];
            for (sum, expr) in sums.iter_mut().zip(exprs) {
                let value = self.at_values(expr, &known);
                *sum = self.builder.add(*sum, value);
            }
        }
        sums
    }

    /// Evaluates an expression at given values of its symbols.
    pub(super) fn at_values(&mut self, expr: &Expr, known: &[(SymbolId, ValueId)]) -> ValueId {
        match expr {
            Expr::Number(number) => self.builder.number(number.clone()),
            Expr::Symbol(symbol) => match known.iter().find(|(id, _)| id == symbol) {
                Some(&(_, value)) => value,
                None => unreachable!("constants of a link are those of its body and places"),
            },
            Expr::Sum(terms) => {
                let start = self.builder.integer(0);
                terms.iter().fold(start, |sum, term| {
                    let term = self.at_values(term, known);
                    self.builder.add(sum, term)
                })
            }
            Expr::Product(factors) => {
                let start = self.builder.integer(1);
                factors.iter().fold(start, |product, factor| {
                    let factor = self.at_values(factor, known);
                    self.builder.mul(product, factor)
                })
            }
            Expr::Power(base, exponent) => {
                let base = self.at_values(base, known);
                let one = self.builder.integer(1);
                (0..*exponent).fold(one, |power, _| self.builder.mul(power, base))
            }
        }
    }

    /// Returns the strips of a scene, with the columns that are read.
    pub(super) fn strips(
        &mut self,
        scene: &Scene,
        table: &Table,
        [columns, body_columns]: [Vec<Column>; 2],
    ) -> LoopTree {
        let any = |force: fn(&crate::scene::Link) -> bool| scene.links.iter().any(force);
        let mut strips = Vec::with_capacity(scene.links.len());
        for link in &scene.links {
            let orbit = link.orbit.0;
            let builder = &mut self.builder;
            let mut constants = |columns: &[Column]| {
                let values = columns.iter().map(|&of| table.rows[orbit][of as usize]);
                let constants = values.map(|value| match builder.as_constant(value) {
                    Some(constant) => constant,
                    // There are too many values.
                    None if builder.is_exceeded() => ConstantId(0),
                    None => unreachable!("rows hold constants"),
                });
                constants.collect::<Vec<_>>()
            };
            let [constants, body] = [constants(&columns), constants(&body_columns)];
            strips.push(StripConstants {
                name: link.name.clone(),
                is_leaf: table.is_leaf[orbit],
                constants,
                body,
                properties: scene.requests.positions.then(|| self.link_properties(link)),
            });
        }
        let spring_dampers = self.spring_damper_constants(scene);
        let lines = self.line_constants(scene);
        let power = self.power_constants(scene, &spring_dampers, &lines);
        let drive = scene.drive.as_ref();
        LoopTree {
            columns,
            body_columns,
            strips,
            spring_dampers,
            lines,
            power,
            has_several_places: table.has_several_places,
            has_joint_torques: any(|link| link.passive.has_joint_torque()),
            has_outside_torques: super::has_outside_torques(scene),
            has_prescribed_links: super::has_prescribed_links(scene),
            has_drive_torque: drive.is_some_and(|drive| drive.torque.is_some()),
        }
    }
}

/// Computes the columns of one orbit.
fn row(
    builder: &mut Builder,
    units: &Units,
    unit: &Unit,
    (mass, is_leaf): (ValueId, bool),
    [along, across]: [ValueId; 2],
) -> [ValueId; Column::ALL.len()] {
    let [tree_mass, tree_length] = units.tree;
    let (zero, one) = (builder.integer(0), builder.integer(1));
    let mut of_leaf = |above: ValueId| match is_leaf {
        true => builder.div(above, unit.inertia),
        false => zero,
    };
    let gain = unit.moment.map(&mut of_leaf);
    let inverse = of_leaf(one);
    let area = builder.mul(tree_length, tree_length);
    let torque = builder.mul(tree_mass, area);
    let per_torque = builder.div(one, torque);
    let [joint, ground] = &unit.passive.laws;
    let [
        friction,
        drag,
        spring,
        coulomb,
        static_excess,
        quadratic_friction,
        quadratic_drag,
    ] = torques(&unit.passive).map(|force| builder.div(force, torque));
    Column::ALL.map(|column| match column {
        Column::Inertia => unit.inertia,
        Column::Moment => unit.moment[0],
        Column::LateralMoment => unit.moment[1],
        Column::Mass => builder.div(mass, tree_mass),
        Column::Length => unit.length,
        Column::InverseLength => unit.inverse_length,
        Column::GainAlong => gain[0],
        Column::GainAcross => gain[1],
        Column::InverseInertia => inverse,
        Column::Along => along,
        Column::Across => across,
        Column::Friction => friction,
        Column::Drag => drag,
        Column::Spring => spring,
        Column::Rest => unit.passive.rest,
        Column::Coulomb => coulomb,
        Column::QuadraticFriction => quadratic_friction,
        Column::StaticExcess => static_excess,
        Column::StribeckRate => joint.stribeck,
        Column::FrictionWidth => joint.width,
        Column::QuadraticDrag => quadratic_drag,
        Column::DragWidth => ground.width,
        Column::PerTorque => per_torque,
        Column::TorqueUnit => torque,
        // The drive's torque is an argument of each evaluation.
        Column::DriveTorque => zero,
        // Zero until `body_columns` fills them, for scenes with energies or positions.
        Column::BodyMass
        | Column::BodyInertia
        | Column::ComAlong
        | Column::ComAcross
        | Column::PlaceAlong
        | Column::PlaceAcross
        | Column::PivotAlong
        | Column::PivotAcross
        | Column::CarriedMoment
        | Column::LateralCarriedMoment
        | Column::WeightMoment
        | Column::LateralWeightMoment
        | Column::Gravity
        | Column::Stiffness
        | Column::PivotFriction
        | Column::GroundDrag
        | Column::PivotCoulomb
        | Column::PivotExcess
        | Column::PivotQuadratic
        | Column::GroundQuadratic => zero,
    })
}

/// Returns the constants of springs and friction that are proportional to the torque: of springs,
/// of viscous friction and of other friction laws.
fn torques(passive: &PassiveTorques<ValueId>) -> [ValueId; 7] {
    let [joint, ground] = &passive.laws;
    [
        passive.friction,
        passive.drag,
        passive.spring,
        joint.coulomb,
        joint.excess,
        joint.quadratic,
        ground.quadratic,
    ]
}
