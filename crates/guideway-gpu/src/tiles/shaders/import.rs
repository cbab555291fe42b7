//! Assembles a shader from its files: resolves `// import: folder/file.wgsl` lines.
//!
//! Imported files precede their importers, each once. An import may contain `{name}`, which the
//! caller replaces by a variant: `// import: cover/team_{team}.wgsl`.

use super::files::FILES;

/// Resolves a shader file.
///
/// `constants` (name, type, value) come first, then all `override` declarations of all files, each
/// once: naga mis-sizes workgroup arrays whose length is an override if another override follows.
///
/// # Panics
/// If an import has no file; a test resolves every entry point.
pub(super) fn resolve(
    file: &str,
    variants: &[(&str, &str)],
    constants: &[(&str, &str, &str)],
) -> String {
    let mut resolver = Resolver {
        variants,
        resolved: Vec::new(),
        overrides: Vec::new(),
        text: String::new(),
    };
    resolver.add(file.to_owned());
    let mut wgsl = String::new();
    for (name, kind, value) in constants {
        wgsl += &format!("const {name}: {kind} = {value};\n");
    }
    for line in resolver.overrides {
        wgsl += line;
        wgsl += "\n";
    }
    wgsl += &resolver.text;
    wgsl
}

struct Resolver<'a> {
    variants: &'a [(&'a str, &'a str)],
    resolved: Vec<String>,
    overrides: Vec<&'static str>,
    text: String,
}

impl Resolver<'_> {
    fn add(&mut self, file: String) {
        if self.resolved.contains(&file) {
            return;
        }
        let (_, text) = FILES
            .iter()
            .find(|(name, _)| *name == file)
            .unwrap_or_else(|| panic!("no shader file `{file}`"));
        self.resolved.push(file);
        for import in text.lines().filter_map(|l| l.strip_prefix("// import: ")) {
            let mut import = import.to_owned();
            for (name, variant) in self.variants {
                import = import.replace(&format!("{{{name}}}"), variant);
            }
            self.add(import);
        }
        for line in text.lines() {
            if line.starts_with("override ") {
                if !self.overrides.contains(&line) {
                    self.overrides.push(line);
                }
            } else {
                self.text += line;
                self.text.push('\n');
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resolves_each_import_once_and_before_its_importer() {
        let wgsl = resolve("flatten/flatten.wgsl", &[("points", "exact")], &[]);
        let index = |text: &str| {
            assert_eq!(wgsl.matches(text).count(), 1, "{text}");
            wgsl.find(text)
        };
        assert!(index("override THREADS: u32;") < index("struct Frame {"));
        assert!(index("struct Frame {") < index("struct Cluster {"));
        assert!(index("struct Cluster {") < index("fn main("));
        assert!(wgsl.contains("points: array<vec2u>") && !wgsl.contains("points: array<u32>"));
    }
}
