//! Constants of a tree in loops on which the virtual power of its forces depends, with their
//! derivatives by the parameters: derivatives in reverse mode of the accelerations need both.

use super::loop_tree::{ConstantSlope, LineConstants, PowerConstants, SpringDamperConstants};
use crate::functions::{Argument, DRIVE_WEIGHTS, LINK_PROPERTIES, Purpose};
use crate::program::ConstantId;
use crate::program::entry_list::EntryList;
use crate::program::lower::Lowering;
use crate::program::pullback::Adjoints;
use crate::scene::{FrictionContact, FrictionLaw, Link, Scene};

/// Returns the meaning of the constants of a link on which its virtual power depends, in the order in
/// which the runtime reads them.
pub fn passive_link_columns() -> Vec<String> {
    let [
        mass,
        inertia,
        along,
        across,
        pivot_along,
        pivot_across,
        _,
        _,
    ] = LINK_PROPERTIES;
    let body = [mass, inertia, along, across, pivot_along, pivot_across];
    let torques = [
        "friction in the pivot (N m s)",
        "drag against the ground (N m s)",
        "stiffness of the torsion spring (N m)",
        "angle at which the torsion spring is at rest (rad)",
    ];
    let laws = FrictionContact::ALL.into_iter().flat_map(|contact| {
        let constants = FrictionLaw::NAMES.into_constants().into_iter();
        constants.map(move |own| format!("{} ({})", own.in_words(contact), own.unit))
    });
    let own = body.into_iter().chain(torques).map(str::to_owned);
    own.chain(laws).collect()
}

impl Lowering<'_> {
    /// Returns the constants and their derivatives, if derivatives of the accelerations are
    /// requested. Linear in the number of constants times the number of parameters.
    pub(super) fn power_constants(
        &mut self,
        scene: &Scene,
        spring_dampers: &[SpringDamperConstants],
        lines: &[LineConstants],
    ) -> Option<PowerConstants> {
        if !super::has_pullback(scene) {
            return None;
        }
        let gravity = self.quantity(&scene.gravity);
        let rows = scene.links.iter().map(|link| self.passive_link(link));
        let rows: Vec<Vec<ConstantId>> = rows.collect();
        let laws = FrictionContact::ALL.map(|contact| {
            let mut links = scene.links.iter();
            links.any(|link| !link.passive.law(contact).is_none())
        });
        let springs = spring_dampers.iter().flat_map(|own| {
            let constants: Vec<ConstantId> = own.named().map(|(_, id)| id).collect();
            vec![constants; own.pairs.len()]
        });
        let lines = lines.iter().flat_map(|own| {
            let constants: Vec<ConstantId> = own.named().map(|(_, id)| id).collect();
            vec![constants; own.runs.len()]
        });
        let groups = std::iter::once(vec![gravity]).chain(rows.iter().cloned());
        let groups: Vec<Vec<ConstantId>> = groups.chain(springs).chain(lines).collect();
        Some(PowerConstants {
            gravity,
            rows,
            laws,
            slopes: self.slopes(&groups, scene.parameters.len()),
        })
    }

    /// Returns the constants of a link: body, points and torques.
    fn passive_link(&mut self, link: &Link) -> Vec<ConstantId> {
        let [mass, inertia, com_along, com_across, along, across, _, _] = link.properties();
        let passive = &link.passive;
        let own = [mass, inertia, com_along, com_across, along, across];
        let torques = [
            &passive.friction,
            &passive.drag,
            &passive.spring,
            &passive.rest,
        ];
        let laws = passive.laws.iter();
        let laws = laws.flat_map(|law| law.each_ref().into_constants());
        let all = own.into_iter().chain(torques).chain(laws);
        all.map(|quantity| self.quantity(quantity)).collect()
    }

    /// Returns the derivatives of groups of constants by parameters, without those that are zero.
    fn slopes(&mut self, groups: &[Vec<ConstantId>], parameters: usize) -> Vec<ConstantSlope> {
        let mut slopes = Vec::new();
        for parameter in 0..parameters {
            let setup = &mut self.builder.setup;
            let all = groups.iter().flatten().copied();
            let derivatives = setup.derivatives(all, parameter);
            for (group, constants) in groups.iter().enumerate() {
                for (constant, id) in constants.iter().enumerate() {
                    let slope = derivatives[id];
                    let exact = setup.get(slope).exact.as_ref();
                    if !exact.is_some_and(|exact| exact.is_zero()) {
                        slopes.push(ConstantSlope {
                            place: [group, constant, parameter],
                            slope,
                        });
                    }
                }
            }
        }
        slopes.sort_by_key(|own| own.place);
        slopes
    }
}

impl EntryList<'_, '_> {
    /// Adds the derivatives by the parameters of a weighted sum of the drive's components, if some
    /// component depends on a parameter. The function of the drive has been added before.
    pub(super) fn drive_pullback(&mut self, scene: &Scene) {
        let mut entries = self.entries.iter();
        let drive = entries.find(|entry| entry.purpose == Purpose::Drive);
        let (Some(drive), true) = (drive.cloned(), super::has_pullback(scene)) else {
            return;
        };
        let builder = &mut self.lowering.builder;
        let argument = Argument::Given(DRIVE_WEIGHTS);
        let weights = (0..drive.outputs.len()).map(|index| builder.input(argument, index));
        let weights: Vec<_> = weights.collect();
        let adjoints = Adjoints::of(builder, &drive.outputs, &weights);
        let parameters = 0..scene.parameters.len();
        let outputs: Vec<_> = parameters
            .map(|parameter| adjoints.of_parameter(builder, parameter))
            .collect();
        if outputs.iter().any(|&output| !builder.is(output, 0)) {
            self.push(Purpose::DrivePullback, outputs);
        }
    }
}
