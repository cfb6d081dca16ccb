//! The pages of the site: those of `docs`, with links to other files of the repository leading to GitHub.

use crate::Failure;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// The folder of the pages, and the address of the repository's other files.
const FOLDER: &str = "docs";
/// The settings in this folder, which are not part of the site.
pub(super) const SETTINGS: &str = "zensical.toml";
const REPOSITORY: &str = "https://github.com/lipz/lipz/blob/main";

/// The page that lists all others, which becomes the first page and the navigation.
const LIST: &str = "README.md";
const FIRST: &str = "index.md";

/// The demo, which the first page shows below its heading.
const DEMO: &str = "<iframe src=\"demo/index.html\" title=\"A recording with its lip sync\" \
     style=\"width:100%;height:36rem;border:0\"></iframe>";

/// Pages and images of the site.
pub(super) struct Pages {
    /// By path below `docs`.
    pub(super) files: BTreeMap<String, Vec<u8>>,
    /// The setting `nav` of zensical.
    pub(super) navigation: String,
}

/// Collects the pages. Fails for links to missing files, and for pages that the list lacks.
pub(super) fn collect(root: &Path) -> Result<Pages, Failure> {
    let mut paths = Vec::new();
    let folder = root.join(FOLDER);
    list(&folder, &mut paths).map_err(|error| format!("`{}`: {error}", folder.display()))?;
    let (mut files, mut faults) = (BTreeMap::new(), Vec::new());
    let mut navigation = String::new();
    for path in paths {
        let name = path.strip_prefix(&folder).unwrap_or(&path).to_string_lossy().replace('\\', "/");
        let bytes = fs::read(&path).map_err(|error| format!("`{}`: {error}", path.display()))?;
        if name == SETTINGS {
            continue;
        }
        if !name.ends_with(".md") {
            files.insert(name, bytes);
            continue;
        }
        let text = String::from_utf8_lossy(&bytes);
        if name == LIST {
            navigation = self::navigation(&text);
        }
        let text = with_links(&text, |link| {
            let target = target(root, &name, link);
            target.map_err(|fault| faults.push(format!("{FOLDER}/{name}: {fault}"))).unwrap_or_default()
        });
        match name == LIST {
            true => {
                files.insert(FIRST.to_owned(), text.replacen("\n\n## ", &format!("\n\n{DEMO}\n\n## "), 1).into_bytes())
            }
            false => files.insert(name, text.into_bytes()),
        };
    }
    let is_missing =
        |name: &&String| name.ends_with(".md") && *name != FIRST && !navigation.contains(&format!("\"{name}\""));
    faults.extend(files.keys().filter(is_missing).map(|name| format!("{FOLDER}/{LIST} does not list `{name}`")));
    if faults.is_empty() { Ok(Pages { files, navigation }) } else { Err(faults.join("\n")) }
}

/// Lists the files in a folder and in the folders in it.
fn list(folder: &Path, paths: &mut Vec<PathBuf>) -> std::io::Result<()> {
    let mut entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>()?;
    entries.sort();
    for path in entries {
        if path.is_dir() {
            list(&path, paths)?;
        } else {
            paths.push(path);
        }
    }
    Ok(())
}

/// Returns a page with the target of each link replaced, except in blocks of code. Of the words after a fence, only the
/// language remains, because zensical does not recognise fences with others, which are for our tests.
fn with_links(text: &str, mut replace: impl FnMut(&str) -> String) -> String {
    let (mut changed, mut is_code) = (String::new(), false);
    for line in text.split_inclusive('\n') {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
            let is_language = |c: char| c == '`' || c.is_whitespace() || c.is_ascii_alphanumeric();
            let fence = line.trim_end().split(|c| !is_language(c)).next().unwrap_or_default();
            let language = fence.split_whitespace().next().unwrap_or_default();
            let indentation = &line[..line.len() - line.trim_start().len()];
            changed.push_str(&format!("{indentation}{language}\n"));
            continue;
        }
        let mut rest = line;
        while let (false, Some((before, after))) = (is_code, rest.split_once("](")) {
            let Some((link, after)) = after.split_once(')') else { break };
            changed.push_str(&format!("{before}]({})", replace(link)));
            rest = after;
        }
        changed.push_str(rest);
    }
    changed
}

