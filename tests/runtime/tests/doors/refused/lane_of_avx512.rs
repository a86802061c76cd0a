// error: error[E0576] | Avx512
type Wide = <f64 as Lane>::Avx512;
fn main() {
    let x = <Wide as Scalar>::from_f64(1.0);
    println!("{:?}", x * x + x);
}
