// error: error[E0405] | ByKind
own_scalar! {
    fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
        question.of_wide::<f64>()
    }
}
fn main() {
    let _ = outlined::<0, Own, _, _>(&Squares, [1.0; 4]);
}
