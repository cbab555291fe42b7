//! Links Blend2D if the feature `blend2d` is on.

use std::env;

fn main() {
    println!("cargo::rerun-if-env-changed=BLEND2D_LIB_DIR");
    if env::var_os("CARGO_FEATURE_BLEND2D").is_none() {
        return;
    }
    let Some(folder) = env::var_os("BLEND2D_LIB_DIR") else {
        println!(
            "cargo::error=feature `blend2d` needs BLEND2D_LIB_DIR, the folder of libblend2d.a"
        );
        return;
    };
    println!("cargo::rustc-link-search=native={}", folder.display());
    // Static constructors initialize the library, and no symbol refers to them.
    println!("cargo::rustc-link-lib=static:+whole-archive=blend2d");
    println!("cargo::rustc-link-lib=stdc++");
}
