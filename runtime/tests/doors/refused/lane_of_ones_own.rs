// error: error[E0277] | Registers
impl Lane for Own {}
fn main() {}
