//! Parses the declarations and imports of a source file, outside of its tests.

use proc_macro2::{TokenStream, TokenTree};
use syn::punctuated::Punctuated;
use syn::visit::{self, Visit};
use syn::{
    Attribute, ImplItemFn, ItemFn, ItemMod, ItemUse, LitStr, Macro, Meta, MetaList, Path, Token, UseTree,
    VisRestricted, Visibility,
};

/// A name that `use` brings into a module.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Import {
    /// The name; `*` for all names of a module.
    pub(super) name: String,
    /// Its path, as written.
    pub(super) path: Vec<String>,
    /// Whether other modules can import it from here.
    pub(super) is_exported: bool,
}

/// A module of a source file.
#[derive(Default, Debug)]
pub(super) struct Module {
    /// Its path below the module of the file; empty for that module itself.
    pub(super) path: Vec<String>,
    /// Modules in separate files.
    pub(super) files: Vec<String>,
    pub(super) imports: Vec<Import>,
    /// Paths of several names in code.
    pub(super) paths: Vec<Vec<String>>,
}

/// Returns the modules of a source file: its own, then those in braces. Also returns the first sentence of its comment.
///
/// # Errors
/// If it cannot be parsed.
pub(super) fn modules(source: &str) -> Result<(Vec<Module>, Option<String>), syn::Error> {
    let file = syn::parse_file(source)?;
    let mut reader = Reader { done: Vec::new(), open: vec![Module::default()] };
    reader.visit_file(&file);
    let mut modules = reader.open;
    modules.append(&mut reader.done);
    let lines: Vec<String> = file.attrs.iter().filter_map(doc_line).take_while(|line| !line.is_empty()).collect();
    Ok((modules, lines.join(" ").split_inclusive(". ").next().map(|sentence| sentence.trim_end().to_owned())))
}

/// Returns a line of a doc comment.
fn doc_line(attribute: &Attribute) -> Option<String> {
    let value = &attribute.meta.require_name_value().ok().filter(|meta| meta.path.is_ident("doc"))?.value;
    let syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) = value else { return None };
    Some(text.value().trim().to_owned())
}

struct Reader {
    done: Vec<Module>,
    /// The current module, last, and those around it.
    open: Vec<Module>,
}

impl Reader {
    fn module(&mut self) -> &mut Module {
        let last = self.open.len() - 1;
        &mut self.open[last]
    }

    fn path(&mut self, path: Vec<String>) {
        if path.len() > 1 {
            self.module().paths.push(path);
        }
    }

    /// Finds the paths in the arguments of a macro or an attribute.
    fn tokens(&mut self, tokens: TokenStream) {
        let mut path = Vec::new();
        let mut colons = 0;
        for token in tokens {
            match token {
                TokenTree::Ident(name) => {
                    if colons != 2 {
                        self.path(std::mem::take(&mut path));
                    }
                    path.push(name.to_string());
                    colons = 0;
                }
                TokenTree::Punct(punct) if punct.as_char() == ':' => colons += 1,
                other => {
                    self.path(std::mem::take(&mut path));
                    colons = 0;
                    match other {
                        TokenTree::Group(group) => self.tokens(group.stream()),
                        TokenTree::Literal(literal) => self.text(&literal.to_string()),
                        _ => {}
                    }
                }
            }
        }
        self.path(path);
    }

    /// Treats a string as a path if it starts like one of this crate, as in attributes of serde.
    fn text(&mut self, text: &str) {
        let text = text.trim_matches('"');
        let is_name = |name: &str| !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let is_of_crate = ["crate::", "self::", "super::"].iter().any(|start| text.starts_with(start));
        if is_of_crate && text.split("::").all(is_name) {
            self.path(text.split("::").map(str::to_owned).collect());
        }
    }

    fn import(&mut self, path: &[String], tree: &UseTree, is_exported: bool) {
        let mut add = |name: String, path: Vec<String>| self.module().imports.push(Import { name, path, is_exported });
        let behind = |name: String| [path, &[name]].concat();
        match tree {
            UseTree::Path(part) => self.import(&behind(part.ident.to_string()), &part.tree, is_exported),
            UseTree::Name(name) if name.ident == "self" => {
                add(path.last().cloned().unwrap_or_default(), path.to_vec());
            }
            UseTree::Name(name) => add(name.ident.to_string(), behind(name.ident.to_string())),
            UseTree::Rename(name) if name.ident == "self" => add(name.rename.to_string(), path.to_vec()),
            UseTree::Rename(name) => add(name.rename.to_string(), behind(name.ident.to_string())),
            UseTree::Glob(_) => add("*".to_owned(), path.to_vec()),
            UseTree::Group(group) => group.items.iter().for_each(|item| self.import(path, item, is_exported)),
        }
    }
}

impl<'a> Visit<'a> for Reader {
    fn visit_item_mod(&mut self, item: &'a ItemMod) {
        if is_of_tests(&item.attrs) {
            return;
        }
        let name = item.ident.to_string();
        let Some((_, items)) = &item.content else { return self.module().files.push(name) };
        let path = [self.module().path.as_slice(), &[name]].concat();
        self.open.push(Module { path, ..Module::default() });
        items.iter().for_each(|item| self.visit_item(item));
        self.done.extend(self.open.pop());
    }

    fn visit_item_use(&mut self, item: &'a ItemUse) {
        if !is_of_tests(&item.attrs) {
            self.import(&[], &item.tree, !matches!(item.vis, Visibility::Inherited));
        }
    }

    fn visit_item_fn(&mut self, item: &'a ItemFn) {
        if !is_of_tests(&item.attrs) {
            visit::visit_item_fn(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'a ImplItemFn) {
        if !is_of_tests(&item.attrs) {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_vis_restricted(&mut self, _: &'a VisRestricted) {
        // `pub(in crate::wing)` is not an import.
    }

    fn visit_path(&mut self, path: &'a Path) {
        self.path(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, item: &'a Macro) {
        self.tokens(item.tokens.clone());
        visit::visit_macro(self, item);
    }

    fn visit_meta_list(&mut self, list: &'a MetaList) {
        self.tokens(list.tokens.clone());
    }

    fn visit_lit_str(&mut self, text: &'a LitStr) {
        self.text(&text.value());
    }
}

/// Whether an item is compiled for tests only.
fn is_of_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("cfg") => list.parse_args().is_ok_and(|condition| is_test(&condition)),
        meta => meta.path().is_ident("test"),
    })
}

/// Whether a condition holds only in tests: `test`, or `all(…)` with such a part.
fn is_test(condition: &Meta) -> bool {
    match condition {
        Meta::List(list) if list.path.is_ident("all") => list
            .parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated)
            .is_ok_and(|parts| parts.iter().any(is_test)),
        meta => meta.path().is_ident("test"),
    }
}
