//! The equations of one link: the program of a tree in loops, taken through the tree by
//! its interpreter, gives what code written out gives; and its functions are the derived
//! balance, symbol by symbol.

mod balance;
mod sweep;

use branched_pendulum_codegen::scene::Layout;
use branched_pendulum_codegen::{Stages, stages};

/// A tree by rule.
const RULE: &str = "gravity = 9.80665, tree: generations(count = 4, branching = 2, \
    mass = 0.12, com = 0.1, inertia = 1e-3, joint = 0.3, mass_ratio = 0.5, length_ratio = 0.7)";

/// Bent links with all forces, driven, the children of each on one pivot. The second leaf
/// has its centre of mass beside its pivot.
const BUSH: &str = "gravity = 9.80665, trunk(mass = 0.3, com = (0.1, 0.02), inertia = 2e-3, \
    joint = (0.3, 0.05), friction = 1e-3, drag = 2e-3, spring = 0.1) [ \
        left(mass = 0.2, com = 0.07, inertia = 1e-3, joint = 0.2, friction = 3e-3, spring = 0.2, \
        rest = -0.4) [ \
            tip: rod(mass = 0.05, length = 0.1, friction = 1e-3), \
            weight(mass = 0.04, com = (0, 0.03), inertia = 1e-4, drag = 1e-3) ], \
        right: rod(mass = 0.1, length = 0.25, spring = 0.05, rest = 0.3) ], \
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))";

/// Several attachments on one link, one of them in its own pivot; a parameter.
const SEVERAL: &str = "gravity = 9.80665, trunk(mass = 0.3, com = (0.1, 0.02), inertia = 2e-3, \
    joint = 0.3, friction = c) [ \
        left: rod(mass = 0.2, length = 0.3) [ tip: rod(mass = 0.05, length = 0.1, at = 0.2) ], \
        right: rod(mass = 0.1, length = 0.25, at = (0.15, 0.04), friction = c), \
        middle: disc(mass = 0.1, length = 0.05, radius = 0.02, at = 0) ]";

/// Every law of friction, on some of the links; one law with a parameter.
const BRAKED: &str = "gravity = 9.80665, trunk(mass = 0.3, com = 0.1, inertia = 2e-3, \
    joint = 0.3, friction(viscous = 1e-3, coulomb = c, quadratic = 1e-3), drag(quadratic = 0.02)) [ \
        left: rod(mass = 0.2, length = 0.3, friction(coulomb = 0.01, width = 0.5), spring = 0.1) [ \
            tip: rod(mass = 0.05, length = 0.1, friction(quadratic = 1e-4)) ], \
        right: rod(mass = 0.1, length = 0.25, drag(viscous = 1e-3, quadratic = 2e-3, width = 1)) ]";

/// The same by a rule, so that all rows of a column are numbers.
const BRAKED_RULE: &str = "gravity = 9.80665, tree: generations(count = 4, branching = 2, \
    mass = 0.12, com = 0.1, inertia = 1e-3, joint = 0.3, mass_ratio = 0.5, length_ratio = 0.7, \
    friction(coulomb = 1e-3, quadratic = 1e-4), friction_ratio = 0.3, drag(quadratic = 1e-4))";

fn compiled(text: &str, code: &str) -> Stages {
    let text = format!("code = {code}, {text}");
    let attribute = text.parse().expect("tokens");
    let item = "struct Sample;".parse().expect("tokens");
    stages(attribute, item).unwrap_or_else(|(report, _)| panic!("{}", report.render(&text)))
}

/// Strip and parent of every link, depth first.
fn tree(stages: &Stages) -> Vec<(usize, Option<usize>)> {
    match stages.scene.layout {
        Layout::Generations { branching, .. } => {
            let mut tree = vec![(0, None)];
            let generations = stages.scene.links.len();
            below(&mut tree, 0, branching, generations);
            tree
        }
        _ => {
            let links = stages.scene.links.iter().enumerate();
            links
                .map(|(index, link)| (index, link.parent.map(|parent| parent.0)))
                .collect()
        }
    }
}

fn below(
    tree: &mut Vec<(usize, Option<usize>)>,
    link: usize,
    branching: usize,
    generations: usize,
) {
    let strip = tree[link].0 + 1;
    if strip < generations {
        for _ in 0..branching {
            tree.push((strip, Some(link)));
            let child = tree.len() - 1;
            below(tree, child, branching, generations);
        }
    }
}
