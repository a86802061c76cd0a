//! Layout of emitted code as text.

use branched_pendulum_codegen::layout;
use quote::quote;

#[test]
fn patterns_of_several_lines_are_indented() {
    let names = (0..12).map(|n| quote::format_ident!("value_{n}"));
    let tokens = quote! { fn f() { let [#(#names),*] = values; g(); } };
    let expected = "\
fn f() {
    let [
        value_0, value_1, value_2, value_3, value_4, value_5, value_6, value_7, value_8,
        value_9, value_10, value_11,
    ] = values;
    g();
}
";
    assert_eq!(layout(tokens).unwrap(), expected);
}

#[test]
fn items_stand_apart_and_statements_do_not() {
    let tokens = quote! {
        struct Model { a: u8, b: u8 }
        impl Model {
            const A: u8 = 1;
            const B: u8 = 2;
            fn first() {
                if true {
                    f();
                }
                #[allow(unused)]
                let a = 1;
            }
            /// Second;
            /// not the third.
            fn second() {}
        }
    };
    let expected = "\
struct Model {
    a: u8,
    b: u8,
}

impl Model {
    const A: u8 = 1;
    const B: u8 = 2;

    fn first() {
        if true {
            f();
        }
        #[allow(unused)]
        let a = 1;
    }

    /// Second;
    /// not the third.
    fn second() {}
}
";
    assert_eq!(layout(tokens).unwrap(), expected);
}
