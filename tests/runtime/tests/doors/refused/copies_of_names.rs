// error: the generations of a tree have more links than a number holds
equations!(Names: &[1, usize::MAX, 3]);
fn main() {
    let _ = (
        Tree::<Names, f64>::link(&[7, 2]),
        Tree::<Names, f64>::path(9),
    );
}
