//! Random trees with springs, their energy by points in the plane, and a search for its minima by
//! finite differences.

use std::fmt::Write;

/// Numbers from 0 to 1 (SplitMix64).
pub(super) struct Random(pub(super) u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64
    }

    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.next() * n as f64) as usize).min(n - 1)
    }
}

/// A rod that hangs from the end of its parent, and the spring in its pivot.
struct Rod {
    parent: Option<usize>,
    mass: f64,
    length: f64,
    spring: f64,
    rest: f64,
}

/// A spring on the difference of two angles, or between points of two rods.
enum Between {
    Torsion([usize; 2], f64, f64),
    Straight([usize; 2], [f64; 2], f64, f64),
}

pub(super) struct Scene {
    gravity: f64,
    rods: Vec<Rod>,
    between: Vec<Between>,
}

pub(super) const NAMES: [&str; 6] = ["a", "b", "c", "d", "e", "f"];

impl Scene {
    pub(super) fn random(random: &mut Random) -> Self {
        let n = 1 + random.below(NAMES.len());
        let mut rods: Vec<Rod> = Vec::new();
        for link in 0..n {
            let is_sprung = random.next() < 0.6;
            rods.push(Rod {
                parent: (link > 0).then(|| random.below(link)),
                mass: random.within(0.05, 0.5),
                length: random.within(0.1, 0.5),
                spring: if is_sprung {
                    random.within(0.05, 2.0)
                } else {
                    0.0
                },
                rest: random.within(-1.0, 1.0),
            });
        }
        let mut between = Vec::new();
        for one in 0..n {
            for other in 0..one {
                if rods[one].parent == Some(other) {
                    continue;
                }
                if random.next() < 0.3 {
                    let (spring, rest) = (random.within(0.05, 2.0), random.within(-1.0, 1.0));
                    between.push(Between::Torsion([one, other], spring, rest));
                }
                if random.next() < 0.3 {
                    let at = [one, other].map(|link| random.within(0.3, 1.0) * rods[link].length);
                    let (spring, rest) = (random.within(1.0, 60.0), random.within(0.02, 0.4));
                    between.push(Between::Straight([one, other], at, spring, rest));
                }
            }
        }
        if between.is_empty() && rods.iter().all(|rod| rod.spring == 0.0) {
            rods[0].spring = random.within(0.05, 2.0);
        }
        let gravity = if random.next() < 0.5 { 9.81 } else { -9.81 };
        Self {
            gravity,
            rods,
            between,
        }
    }

    pub(super) fn text(&self) -> String {
        let mut text = format!("gravity = {}, ", self.gravity);
        self.write(0, &mut text);
        for own in &self.between {
            let (links, clause) = match own {
                Between::Torsion(links, spring, rest) => {
                    (links, format!("spring = {spring}, rest = {rest}"))
                }
                Between::Straight(links, [p, q], spring, rest) => (
                    links,
                    format!("at = each({p}, {q}), spring = {spring}, rest = {rest}"),
                ),
            };
            let [one, other] = links.map(|link| NAMES[link]);
            write!(text, ", between({one}, {other}, {clause})").unwrap();
        }
        text
    }

    fn write(&self, link: usize, text: &mut String) {
        let rod = &self.rods[link];
        let Rod {
            mass,
            length,
            spring,
            rest,
            ..
        } = rod;
        write!(
            text,
            "{}: rod(mass = {mass}, length = {length}",
            NAMES[link]
        )
        .unwrap();
        if *spring != 0.0 {
            write!(text, ", spring = {spring}, rest = {rest}").unwrap();
        }
        text.push(')');
        let children: Vec<usize> = (0..self.rods.len())
            .filter(|&own| self.rods[own].parent == Some(link))
            .collect();
        if !children.is_empty() {
            text.push('[');
            for child in children {
                self.write(child, text);
                text.push(',');
            }
            text.push(']');
        }
    }

