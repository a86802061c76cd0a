//! The program of a tree in loops, taken through the tree by its interpreter, against
//! code written out.

use branched_pendulum_codegen::Stages;
use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_codegen::program::{LoopTree, Program};

use super::{BRAKED, BRAKED_RULE, BUSH, RULE, SEVERAL, compiled, tree};
/// The recursion through a tree, by the interpreter.
struct Sweep<'s> {
    program: &'s Program,
    strips: &'s LoopTree,
    parameters: &'s [f64],
    constants: Vec<Vec<f64>>,
    motion: Vec<[f64; 5]>,
}

impl Sweep<'_> {
    fn call(
        &self,
        entry: &str,
        row: usize,
        motion: usize,
        others: &[(Argument, &[f64])],
    ) -> Vec<f64> {
        let input = |argument: Argument, index: usize| match argument {
            Argument::Constants => self.constants[row][index],
            Argument::Motion => self.motion[motion][index],
            _ => {
                let given = others.iter().find(|(name, _)| *name == argument);
                given.expect("the argument is given").1[index]
            }
        };
        let values = self
            .program
            .evaluate(f64::sin_cos, entry, self.parameters, input);
        values.expect("the entry point exists")
    }

    fn accelerations(&self, tree: &[(usize, Option<usize>)], root: [f64; 2]) -> Vec<f64> {
        let links = tree.len();
        let has_children: Vec<bool> = (0..links)
            .map(|link| tree.iter().any(|(_, parent)| *parent == Some(link)))
            .collect();
        let mut sums = vec![vec![0.0; self.strips.length(Argument::Sums)]; links];
        let mut eliminations = vec![Vec::new(); links];
        for link in (0..links).rev() {
            let response = if has_children[link] {
                let mut both = self.call("inner", link, link, &[(Argument::Sums, &sums[link])]);
                eliminations[link] = both.split_off(self.strips.length(Argument::Response));
                both
            } else {
                self.call("leaf", link, link, &[])
            };
            if let Some(parent) = tree[link].1 {
                let attached =
                    self.call("attach", link, parent, &[(Argument::Response, &response)]);
                for (sum, value) in sums[parent].iter_mut().zip(attached) {
                    *sum += value;
                }
            }
        }
        let mut carried = vec![Vec::new(); links];
        let mut alpha = Vec::new();
        for link in 0..links {
            let pivot = match tree[link].1 {
                None => root.to_vec(),
                Some(parent) => self.call(
                    "pivot",
                    link,
                    parent,
                    &[(Argument::Carried, &carried[parent])],
                ),
            };
            let pivot = (Argument::Pivot, pivot.as_slice());
            let mut values = match has_children[link] {
                true => {
                    let elimination = (Argument::Elimination, eliminations[link].as_slice());
                    self.call("accelerate", link, link, &[elimination, pivot])
                }
                false => self.call("accelerate_leaf", link, link, &[pivot]),
            };
            carried[link] = values.split_off(1);
            alpha.push(values[0]);
        }
        alpha
    }
}

/// By the interpreter, in loops.
fn in_loops(
    stages: &Stages,
    parameters: &[f64],
    time: f64,
    theta: &[f64],
    omega: &[f64],
) -> Vec<f64> {
    let program = &stages.program;
    let strips = program.strips.as_ref().expect("a tree in loops");
    let tree = tree(stages);
    let values = program.setup.evaluate(parameters);
    let row = |strip: usize| -> Vec<f64> {
        let constants = strips.strips[strip].constants.iter();
        constants.map(|id| values[id.0 as usize]).collect()
    };
    let mut constants: Vec<Vec<f64>> = tree.iter().map(|(strip, _)| row(*strip)).collect();
    let at_time = |entry: &str| program.evaluate(f64::sin_cos, entry, parameters, |_, _| time);
    let mut root = at_time("root_gravity").expect("every tree has gravity");
    if let Some(drive) = at_time("root_drive") {
        root = vec![root[0] + drive[0], root[1] + drive[1]];
        if strips.has_drive_torque {
            *constants[0].last_mut().expect("a column for the torque") = drive[2];
        }
    }
    let motion = tree.iter().enumerate().map(|(link, (_, parent))| {
        let (sine, cosine) = theta[link].sin_cos();
        let relative = |state: &[f64]| state[link] - parent.map_or(0.0, |parent| state[parent]);
        [sine, cosine, omega[link], relative(theta), relative(omega)]
    });
    let sweep = Sweep {
        program,
        strips,
        parameters,
        constants,
        motion: motion.collect(),
    };
    sweep.accelerations(&tree, [root[0], root[1]])
}

/// Numbers without pattern between −1 and 1.
fn scattered(seed: usize, count: usize) -> Vec<f64> {
    (0..count)
        .map(|index| ((1 + seed * 37 + index * 101) as f64 * 12.9898).sin())
        .collect()
}

fn agree(text: &str, parameters: &[f64]) {
    let (loops, unrolled) = (compiled(text, "loops"), compiled(text, "unrolled"));
    let links = unrolled.scene.links.len();
    assert_eq!(tree(&loops).len(), links);
    let mut worst = 0.0_f64;
    for seed in 0..40 {
        let theta: Vec<f64> = scattered(seed, links).iter().map(|x| 3.0 * x).collect();
        let omega: Vec<f64> = scattered(seed + 500, links)
            .iter()
            .map(|x| 5.0 * x)
            .collect();
        let time = 0.1 * seed as f64;
        let input = |argument: Argument, index: usize| match argument {
            Argument::Theta => theta[index],
            Argument::Omega => omega[index],
            _ => time,
        };
        let expected = unrolled
            .program
            .evaluate(f64::sin_cos, "accelerations", parameters, input)
            .expect("accelerations");
        let found = in_loops(&loops, parameters, time, &theta, &omega);
        let scale = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for (found, expected) in found.iter().zip(&expected) {
            worst = worst.max((found - expected).abs() / scale);
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn a_tree_by_rule_moves_as_written_out() {
    agree(RULE, &[]);
}

#[test]
fn a_driven_bush_moves_as_written_out() {
    agree(BUSH, &[]);
}

#[test]
fn several_attachments_move_as_written_out() {
    agree(SEVERAL, &[2e-3]);
}

#[test]
fn links_with_friction_of_all_kinds_move_as_written_out() {
    agree(BRAKED, &[0.03]);
    agree(BRAKED_RULE, &[]);
}
