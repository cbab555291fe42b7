//! Parses the files of a crate into [`Module`]s: what each defines, imports and uses.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};

/// A module of a crate. An inline module has the file of the module around it.
#[derive(Clone, Debug, Default)]
pub struct Module {
    /// Names from the crate root, without `crate`.
    pub path: Vec<String>,
    /// File relative to the crate's `src`.
    pub file: String,
    /// Names of the items that it defines.
    pub items: BTreeSet<String>,
    /// Names of its child modules.
    pub children: BTreeSet<String>,
    /// Names that it imports.
    pub imports: Vec<Import>,
    /// Paths in its code, in expressions, types, attributes and macros.
    pub used: BTreeSet<Vec<String>>,
    /// Methods of inherent implementations: type and method.
    pub methods: Vec<(String, String)>,
    /// Names of the methods of traits and of their implementations.
    pub trait_methods: BTreeSet<String>,
    /// Names of the methods that its code calls on `self`.
    pub self_calls: BTreeSet<String>,
}

/// One name of a `use` declaration.
#[derive(Clone, Debug)]
pub struct Import {
    /// The name in this module, `*` for a glob.
    pub name: String,
    /// The path as written.
    pub path: Vec<String>,
    /// True if other modules can import it from here.
    pub is_reexport: bool,
}

/// Parses all modules of the crate whose root file is `root`, such as `src/lib.rs`.
///
/// # Panics
/// When a file cannot be read or parsed: the compiler has accepted them all.
pub fn crate_modules(root: &Path) -> Vec<Module> {
    let src = root.parent().expect("a root file lies in a folder");
    let read = |file: &Path| {
        std::fs::read_to_string(src.join(file))
            .ok()
            .map(|text| (file.to_string_lossy().into_owned(), text))
    };
    let name = PathBuf::from(root.file_name().expect("a root file has a name"));
    collect(&read, &name)
}

/// As [`crate_modules`], from files in memory; the first one is the root.
pub fn parse_sources(files: &[(&str, &str)]) -> Vec<Module> {
    let read = |file: &Path| {
        let found = files.iter().find(|(name, _)| Path::new(name) == file);
        found.map(|(name, text)| ((*name).to_owned(), (*text).to_owned()))
    };
    collect(&read, Path::new(files[0].0))
}

/// Reads a file by its path below `src`: its name and text, if it exists.
type Read<'a> = &'a dyn Fn(&Path) -> Option<(String, String)>;

fn collect(read: Read<'_>, root: &Path) -> Vec<Module> {
    let mut modules = Vec::new();
    let found = read(root).unwrap_or_else(|| panic!("{} cannot be read", root.display()));
    add_file(read, found, Path::new(""), Vec::new(), &mut modules);
    modules
}

fn add_file(
    read: Read<'_>,
    (file, text): (String, String),
    folder: &Path,
    path: Vec<String>,
    modules: &mut Vec<Module>,
) {
    let parsed = syn::parse_file(&text).unwrap_or_else(|error| panic!("{file}: {error}"));
    add_module(read, &parsed.items, file, folder, path, modules);
}

fn add_module(
    read: Read<'_>,
    items: &[syn::Item],
    file: String,
    folder: &Path,
    path: Vec<String>,
    modules: &mut Vec<Module>,
) {
    let mut module = Module {
        path: path.clone(),
        file: file.clone(),
        ..Module::default()
    };
    for item in items.iter().filter(|item| !is_test(attributes(item))) {
        let syn::Item::Mod(child) = item else {
            Collector(&mut module).visit_item(item);
            continue;
        };
        let name = child.ident.to_string();
        module.children.insert(name.clone());
        let child_path = [path.as_slice(), std::slice::from_ref(&name)].concat();
        let child_folder = folder.join(&name);
        if let Some((_, items)) = &child.content {
            add_module(
                read,
                items,
                file.clone(),
                &child_folder,
                child_path,
                modules,
            );
            continue;
        }
        let beside = folder.join(format!("{name}.rs"));
        let found = read(&beside).or_else(|| read(&child_folder.join("mod.rs")));
        if let Some(found) = found {
            add_file(read, found, &child_folder, child_path, modules);
        }
    }
    modules.push(module);
}

/// Collects what one module defines, imports and uses.
struct Collector<'a>(&'a mut Module);

