// error: a tree has more links than memory or numbers for them
equations!(Endless: &[1, 1 << (usize::BITS - 2)]);
fn main() {
    // Without a slice that would have to be as long.
    Tree::<Endless, f64>::new(vec![0.0; 2], [0.0, 1.0]).evaluate(
        None,
        |_| 0.1,
        |_| 0.0,
        |link, value| println!("{link} {value}"),
    );
}
