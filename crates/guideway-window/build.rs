//! Gives the program of Windows its icon and version.

fn main() {
    println!("cargo::rerun-if-changed=guideway.ico");
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "windows") {
        let mut resource = winresource::WindowsResource::new();
        resource.set_icon("guideway.ico");
        resource.set("FileDescription", "Guideway");
        resource.set("ProductName", "Guideway");
        resource
            .compile()
            .expect("the resource compiler of the target is installed");
    }
}
