//! NEON instructions, which every AArch64 machine has.

macro_rules! instructions {
    ($($function:ident($($argument:ident: $kind:ty),+) -> $result:ty = $call:expr;)+) => {
        $(
            #[inline(always)]
            pub(in super::super) fn $function($($argument: $kind),+) -> $result {
                // SAFETY: the machine has NEON, and none of these instructions accesses memory.
                unsafe { $call }
            }
        )+
    };
}

/// Registers of `f64`.
pub(super) mod double {
    use core::arch::aarch64::*;

    pub(in super::super) type Vector = float64x2_t;
    /// Mask of lanes: in each lane, all bits are set or none.
    pub(in super::super) type Mask = uint64x2_t;

    instructions! {
        splat(value: f64) -> Vector = vdupq_n_f64(value);
        add(a: Vector, b: Vector) -> Vector = vaddq_f64(a, b);
        sub(a: Vector, b: Vector) -> Vector = vsubq_f64(a, b);
        mul(a: Vector, b: Vector) -> Vector = vmulq_f64(a, b);
        div(a: Vector, b: Vector) -> Vector = vdivq_f64(a, b);
        neg(a: Vector) -> Vector = vnegq_f64(a);
        sqrt(a: Vector) -> Vector = vsqrtq_f64(a);
        choose(mask: Mask, a: Vector, b: Vector) -> Vector = vbslq_f64(mask, a, b);
        larger_size(a: Vector, b: Vector) -> Vector = {
            let (a, b) = (vabsq_f64(a), vabsq_f64(b));
            vbslq_f64(vcltq_f64(a, b), b, a)
        };
        all_below(a: Vector, limit: f64) -> bool = {
            let below = vcltq_f64(vabsq_f64(a), vdupq_n_f64(limit));
            vgetq_lane_u64::<0>(below) & vgetq_lane_u64::<1>(below) != 0
        };
        exchange(quarter: Vector, sine: Vector, cosine: Vector) -> (Vector, Vector) = {
            let (one, sign) = (vdupq_n_u64(1), vdupq_n_u64(1 << 63));
            let [quarter, sine, cosine] =
                [quarter, sine, cosine].map(|number| vreinterpretq_u64_f64(number));
            // All bits of the lanes with an odd quarter.
            let odd = vtstq_u64(quarter, one);
            let exchange = vandq_u64(odd, veorq_u64(sine, cosine));
            let turned = |value, quarters| {
                let signs = vandq_u64(sign, vshlq_n_u64::<62>(quarters));
                vreinterpretq_f64_u64(veorq_u64(veorq_u64(value, exchange), signs))
            };
            (turned(sine, quarter), turned(cosine, vaddq_u64(quarter, one)))
        };
    }
}

/// Registers of `f32`.
pub(super) mod single {
    use core::arch::aarch64::*;

    pub(in super::super) type Vector = float32x4_t;
    /// Mask of lanes: in each lane, all bits are set or none.
    pub(in super::super) type Mask = uint32x4_t;

    instructions! {
        splat(value: f32) -> Vector = vdupq_n_f32(value);
        add(a: Vector, b: Vector) -> Vector = vaddq_f32(a, b);
        sub(a: Vector, b: Vector) -> Vector = vsubq_f32(a, b);
        mul(a: Vector, b: Vector) -> Vector = vmulq_f32(a, b);
        div(a: Vector, b: Vector) -> Vector = vdivq_f32(a, b);
        neg(a: Vector) -> Vector = vnegq_f32(a);
        sqrt(a: Vector) -> Vector = vsqrtq_f32(a);
        choose(mask: Mask, a: Vector, b: Vector) -> Vector = vbslq_f32(mask, a, b);
        larger_size(a: Vector, b: Vector) -> Vector = {
            let (a, b) = (vabsq_f32(a), vabsq_f32(b));
            vbslq_f32(vcltq_f32(a, b), b, a)
        };
    }
}
