//! Links Blend2D, where it is asked for.

use std::env;

fn main() {
    println!("cargo::rerun-if-env-changed=BLEND2D_LIB_DIR");
    if env::var_os("CARGO_FEATURE_BLEND2D").is_none() {
        return;
    }
    let Some(folder) = env::var_os("BLEND2D_LIB_DIR") else {
        println!("cargo::error=BLEND2D_LIB_DIR has to name the folder of libblend2d.a");
        return;
    };
    println!("cargo::rustc-link-search=native={}", folder.display());
    // What sets it up is not called by name.
    println!("cargo::rustc-link-lib=static:+whole-archive=blend2d");
    println!("cargo::rustc-link-lib=stdc++");
}
