// error: `Avx2` is private
fn outline<T: Lane>(numbers: [T; 4]) -> [T; 4] {
    outlined::<0, T::Avx2, _, _>(&Squares, numbers)
}
fn main() {
    println!("{:?}", outline([1.0; 4]));
}
