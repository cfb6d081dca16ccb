//! The modules of a crate, and the imports between its files.

use super::imports::{self, Import};
use crate::Failure;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The sources of a crate below `src`.
#[derive(Default)]
pub(super) struct Sources {
    /// The files, each with the first sentence of its comment.
    pub(super) files: BTreeMap<String, Option<String>>,
    modules: BTreeMap<Vec<String>, Module>,
}

struct Module {
    file: String,
    imports: Vec<Import>,
    paths: Vec<Vec<String>>,
}

/// The imports of a crate's files.
#[derive(Default)]
pub(super) struct Imports {
    /// The files that each file imports.
    pub(super) files: BTreeMap<String, BTreeSet<String>>,
    /// Paths after `crate` in each file.
    pub(super) of_crate: BTreeSet<(String, Vec<String>)>,
}

impl Sources {
    /// Reads the modules of a crate from its folder `src`, starting with `lib.rs`.
    ///
    /// # Errors
    /// If a module has no file, or a file cannot be parsed.
    pub(super) fn read(src: &Path) -> Result<Sources, Failure> {
        Sources::from_files(&|name| std::fs::read_to_string(src.join(name)).ok())
    }

    /// The same, with a function that returns the text of a file.
    pub(super) fn from_files(read: &dyn Fn(&str) -> Option<String>) -> Result<Sources, Failure> {
        let mut sources = Sources::default();
        sources.add(&[], &["lib.rs".to_owned()], read)?;
        Ok(sources)
    }

    /// Adds a module, whose file has one of these names, and the modules below it.
    fn add(&mut self, path: &[String], names: &[String], read: &dyn Fn(&str) -> Option<String>) -> Result<(), Failure> {
        let found = names.iter().find_map(|name| Some((name, read(name)?)));
        let (file, source) = found.ok_or_else(|| format!("`{}` is missing", names.join("` or `")))?;
        let (modules, about) = imports::modules(&source).map_err(|error| format!("{file}: {error}"))?;
        self.files.insert(file.clone(), about);
        for imports::Module { path: inside, files, imports, paths } in modules {
            let path = [path, &inside].concat();
            for name in files {
                let below = [path.as_slice(), &[name]].concat();
                let stem = below.join("/");
                self.add(&below, &[format!("{stem}.rs"), format!("{stem}/mod.rs")], read)?;
            }
            self.modules.insert(path, Module { file: file.clone(), imports, paths });
        }
        Ok(())
    }

    /// Returns the imports between files.
    pub(super) fn imports(&self) -> Imports {
        let mut all = Imports::default();
        for (path, module) in &self.modules {
            let used = module.imports.iter().filter_map(|import| {
                let used = self.absolute(path, &import.path)?;
                // An imported module counts where one of its items is used.
                let is_item = import.name == "*" || !self.modules.contains_key(&used);
                // A module that exports the items of its own modules does not import them.
                let is_facade = import.is_exported && used.starts_with(path);
                (is_item && !is_facade).then(|| (used, import.path[0] == "crate"))
            });
            let in_code = module.paths.iter().filter_map(|used| {
                let imported = module.imports.iter().find(|import| import.name == used[0]);
                let (used, is_of_crate) = match imported {
                    Some(import) => ([&import.path, &used[1..]].concat(), false),
                    None => (used.clone(), used[0] == "crate"),
                };
                Some((self.absolute(path, &used)?, is_of_crate))
            });
            for (used, is_of_crate) in used.chain(in_code) {
                if is_of_crate {
                    all.of_crate.insert((module.file.clone(), used.clone()));
                }
                let file = self.defining_file(&used);
                if *file != module.file {
                    all.files.entry(module.file.clone()).or_default().insert(file.clone());
                }
            }
        }
        all
    }

    /// Returns a path in `module` from the root of the crate; `None` if it leads to another crate, or nowhere.
    fn absolute(&self, module: &[String], path: &[String]) -> Option<Vec<String>> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => Some(rest.to_vec()),
            "self" => Some([module, rest].concat()),
            "super" => {
                let up = path.iter().take_while(|name| *name == "super").count();
                Some([module.get(..module.len().checked_sub(up)?)?, &path[up..]].concat())
            }
            _ => Some([module, path].concat()).filter(|below| self.modules.contains_key(&below[..=module.len()])),
        }
    }

    /// Returns the file that defines the item at `path`. Re-exports are followed, which the compiler has checked for circles.
    fn defining_file(&self, path: &[String]) -> &String {
        let depth = (0..=path.len()).rev().find(|depth| self.modules.contains_key(&path[..*depth])).unwrap_or_default();
        let module = &self.modules[&path[..depth]];
        let Some(name) = path.get(depth) else { return &module.file };
        let exported = module.imports.iter().find(|import| import.is_exported && import.name == *name);
        let exported = exported.and_then(|import| self.absolute(&path[..depth], &import.path));
        match exported {
            Some(exported) => self.defining_file(&[&exported, &path[depth + 1..]].concat()),
            None => &module.file,
        }
    }
}
