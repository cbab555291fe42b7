// Float arithmetic with the same bits on every device.
//
// WGSL lets a device contract a * b + c to one fma, which rounds once instead of twice, and bounds
// the error of divisions and roots only loosely. A min or clamp between a product and a sum
// prevents contraction. So every product passes `rounded` or a clamp before it enters a sum.
// `rounding_tests.rs` checks every sum of every shader.

const LIMIT: f32 = 1e30;

// Returns a product below LIMIT.
fn rounded(product: f32) -> f32 {
    return min(product, LIMIT);
}

fn rounded2(products: vec2f) -> vec2f {
    return min(products, vec2f(LIMIT));
}

fn rounded4(products: vec4f) -> vec4f {
    return min(products, vec4f(LIMIT));
}

// Returns a product that needs no rounding, as one by a power of two.
fn exact(product: f32) -> f32 {
    return product;
}

fn exact2(products: vec2f) -> vec2f {
    return products;
}

fn exact4(products: vec4f) -> vec4f {
    return products;
}

// Returns 1 / x for a normal x > 0, by three steps of Newton's method: the error of the first
// estimate, 12 %, is squared by each. `half` nears half of the result, so that products with it lie
// within the bounds of the clamp.
fn reciprocal(x: f32) -> f32 {
    var half = bitcast<f32>(0x7e7311c7u - bitcast<u32>(x));
    for (var i = 0u; i < 3u; i++) {
        half *= 2.0 - exact(2.0 * clamp(x * half, 0.0, 1.0));
    }
    return 2.0 * half;
}

// Returns 1 / sqrt(x) for a normal x > 0, up to 8 parts in a million more, by two such steps. The
// first estimate is off by 3.5 % at most, and the result of a step is never too large.
fn near_inverse_root(x: f32) -> f32 {
    var root = bitcast<f32>(0x5f3759dfu - (bitcast<u32>(x) >> 1u));
    for (var i = 0u; i < 2u; i++) {
        root *= 1.5 - clamp(0.5 * x * root * root, 0.0, 1.0);
    }
    return root * (1.0 + 1.0 / 131072.0);
}
