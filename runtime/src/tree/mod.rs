//! Large trees: equations of motion in loops.
//
// Emitted code will find here, beside the equations:
//
//     pub struct Tree<E, T>;               // Clone, Debug, PartialEq by derive or bounds on T alone
//     impl<E: LinkEquations, T: Scalar> Tree<E, T> {
//         // By generations: a row for each entry of E::COPIES.
//         fn new(rows: Vec<E::Constants<T>>, root: [T; 2]) -> Self;
//         // Otherwise: parents before children, the root's own is 0; a row a link.
//         fn with_parents(parents: &[u32], rows: Vec<E::Constants<T>>, root: [T; 2]) -> Self;
//         fn set_threads(&mut self, threads: NonZeroUsize);
//         fn accelerations_with(&self, workspace: &mut Workspace<T>, drive: Option<RootDrive<T>>,
//             theta: &[T], omega: &[T], alpha: &mut [T]);
//         fn accelerations_into(&self, drive: Option<RootDrive<T>>, theta, omega, alpha);
//         fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Tree<E, S>;
//         fn evaluate(&self, drive: Option<RootDrive<T>>, theta: impl Fn(usize) -> T,
//             omega: impl Fn(usize) -> T, alpha: impl FnMut(usize, T));       // as Cast::evaluate
//         fn room(&self) -> usize;                                            // as Cast::room
//         fn in_registers<R: Register<Lane = T>>(&self, drive: Option<RootDrive<T>>, room: &mut [T])
//             -> impl InRegisters<R>;                                         // as Cast::in_registers
//         fn link(path: &[usize]) -> Option<usize>;  fn path(index) -> Option<Vec<usize>>;
//         fn link_name(index) -> Option<LinkName>;                            // by generations
//     }
//     pub fn rows<T, const N: usize>(exact: &[[[f64; 2]; N]]) -> Vec<[T; N]>;
//     pub struct RootDrive<T> { pivot: [T; 2], torque: T }   // added to `root`; in the tree's units
//     pub enum Shape { Generations(&'static [usize]), Parents(&'static [u32]) }
//     pub struct Bodies<T>; Bodies::new(Shape, rows): as today, all energies;
//         its functions allocate.

mod equations;

pub use equations::{LinkEquations, LinkMotion, Row};
