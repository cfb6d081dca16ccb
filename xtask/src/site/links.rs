//! Dead links of a site: targets that do not exist, or that lack the linked heading.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The folder of pages by rustdoc, which checks links between them itself.
const API: &str = "api";

/// Returns the dead links of all pages.
pub(super) fn dead(site: &Path) -> io::Result<Vec<String>> {
    let mut pages = BTreeMap::new();
    collect(site, &mut pages)?;
    let mut dead = Vec::new();
    for (path, text) in pages.iter().filter(|(path, _)| !path.starts_with(site.join(API))) {
        for link in links(text) {
            if let Some(fault) = fault(site, path, &link, &pages) {
                dead.push(format!("{}: {fault}", path.strip_prefix(site).unwrap_or(path).display()));
            }
        }
    }
    dead.dedup();
    Ok(dead)
}

/// Collects the pages in a folder and in the folders in it.
fn collect(folder: &Path, pages: &mut BTreeMap<PathBuf, String>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, pages)?;
        } else if path.extension().is_some_and(|extension| extension == "html") {
            let text = String::from_utf8_lossy(&fs::read(&path)?).into_owned();
            pages.insert(path, text);
        }
    }
    Ok(())
}

/// Returns the values of the attributes `href` and `src`, quoted or not.
fn links(page: &str) -> Vec<String> {
    let mut links = Vec::new();
    for name in [" href=", " src="] {
        for (at, _) in page.match_indices(name) {
            let value = &page[at + name.len()..];
            let end = |c: char| c.is_whitespace() || c == '>';
            let value = match value.chars().next() {
                Some(quote @ ('"' | '\'')) => value[1..].split(quote).next(),
                _ => value.split(end).next(),
            };
            links.push(value.unwrap_or_default().replace("&amp;", "&"));
        }
    }
    links
}

/// Returns the fault of a link, if it has one.
fn fault(site: &Path, page: &Path, link: &str, pages: &BTreeMap<PathBuf, String>) -> Option<String> {
    let scheme = link.split([':', '/', '#', '?']).next().unwrap_or_default();
    if link.starts_with("//") || link[scheme.len()..].starts_with(':') {
        return None;
    }
    let (path, fragment) = link.split_once('#').unwrap_or((link, ""));
    let path = path.split('?').next().unwrap_or_default();
    let mut target = match path.strip_prefix('/') {
        // The page of missing addresses can be anywhere, so its links are absolute.
        Some(path) => site.join(path),
        None if path.is_empty() => page.to_owned(),
        None => page.parent().unwrap_or(site).join(path),
    };
    if target.is_dir() {
        target.push("index.html");
    }
    let Ok(target) = target.canonicalize() else {
        return Some(format!("`{link}` leads nowhere"));
    };
    // Names of headings are not escaped in pages, but may be in links.
    let is_checked = !fragment.is_empty() && !fragment.contains('%') && !target.starts_with(site.join(API));
    let text = pages.get(&target).filter(|_| is_checked)?;
    let has = |quote: &str| text.contains(&format!("id={quote}{fragment}{quote}"));
    (!has("\"") && !has("")).then(|| format!("`{link}` has no such heading"))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn dead_links_are_found() {
        let folder = crate::paths::temporary_folder().unwrap();
        let site = folder.path().canonicalize().unwrap();
        fs::create_dir(site.join("a")).unwrap();
        fs::write(site.join("a/index.html"), "<h2 id=\"b\">B</h2> <a href=\"../none/\">").unwrap();
        let page = "<a href=\"a/#b\"> <a href='a/#c'> <img src=x.png> <a href=https://example.com/> <a href=\"#top\">";
        fs::write(site.join("index.html"), page).unwrap();
        let expected = [
            "a/index.html: `../none/` leads nowhere",
            "index.html: `a/#c` has no such heading",
            "index.html: `#top` has no such heading",
            "index.html: `x.png` leads nowhere",
        ];
        assert_eq!(dead(&site).unwrap(), expected);
    }
}
