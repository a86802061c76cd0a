// error: error[E0277] | Sealed
use branched_pendulum::tree::Row;
#[derive(Clone, Copy)]
struct Long;
impl AsRef<[f64]> for Long {
    fn as_ref(&self) -> &[f64] {
        &[]
    }
}
impl AsMut<[f64]> for Long {
    fn as_mut(&mut self) -> &mut [f64] {
        &mut []
    }
}
impl Row<f64> for Long {
    const LENGTH: usize = 1000;
    fn filled(_: f64) -> Long {
        Long
    }
    fn first_of(_: &[f64]) -> Option<&Long> {
        None
    }
    fn last_of(_: &[f64]) -> Option<&Long> {
        None
    }
}
fn main() {}
