//! Talking heads: the FRM files whose frames are the mouth shapes of LIP files, and `heads.lst`.

mod disposition;
mod frm;
mod list;
mod name;

pub use disposition::Disposition;
pub use frm::Frm;
pub use list::{Head, read_list};
pub use name::{Content, HeadFile};

use lipz_diagnostics::{Code, Diagnostic, escape};
use std::collections::BTreeSet;

/// The number of mouth shapes in a phoneme file. The game does not use later frames.
pub const MOUTH_SHAPES: u16 = 9;

/// Checks the name and the bytes of an FRM file of a head, and returns its description.
pub fn check_file(name: &str, bytes: &[u8]) -> (Option<HeadFile>, Vec<Diagnostic>) {
    let mut found = Vec::new();
    let file = HeadFile::parse(name);
    if file.is_none() {
        let message = format!("{} is not the name of a head's file", escape::quoted(name));
        found.push(
            Diagnostic::new(Code::HeadName, message)
                .note(name::FORM)
                .help("rename the file, or move files of other art to a different folder"),
        );
    }
    match Frm::read(bytes) {
        Err(diagnostic) => found.push(*diagnostic),
        Ok(frm) => found.extend(file.as_ref().and_then(|file| too_few_frames(file, frm))),
    }
    (file, found)
}

fn too_few_frames(file: &HeadFile, frm: Frm) -> Option<Diagnostic> {
    let is_short = file.content == Content::Phonemes && frm.frames < MOUTH_SHAPES;
    is_short.then(|| {
        let message = format!("the phoneme file has {} frames, not {MOUTH_SHAPES}", frm.frames);
        super::place(Code::HeadFrames, frm::FRAMES, message)
            .note("each frame is a mouth shape: rest, A, S, E, F, L, M, O, W")
            .help("draw the missing frames; a LIP file that uses one shows a wrong picture")
    })
}

/// Compares the heads of `heads.lst` with the files in its folder. The diagnostics are about the list.
pub fn compare(heads: &[Head], files: &[HeadFile]) -> Vec<Diagnostic> {
    let there: BTreeSet<String> = files.iter().map(HeadFile::file_name).collect();
    let mut found = Vec::new();
    let mut counted = BTreeSet::new();
    let mut elsewhere = Vec::new();
    for head in heads {
        let expected: BTreeSet<String> = head.files().map(|file| file.file_name()).collect();
        let missing: Vec<&str> = expected.difference(&there).map(String::as_str).collect();
        if missing.len() == expected.len() && !missing.is_empty() && !files.is_empty() {
            elsewhere.push(head.root.as_str());
        } else if !missing.is_empty() {
            let message = format!("{} has no {}", escape::quoted(&head.root), listed(&missing));
            let diagnostic = Diagnostic::at(Code::HeadFiles, head.span, message);
            found.push(diagnostic.help("add the files, or correct the numbers of fidget files"));
        }
        counted.extend(expected);
    }
    if !elsewhere.is_empty() {
        let (count, have) = (elsewhere.len(), if elsewhere.len() == 1 { "head has" } else { "heads have" });
        let message = format!("{count} {have} no files here: {}", listed(&elsewhere));
        let diagnostic = Diagnostic::new(Code::HeadFiles, message).note("files of other heads are here");
        found.push(diagnostic.help("add the files, or ignore this if they are in the archives of the game"));
    }
    let of_list = |file: &&HeadFile| heads.iter().any(|head| head.root.eq_ignore_ascii_case(&file.root));
    let is_surplus =
        |file: &&HeadFile| matches!(file.content, Content::Fidget(_)) && !counted.contains(&file.file_name());
    for head in heads {
        let own = files.iter().filter(|file| head.root.eq_ignore_ascii_case(&file.root));
        let surplus: Vec<String> = own.filter(is_surplus).map(HeadFile::file_name).collect();
        if !surplus.is_empty() {
            let surplus: Vec<&str> = surplus.iter().map(String::as_str).collect();
            let message = format!("the numbers of {} do not include {}", escape::quoted(&head.root), listed(&surplus));
            let diagnostic = Diagnostic::at(Code::HeadFiles, head.span, message);
            found.push(diagnostic.note("the game never shows them").help("correct the numbers of fidget files"));
        }
    }
    let unlisted: BTreeSet<&str> = files.iter().filter(|file| !of_list(file)).map(|file| file.root.as_str()).collect();
    found.extend(unlisted.into_iter().map(|root| {
        let message = format!("heads.lst has no line for {}", escape::quoted(root));
        Diagnostic::new(Code::HeadFiles, message).help(format!("add `{root},1,1,1` with its numbers of fidget files"))
    }));
    found
}

/// Returns names of files for a message: the first few, and the number of others.
fn listed(names: &[&str]) -> String {
    const SHOWN: usize = 6;
    let shown: Vec<String> = names.iter().take(SHOWN).map(|name| escape::quoted(name)).collect();
    match names.len().saturating_sub(SHOWN) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn files(names: &[&str]) -> Vec<HeadFile> {
        names.iter().map(|name| HeadFile::parse(name).unwrap()).collect()
    }

    fn headlines(list: &str, names: &[&str]) -> Vec<String> {
        let (heads, found) = read_list(list);
        assert_eq!(found, []);
        compare(&heads, &files(names)).into_iter().map(|diagnostic| diagnostic.message).collect()
    }

    #[test]
    fn a_head_is_whole_with_its_phonemes_transitions_and_fidgets() {
        let whole = ["elgn", "elng", "elnb", "elbn", "elgp", "elnp", "elbp", "elgf1", "elnf1", "elnf2", "elbf1"];
        let names: Vec<String> = whole.iter().map(|name| format!("{}.FRM", name.to_uppercase())).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        assert_eq!(headlines("el,1,2,1\n", &names), Vec::<String>::new());
        assert_eq!(headlines("el,1,1,1\n", &names), ["the numbers of `el` do not include `elnf2.frm`"]);
        assert_eq!(headlines("el,1,3,1\n", &names), ["`el` has no `elnf3.frm`"]);
        assert_eq!(headlines("", &names), ["heads.lst has no line for `EL`"; 1].map(|line| line.replace("EL", "el")));
        assert_eq!(headlines("el,1,2,1\nab,1,1,1\ncd,1,1,1\n", &names), ["2 heads have no files here: `ab`, `cd`"]);
        let none = headlines("el,1,2,1\n", &[]);
        assert_eq!(
            none,
            ["`el` has no `elbf1.frm`, `elbn.frm`, `elbp.frm`, `elgf1.frm`, `elgn.frm`, `elgp.frm` and 5 more"]
        );
    }
}
