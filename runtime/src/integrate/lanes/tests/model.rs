//! A pendulum with all that a description may ask for, and places without answer.

use crate::scalar::Scalar;
use crate::system::{AbsoluteAngles, LinkName, Model, Pendulum, TaylorPendulum};
use crate::taylor::{self, Connectivity, KnownOrder, LinkConstants, Quad, Start};

/// Two lopsided links with friction, the first driven.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lopsided<T> {
    /// No answer where the second link stands higher than this, in rad.
    pub(super) wall: T,
    /// Of the second link; without answer where it makes the mass matrix singular.
    pub(super) inertia: T,
    /// Torque on the first link is this times cos 2t.
    pub(super) drive: T,
    /// Torque over angular velocity.
    pub(super) friction: T,
    /// Scales how far the centres of mass lie off the links' axes.
    pub(super) lateral: T,
}

/// In absolute angles.
pub(super) type LopsidedOde<T> = AbsoluteAngles<Lopsided<T>>;

struct TwoLinks;

impl Connectivity<2> for TwoLinks {
    const PARENTS: [usize; 2] = [0, 0];
    const LATERAL: bool = true;
}

const INERTIA: f64 = 1.0;
const ALONG: f64 = 0.3;
const ACROSS: f64 = 0.1;
const WEIGHTS: [f64; 2] = [9.0, 4.0];
const LATERAL: [f64; 2] = [0.5, -0.2];
const PACE: f64 = 2.0;

pub(super) fn lopsided<T: Scalar>() -> LopsidedOde<T> {
    let model = Lopsided {
        wall: 7.0,
        inertia: 0.6,
        drive: 0.3,
        friction: 0.02,
        lateral: 1.0,
    };
    AbsoluteAngles(model.cast(T::from_f64))
}

impl<T: Scalar> Lopsided<T> {
    /// Zero, or NaN beyond the wall.
    #[inline(always)]
    fn check(&self, angle: T) -> T {
        (self.wall - angle).sqrt() * T::from_f64(0.0)
    }
}

impl<T: Scalar> Model<T> for Lopsided<T> {
    type Of<S: Scalar> = Lopsided<S>;
    const KNOWN_LINKS: Option<usize> = Some(2);

    fn links(&self) -> usize {
        2
    }

    fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
        LinkName::in_list(&["first", "second"], index)
    }

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Lopsided<S> {
        Lopsided {
            wall: convert(self.wall),
            inertia: convert(self.inertia),
            drive: convert(self.drive),
            friction: convert(self.friction),
            lateral: convert(self.lateral),
        }
    }
}

impl<T: Scalar> Pendulum<T> for Lopsided<T> {
    /// Σ_j M_ij α_j = Σ_j M'_ij ω_j² − …, M_01 = a cos(θ_0 − θ_1) + b sin(θ_0 − θ_1).
    #[inline(always)]
    fn evaluate(
        &self,
        time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        mut alpha: impl FnMut(usize, T),
    ) {
        let number = T::from_f64;
        let (sine, cosine) = (theta(0) - theta(1)).sin_cos();
        let mass = number(ALONG) * cosine + number(ACROSS) * sine;
        let turned = number(ACROSS) * cosine - number(ALONG) * sine;
        let mut torque = [mass; 2];
        for i in 0..2 {
            let (sine, cosine) = theta(i).sin_cos();
            torque[i] = -(number(WEIGHTS[i]) * sine)
                - self.lateral * number(LATERAL[i]) * cosine
                - self.friction * omega(i)
                - self.check(theta(1));
        }
        let drive = self.drive * (number(PACE) * time).sin_cos().1;
        torque[0] = torque[0] + drive + turned * omega(1) * omega(1);
        torque[1] = torque[1] - turned * omega(0) * omega(0);
        let (first, second) = (number(INERTIA), self.inertia);
        let determinant = first * second - mass * mass;
        alpha(0, (second * torque[0] - mass * torque[1]) / determinant);
        alpha(1, (first * torque[1] - mass * torque[0]) / determinant);
    }
}

impl<T: Scalar> TaylorPendulum<T> for Lopsided<T> {
    fn taylor_workspace(&self, order: usize) -> usize {
        taylor::workspace(2, order)
    }

    #[inline(always)]
    fn taylor_coefficients_into(
        &self,
        time: T,
        theta: &[T],
        omega: &[T],
        coefficients: &mut [T],
        work: &mut [Quad<T>],
    ) {
        let (Some(theta), Some(omega)) = (theta.first_chunk(), omega.first_chunk()) else {
            return;
        };
        let friction = self.friction;
        let (sine, cosine) = (T::from_f64(PACE) * time).sin_cos();
        // Order k of the drive: the k-th derivative of cos 2t over k!.
        let drive = |k: usize| {
            let derivative = [cosine, -sine, -cosine, sine][k % 4];
            let factor = (1..=k).fold(1.0, |factor, j| factor * PACE / j as f64);
            self.drive * derivative * T::from_f64(factor)
        };
        let (sines, cosines) = T::sin_cos_each(theta);
        let check = self.check(theta[1]);
        let start = Start {
            theta,
            omega,
            sines,
            cosines,
            bias: [
                friction * omega[0] + check - drive(0),
                friction * omega[1] + check,
            ],
        };
        let constants = LinkConstants {
            inertias: [T::from_f64(INERTIA), self.inertia],
            // M_01 is the first moment of the second link at a distance of one.
            moments: [[0.0, 0.0], [ALONG, ACROSS]].map(|moment| moment.map(T::from_f64)),
            attachments: [[1.0, 0.0]; 2].map(|place| place.map(T::from_f64)),
            weights: WEIGHTS.map(T::from_f64),
            lateral_weights: LATERAL.map(|weight| self.lateral * T::from_f64(weight)),
        };
        let (rows, _) = coefficients.as_chunks_mut::<2>();
        let (rows, _) = rows.as_chunks_mut::<2>();
        let bias = |known: &KnownOrder<T, 2>| {
            let [first, second] = known.omega.map(|omega| friction * omega);
            [first - drive(known.order), second]
        };
        taylor::expand::<T, TwoLinks, 2, 1, _>(&start, &constants, rows, work, Some(bias));
    }

    #[inline(always)]
    fn taylor_coefficients_of<S: Scalar>(
        pendulum: &Lopsided<S>,
        time: S,
        theta: &[S],
        omega: &[S],
        coefficients: &mut [S],
        work: &mut [Quad<S>],
    ) {
        pendulum.taylor_coefficients_into(time, theta, omega, coefficients, work);
    }
}
