//! The rule for singular mass matrices against the matrices themselves.

use branched_pendulum_codegen::report::{Message, TreeMessage};

use branched_pendulum_compiler_tests::front_end::{Outcome, run_source};
use branched_pendulum_compiler_tests::random::Random;

/// A link with small whole numbers for values.
struct Link {
    parent: usize,
    mass: i64,
    inertia: i64,
    com: (i64, i64),
    at: (i64, i64),
}

/// A random tree; with lateral offsets if `lateral`.
fn tree(random: &mut Random, links: usize, lateral: bool) -> Vec<Link> {
    let mut rarely = |limit: usize| random.below(limit);
    (0..links)
        .map(|i| {
            let across = |value: usize| if lateral { value as i64 } else { 0 };
            Link {
                parent: rarely(i.max(1)),
                mass: i64::from(rarely(3) > 0),
                inertia: i64::from(rarely(3) == 0),
                com: (rarely(2) as i64, across(rarely(2))),
                at: (rarely(2) as i64, across(rarely(2))),
            }
        })
        .collect()
}

/// The tree as an attribute; links are written behind their children's list.
fn source(links: &[Link]) -> String {
    fn write(links: &[Link], i: usize) -> String {
        let Link {
            mass,
            inertia,
            com,
            at,
            ..
        } = &links[i];
        let at = match i {
            0 => String::new(),
            _ => format!(", at = ({}, {})", at.0, at.1),
        };
        let children: Vec<String> = (1..links.len())
            .filter(|&child| links[child].parent == i)
            .map(|child| write(links, child))
            .collect();
        format!(
            "link{i}(mass = {mass}, inertia = {inertia}, com = ({}, {}){at}) [{}]",
            com.0,
            com.1,
            children.join(", ")
        )
    }
    format!(
        "#[branched_pendulum(gravity = 1, {})] struct Tree;",
        write(links, 0)
    )
}

/// Returns true if the front end calls the tree singular.
fn is_refused(links: &[Link]) -> bool {
    let source = source(links);
    let Outcome { scene, report, .. } = run_source(&source);
    let all_singular = report.diagnostics().iter().all(|diagnostic| {
        matches!(
            diagnostic.message,
            Message::Tree(TreeMessage::Singular { .. })
        )
    });
    assert!(all_singular, "{}", report.render(&source));
    scene.is_none()
}

/// Determinant of the mass matrix at the given angles in units of 45°, from the
/// velocities of the centres of mass.
fn determinant(links: &[Link], angles: &[usize]) -> f64 {
    let n = links.len();
    let turned = |(along, across): (i64, i64), i: usize| {
        let (sin, cos) = (angles[i] as f64 * std::f64::consts::FRAC_PI_4).sin_cos();
        let (along, across) = (along as f64, across as f64);
        (along * cos - across * sin, along * sin + across * cos)
    };
    let mut matrix = vec![vec![0.0; n]; n];
    for (k, link) in links.iter().enumerate() {
        // What the centre of mass moves with, for each link that carries it: a
        // quarter turn of this, which leaves products as they are.
        let mut arms = vec![(k, turned(link.com, k))];
        let mut i = k;
        while i > 0 {
            let above = links[i].parent;
            arms.push((above, turned(links[i].at, above)));
            i = above;
        }
        for &(i, a) in &arms {
            for &(j, b) in &arms {
                matrix[i][j] += link.mass as f64 * (a.0 * b.0 + a.1 * b.1);
            }
        }
        matrix[k][k] += link.inertia as f64;
    }
    let mut determinant = 1.0;
    for i in 0..n {
        // The matrix is positive semidefinite: the diagonal is the best pivot.
        let pivot = (i..n)
            .max_by(|&a, &b| matrix[a][a].total_cmp(&matrix[b][b]))
            .expect("rows are left");
        matrix.swap(i, pivot);
        for row in &mut matrix {
            row.swap(i, pivot);
        }
        let divisor = matrix[i][i];
        if divisor < 1e-9 {
            return 0.0;
        }
        determinant *= divisor;
        let (above, below) = matrix.split_at_mut(i + 1);
        for row in below {
            let factor = row[i] / divisor;
            for (value, pivot) in row.iter_mut().zip(&above[i]) {
                *value -= factor * pivot;
            }
        }
    }
    determinant
}

/// Calls `visit` with all choices of `count` angles in units of 45°, the first
/// of them 0.
fn all_angles(count: usize, mut visit: impl FnMut(&[usize])) {
    let mut angles = vec![0; count];
    for code in 0..8_usize.pow(count as u32 - 1) {
        for (i, angle) in angles.iter_mut().enumerate().skip(1) {
            *angle = code / 8_usize.pow(i as u32 - 1) % 8;
        }
        visit(&angles);
    }
}

/// Without lateral offsets, a mass matrix that is singular anywhere is singular
/// with all links in line.
#[test]
fn rule_agrees_with_straight_trees() {
    let mut random = Random::new(11);
    let mut counts = [0, 0];
    for _ in 0..4_000 {
        let size = 1 + random.below(6);
        let links = tree(&mut random, size, false);
        let singular = determinant(&links, &vec![0; size]) == 0.0;
        counts[usize::from(singular)] += 1;
        assert_eq!(is_refused(&links), singular, "{}", source(&links));
    }
    assert!(counts.iter().all(|&count| count > 400), "{counts:?}");
}

/// With lateral offsets of 0 or 1, all directions in question are multiples of
/// 45°.
#[test]
fn rule_agrees_with_bent_trees() {
    let mut random = Random::new(12);
    let mut counts = [0, 0];
    for _ in 0..1_500 {
        let size = 1 + random.below(4);
        let links = tree(&mut random, size, true);
        let mut singular = false;
        all_angles(size, |angles| {
            singular = singular || determinant(&links, angles) == 0.0;
        });
        counts[usize::from(singular)] += 1;
        assert_eq!(is_refused(&links), singular, "{}", source(&links));
    }
    assert!(counts.iter().all(|&count| count > 150), "{counts:?}");
}
