//! The mechanics: what is derived and emitted, against independent derivations,
//! reference numbers and the paper's formulas.

mod between;
mod drive;
mod exactness;
mod fixtures;
mod formulas;
mod friction;
mod letters;
mod lineage;
mod nested_observables;
mod normal_form;
mod observables;
mod orders;
mod outside;
mod paper;
mod parameters;
mod pullbacks;
mod random_trees;
mod rebuilt;
mod reductions;
mod reference;
mod run_time;
mod scans;
mod sectors;
mod small;
mod solves;
mod stiff;
mod support;
mod symmetric;
mod taylor;
mod transfer;
mod transverse;
mod unequal;
