// error: error[E0576] | Avx512
fn main() {
    println!(
        "{:?}",
        outlined::<0, <f64 as Lane>::Avx512, _, _>(&Squares, [1.0; 4])
    );
}
