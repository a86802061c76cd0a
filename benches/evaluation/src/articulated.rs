//! Articulated-body recursion for any tree, driven by a table of links: `docs/physics.md`, section
//! 2; Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7, in the plane.

use super::table::{GRAVITY, Link};

/// A tree, with the workspace of one evaluation.
#[derive(Clone, Debug)]
pub struct Articulated {
    links: Vec<Link>,
    bodies: Vec<Body>,
}

/// Response of a subtree: the force at its pivot is Φ a + β for the pivot's acceleration a.
#[derive(Clone, Copy, Debug, Default)]
struct Body {
    sine: f64,
    cosine: f64,
    /// Articulated inertia Φ, as xx, xy, yy.
    phi: [f64; 3],
    beta: [f64; 2],
    b: [f64; 2],
    j: f64,
    kappa: f64,
    a: [f64; 2],
}

impl Articulated {
    /// Allocates the workspace for a tree.
    #[must_use]
    pub fn new(links: &[Link]) -> Self {
        Self {
            links: links.to_vec(),
            bodies: vec![Body::default(); links.len()],
        }
    }

    /// Writes the angular accelerations.
    pub fn accelerations(&mut self, theta: &[f64], omega: &[f64], alpha: &mut [f64]) {
        for (i, (body, link)) in self.bodies.iter_mut().zip(&self.links).enumerate() {
            let (sine, cosine) = theta[i].sin_cos();
            let (v, u) = ([cosine, sine], [sine, -cosine]);
            let moment = link.mass * link.com;
            let centrifugal = omega[i] * omega[i] * moment;
            *body = Body {
                sine,
                cosine,
                phi: [link.mass, 0.0, link.mass],
                beta: [-centrifugal * u[0], -centrifugal * u[1]],
                b: [moment * v[0], moment * v[1]],
                j: link.inertia + moment * link.com,
                kappa: 0.0,
                a: [0.0; 2],
            };
        }
        for i in (0..self.links.len()).rev() {
            let body = &mut self.bodies[i];
            let [bx, by] = body.b;
            body.phi[0] -= bx * bx / body.j;
            body.phi[1] -= bx * by / body.j;
            body.phi[2] -= by * by / body.j;
            body.beta[0] -= bx * body.kappa / body.j;
            body.beta[1] -= by * body.kappa / body.j;
            let child = *body;
            if let Some(parent) = self.links[i].parent {
                self.bodies[parent].take(&child, self.links[i].lever, omega[parent]);
            }
        }
        for i in 0..self.links.len() {
            let a = match self.links[i].parent {
                None => [0.0, GRAVITY],
                Some(parent) => {
                    let lever = self.links[i].lever;
                    let above = &self.bodies[parent];
                    let (turn, square) = (alpha[parent], omega[parent] * omega[parent]);
                    [
                        above.a[0] + lever * (turn * above.cosine - square * above.sine),
                        above.a[1] + lever * (turn * above.sine + square * above.cosine),
                    ]
                }
            };
            let body = &mut self.bodies[i];
            body.a = a;
            alpha[i] = -(body.b[0] * a[0] + body.b[1] * a[1] + body.kappa) / body.j;
        }
    }
}

impl Body {
    /// Adds the response of a child that hangs at the distance `lever` along the link.
    fn take(&mut self, child: &Body, lever: f64, omega: f64) {
        let (v, u) = ([self.cosine, self.sine], [self.sine, -self.cosine]);
        let [xx, xy, yy] = child.phi;
        let phi_v = [xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]];
        let phi_u = [xx * u[0] + xy * u[1], xy * u[0] + yy * u[1]];
        let square = omega * omega;
        let q = [
            child.beta[0] - lever * square * phi_u[0],
            child.beta[1] - lever * square * phi_u[1],
        ];
        for k in 0..2 {
            self.b[k] += lever * phi_v[k];
            self.beta[k] += q[k];
        }
        for k in 0..3 {
            self.phi[k] += child.phi[k];
        }
        self.j += lever * lever * (v[0] * phi_v[0] + v[1] * phi_v[1]);
        self.kappa += lever * (v[0] * q[0] + v[1] * q[1]);
    }
}
