// error: error[E0119] | conflicting implementations
own_scalar!();
impl Simd<Own> for Own {}
fn main() {}
