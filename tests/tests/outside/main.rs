//! Actions on a tree from outside at run time: torques in every form of tree, links whose
//! motion is prescribed, parameters that change.

mod adjoint;
mod antiphase;
mod balance;
mod canonical;
mod changes;
mod gusts;
mod inverse_dynamics;
mod lanes;
mod prescribed;
mod prescribed_loops;
mod reduced;
mod small;
mod symplectic;
