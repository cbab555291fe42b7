//! Installs the tools and packages that the checks need beyond Rust and a C compiler.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use crate::step::{cargo, command};

/// Debian packages of Mesa's software Vulkan and OpenGL, for tests of graphics methods.
const SOFTWARE_DEVICES: &[&str] = &[
    "libvulkan1",
    "mesa-vulkan-drivers",
    "libegl1",
    "libgl1-mesa-dri",
];
/// Debian packages of a virtual screen and synthetic input, for tests of the window.
const SCREEN: &[&str] = &["xvfb", "xdotool", "libxkbcommon-x11-0"];

/// Debian package that draws pages of PDF, for tests of floor plans.
const PDF: &[&str] = &["poppler-utils"];

/// Debian packages that build programs in C and C++ and watch their memory, for the C library.
const PROGRAMS: &[&str] = &["g++", "pkg-config", "valgrind"];

/// A tool from crates.io, installed once into cargo's own folder.
pub(crate) struct Tool {
    /// Name of the crate and of its program.
    pub(crate) name: &'static str,
    version: &'static str,
    /// Further arguments of `cargo install`.
    features: &'static [&'static str],
}

pub(crate) const CARGO_DENY: Tool = Tool {
    name: "cargo-deny",
    version: "0.20.2",
    features: &[],
};
pub(crate) const CBINDGEN: Tool = Tool {
    name: "cbindgen",
    version: "0.29.4",
    features: &[],
};
pub(crate) const CARGO_FUZZ: Tool = Tool {
    name: "cargo-fuzz",
    version: "0.13.1",
    features: &[],
};
pub(crate) const SEMVER_CHECKS: Tool = Tool {
    name: "cargo-semver-checks",
    version: "0.51.0",
    features: &[],
};
pub(crate) const MDBOOK: Tool = Tool {
    name: "mdbook",
    version: "0.5.4",
    features: &["--no-default-features"],
};

impl Tool {
    /// The path of the program, which is installed first where it is missing.
    pub(crate) fn ensure(&self) -> Result<PathBuf> {
        if let Some(program) = self.find() {
            return Ok(program);
        }
        println!("installing {} {}, once", self.name, self.version);
        // Unoptimized: the tool runs for seconds, and this saves minutes of building.
        cargo(&["install", self.name, "--version", self.version])
            .args(["--locked", "--quiet", "--debug"])
            .args(["--config", "profile.dev.debug=0"])
            .args(self.features)
            .run()?;
        match self.find() {
            Some(program) => Ok(program),
            None => bail!(
                "{} is installed, but neither on PATH nor in cargo's folder",
                self.name
            ),
        }
    }

    fn find(&self) -> Option<PathBuf> {
        let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
        let home = home.or_else(|| Some(PathBuf::from(std::env::var_os("HOME")?).join(".cargo")));
        let installed = home.map(|home| home.join("bin").join(self.name));
        [Some(PathBuf::from(self.name)), installed]
            .into_iter()
            .flatten()
            .find(|program| command(program).args(["--version"]).succeeds())
    }
}

/// Installs `rustfmt` and `clippy` through rustup where they are missing.
pub(crate) fn rust_components() -> Result<()> {
    for (subcommand, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if cargo(&[subcommand, "--version"]).succeeds() {
            continue;
        }
        if command("rustup")
            .args(["component", "add", component])
            .run()
            .is_err()
        {
            bail!(
                "`cargo {subcommand}` is missing: install your distribution's {component}, \
                 or use rustup"
            );
        }
    }
    Ok(())
}

/// A Python in a virtual environment under `target/`, for tests that read Guideway's files with
/// other programs, and for those of the Python package.
pub(crate) fn python() -> Result<PathBuf> {
    let packages = [
        "anywidget",
        "dask[dataframe]",
        "duckdb",
        "geopandas",
        "ipykernel",
        "jsonschema",
        "lxml",
        "mypy",
        "nbclient",
        "pandas",
        "polars",
        "pyarrow",
        "pyright",
        "pytest",
        "ray",
    ];
    let modules = "import anywidget, dask.dataframe, duckdb, geopandas, ipykernel, jsonschema, \
                   lxml, mypy, nbclient, pandas, polars, pyarrow, pyright, pytest, ray.data";
    environment("python", &packages, modules)
}

/// A Python with other readers of the formats, whose versions `tests/conformance` states.
pub(crate) fn conformance_python() -> Result<PathBuf> {
    let modules = "import ezdxf, jsonschema, lanelet2, lxml, numpy, PIL, pyarrow, pyproj, \
                   scipy, shapely, svgelements, yaml";
    let packages = ["-r", "tests/conformance/requirements.txt"];
    environment("conformance", &packages, modules)
}

/// A virtual environment under `target/` in which a line of imports runs; it is made and filled by
/// pip where that fails.
fn environment(name: &str, packages: &[&str], imports: &str) -> Result<PathBuf> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()?;
    let folder = workspace.join("target").join(name);
    let python = folder.join("bin").join("python3");
    let imports_all = || command(&python).args(["-c", imports]).succeeds();
    if imports_all() {
        return Ok(python);
    }
    let create = || command("python3").args(["-m", "venv"]).args([&folder]);
    if !create().succeeds() {
        apt_install(&["python3", "python3-venv"])?;
        create().run()?;
    }
    command(&python)
        .args(["-m", "pip", "install", "--quiet"])
        .args(packages)
        .run()?;
    if !imports_all() {
        bail!(
            "pip filled {}, but this fails there: {imports}",
            folder.display()
        );
    }
    Ok(python)
}

/// Installs software Vulkan and OpenGL and a virtual screen, so that the graphics methods and the
/// window can be tested without hardware, and tools that other tests start.
pub(crate) fn debian_packages() -> Result<()> {
    if !command("dpkg").args(["--version"]).succeeds() {
        // Not a Debian system: its own drivers serve, and tests report what is missing.
        return Ok(());
    }
    let is_installed = |package: &&str| command("dpkg").args(["--status", package]).succeeds();
    let packages = [SOFTWARE_DEVICES, SCREEN, PDF, PROGRAMS].concat();
    if packages.iter().all(is_installed) {
        return Ok(());
    }
    apt_install(&packages)
}

pub(crate) fn apt_install(packages: &[&str]) -> Result<()> {
    let install = [&["install", "-y", "--no-install-recommends"], packages].concat();
    if apt(&["update", "-q"]).and_then(|()| apt(&install)).is_err() {
        bail!(
            "cannot install the packages {} (no rights, or no apt): run `sudo apt-get install {}` \
             and start again",
            packages.join(", "),
            packages.join(" ")
        );
    }
    Ok(())
}

/// Runs `apt-get` as root.
pub(crate) fn apt(args: &[&str]) -> Result<()> {
    let is_root = command("sh")
        .args(["-c", "test \"$(id -u)\" = 0"])
        .succeeds();
    let sudo: &[&str] = if is_root { &[] } else { &["sudo", "-n"] };
    let words = [sudo, &["apt-get"], args].concat();
    command(words[0])
        .args(&words[1..])
        .env("DEBIAN_FRONTEND", "noninteractive")
        .run()
}
