//! Resolves the names that modules use to the files that define them.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::Module;

/// File `from` uses definitions of file `to`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arrow {
    /// The file that uses.
    pub from: String,
    /// The file that defines.
    pub to: String,
    /// Names of the definitions.
    pub names: BTreeSet<String>,
}

/// Longest chain of re-exports that is followed.
const MAX_REEXPORTS: u32 = 16;

struct Crate<'a>(HashMap<&'a [String], &'a Module>);

/// All arrows between different files of a crate.
pub fn arrows(modules: &[Module]) -> Vec<Arrow> {
    let by_path = modules.iter().map(|m| (m.path.as_slice(), m)).collect();
    let found = Crate(by_path);
    let mut names: BTreeMap<(String, String), BTreeSet<String>> = BTreeMap::new();
    let mut add = |from: &Module, (to, name): (&Module, String)| {
        if from.file != to.file {
            let key = (from.file.clone(), to.file.clone());
            names.entry(key).or_default().insert(name);
        }
    };
    for module in modules {
        let heads: BTreeSet<&String> = module.used.iter().filter_map(|path| path.first()).collect();
        for import in &module.imports {
            let is_used = !import.is_reexport || heads.contains(&import.name);
            if is_used && let Some(target) = found.resolve(module, &import.path, 0) {
                add(module, target);
            }
        }
        for path in module.used.iter().filter(|path| path.len() > 1) {
            if let Some(target) = found.resolve(module, path, 0) {
                add(module, target);
            }
        }
    }
    for (user, method) in distant_methods(&found, modules) {
        add(user, method);
    }
    let arrows = names
        .into_iter()
        .map(|((from, to), names)| Arrow { from, to, names });
    arrows.collect()
}

/// Calls of `self.method()` where the method is implemented in another file than its type: the file
/// that calls, and the one that implements. Methods are known by their name, where it is unique in
/// the crate.
fn distant_methods<'a>(
    found: &Crate<'a>,
    modules: &'a [Module],
) -> Vec<(&'a Module, (&'a Module, String))> {
    let mut by_name: HashMap<&str, Vec<(&Module, &str)>> = HashMap::new();
    for module in modules {
        for (of, method) in &module.methods {
            by_name.entry(method).or_default().push((module, of));
        }
    }
    let is_of_trait = |name: &str| modules.iter().any(|m| m.trait_methods.contains(name));
    by_name.retain(|name, _| !is_of_trait(name));
    let mut calls = Vec::new();
    for (name, implementations) in by_name {
        let [(module, of)] = implementations[..] else {
            continue;
        };
        let owner = found.resolve(module, &[of.to_owned()], 0);
        if owner.is_none_or(|(owner, _)| owner.file == module.file) {
            continue;
        }
        let callers = modules.iter().filter(|user| user.self_calls.contains(name));
        calls.extend(callers.map(|user| (user, (module, format!("{of}::{name}")))));
    }
    calls
}

impl<'a> Crate<'a> {
    /// The module that defines what a path names, and the name.
    fn resolve(
        &self,
        from: &'a Module,
        path: &[String],
        depth: u32,
    ) -> Option<(&'a Module, String)> {
        let (mut module, mut rest) = (from, path);
        if depth > MAX_REEXPORTS {
            return None;
        }
        match rest.first()?.as_str() {
            "crate" => {
                module = self.0.get(&[][..])?;
                rest = &rest[1..];
            }
            "self" => rest = &rest[1..],
            "super" => {
                while rest.first().is_some_and(|name| name == "super") {
                    module = self.0.get(module.path.split_last()?.1)?;
                    rest = &rest[1..];
                }
            }
            _ => {}
        }
        let (name, behind) = rest.split_first()?;
        if module.children.contains(name) {
            let path = [module.path.as_slice(), std::slice::from_ref(name)].concat();
            let child = self.0.get(path.as_slice())?;
            return match behind {
                // The module itself: whoever uses it names what is in it.
                [] => None,
                _ => self.resolve_in(child, behind, depth),
            };
        }
        self.resolve_in(module, rest, depth)
    }

    /// As [`Self::resolve`], for a path that begins inside of a module.
    fn resolve_in(
        &self,
        module: &'a Module,
        path: &[String],
        depth: u32,
    ) -> Option<(&'a Module, String)> {
        let (name, behind) = path.split_first()?;
        if module.items.contains(name) {
            return Some((module, name.clone()));
        }
        if module.children.contains(name) && !behind.is_empty() {
            let path = [module.path.as_slice(), std::slice::from_ref(name)].concat();
            return self.resolve_in(self.0.get(path.as_slice())?, behind, depth);
        }
        for import in &module.imports {
            let full = if import.name == *name {
                [import.path.as_slice(), behind].concat()
            } else if import.name == "*" {
                [import.path.as_slice(), path].concat()
            } else {
                continue;
            };
            if full != path
                && let Some(target) = self.resolve(module, &full, depth + 1)
            {
                return Some(target);
            }
        }
        None
    }
}
