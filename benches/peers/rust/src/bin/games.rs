//! Compares the physics engine `rapier2d-f64` for games, with both kinds of its joints, with our
//! frame stepping and integration methods on the paper's pendulum: errors after 1 s and 10 s, and
//! the time for ten seconds of motion.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::integrate::{Frames, longest_sub_step};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum_peers::scenes::BranchedDouble;
use branched_pendulum_peers::work_precision::reference::{REGULAR, states};
use rapier2d_f64::prelude::*;

/// Number of times that each contender runs, alternating with the others; the median counts.
const ROUNDS: usize = 7;
/// End times of the motion, in s.
const ENDS: [f64; 2] = [1.0, 10.0];
const GRAVITY: f64 = 9.80665;

/// A link of the paper's pendulum: parent, mass (kg), centre of mass (m), inertia (kg m²), position
/// on its parent (m).
struct Link(Option<usize>, f64, f64, f64, f64);

const LINKS: [Link; 3] = [
    Link(None, 0.12880, 0.084, 1.88e-3, 0.0),
    Link(Some(0), 0.10531, 0.043, 0.516e-3, 0.27),
    Link(Some(0), 0.10531, 0.043, 0.516e-3, 0.27),
];

#[derive(Clone, Copy)]
enum Joints {
    Impulse,
    Multibody,
}

type Angles = [f64; 3];

/// Builds the pendulum in a world of Rapier, with the engine's default settings except for the
/// step.
fn world(
    joints: Joints,
    frame: f64,
    iterations: usize,
) -> Option<(PhysicsWorld, Vec<RigidBodyHandle>)> {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, -GRAVITY);
    world.integration_parameters.dt = frame;
    world.integration_parameters.num_solver_iterations = iterations;
    let ground = world.insert_body(RigidBodyBuilder::fixed());
    let mut pivots: Vec<Vector> = Vec::new();
    let mut bodies: Vec<RigidBodyHandle> = Vec::new();
    for (Link(parent, mass, com, inertia, place), angle) in LINKS.iter().zip(REGULAR) {
        let (pivot, above) = match parent {
            Some(parent) => {
                let (sine, cosine) = REGULAR[*parent].sin_cos();
                (
                    pivots[*parent] + Vector::new(place * sine, -place * cosine),
                    bodies[*parent],
                )
            }
            None => (Vector::new(0.0, 0.0), ground),
        };
        let own = RigidBodyBuilder::dynamic()
            .translation(pivot)
            .rotation(angle)
            .additional_mass_properties(MassProperties::new(
                Vector::new(0.0, -com),
                *mass,
                *inertia,
            ))
            .can_sleep(false);
        let own = world.insert_body(own);
        let joint = RevoluteJointBuilder::new()
            .local_anchor1(Vector::new(0.0, -place))
            .local_anchor2(Vector::new(0.0, 0.0))
            .contacts_enabled(false);
        match joints {
            Joints::Impulse => {
                world.insert_impulse_joint(above, own, joint);
            }
            Joints::Multibody => {
                world.insert_multibody_joint(above, own, joint)?;
            }
        }
        pivots.push(pivot);
        bodies.push(own);
    }
    if let Joints::Multibody = joints {
        // The engine's coordinates start at zero: relative angles, in the order of insertion.
        let index = world.multibody_joints.rigid_body_link(bodies[0])?.multibody;
        let multibody = world.multibody_joints.get_multibody_mut(index)?;
        multibody.forward_kinematics(&world.bodies, true);
        // By default the engine damps every joint by 0.1 N m s.
        multibody.damping_mut().fill(0.0);
        let relative = LINKS.iter().zip(REGULAR);
        let relative =
            relative.map(|(link, angle)| angle - link.0.map_or(0.0, |parent| REGULAR[parent]));
        multibody.apply_displacements(&relative.collect::<Vec<f64>>());
        multibody.forward_kinematics(&world.bodies, true);
        multibody.update_rigid_bodies(&mut world.bodies, true);
    }
    Some((world, bodies))
}

/// Function that returns the angles at both end times, and the time for the whole motion in µs.
type Run<'a> = Box<dyn Fn() -> Result<([Angles; 2], f64), Box<dyn Error>> + 'a>;

