//! Random trees in plain numbers, with springs and friction between their links, solved densely.

/// Uniform numbers from a seed (Numerical Recipes' `ranqd1` in 64 bits).
pub(super) struct Numbers(pub(super) u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub(super) fn below(&mut self, end: usize) -> usize {
        (self.next() * end as f64) as usize
    }
}

/// Solves a system of equations by elimination with pivots.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for column in 0..n {
        let size = |row: &usize| matrix[*row][column].abs();
        let pivot = (column..n).max_by(|a, b| size(a).total_cmp(&size(b)));
        matrix.swap(column, pivot.unwrap());
        right.swap(column, pivot.unwrap());
        let (above, below) = matrix.split_at_mut(column + 1);
        let pivot = &above[column];
        for (row, own) in (column + 1..).zip(below) {
            let factor = own[column] / pivot[column];
            for (own, pivot) in own.iter_mut().zip(pivot) {
                *own -= factor * pivot;
            }
            right[row] -= factor * right[column];
        }
    }
    for row in (0..n).rev() {
        let known: f64 = (row + 1..n)
            .map(|place| matrix[row][place] * right[place])
            .sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    right
}

/// A tree of links without lateral offsets and without joint torques, in plain numbers, and what
/// acts between its links: the accelerations by the closed form of the mass matrix.
pub(super) struct PlainTree {
    parents: Vec<Option<usize>>,
    /// Mass, centre of mass, inertia and pivot on the parent.
    bodies: Vec<[f64; 4]>,
    /// The two links, κ, ρ, c, C, q and ε.
    spring_dampers: Vec<([usize; 2], [f64; 6])>,
}

impl PlainTree {
    pub(super) fn random(numbers: &mut Numbers) -> Self {
        let links = 2 + numbers.below(11);
        let parents = (0..links)
            .map(|link| (link > 0).then(|| numbers.below(link)))
            .collect();
        let body = |numbers: &mut Numbers| {
            let ranges = [(0.05, 0.4), (0.05, 0.3), (1e-4, 3e-3), (0.05, 0.4)];
            ranges.map(|(low, high)| numbers.between(low, high))
        };
        let bodies = (0..links).map(|_| body(numbers)).collect();
        let spring_damper = |numbers: &mut Numbers| {
            let first = numbers.below(links);
            let second = (first + 1 + numbers.below(links - 1)) % links;
            let ranges = [
                (0.0, 0.5),
                (-1.0, 1.0),
                (0.0, 1e-2),
                (0.0, 0.05),
                (0.0, 1e-2),
                (0.01, 0.3),
            ];
            let own = ranges.map(|(low, high)| numbers.between(low, high));
            ([first, second], own)
        };
        let spring_dampers = (0..1 + numbers.below(4))
            .map(|_| spring_damper(numbers))
            .collect();
        Self {
            parents,
            bodies,
            spring_dampers,
        }
    }

    pub(super) fn text(&self) -> String {
        let link = |link: usize| {
            let [mass, com, inertia, at] = self.bodies[link];
            let at = match self.parents[link] {
                Some(_) => format!(", at = {at}"),
                None => String::new(),
            };
            format!("l{link}(mass = {mass}, com = {com}, inertia = {inertia}{at})")
        };
        fn written(tree: &PlainTree, own: usize, link: &dyn Fn(usize) -> String) -> String {
            let children =
                (0..tree.parents.len()).filter(|other| tree.parents[*other] == Some(own));
            let children: Vec<String> = children.map(|child| written(tree, child, link)).collect();
            match children.is_empty() {
                true => link(own),
                false => format!("{} [{}]", link(own), children.join(", ")),
            }
        }
        let spring_dampers = self.spring_dampers.iter().map(|([a, b], own)| {
            let [spring, rest, friction, coulomb, quadratic, width] = own;
            format!(
                ", between(l{a}, l{b}, spring = {spring}, rest = {rest}, friction(viscous = \
                 {friction}, coulomb = {coulomb}, quadratic = {quadratic}, width = {width}))"
            )
        });
        let spring_dampers: String = spring_dampers.collect();
        format!(
            "gravity = 9.81, {}{spring_dampers}",
            written(self, 0, &link)
        )
    }

    pub(super) fn accelerations(&self, theta: &[f64], omega: &[f64]) -> Vec<f64> {
        let n = theta.len();
        let below = |link: usize, above: usize| {
            let mut at = Some(link);
            while let Some(own) = at {
                if own == above {
                    return true;
                }
                at = self.parents[own];
            }
            false
        };
        let children = |link: usize| (0..n).filter(move |other| self.parents[*other] == Some(link));
        let carried = |link: usize| -> f64 {
            (0..n)
                .filter(|other| below(*other, link))
                .map(|other| self.bodies[other][0])
                .sum()
        };
        let moment = |link: usize| -> f64 {
            let [mass, com, ..] = self.bodies[link];
            let hung: f64 = children(link)
                .map(|child| self.bodies[child][3] * carried(child))
                .sum();
            mass * com + hung
        };
        let mut matrix = vec![vec![0.0; n]; n];
        let mut right = vec![0.0; n];
        for i in 0..n {
            let [mass, com, inertia, _] = self.bodies[i];
            let hung: f64 = children(i)
                .map(|child| self.bodies[child][3].powi(2) * carried(child))
                .sum();
            matrix[i][i] = inertia + mass * com * com + hung;
            right[i] -= 9.81 * moment(i) * theta[i].sin();
            for j in (0..n).filter(|j| *j != i && below(*j, i)) {
                let child = children(i).find(|child| below(j, *child)).unwrap();
                let entry = self.bodies[child][3] * moment(j);
                let apart = theta[i] - theta[j];
                matrix[i][j] = entry * apart.cos();
                matrix[j][i] = matrix[i][j];
                right[i] -= entry * apart.sin() * omega[j] * omega[j];
                right[j] += entry * apart.sin() * omega[i] * omega[i];
            }
        }
        for ([a, b], [spring, rest, friction, coulomb, quadratic, width]) in &self.spring_dampers {
            let (apart, rate) = (theta[*a] - theta[*b], omega[*a] - omega[*b]);
            let speed = rate.hypot(*width);
            let braking = (friction + coulomb / speed + quadratic * speed) * rate;
            let torque = -spring * (apart - rest) - braking;
            right[*a] += torque;
            right[*b] -= torque;
        }
        solve(matrix, right)
    }
}
