// What the refused sources do, but for what is refused in them.
equations!(Fork: &[1, 2, 1]);

own_scalar!();

fn double<T: Lane>(x: T) -> T {
    x + x
}

fn last<T: Scalar, V: Simd<T>>(numbers: &[T]) -> Option<V> {
    V::load(numbers)
}

fn main() {
    evaluate::<Fork>();
    let _ = (Tree::<Fork, f64>::link(&[1]), Tree::<Fork, f64>::path(3));
    let _ = (double(1.0), InstructionSet::widest());
    let _ = outlined::<0, Lanes<f64, 4>, _, _>(&Squares, [1.0; 4]);
    let _ = outlined::<0, Own, _, _>(&Squares, [Own(1.0); 4]);
    let _ = last::<f64, Lanes<f64, 16>>(&[1.0; 16]);
    let _ = last::<Own, Own>(&[Own(1.0)]).map(Simd::<Own>::first);
}
