// error: the generations of a tree have more links than a number holds
equations!(Nothing: &[1, 1 << (usize::BITS / 2), 1 << (usize::BITS / 2)]);
fn main() {
    evaluate::<Nothing>();
}