    /// Potential energy by points: x to the side, y along links of angle zero.
    pub(super) fn energy(&self, theta: &[f64]) -> f64 {
        let along = |link: usize, length: f64| {
            let (sin, cos) = theta[link].sin_cos();
            [length * sin, length * cos]
        };
        let mut pivots: Vec<[f64; 2]> = Vec::new();
        let mut energy = 0.0;
        for (link, rod) in self.rods.iter().enumerate() {
            let pivot = match rod.parent {
                None => [0.0; 2],
                Some(parent) => {
                    let end = along(parent, self.rods[parent].length);
                    [pivots[parent][0] + end[0], pivots[parent][1] + end[1]]
                }
            };
            pivots.push(pivot);
            energy -= rod.mass * self.gravity * (pivot[1] + along(link, 0.5 * rod.length)[1]);
            let turn = theta[link] - rod.parent.map_or(0.0, |parent| theta[parent]) - rod.rest;
            energy += 0.5 * rod.spring * turn * turn;
        }
        for own in &self.between {
            energy += match *own {
                Between::Torsion([one, other], spring, rest) => {
                    0.5 * spring * (theta[one] - theta[other] - rest).powi(2)
                }
                Between::Straight([one, other], [p, q], spring, rest) => {
                    let (a, b) = (along(one, p), along(other, q));
                    let [x, y] = [0, 1].map(|k| pivots[one][k] + a[k] - pivots[other][k] - b[k]);
                    0.5 * spring * (x.hypot(y) - rest).powi(2)
                }
            };
        }
        energy
    }

    pub(super) fn gradient(&self, theta: &[f64]) -> Vec<f64> {
        let slope = |link: usize| {
            let at = |step: f64| {
                let mut theta = theta.to_vec();
                theta[link] += step;
                self.energy(&theta)
            };
            // Of the fourth order; short, since springs between points that nearly meet have large
            // higher derivatives.
            let h = 1e-4;
            (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)
        };
        (0..theta.len()).map(slope).collect()
    }

    pub(super) fn hessian(&self, theta: &[f64]) -> Vec<Vec<f64>> {
        let h = 1e-3;
        let at = |link: usize, step: f64| {
            let mut theta = theta.to_vec();
            theta[link] += step;
            self.gradient(&theta)
        };
        let columns: Vec<Vec<f64>> = (0..theta.len())
            .map(|link| {
                let (ahead, behind) = (at(link, h), at(link, -h));
                ahead
                    .iter()
                    .zip(behind)
                    .map(|(a, b)| (a - b) / (2.0 * h))
                    .collect()
            })
            .collect();
        let n = theta.len();
        let entry = |row: usize, column: usize| 0.5 * (columns[row][column] + columns[column][row]);
        (0..n)
            .map(|row| (0..n).map(|column| entry(row, column)).collect())
            .collect()
    }

    /// Minimum next to a start, by Newton's method with the magnitudes of the eigenvalues.
    pub(super) fn descend(&self, mut theta: Vec<f64>) -> Option<Vec<f64>> {
        for _ in 0..300 {
            let gradient = self.gradient(&theta);
            let (values, vectors) = eigen(self.hessian(&theta));
            let mut step = vec![0.0; theta.len()];
            for (value, vector) in values.iter().zip(&vectors) {
                let part: f64 = vector.iter().zip(&gradient).map(|(v, g)| v * g).sum();
                for (own, v) in step.iter_mut().zip(vector) {
                    *own -= part / value.abs().max(1e-3) * v;
                }
            }
            let size = step.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            if size < 1e-7 {
                return values.iter().all(|value| *value > 0.0).then_some(theta);
            }
            let mut factor = f64::min(0.3 / size, 1.0);
            let energy = self.energy(&theta);
            let moved = |factor: f64| -> Vec<f64> {
                theta
                    .iter()
                    .zip(&step)
                    .map(|(angle, part)| angle + factor * part)
                    .collect()
            };
            while size > 1e-4 && self.energy(&moved(factor)) > energy && factor > 1e-6 {
                factor *= 0.5;
            }
            theta = moved(factor);
        }
        None
    }
}

/// Eigenvalues and eigenvectors of a symmetric matrix, by Jacobi's rotations.
pub(super) fn eigen(mut a: Vec<Vec<f64>>) -> (Vec<f64>, Vec<Vec<f64>>) {
    let n = a.len();
    let mut vectors: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect())
        .collect();
    for _ in 0..60 {
        for p in 0..n {
            for q in p + 1..n {
                if a[p][q].abs() < 1e-300 {
                    continue;
                }
                let angle = 0.5 * f64::atan2(2.0 * a[p][q], a[q][q] - a[p][p]);
                let (sin, cos) = angle.sin_cos();
                for row in &mut a {
                    let (x, y) = (row[p], row[q]);
                    (row[p], row[q]) = (cos * x - sin * y, sin * x + cos * y);
                }
                for k in 0..n {
                    let (x, y) = (a[p][k], a[q][k]);
                    (a[p][k], a[q][k]) = (cos * x - sin * y, sin * x + cos * y);
                    let (x, y) = (vectors[p][k], vectors[q][k]);
                    (vectors[p][k], vectors[q][k]) = (cos * x - sin * y, sin * x + cos * y);
                }
            }
        }
    }
    ((0..n).map(|i| a[i][i]).collect(), vectors)
}
