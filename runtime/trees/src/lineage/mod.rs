//! Budgets by scale of lineages: trees with one open branching of each generation (`docs/physics.md`,
//! section 18).
//!
//! All quantities of a generation have as many different values as there are branchings above it, so
//! that a part of scale s is one number for each generation. The energy counts the copies that a
//! link represents.

mod links;

use branched_pendulum::ScaleBudget;
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::sectors::PowerKind;
use branched_pendulum_codegen::scene::{Lineage, Scene};

use self::links::{PlacedLink, cross, dot, times};
use crate::carried::carried;
use crate::numbers::{LinkNumbers, law};
use crate::tree::constant;

/// A lineage, in which energies and transfers are known by scale.
#[derive(Clone, Debug)]
pub(crate) struct LineageScales<T> {
    pub(crate) lineage: Lineage,
    gravity: T,
    links: Vec<LineageLink<T>>,
}

/// A link with all of its copies.
#[derive(Clone, Copy, Debug)]
struct LineageLink<T> {
    generation: usize,
    /// Generation of the branching at which the link's chain is closed; `None` on the open path.
    closed: Option<usize>,
    numbers: LinkNumbers<T>,
    /// First moment about the pivot of the link and all that it carries, kg m.
    moment: [T; 2],
}

/// Parts of a quantity by scale and generation; zero for scales beyond the generation.
struct Parts<T> {
    generations: usize,
    values: Vec<T>,
}

/// Parts of all quantities that the energies are made of, and the velocities of the centres of mass.
struct EnergyParts<T> {
    velocities: Vec<[T; 2]>,
    velocity: [Parts<T>; 2],
    rate: Parts<T>,
    /// 1 − cos θ and sin θ.
    rise: Parts<T>,
    side: Parts<T>,
    /// Strain of the spring in the pivot, rad.
    strain: Parts<T>,
}

/// Angular velocities along the flow of one scale's energy, and the velocities of the centres.
struct Flow<T> {
    rates: Vec<T>,
    velocities: Vec<[T; 2]>,
}

impl<T: Scalar> Parts<T> {
    fn at(&self, scale: usize, generation: usize) -> T {
        let value = self.values.get(scale * self.generations + generation);
        value.copied().unwrap_or(T::from_f64(0.0))
    }

    /// Returns the part of a scale in one link.
    fn of_link(&self, scale: usize, link: &LineageLink<T>) -> T {
        match link.closed {
            Some(closed) if scale > closed => T::from_f64(0.0),
            Some(closed) if scale == closed => -self.at(scale, link.generation),
            Some(_) | None => self.at(scale, link.generation),
        }
    }
}

