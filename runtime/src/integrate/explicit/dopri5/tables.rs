//! Coefficients of Dormand and Prince's pair of order 5(4).
//!
//! Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations
//! I*, 2nd edition, Springer 1993, table II.5.2; dense output as in the
//! authors' program `dopri5.f`. Stages count from 1; entries that are not
//! listed are zero. The tests check every order condition.

use crate::integrate::explicit::pair::TableRow;

/// Order of the solution from which the next step starts.
pub(super) const ORDER: u32 = 5;
/// Number of stages of a step. The first is shared with the step before.
pub(super) const STAGES: usize = 6;
/// Number of all stages: the step, and the rates at its end.
pub(super) const STAGES_DENSE: usize = 7;

/// Nodes c of the stages, as fractions of the step.
pub(super) const C: [f64; STAGES_DENSE] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];

pub(super) const A2: TableRow<1> = [(1, 1.0 / 5.0)];
pub(super) const A3: TableRow<2> = [(1, 3.0 / 40.0), (2, 9.0 / 40.0)];
pub(super) const A4: TableRow<3> = [(1, 44.0 / 45.0), (2, -56.0 / 15.0), (3, 32.0 / 9.0)];
pub(super) const A5: TableRow<4> = [
    (1, 19372.0 / 6561.0),
    (2, -25360.0 / 2187.0),
    (3, 64448.0 / 6561.0),
    (4, -212.0 / 729.0),
];
pub(super) const A6: TableRow<5> = [
    (1, 9017.0 / 3168.0),
    (2, -355.0 / 33.0),
    (3, 46732.0 / 5247.0),
    (4, 49.0 / 176.0),
    (5, -5103.0 / 18656.0),
];

/// Weights of the solution of order 5; also the row of stage 7.
pub(super) const B: TableRow<5> = [
    (1, 35.0 / 384.0),
    (3, 500.0 / 1113.0),
    (4, 125.0 / 192.0),
    (5, -2187.0 / 6784.0),
    (6, 11.0 / 84.0),
];

/// Weights of the solution of order 5 minus those of the embedded solution of order 4.
pub(super) const E: TableRow<6> = [
    (1, 71.0 / 57600.0),
    (3, -71.0 / 16695.0),
    (4, 71.0 / 1920.0),
    (5, -17253.0 / 339200.0),
    (6, 22.0 / 525.0),
    (7, -1.0 / 40.0),
];

/// Weights of the highest coefficient of the dense output.
pub(super) const D: TableRow<6> = [
    (1, -12715105075.0 / 11282082432.0),
    (3, 87487479700.0 / 32700410799.0),
    (4, -10690763975.0 / 1880347072.0),
    (5, 701980252875.0 / 199316789632.0),
    (6, -1453857185.0 / 822651844.0),
    (7, 69997945.0 / 29380423.0),
];
