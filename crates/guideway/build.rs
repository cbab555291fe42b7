//! Packs the large texts of the command, its example site and the schema of its answers, as gzip:
//! a twentieth of their size.

fn main() -> std::io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "cli")]
    for file in ["examples/site.lif.json", "docs/answers.schema.json"] {
        println!("cargo::rerun-if-changed={file}");
        pack(file)?;
    }
    Ok(())
}

#[cfg(feature = "cli")]
fn pack(file: &str) -> std::io::Result<()> {
    use std::io::Write;
    use std::path::Path;
    use std::{env, fs, io};

    let folder = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    let name = Path::new(file).file_name().unwrap_or_default();
    let packed = fs::File::create(Path::new(&folder).join(name).with_extension("json.gz"))?;
    let mut packed = flate2::write::GzEncoder::new(packed, flate2::Compression::best());
    packed.write_all(&fs::read(file)?)?;
    packed.finish()?;
    Ok(())
}
