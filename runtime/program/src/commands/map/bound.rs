//! Energy below which no link can turn over.

use branched_pendulum::prelude::*;
use branched_pendulum::system::Energy;
use branched_pendulum_charts::{Color, Dash, Series};
use branched_pendulum_trees::PendulumTree;

use crate::Failure;
use crate::commands::plane::{MapPlane, Point};

/// Colour of the curve, visible on dark blue, yellow and grey.
const CURVE: Color = Color::rgb(225, 70, 60);

/// Potential energy Σ G (1 − cos θ) + F sin θ (J) of a tree without springs.
struct GravityPotential(Vec<[f64; 2]>);

impl GravityPotential {
    /// Returns the gravity potential of a tree; `None` if its potential energy has another form.
    fn of(tree: &PendulumTree) -> Option<Self> {
        use std::f64::consts::{FRAC_PI_2, PI};
        let links = tree.links();
        let at = |link: usize, angle: f64| {
            let mut theta = vec![0.0; links];
            theta[link] = angle;
            tree.potential_energy_of(&theta)
        };
        let rest = tree.potential_energy_of(&vec![0.0; links]);
        let moments = (0..links).map(|link| {
            let lateral = at(link, FRAC_PI_2) - at(link, -FRAC_PI_2);
            [0.5 * (at(link, PI) - rest), 0.5 * lateral]
        });
        let own = Self(moments.collect());
        // More than a turn from rest: springs would be wound up.
        let theta: Vec<f64> = (0..links).map(|link| 7.0 + 1.3 * link as f64).collect();
        let sum = own.0.iter().zip(&theta);
        let sum: f64 = sum
            .map(|([g, f], angle)| g * (1.0 - angle.cos()) + f * angle.sin())
            .sum();
        let size: f64 = own.0.iter().map(|[g, f]| g.hypot(*f)).sum();
        let difference = tree.potential_energy_of(&theta) - rest - sum;
        (difference.abs() <= 1e-12 * size).then_some(own)
    }

    /// Returns the energy of the lowest configuration in which one of these links is upside down,
    /// relative to the configuration with all angles zero.
    fn lowest_inverted(&self, links: &[usize]) -> f64 {
        let lowest = |[g, f]: &[f64; 2]| g - g.hypot(*f);
        let all: f64 = self.0.iter().map(lowest).sum();
        let inverted = links.iter().filter_map(|&link| self.0.get(link));
        let inverted = inverted.map(|own| 2.0 * own[0] - lowest(own) + all);
        inverted.fold(f64::INFINITY, f64::min)
    }
}

/// Returns, for each point, the energy of the start minus the energy of the lowest configuration
/// with one of these links upside down, in J. If it is negative, none of the links ever turns over,
/// because friction removes energy. `None` if the tree has springs or is driven.
///
/// # Errors
/// [`Failure::Tree`].
pub(super) fn excess(
    plane: &MapPlane<'_>,
    links: &[usize],
    points: &[Point],
) -> Result<Option<Vec<f64>>, Failure> {
    let trees = plane.trees_at(points)?;
    let excess = points.iter().zip(trees).map(|(point, tree)| {
        let gravity = GravityPotential::of(&tree).filter(|_| tree.drive(0.0).is_none())?;
        let State { values, .. } = plane.start_at(point);
        let (theta, omega) = values.split_at(tree.links());
        let rest = tree.potential_energy_of(&vec![0.0; tree.links()]);
        let energy = tree.kinetic_energy_of(theta, omega) + tree.potential_energy_of(theta) - rest;
        Some(energy - gravity.lowest_inverted(links))
    });
    Ok(excess.collect())
}

/// Returns the curve on which this energy difference is zero; `excess` has its values at the points
/// of the plane, row by row. `None` if they all have the same sign.
pub(super) fn curve(plane: &MapPlane<'_>, excess: &[f64]) -> Option<Series> {
    let ([columns, rows], points) = (plane.size(), plane.points());
    let (mut x, mut y) = (Vec::new(), Vec::new());
    if excess.len() != columns * rows {
        return None;
    }
    for (row, column) in (1..rows).flat_map(|row| (1..columns).map(move |column| (row, column))) {
        let place = |row: usize, column: usize| row * columns + column;
        let corners = [
            place(row - 1, column - 1),
            place(row - 1, column),
            place(row, column),
            place(row, column - 1),
        ];
        // Where the sides of the cell are crossed: at two places, or at four next to a saddle.
        let crossed = (0..4).filter_map(|side| {
            let (one, other) = (corners[side], corners[(side + 1) % 4]);
            let (a, b) = (excess[one], excess[other]);
            let part = a / (a - b);
            let between =
                |axis: usize| points[one][axis] + part * (points[other][axis] - points[one][axis]);
            ((a < 0.0) != (b < 0.0)).then(|| [between(0), between(1)])
        });
        let crossed: Vec<Point> = crossed.collect();
        for pair in crossed.chunks_exact(2) {
            for point in pair {
                x.push(point[0]);
                y.push(point[1]);
            }
            // A gap before the next cell.
            x.push(f64::NAN);
            y.push(f64::NAN);
        }
    }
    let label = "energy of the lowest inverted configuration";
    let curve = Series::line(label, &x, &y).color(CURVE).dash(Dash::Solid);
    (!x.is_empty()).then_some(curve)
}
