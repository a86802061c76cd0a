//! Conversion of formulas of the algebra to plain data.

use crate::exact::Rational;
use crate::mechanics::expression::{Expr, SymbolId};
use symbolica::atom::{AtomView, Symbol as AlgebraSymbol};
use symbolica::coefficient::Coefficient;

pub(super) fn symbol_id(symbol: AlgebraSymbol) -> SymbolId {
    let name = symbol.get_stripped_name();
    match name
        .strip_prefix('x')
        .and_then(|digits| digits.parse().ok())
    {
        Some(id) => SymbolId(id),
        None => unreachable!("the algebra returned a symbol that we did not make: {name}"),
    }
}

pub(super) fn integer(view: AtomView<'_>) -> i32 {
    let number = rational(view);
    match number.to_i32() {
        Some(value) => value,
        None => unreachable!("the algebra returned the exponent {number}"),
    }
}

fn rational(view: AtomView<'_>) -> Rational {
    if let AtomView::Num(number) = view
        && let Coefficient::Complex(value) = number.get_coeff_view().to_owned()
        && value.is_real()
    {
        return Rational::from_inner(value.re);
    }
    unreachable!("the algebra returned a number that is not rational: {view}")
}

pub(super) fn expression(view: AtomView<'_>) -> Expr {
    match view {
        AtomView::Num(_) => Expr::Number(rational(view)),
        AtomView::Var(variable) => Expr::Symbol(symbol_id(variable.get_symbol())),
        AtomView::Pow(power) => Expr::Power(
            Box::new(expression(power.get_base())),
            integer(power.get_exp()),
        ),
        AtomView::Mul(product) => Expr::Product(product.iter().map(expression).collect()),
        AtomView::Add(sum) => Expr::Sum(sum.iter().map(expression).collect()),
        AtomView::Fun(_) => {
            unreachable!("no function enters the algebra, yet it returned {view}")
        }
    }
}
