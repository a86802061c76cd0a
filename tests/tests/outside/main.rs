//! Actions on a tree from outside at run time: torques in every form of tree, links whose
//! motion is prescribed, parameters that change.

mod antiphase;
mod balance;
mod changes;
mod gusts;
mod lanes;
mod prescribed;
mod prescribed_loops;
mod reduced;
mod small;
