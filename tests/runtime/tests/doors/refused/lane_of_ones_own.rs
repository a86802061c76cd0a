// error: error[E0277] | Registers
own_scalar!();
impl Lane for Own {}
fn main() {}
