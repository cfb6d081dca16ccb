//! Files that import each other.

use std::collections::{BTreeMap, BTreeSet};

/// Returns the groups of files that all import each other, directly or through others, the largest first.
pub(super) fn circles(imports: &BTreeMap<String, BTreeSet<String>>) -> Vec<BTreeSet<&str>> {
    let reached: BTreeMap<&str, BTreeSet<&str>> =
        imports.keys().map(|file| (file.as_str(), reached(imports, file))).collect();
    let reaches = |from: &str, to: &str| reached.get(from).is_some_and(|files| files.contains(to));
    let mut circles: BTreeSet<BTreeSet<&str>> = BTreeSet::new();
    for (file, files) in &reached {
        let circle: BTreeSet<&str> = files.iter().copied().filter(|other| reaches(other, file)).collect();
        if circle.len() > 1 {
            circles.insert(circle);
        }
    }
    let mut circles: Vec<BTreeSet<&str>> = circles.into_iter().collect();
    circles.sort_by_key(|circle| std::cmp::Reverse(circle.len()));
    circles
}

/// Returns all files that a file imports, directly or through others.
fn reached<'i>(imports: &'i BTreeMap<String, BTreeSet<String>>, file: &'i str) -> BTreeSet<&'i str> {
    let mut reached = BTreeSet::new();
    let mut next: Vec<&str> = vec![file];
    while let Some(file) = next.pop() {
        let below = imports.get(file).into_iter().flatten().map(String::as_str);
        next.extend(below.filter(|below| reached.insert(*below)));
    }
    reached
}
