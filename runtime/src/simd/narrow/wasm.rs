//! WebAssembly instructions of `simd128`.

macro_rules! instructions {
    ($($function:ident($($argument:ident: $kind:ty),+) -> $result:ty = $call:expr;)+) => {
        $(
            #[inline(always)]
            pub(in super::super) fn $function($($argument: $kind),+) -> $result {
                $call
            }
        )+
    };
}

/// Registers of `f64`.
pub(super) mod double {
    use core::arch::wasm32::*;

    pub(in super::super) type Vector = v128;
    /// Mask of lanes: in each lane, all bits are set or none.
    pub(in super::super) type Mask = v128;

    instructions! {
        splat(value: f64) -> Vector = f64x2_splat(value);
        add(a: Vector, b: Vector) -> Vector = f64x2_add(a, b);
        sub(a: Vector, b: Vector) -> Vector = f64x2_sub(a, b);
        mul(a: Vector, b: Vector) -> Vector = f64x2_mul(a, b);
        div(a: Vector, b: Vector) -> Vector = f64x2_div(a, b);
        neg(a: Vector) -> Vector = f64x2_neg(a);
        sqrt(a: Vector) -> Vector = f64x2_sqrt(a);
        choose(mask: Mask, a: Vector, b: Vector) -> Vector = v128_bitselect(a, b, mask);
        larger_size(a: Vector, b: Vector) -> Vector = f64x2_pmax(f64x2_abs(a), f64x2_abs(b));
        all_below(a: Vector, limit: f64) -> bool =
            i64x2_all_true(f64x2_lt(f64x2_abs(a), f64x2_splat(limit)));
        exchange(quarter: Vector, sine: Vector, cosine: Vector) -> (Vector, Vector) = {
            let (one, sign) = (i64x2_splat(1), i64x2_splat(i64::MIN));
            // All bits of the lanes with an odd quarter.
            let odd = i64x2_neg(v128_and(quarter, one));
            let exchange = v128_and(odd, v128_xor(sine, cosine));
            let turned = |value, quarters| {
                let signs = v128_and(sign, i64x2_shl(quarters, 62));
                v128_xor(v128_xor(value, exchange), signs)
            };
            (turned(sine, quarter), turned(cosine, i64x2_add(quarter, one)))
        };
    }
}

/// Registers of `f32`.
pub(super) mod single {
    use core::arch::wasm32::*;

    pub(in super::super) type Vector = v128;
    /// Mask of lanes: in each lane, all bits are set or none.
    pub(in super::super) type Mask = v128;

    instructions! {
        splat(value: f32) -> Vector = f32x4_splat(value);
        add(a: Vector, b: Vector) -> Vector = f32x4_add(a, b);
        sub(a: Vector, b: Vector) -> Vector = f32x4_sub(a, b);
        mul(a: Vector, b: Vector) -> Vector = f32x4_mul(a, b);
        div(a: Vector, b: Vector) -> Vector = f32x4_div(a, b);
        neg(a: Vector) -> Vector = f32x4_neg(a);
        sqrt(a: Vector) -> Vector = f32x4_sqrt(a);
        choose(mask: Mask, a: Vector, b: Vector) -> Vector = v128_bitselect(a, b, mask);
        larger_size(a: Vector, b: Vector) -> Vector = f32x4_pmax(f32x4_abs(a), f32x4_abs(b));
    }
}
