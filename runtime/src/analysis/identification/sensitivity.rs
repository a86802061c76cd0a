//! A motion and its derivatives with respect to its start and to parameters.

use std::cell::RefCell;

use super::family::{AnyFamily, WIDTH, Wide};
use crate::analysis::variational::TangentMemory;
use crate::scalar::Dual;
use crate::system::Ode;

/// A motion y and its derivatives: the state is y, followed by a column ∂y/∂x for each
/// component x of its start, then one for each free parameter, in units of its scale.
///
/// With y' = f(y, p), a column v obeys v' = ∂f/∂y v + ∂f/∂p: what a number with the
/// derivatives v and ∂p has for a derivative of its rate. Some columns are taken at a time.
pub(super) struct Sensitivities<'a> {
    dimension: usize,
    columns: usize,
    /// The equations, whose parameters carry the derivatives of their group of columns.
    groups: Vec<Box<dyn Ode<Wide> + 'a>>,
    memory: RefCell<TangentMemory<Wide>>,
}

impl<'a> Sensitivities<'a> {
    /// Derivatives with respect to the start, of `dimension` numbers, and to the
    /// parameters with these indices and scales.
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
            columns,
            groups: (0..columns.div_ceil(WIDTH)).map(group).collect(),
            memory: RefCell::new(TangentMemory::new(dimension)),
        }
    }

    /// The start of motion and columns.
    pub(super) fn start(&self, state: &[f64]) -> Vec<f64> {
        let n = self.dimension;
        let mut start = vec![0.0; n * (1 + self.columns)];
        start[..n].copy_from_slice(state);
        for component in 0..n {
            start[n * (1 + component) + component] = 1.0;
        }
        start
    }
}

impl Ode<f64> for Sensitivities<'_> {
    fn dimension(&self) -> usize {
        self.dimension * (1 + self.columns)
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        let n = self.dimension;
        let mut memory = self.memory.borrow_mut();
        let own = &mut *memory;
        let (motion, columns) = state.split_at(n);
        let (motion_rates, column_rates) = rates.split_at_mut(n);
        let in_groups = columns
            .chunks(n * WIDTH)
            .zip(column_rates.chunks_mut(n * WIDTH));
        for (equations, (columns, column_rates)) in self.groups.iter().zip(in_groups) {
            for (component, number) in own.state.iter_mut().enumerate() {
                *number = Dual::constant(motion[component]);
                for (tangent, column) in number.tangents.iter_mut().zip(columns.chunks_exact(n)) {
                    *tangent = column[component];
                }
            }
            equations.rates_with(
                &mut own.workspace,
                Dual::constant(time),
                &own.state,
                &mut own.rates,
            );
            for (component, number) in own.rates.iter().enumerate() {
                motion_rates[component] = number.value;
                let columns = column_rates.chunks_exact_mut(n);
                for (tangent, column) in number.tangents.iter().zip(columns) {
                    column[component] = *tangent;
                }
            }
        }
    }
}