/// Returns the target of a link on the site.
fn target(root: &Path, page: &str, link: &str) -> Result<String, Failure> {
    if link.contains("://") || link.starts_with('#') || link.starts_with("mailto:") {
        return Ok(link.to_owned());
    }
    let (path, fragment) = link.split_once('#').map_or((link, String::new()), |(path, id)| (path, format!("#{id}")));
    let path = joined(Path::new(FOLDER).join(page).parent().unwrap_or(Path::new("")), path)
        .ok_or_else(|| format!("the link `{link}` leads out of the repository"))?;
    if !root.join(&path).exists() {
        return Err(format!("the link `{link}` leads nowhere"));
    }
    let shown = path.to_string_lossy().replace('\\', "/");
    if !path.starts_with(FOLDER) {
        return Ok(format!("{REPOSITORY}/{shown}{fragment}"));
    }
    // Links between pages stay relative. Only the name of the list changes.
    let relative = link.split('#').next().unwrap_or_default();
    Ok(format!(
        "{}{fragment}",
        relative.strip_suffix(LIST).map_or(relative.to_owned(), |folder| format!("{folder}{FIRST}"))
    ))
}

/// Returns a path relative to a folder, without `..`; `None` if it leads out of the root.
fn joined(folder: &Path, path: &str) -> Option<PathBuf> {
    let mut joined = folder.to_owned();
    for part in Path::new(path).components() {
        match part {
            Component::ParentDir if !joined.pop() => return None,
            Component::ParentDir | Component::CurDir => {}
            part => joined.push(part),
        }
    }
    Some(joined)
}

/// Returns the navigation that the list of pages describes: its headings, with the pages linked below each.
fn navigation(list: &str) -> String {
    let mut navigation = format!("nav = [\n  {{ \"lipz\" = {FIRST:?} }},\n");
    let mut is_open = false;
    for line in list.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            navigation.push_str(if is_open { "  ] },\n" } else { "" });
            navigation.push_str(&format!("  {{ {heading:?} = [\n"));
            is_open = true;
        }
        let mut rest = line;
        while let (true, Some((_, after))) = (is_open, rest.split_once('[')) {
            let Some((title, after)) = after.split_once("](") else { break };
            let Some((page, after)) = after.split_once(')') else { break };
            if page.ends_with(".md") && !page.starts_with("..") {
                let mut letters = title.chars();
                let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
                navigation.push_str(&format!("    {{ {:?} = {page:?} }},\n", first + letters.as_str()));
            }
            rest = after;
        }
    }
    navigation.push_str(if is_open { "  ] },\n" } else { "" });
    navigation + "  { \"Demo\" = \"demo/index.html\" },\n  { \"API\" = \"api/lipz_bank/index.html\" },\n]"
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::paths::workspace_root;

    #[test]
    fn every_link_of_the_pages_has_a_target() {
        let pages = collect(&workspace_root()).unwrap();
        let first = String::from_utf8_lossy(&pages.files[FIRST]);
        assert!(first.contains("](start/getting-started.md)"));
        assert!(first.contains("](https://github.com/lipz/lipz/blob/main/README.md)"));
    }

    #[test]
    fn links_in_code_are_left_alone() {
        let text = "[a](b) and [c](d)\n```\n[e](f)\n```\n[g](h";
        assert_eq!(with_links(text, str::to_uppercase), "[a](B) and [c](D)\n```\n[e](f)\n```\n[g](h");
        let fences = "  ```json flags=\"--a b\"\n  ```\n```rust,no_run\n```\n";
        assert_eq!(with_links(fences, str::to_uppercase), "  ```json\n  ```\n```rust\n```\n");
    }

    #[test]
    fn a_link_to_a_missing_file_is_a_fault() {
        let root = workspace_root();
        assert!(target(&root, "start/a.md", "../guides/none.md").is_err());
        let outside = target(&root, "start/a.md", "../../../docs/README.md");
        assert_eq!(outside.unwrap_err(), "the link `../../../docs/README.md` leads out of the repository");
        assert_eq!(target(&root, "start/a.md", "../README.md#guides").unwrap(), "../index.md#guides");
    }

    #[test]
    fn the_navigation_has_the_groups_of_the_list() {
        let list = "# All\n[x](y.md)\n## Start\n\n* [One](a/b.md): text, [two](c.md) and [out](../d.md)\n";
        let expected = "  { \"Start\" = [\n    { \"One\" = \"a/b.md\" },\n    { \"Two\" = \"c.md\" },\n  ] },\n";
        assert!(navigation(list).contains(expected), "{}", navigation(list));
    }
}
