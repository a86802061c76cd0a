//! Accelerations against the equations of motion as one linear system.

use alloc::vec::Vec;

use super::equations::{ALL, SampleBody, any, by_generation, by_link, links};
use super::{accelerations, drive, motion};

type Vector = [f64; 2];

fn dot([x, y]: Vector, [u, v]: Vector) -> f64 {
    x * u + y * v
}

/// Solves Σ_k (∂r_k/∂θ_i)·m_k (r̈_k + g) + I_i θ̈_i = Q_i for the accelerations.
fn dense(parents: &[u32], bodies: &[SampleBody]) -> Vec<f64> {
    let count = bodies.len();
    let [theta, omega, torques] = motion::<f64>(count);
    let drive = drive::<f64>();
    let parent = |link: usize| (link > 0).then(|| parents[link] as usize);
    let u = |link: usize| [theta[link].sin(), -theta[link].cos()];
    let v = |link: usize| [theta[link].cos(), theta[link].sin()];
    let place = |link: usize, [along, across]: Vector| {
        let (u, v) = (u(link), v(link));
        let p = [along * u[0] + across * v[0], along * u[1] + across * v[1]];
        let w = [along * v[0] - across * u[0], along * v[1] - across * u[1]];
        [p, w]
    };
    let mut matrix = alloc::vec![alloc::vec![0.0; count + 1]; count];
    for (k, body) in bodies.iter().enumerate() {
        // Links above, each with the place on it that the body hangs from.
        let mut chain = alloc::vec![(k, [body.moment / body.mass, 0.0])];
        let mut link = k;
        while let Some(above) = parent(link) {
            chain.push((above, bodies[link].place));
            link = above;
        }
        let mut known = [drive.pivot[0], 9.81 + drive.pivot[1]];
        for &(i, at) in &chain {
            let [p, _] = place(i, at);
            known[0] -= omega[i] * omega[i] * p[0];
            known[1] -= omega[i] * omega[i] * p[1];
        }
        for &(i, at_i) in &chain {
            let [_, w_i] = place(i, at_i);
            for &(j, at_j) in &chain {
                matrix[i][j] += body.mass * dot(w_i, place(j, at_j)[1]);
            }
            matrix[i][count] -= body.mass * dot(w_i, known);
        }
        // What is missing to the inertia about the pivot.
        matrix[k][k] += body.inertia - body.moment * body.moment / body.mass;
        let (mut angle, mut rate) = (theta[k], omega[k]);
        if let Some(above) = parent(k) {
            angle -= theta[above];
            rate -= omega[above];
        }
        let torque = body.friction * rate + body.spring * angle;
        matrix[k][count] += torques[k] - torque;
        if let Some(above) = parent(k) {
            matrix[above][count] += torque;
        }
    }
    matrix[0][count] += drive.torque;
    solve(matrix)
}

/// Gaussian elimination; the matrix is positive definite.
fn solve(mut matrix: Vec<Vec<f64>>) -> Vec<f64> {
    let count = matrix.len();
    for pivot in 0..count {
        let row = matrix[pivot].clone();
        for other in matrix.iter_mut().skip(pivot + 1) {
            let factor = other[pivot] / row[pivot];
            for (value, own) in other.iter_mut().zip(&row) {
                *value -= factor * own;
            }
        }
    }
    let mut solution = alloc::vec![0.0; count];
    for row in (0..count).rev() {
        let known: f64 = (row + 1..count).map(|i| matrix[row][i] * solution[i]).sum();
        solution[row] = (matrix[row][count] - known) / matrix[row][row];
    }
    solution
}

#[track_caller]
fn agree(own: &[f64], dense: &[f64]) {
    let size = dense
        .iter()
        .fold(1.0, |size: f64, alpha| size.max(alpha.abs()));
    for (link, (own, dense)) in own.iter().zip(dense).enumerate() {
        let apart = (own - dense).abs();
        assert!(apart <= 2e-14 * size, "link {link}: {own} {dense}");
    }
}

fn generations_agree<const PLACE: usize>() {
    // Of more links the dense solve has too few digits left.
    let small = |copies: &&&[usize]| links(copies).0.len() < 200;
    for copies in ALL[PLACE].iter().filter(small) {
        let (parents, bodies) = links(copies);
        let expected = dense(&parents, &bodies);
        let tree = by_generation::<f64, PLACE>(copies);
        agree(&accelerations(&tree, bodies.len()), &expected);
        let same = by_link::<f64>(&parents, &bodies);
        agree(&accelerations(&same, bodies.len()), &expected);
    }
}

#[test]
fn trees_by_generation_solve_the_equations_of_motion() {
    generations_agree::<0>();
    generations_agree::<1>();
    generations_agree::<2>();
    generations_agree::<3>();
    generations_agree::<4>();
}

#[test]
fn trees_of_any_shape_solve_the_equations_of_motion() {
    for (count, seed) in [
        (1, 0),
        (2, 0),
        (5, 3),
        (17, 4),
        (33, 9),
        (64, 1),
        (90, 7),
        (91, 8),
    ] {
        let (parents, bodies) = any(count, seed);
        let tree = by_link::<f64>(&parents, &bodies);
        agree(&accelerations(&tree, count), &dense(&parents, &bodies));
    }
}

/// Parents that are none must not lead out of memory.
#[test]
fn parents_behind_their_links_are_no_parents() {
    let (_, bodies) = any(40, 2);
    let tree = by_link::<f64>(&[u32::MAX; 40], &bodies);
    assert!(
        accelerations(&tree, 40)
            .iter()
            .all(|alpha| alpha.is_finite())
    );
}