fn rapier(joints: Joints, rate: u32, iterations: usize) -> Run<'static> {
    Box::new(move || {
        let built = world(joints, 1.0 / f64::from(rate), iterations);
        let (mut world, bodies) = built.ok_or("the joints do not make a tree")?;
        let mut seconds = 0;
        let clock = Instant::now();
        let ends = ENDS.map(|end| {
            while f64::from(seconds) < end {
                for _ in 0..rate {
                    world.step();
                }
                seconds += 1;
            }
            let angle = |body: &RigidBodyHandle| world.bodies[*body].rotation().angle();
            std::array::from_fn(|link| angle(&bodies[link]))
        });
        Ok((ends, clock.elapsed().as_secs_f64() * 1e6))
    })
}

fn frames(tree: &BranchedDouble, rate: u32, parts: u32) -> Run<'_> {
    Box::new(move || {
        let start = State::at_rest(0.0, &REGULAR);
        let sub_step = longest_sub_step(tree) / f64::from(parts);
        let mut frames = Frames::new(AbsoluteAngles(tree), &start, sub_step)?;
        let (mut seconds, frame) = (0, 1.0 / f64::from(rate));
        let clock = Instant::now();
        let ends = ENDS.map(|end| {
            while f64::from(seconds) < end {
                for _ in 0..rate {
                    frames.advance(frame);
                }
                seconds += 1;
            }
            std::array::from_fn(|link| frames.state()[link])
        });
        Ok((ends, clock.elapsed().as_secs_f64() * 1e6))
    })
}

fn dop853(tree: &BranchedDouble, tolerance: f64) -> Run<'_> {
    Box::new(move || {
        let method = Dop853::new(Options::with_tolerance(tolerance));
        let (start, system) = (State::at_rest(0.0, &REGULAR), AbsoluteAngles(tree));
        let clock = Instant::now();
        let states = method.sample_to_vec(&system, black_box(&start), &ENDS)?;
        let micros = clock.elapsed().as_secs_f64() * 1e6;
        let angles = |end: usize| std::array::from_fn(|link| states[end].values[link]);
        Ok(([angles(0), angles(1)], micros))
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let (tree, expected) = (
        BranchedDouble::new(),
        states(
            &AbsoluteAngles(&BranchedDouble::<Double>::default()),
            &REGULAR,
            &ENDS,
        )?,
    );
    let mut contenders: Vec<(String, Run)> = vec![
        ("ours, frames, 60 Hz".to_owned(), frames(&tree, 60, 1)),
        (
            "ours, frames of 4 sub-steps, 60 Hz".to_owned(),
            frames(&tree, 60, 4),
        ),
        ("ours, Dop853, 1e-6".to_owned(), dop853(&tree, 1e-6)),
        ("ours, Dop853, 1e-12".to_owned(), dop853(&tree, 1e-12)),
    ];
    for (name, joints) in [
        ("impulse", Joints::Impulse),
        ("multibody", Joints::Multibody),
    ] {
        for (rate, iterations) in [(60, 4), (60, 16), (240, 4), (1_000, 4), (10_000, 4)] {
            let name = format!("Rapier, {name} joints, {rate} Hz, {iterations} iterations");
            contenders.push((name, rapier(joints, rate, iterations)));
        }
    }
    let mut times = vec![Vec::new(); contenders.len()];
    let mut errors = vec![[0.0; 2]; contenders.len()];
    for _ in 0..ROUNDS {
        for (number, (_, run)) in contenders.iter().enumerate() {
            let (found, micros) = run()?;
            times[number].push(micros);
            for ((error, found), expected) in errors[number].iter_mut().zip(found).zip(&expected) {
                let pairs = found.iter().zip(expected);
                *error = pairs.fold(0.0, |worst, (a, b)| (a - b).abs().max(worst));
            }
        }
    }
    println!(
        "{:44}{:>12}{:>10}{:>12}{:>12}",
        "", "µs for 10 s", "ratio", "rad at 1 s", "at 10 s"
    );
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let unit = median(&mut times[0].clone());
    for (((name, _), mut times), errors) in contenders.iter().zip(times).zip(errors) {
        let micros = median(&mut times);
        let [short, long] = errors;
        println!(
            "{name:44}{micros:12.0}{:10.1}{short:12.1e}{long:12.1e}",
            micros / unit
        );
    }
    Ok(())
}