impl<T: Scalar> LineageScales<T> {
    /// Returns the lineage that a scene is; `None` for another tree.
    pub(crate) fn of(scene: &Scene, links: &[LinkNumbers], gravity: Double) -> Option<Self> {
        let lineage = scene.lineage?;
        let mut places = vec![None; links.len()];
        for generation in 0..lineage.generations {
            *places.get_mut(lineage.open(generation))? = Some((generation, None));
            for closed in 1..=generation {
                let link = lineage.closed(closed, generation);
                *places.get_mut(link)? = Some((generation, Some(closed)));
            }
        }
        let carried = carried(links);
        let rows = links.iter().zip(&carried).zip(places);
        let rows = rows.map(|((numbers, carried), place)| {
            let (generation, closed) = place?;
            Some(LineageLink {
                generation,
                closed,
                numbers: numbers.map(constant),
                moment: carried.moment.map(constant),
            })
        });
        Some(Self {
            lineage,
            gravity: constant(gravity),
            links: rows.collect::<Option<_>>()?,
        })
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> LineageScales<S> {
        let links = self.links.iter().map(|link| LineageLink {
            generation: link.generation,
            closed: link.closed,
            numbers: link.numbers.map(&convert),
            moment: link.moment.map(&convert),
        });
        LineageScales {
            lineage: self.lineage,
            gravity: convert(self.gravity),
            links: links.collect(),
        }
    }

    /// Returns the generation of a link whose sibling moves on its own; springs between these two
    /// belong to the scale of that generation.
    pub(crate) fn branching_of(&self, link: usize) -> Option<usize> {
        let own = self.links.get(link)?;
        let branches = own.closed.is_none_or(|closed| closed == own.generation);
        (own.generation > 0 && branches).then_some(own.generation)
    }

    fn generations(&self) -> usize {
        self.lineage.generations
    }

    fn fits(&self, theta: &[T], omega: &[T]) -> bool {
        [theta.len(), omega.len()] == [self.links.len(); 2]
    }

    /// Writes the energies alone; NaN for slices of another length than there are links.
    pub(crate) fn energies(&self, theta: &[T], omega: &[T], budget: &mut ScaleBudget<T>) {
        if !self.fits(theta, omega) {
            return budget.fill(self.generations(), T::from_f64(f64::NAN));
        }
        budget.fill(self.generations(), T::from_f64(0.0));
        let placed = self.placed(theta);
        self.write_energies(&self.parts(&placed, theta, omega), budget);
    }

    /// Writes the whole budget at angles, angular velocities and, unless the third slice is empty,
    /// torques from outside. `drive` is the acceleration of the root's pivot and the torque on the
    /// root; `between` holds slopes of the springs' energy and torques of friction between siblings.
    pub(crate) fn budget(
        &self,
        drive: Option<[T; 3]>,
        [theta, omega, torques]: [&[T]; 3],
        between: [&[T]; 2],
        budget: &mut ScaleBudget<T>,
    ) {
        let scales = self.generations();
        if !self.fits(theta, omega) || ![0, self.links.len()].contains(&torques.len()) {
            return budget.fill(scales, T::from_f64(f64::NAN));
        }
        budget.fill(scales, T::from_f64(0.0));
        let mut placed = self.placed(theta);
        self.factor(&mut placed);
        let parts = self.parts(&placed, theta, omega);
        self.write_energies(&parts, budget);
        let flows: Vec<Flow<T>> = (0..scales)
            .map(|scale| self.flow(&placed, &parts, scale))
            .collect();
        let momenta = self.momenta(&parts.velocities);
        let turning = self.levered(&placed, &momenta, cross);
        let slopes: Vec<Vec<T>> = (0..scales)
            .map(|scale| {
                self.slope(
                    &placed,
                    &parts,
                    (scale, &flows),
                    omega,
                    [&turning, between[0]],
                )
            })
            .collect();
        let sum = |a: &[T], b: &[T]| {
            let products = a.iter().zip(b).map(|(&a, &b)| a * b);
            products.fold(T::from_f64(0.0), |sum, own| sum + own)
        };
        let all = || flows.iter().zip(&slopes).enumerate();
        for (to, (own, slope)) in all() {
            for (from, (other, rise)) in all().take(to) {
                let transfer = sum(slope, &other.rates) - sum(rise, &own.rates);
                budget.set_transfer(from, to, transfer);
            }
        }
        let acting = [
            (PowerKind::Friction, self.friction(omega, between[1])),
            (PowerKind::Drag, self.drag(omega)),
            (PowerKind::Drive, self.drive(&placed, drive)),
            (PowerKind::Outside, torques.to_vec()),
        ];
        for (kind, torques) in &acting {
            for (scale, flow) in flows.iter().enumerate() {
                budget.add_power(*kind, scale, sum(torques, &flow.rates));
            }
        }
    }

    /// Splits a quantity into scales: of the two links at a branching the mean goes to the older
    /// scales, and half the difference to the scale of the branching.
    fn split(&self, value: impl Fn(usize) -> T) -> Parts<T> {
        let (generations, half) = (self.generations(), T::from_f64(0.5));
        let mut values = vec![T::from_f64(0.0); generations * generations];
        for generation in 0..generations {
            let mut mean = value(self.lineage.open(generation));
            for scale in (1..=generation).rev() {
                let closed = value(self.lineage.closed(scale, generation));
                values[scale * generations + generation] = half * (mean - closed);
                mean = half * (mean + closed);
            }
            values[generation] = mean;
        }
        Parts {
            generations,
            values,
        }
    }

    fn parts(&self, placed: &[PlacedLink<T>], theta: &[T], omega: &[T]) -> EnergyParts<T> {
        let velocities = self.velocities(placed, omega);
        let strain = |link: usize| {
            let LinkNumbers {
                parent, passive, ..
            } = self.links[link].numbers;
            let above = parent.map_or(T::from_f64(0.0), |parent| theta[parent]);
            theta[link] - above - passive.rest
        };
        EnergyParts {
            velocity: [0, 1].map(|axis| self.split(|link| velocities[link][axis])),
            rate: self.split(|link| omega[link]),
            rise: self.split(|link| T::from_f64(1.0) - placed[link].cosine),
            side: self.split(|link| placed[link].sine),
            strain: self.split(strain),
            velocities,
        }
    }

    fn write_energies(&self, parts: &EnergyParts<T>, budget: &mut ScaleBudget<T>) {
        let half = T::from_f64(0.5);
        for generation in 0..self.generations() {
            let link = &self.links[self.lineage.open(generation)];
            let LinkNumbers {
                mass,
                inertia,
                passive,
                ..
            } = link.numbers;
            let [weight, lateral] = times(self.gravity, link.moment);
            for scale in 0..=generation {
                // A scale's part is that of 2^(g − s) links on both sides of its branching.
                let copies = match scale {
                    0 => self.lineage.copies(0, generation),
                    _ => 2 * self.lineage.copies(scale, generation),
                };
                let square = |own: &Parts<T>| {
                    let part = own.at(scale, generation);
                    part * part
                };
                let [x, y] = &parts.velocity;
                let mut energy = half
                    * (mass * (square(x) + square(y))
                        + inertia * square(&parts.rate)
                        + weight * (square(&parts.rise) + square(&parts.side))
                        + passive.spring * square(&parts.strain));
                if scale == 0 {
                    energy = energy + lateral * parts.side.at(0, generation);
                }
                let energy = T::from_f64(copies as f64) * energy;
                budget.set_energy(scale, generation, energy);
            }
        }
    }

    /// Returns the flow of the energy of a scale: the rates M⁻¹ K_s ω.
    fn flow(&self, placed: &[PlacedLink<T>], parts: &EnergyParts<T>, scale: usize) -> Flow<T> {
        let forces = self.momenta_of_scale(parts, scale);
        let mut torques = self.levered(placed, &forces, dot);
        for (torque, link) in torques.iter_mut().zip(&self.links) {
            *torque = *torque + link.numbers.inertia * parts.rate.of_link(scale, link);
        }
        let rates = self.solve(placed, torques);
        let velocities = self.velocities(placed, &rates);
        Flow { rates, velocities }
    }

    fn momenta_of_scale(&self, parts: &EnergyParts<T>, scale: usize) -> Vec<[T; 2]> {
        let links = self.links.iter().map(|link| {
            let [x, y] = &parts.velocity;
            let velocity = [x, y].map(|own| own.of_link(scale, link));
            times(link.numbers.mass, velocity)
        });
        links.collect()
    }

    /// Returns the derivative of a scale's energy with respect to the angles at constant momenta.
    /// `turning` are the levered momenta of the motion, and `springs` the slopes of the energy of
    /// springs between siblings.
    fn slope(
        &self,
        placed: &[PlacedLink<T>],
        parts: &EnergyParts<T>,
        (scale, flows): (usize, &[Flow<T>]),
        omega: &[T],
        [turning, springs]: [&[T]; 2],
    ) -> Vec<T> {
        let flow = &flows[scale];
        let own = self.momenta_of_scale(parts, scale).into_iter();
        let along = self.momenta(&flow.velocities);
        let changed: Vec<[T; 2]> = own
            .zip(along)
            .map(|(a, b)| [a[0] - b[0], a[1] - b[1]])
            .collect();
        let mut slopes = self.levered(placed, &changed, cross);
        for (index, link) in self.links.iter().enumerate() {
            let (own, passive) = (&placed[index], &link.numbers.passive);
            let [weight, lateral] = times(self.gravity, link.moment);
            let rise = parts.rise.of_link(scale, link);
            let side = parts.side.of_link(scale, link);
            let mut slope = omega[index] * slopes[index] - flow.rates[index] * turning[index]
                + weight * (rise * own.sine + side * own.cosine);
            if scale == 0 {
                slope = slope + lateral * own.cosine;
            }
            if let (true, Some(&spring)) =
                (self.branching_of(index) == Some(scale), springs.get(index))
            {
                slope = slope + spring;
            }
            let torque = passive.spring * parts.strain.of_link(scale, link);
            slopes[index] = slope + torque;
            if let Some(parent) = link.numbers.parent {
                slopes[parent] = slopes[parent] - torque;
            }
        }
        slopes
    }

    /// Returns the torques of friction in the pivots, and those between siblings.
    fn friction(&self, omega: &[T], between: &[T]) -> Vec<T> {
        let mut torques = match between.is_empty() {
            true => vec![T::from_f64(0.0); self.links.len()],
            false => between.to_vec(),
        };
        for (index, link) in self.links.iter().enumerate() {
            let LinkNumbers {
                parent, passive, ..
            } = link.numbers;
            let above = parent.map_or(T::from_f64(0.0), |parent| omega[parent]);
            let rate = omega[index] - above;
            let torque = passive.friction * rate + law(passive.laws[0]).torque(rate);
            torques[index] = torques[index] - torque;
            if let Some(parent) = parent {
                torques[parent] = torques[parent] + torque;
            }
        }
        torques
    }

    fn drag(&self, omega: &[T]) -> Vec<T> {
        let links = self.links.iter().zip(omega);
        let torque = |(link, &rate): (&LineageLink<T>, &T)| {
            let passive = &link.numbers.passive;
            -(passive.drag * rate + law(passive.laws[1]).torque(rate))
        };
        links.map(torque).collect()
    }

    /// Returns the torques of the drive: on the root, and of inertial forces if the pivot is moved.
    fn drive(&self, placed: &[PlacedLink<T>], drive: Option<[T; 3]>) -> Vec<T> {
        let [x, y, torque] = drive.unwrap_or([T::from_f64(0.0); 3]);
        let links = self.links.iter().zip(placed);
        let inertial = links.map(|(link, own)| {
            let [along, across] = link.moment;
            let lever = [
                along * own.cosine - across * own.sine,
                along * own.sine + across * own.cosine,
            ];
            -dot(lever, [x, y])
        });
        let mut torques: Vec<T> = inertial.collect();
        if let Some(root) = torques.first_mut() {
            *root = *root + torque;
        }
        torques
    }
}
