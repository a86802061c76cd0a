//! A motion and its derivatives by its initial state and by parameters.

use std::cell::RefCell;

use super::family::{AnyFamily, WIDTH, Wide};
use branched_pendulum::scalar::Dual;
use branched_pendulum::system::{Ode, Workspace};

/// The system of a motion y and its derivatives: one column ∂y/∂x for each component x of its
/// start, then one for each free parameter, in units of its scale.
///
/// With y' = f(y, p), a column v obeys v' = ∂f/∂y v + ∂f/∂p, which is the derivative of the rate in
/// numbers with the derivatives v and ∂p. [`WIDTH`] columns are computed at a time: the state is y,
/// followed by groups of that number of columns, in which those of one component are neighbours, as
/// in the number. Unused columns of the last group are zero.
pub(super) struct Sensitivities<'a> {
    dimension: usize,
    /// The equations for each group of columns; their parameters carry the derivatives of that
    /// group.
    groups: Vec<Box<dyn Ode<Wide> + 'a>>,
    memory: RefCell<Memory>,
}

/// Buffers for one evaluation in numbers with derivatives.
struct Memory {
    state: Vec<Wide>,
    rates: Vec<Wide>,
    workspace: Workspace<Wide>,
}

impl<'a> Sensitivities<'a> {
    /// Creates the system of derivatives by the initial state, which has `dimension` components,
    /// and by the parameters with these indices and scales.
    pub(super) fn new(
        family: &'a dyn AnyFamily,
        dimension: usize,
        values: &[f64],
        free: &[(usize, f64)],
    ) -> Self {
        let columns = dimension + free.len();
        let group = |group: usize| {
            let mut wide: Vec<Wide> = values.iter().map(|&value| Dual::constant(value)).collect();
            for (number, &(parameter, scale)) in free.iter().enumerate() {
                let place = (dimension + number).checked_sub(group * WIDTH);
                let slot = wide.get_mut(parameter);
                if let (Some(place), Some(wide)) = (place, slot)
                    && let Some(tangent) = wide.tangents.get_mut(place)
                {
                    *tangent = scale;
                }
            }
            family.wide(&wide)
        };
        Self {
            dimension,
            groups: (0..columns.div_ceil(WIDTH)).map(group).collect(),
            memory: RefCell::new(Memory {
                state: vec![Wide::constant(0.0); dimension],
                rates: vec![Wide::constant(0.0); dimension],
                workspace: Workspace::new(),
            }),
        }
    }

    /// Returns the initial state of the motion followed by all columns.
    pub(super) fn start(&self, state: &[f64]) -> Vec<f64> {
        let mut start = vec![0.0; self.dimension()];
        start[..self.dimension].copy_from_slice(state);
        for component in 0..self.dimension {
            start[self.state_index(component, component)] = 1.0;
        }
        start
    }

    /// Returns the index, within the state of this system, of one component of a column.
    pub(super) fn state_index(&self, column: usize, component: usize) -> usize {
        let group = self.dimension * (1 + column / WIDTH * WIDTH);
        group + component * WIDTH + column % WIDTH
    }
}

impl Ode<f64> for Sensitivities<'_> {
    fn dimension(&self) -> usize {
        self.dimension * (1 + self.groups.len() * WIDTH)
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        let n = self.dimension;
        let mut memory = self.memory.borrow_mut();
        let own = &mut *memory;
        let (motion, columns) = state.split_at(n);
        let (motion_rates, column_rates) = rates.split_at_mut(n);
        let (columns, _) = columns.as_chunks::<WIDTH>();
        let (column_rates, _) = column_rates.as_chunks_mut::<WIDTH>();
        let in_groups = columns
            .chunks_exact(n)
            .zip(column_rates.chunks_exact_mut(n));
        for (equations, (columns, column_rates)) in self.groups.iter().zip(in_groups) {
            for (component, number) in own.state.iter_mut().enumerate() {
                (number.value, number.tangents) = (motion[component], columns[component]);
            }
            equations.rates_with(
                &mut own.workspace,
                Dual::constant(time),
                &own.state,
                &mut own.rates,
            );
            for (component, number) in own.rates.iter().enumerate() {
                motion_rates[component] = number.value;
                column_rates[component] = number.tangents;
            }
        }
    }
}