impl Collector<'_> {
    fn import(&mut self, tree: &syn::UseTree, prefix: &[String], is_reexport: bool) {
        let with = |name: &syn::Ident| [prefix, &[name.to_string()]].concat();
        let (name, path) = match tree {
            syn::UseTree::Path(tree) => {
                return self.import(&tree.tree, &with(&tree.ident), is_reexport);
            }
            syn::UseTree::Group(group) => {
                for tree in &group.items {
                    self.import(tree, prefix, is_reexport);
                }
                return;
            }
            syn::UseTree::Name(tree) if tree.ident == "self" => {
                (prefix.last().cloned().unwrap_or_default(), prefix.to_vec())
            }
            syn::UseTree::Name(tree) => (tree.ident.to_string(), with(&tree.ident)),
            syn::UseTree::Rename(tree) => (tree.rename.to_string(), with(&tree.ident)),
            syn::UseTree::Glob(_) => ("*".to_owned(), prefix.to_vec()),
        };
        self.0.imports.push(Import {
            name,
            path,
            is_reexport,
        });
    }

    /// Paths in the tokens of a macro: names joined by `::`.
    fn tokens(&mut self, tokens: proc_macro2::TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut colons = 0;
        for token in tokens {
            match token {
                proc_macro2::TokenTree::Ident(name) => {
                    if colons < 2 {
                        self.0.used.insert(std::mem::take(&mut path));
                    }
                    path.push(name.to_string());
                    colons = 0;
                }
                proc_macro2::TokenTree::Punct(mark) if mark.as_char() == ':' => colons += 1,
                other => {
                    self.0.used.insert(std::mem::take(&mut path));
                    colons = 0;
                    if let proc_macro2::TokenTree::Group(group) = other {
                        self.tokens(group.stream());
                    }
                }
            }
        }
        self.0.used.insert(path);
    }
}

impl<'ast> Visit<'ast> for Collector<'_> {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        if let Some(name) = defined_name(item) {
            self.0.items.insert(name);
        }
        visit::visit_item(self, item);
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let is_reexport = !matches!(item.vis, syn::Visibility::Inherited);
        self.import(&item.tree, &[], is_reexport);
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if is_test(&item.attrs) {
            return;
        }
        let of = match &*item.self_ty {
            syn::Type::Path(of) => of.path.segments.last(),
            _ => None,
        };
        for part in &item.items {
            let syn::ImplItem::Fn(method) = part else {
                continue;
            };
            let name = method.sig.ident.to_string();
            match of {
                Some(of) if item.trait_.is_none() => {
                    self.0.methods.push((of.ident.to_string(), name));
                }
                _ => {
                    self.0.trait_methods.insert(name);
                }
            }
        }
        visit::visit_item_impl(self, item);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        if !is_test(&item.attrs) {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        self.0.trait_methods.insert(item.sig.ident.to_string());
        visit::visit_trait_item_fn(self, item);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names = path.segments.iter().map(|s| s.ident.to_string());
        self.0.used.insert(names.collect());
        visit::visit_path(self, path);
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        if matches!(&*call.receiver, syn::Expr::Path(path) if path.path.is_ident("self")) {
            self.0.self_calls.insert(call.method.to_string());
        }
        visit::visit_expr_method_call(self, call);
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        self.tokens(call.tokens.clone());
        visit::visit_macro(self, call);
    }
}

fn defined_name(item: &syn::Item) -> Option<String> {
    let name = match item {
        syn::Item::Const(item) => &item.ident,
        syn::Item::Enum(item) => &item.ident,
        syn::Item::Fn(item) => &item.sig.ident,
        syn::Item::Static(item) => &item.ident,
        syn::Item::Struct(item) => &item.ident,
        syn::Item::Trait(item) => &item.ident,
        syn::Item::Type(item) => &item.ident,
        syn::Item::Union(item) => &item.ident,
        syn::Item::Macro(item) => item.ident.as_ref()?,
        _ => return None,
    };
    Some(name.to_string())
}

fn attributes(item: &syn::Item) -> &[syn::Attribute] {
    match item {
        syn::Item::Const(item) => &item.attrs,
        syn::Item::Enum(item) => &item.attrs,
        syn::Item::Fn(item) => &item.attrs,
        syn::Item::Impl(item) => &item.attrs,
        syn::Item::Macro(item) => &item.attrs,
        syn::Item::Mod(item) => &item.attrs,
        syn::Item::Static(item) => &item.attrs,
        syn::Item::Struct(item) => &item.attrs,
        syn::Item::Trait(item) => &item.attrs,
        syn::Item::Type(item) => &item.attrs,
        syn::Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

/// Returns `true` if an item is compiled for tests alone.
fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        syn::Meta::List(list) if list.path.is_ident("cfg") => {
            let words = list.tokens.to_string();
            words
                .split(|c: char| !c.is_alphanumeric())
                .any(|word| word == "test")
        }
        _ => false,
    })
}
