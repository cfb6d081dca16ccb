//! Systems with fewer resources than usual: no threads, no disk space, no permissions, no /proc. Each failure is a
//! diagnostic with a code and a path, never a panic, and no file is lost or incomplete.
#![cfg(all(target_os = "linux", target_env = "gnu"))]
#![allow(clippy::unwrap_used, reason = "tests")]
#![allow(unsafe_code, reason = "limits are set between fork and exec")]

mod support;

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use support::{Outcome, Scene, tree};
use tempfile::TempDir;

/// A user without files: limits and permissions do not apply to root.
const NOBODY: u32 = 65534;

/// A command that runs as a user other than root.
struct Unprivileged {
    command: Command,
    /// The folder with a copy of the program, if its own folder is not open to other users.
    _folder: Option<TempDir>,
}

/// Returns the command in the folder of a scene, as a user other than root.
fn as_nobody(scene: &Scene, arguments: &[&str]) -> Unprivileged {
    // SAFETY: the function does not take arguments and only returns a number.
    let is_root = unsafe { libc::geteuid() } == 0;
    let program = Path::new(env!("CARGO_BIN_EXE_lipz"));
    let folder = (is_root && !is_open_to_all(program)).then(|| tempfile::tempdir().unwrap());
    let mut command = Command::new(folder.as_ref().map_or(program.to_owned(), |folder| beside(program, folder.path())));
    command.args(arguments).current_dir(scene.path()).env("NO_COLOR", "1").env_remove("CLICOLOR_FORCE");
    if is_root {
        command.uid(NOBODY).gid(NOBODY);
    }
    Unprivileged { command, _folder: folder }
}

/// Whether all users may access a file: a clone in a folder of `mktemp -d` is open only to its owner.
fn is_open_to_all(file: &Path) -> bool {
    file.ancestors().skip(1).all(|folder| fs::metadata(folder).is_ok_and(|it| it.permissions().mode() & 0o001 != 0))
}

/// Returns a copy of the program in a folder that all users may enter.
fn beside(program: &Path, folder: &Path) -> PathBuf {
    fs::set_permissions(folder, fs::Permissions::from_mode(0o755)).unwrap();
    let place = folder.join("lipz");
    fs::hard_link(program, &place).or_else(|_| fs::copy(program, &place).map(|_| ())).unwrap();
    place
}

/// Sets a resource limit of the command.
fn limit(mut it: Unprivileged, resource: libc::__rlimit_resource_t, most: u64) -> Unprivileged {
    let limit = libc::rlimit { rlim_cur: most, rlim_max: most };
    // SAFETY: the closure only makes a system call with a struct of numbers.
    unsafe {
        it.command.pre_exec(move || match libc::setrlimit(resource, &raw const limit) {
            0 => Ok(()),
            _ => Err(std::io::Error::last_os_error()),
        });
    }
    it
}

fn run(mut it: Unprivileged) -> Outcome {
    Outcome::from(it.command.output().unwrap())
}

/// Gives all users full access to the files in the scene, so that each test can restrict it.
fn open_to_all(scene: &Scene) {
    fs::set_permissions(scene.path(), fs::Permissions::from_mode(0o777)).unwrap();
    for name in tree(scene.path()) {
        fs::set_permissions(scene.path().join(name), fs::Permissions::from_mode(0o777)).unwrap();
    }
}

const CLIP: &str =
    r#"{"visemes":"MAEO-","viseme_type":"blair","fps":24,"text_en-us":"Mayor!","events":"otto feels sad"}"#;

fn scene() -> Scene {
    let scene = Scene::new();
    for name in ["act1/mayor", "act1/otto", "act2/mara"] {
        scene.write(&format!("voices/{name}.lipz"), CLIP);
    }
    scene.write("mouth.tsv", "0.00\tX\n0.25\tD\n0.50\tX\n1.75\tX\n");
    scene.prepare(&["pack", "voices", "-o", "old.lipzbank", "--quiet"]);
    open_to_all(&scene);
    scene
}

#[test]
fn without_threads_every_command_does_its_work() {
    let scene = scene();
    let commands: &[&[&str]] = &[
        &["check", "voices"],
        &["check", "voices", "--fix", "--jobs", "4"],
        &["pack", "voices", "-o", "new.lipzbank"],
        &["pack", "voices", "-o", "cached.lipzbank", "--cache", "c.cache", "--jobs", "8"],
        &["pack", "voices", "-o", "split.lipzbank", "--config", "split-locales=true"],
        &["unpack", "old.lipzbank", "-o", "unpacked"],
        &["fmt", "voices"],
        &["convert", "voices", "--viseme-type", "toonboom", "--in-place"],
        &["import", "visemes", "rhubarb-tsv", "mouth.tsv", "-o", "imported"],
        &["verify", "old.lipzbank"],
        &["inspect", "--show", "stats", "old.lipzbank"],
        &["diff", "old.lipzbank", "new.lipzbank"],
        &["coverage", "voices"],
        &["inspect", "old.lipzbank"],
    ];
    for arguments in commands {
        let outcome = run(limit(as_nobody(&scene, arguments), libc::RLIMIT_NPROC, 1));
        assert_eq!(outcome.code, 0, "{arguments:?}: {}{}", outcome.stdout, outcome.stderr);
    }
    let bank = |name: &str| fs::read(scene.path().join(name)).unwrap();
    assert!(bank("new.lipzbank") == bank("old.lipzbank") && bank("cached.lipzbank") == bank("old.lipzbank"));
    // Changes are detected on a thread. Without an error message, nothing would ever be packed again.
    let watch = ["watch", "voices", "-o", "watched.lipzbank"];
    let outcome = run(limit(as_nobody(&scene, &watch), libc::RLIMIT_NPROC, 1));
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("error[LZ1605]: files cannot be watched: "), "{}", outcome.stderr);
    // The language server reads its messages on a thread.
    let outcome = run(limit(as_nobody(&scene, &["lsp"]), libc::RLIMIT_NPROC, 1));
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(!outcome.stderr.contains("panicked"), "{}", outcome.stderr);
}

/// A link to a device without an end was read until memory ended.
#[test]
fn devices_without_an_end_are_refused() {
    let scene = scene();
    for name in ["zero.tsv", "zero.po", "zero.en-us.srt", "zero.xml", "zero.csv", "zero.lipzbank", "zero.toml"] {
        std::os::unix::fs::symlink("/dev/zero", scene.path().join(name)).unwrap();
    }
    open_to_all(&scene);
    let import = ["import", "visemes", "rhubarb-tsv"];
    let commands: &[&[&str]] = &[
        &["verify", "zero.lipzbank"],
        &["inspect", "zero.lipzbank"],
        &["diff", "old.lipzbank", "zero.lipzbank"],
        &["merge", "old.lipzbank", "zero.lipzbank", "-o", "merged.lipzbank"],
        &[&import[..], &["zero.tsv", "-o", "imported"]].concat(),
        &[&import[..], &["mouth.tsv", "-o", "imported", "--script", "zero.csv"]].concat(),
        &[&import[..], &["mouth.tsv", "-o", "imported", "--map", "zero.toml"]].concat(),
        &["import", "texts", "zero.po", "--config", "sources=['voices']"],
        &["import", "subtitles", "zero.en-us.srt", "-o", "imported"],
        &["print", "babble", "zero.xml"],
        &["check", "voices", "--baseline", "zero.csv"],
    ];
    for arguments in commands {
        let outcome = run(limit(as_nobody(&scene, arguments), libc::RLIMIT_AS, 1 << 30));
        assert!([1, 2].contains(&outcome.code), "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.starts_with("error[LZ"), "{arguments:?}: {}", outcome.stderr);
    }
}

#[test]
fn files_that_may_not_grow_are_an_error_and_the_old_ones_stay() {
    let scene = Scene::new();
    let long = |text: &str| format!(r#"{{"text_en-us":"{}"}}"#, text.repeat(10_000));
    scene.write("voices/long.lipz", long("Aye. "));
    scene.prepare(&["pack", "voices", "-o", "old.lipzbank", "--quiet"]);
    scene.write("voices/long.lipz", long("Nay. "));
    open_to_all(&scene);
    let (before, files) = (fs::read(scene.path().join("old.lipzbank")).unwrap(), tree(scene.path()));
    let commands: &[(&[&str], &str)] = &[
        (&["pack", "voices", "-o", "old.lipzbank"], "old.lipzbank"),
        (&["pack", "voices", "-o", "new.lipzbank", "--config", "split-locales=true"], "new.en-us.lipztexts"),
        (&["unpack", "old.lipzbank", "-o", "unpacked"], "unpacked/long.lipz"),
        (&["fmt", "voices"], "voices/long.lipz"),
    ];
    for (arguments, path) in commands {
        let outcome = run(limit(as_nobody(&scene, arguments), libc::RLIMIT_FSIZE, 20_000));
        assert_eq!(outcome.code, 2, "{arguments:?}: {}", outcome.stderr);
        let message = format!("error[LZ0904]: `{path}` cannot be written: ");
        assert!(outcome.stderr.starts_with(&message), "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains("limit for the size of a file"), "{arguments:?}: {}", outcome.stderr);
    }
    assert!(fs::read(scene.path().join("old.lipzbank")).unwrap() == before);
    assert_eq!(fs::read_to_string(scene.path().join("voices/long.lipz")).unwrap(), long("Nay. "));
    let left: Vec<String> = tree(scene.path()).into_iter().filter(|name| !files.contains(name)).collect();
    assert_eq!(left, ["unpacked"], "no temporary file");
}

#[test]
fn what_may_not_be_read_is_named() {
    let scene = scene();
    let forbid = |name: &str| fs::set_permissions(scene.path().join(name), fs::Permissions::from_mode(0o000)).unwrap();
    forbid("voices/act1");
    forbid("voices/act2/mara.lipz");
    let over_sources: &[&[&str]] = &[
        &["check", "voices"],
        &["check", "voices", "--fix"],
        &["pack", "voices", "-o", "new.lipzbank"],
        &["pack", "voices", "-o", "new.lipzbank", "--cache", "c.cache"],
        &["fmt", "voices"],
        &["convert", "voices", "--viseme-type", "toonboom", "--in-place"],
        &["coverage", "voices"],
        &["inspect", "--show", "stats", "voices"],
        &["ids", "voices", "--lang", "c"],
    ];
    for arguments in over_sources {
        let outcome = run(as_nobody(&scene, arguments));
        assert!([1, 2].contains(&outcome.code), "{arguments:?}: {} {}", outcome.code, outcome.stderr);
        for part in ["error[LZ0001]", "voices/act1", "voices/act2/mara.lipz", "ermission denied"] {
            assert!(outcome.stderr.contains(part), "{arguments:?}: no {part} in\n{}", outcome.stderr);
        }
    }
    for name in ["old.lipzbank", "mouth.tsv"] {
        forbid(name);
    }
    let over_files: &[(&[&str], &str)] = &[
        (&["unpack", "old.lipzbank", "-o", "out"], "old.lipzbank"),
        (&["verify", "old.lipzbank"], "old.lipzbank"),
        (&["inspect", "old.lipzbank"], "old.lipzbank"),
        (&["diff", "old.lipzbank", "old.lipzbank"], "old.lipzbank"),
        (&["import", "visemes", "rhubarb-tsv", "mouth.tsv", "-o", "out"], "mouth.tsv"),
    ];
    for (arguments, path) in over_files {
        let outcome = run(as_nobody(&scene, arguments));
        assert!([1, 2].contains(&outcome.code), "{arguments:?}: {} {}", outcome.code, outcome.stderr);
        for part in ["error[LZ", path, "ermission denied"] {
            assert!(outcome.stderr.contains(part), "{arguments:?}: no {part} in\n{}", outcome.stderr);
        }
    }
    assert!(!scene.path().join("out").exists() && !scene.path().join("new.lipzbank").exists());
}

#[test]
fn what_may_not_be_written_is_named_and_stays() {
    let scene = scene();
    scene.write("closed/here", "");
    // Files can be read, but not created or replaced.
    for name in ["closed", "voices", "voices/act1", "voices/act2"] {
        fs::set_permissions(scene.path().join(name), fs::Permissions::from_mode(0o555)).unwrap();
    }
    let before = tree(scene.path());
    let commands: &[(&[&str], &str)] = &[
        (&["pack", "voices", "-o", "closed/b.lipzbank"], "closed/b.lipzbank"),
        (&["pack", "voices", "-o", "closed/new/b.lipzbank"], "closed/new/b.lipzbank"),
        (&["pack", "voices", "-o", "closed/b.lipzbank", "--cache", "closed/c.cache"], "closed/b.lipzbank"),
        (&["pack", "voices", "-o", "closed/b.lipzbank", "--config", "split-locales=true"], "closed/b.en-us.lipztexts"),
        (&["unpack", "old.lipzbank", "-o", "closed"], "closed/act1/mayor.lipz"),
        (&["unpack", "old.lipzbank", "-o", "closed/new"], "closed/new"),
        (&["fmt", "voices"], "voices/act1/mayor.lipz"),
        (&["convert", "voices", "--viseme-type", "toonboom", "--in-place"], "voices/act1/mayor.lipz"),
        (&["import", "visemes", "rhubarb-tsv", "mouth.tsv", "-o", "closed"], "closed/mouth.lipz"),
        (&["export", "subtitles", "srt", "voices", "-o", "closed"], "closed"),
    ];
    for (arguments, path) in commands {
        let outcome = run(as_nobody(&scene, arguments));
        assert_eq!(outcome.code, 2, "{arguments:?}: {}", outcome.stderr);
        for part in ["error[LZ0904]", path, "ermission denied", "= help: "] {
            assert!(outcome.stderr.contains(part), "{arguments:?}: no {part} in\n{}", outcome.stderr);
        }
    }
    assert_eq!(tree(scene.path()), before);
    assert_eq!(fs::read_to_string(scene.path().join("voices/act1/mayor.lipz")).unwrap(), CLIP);
}

/// Runs a shell script in which `mount` works, as root in containers that allow it; returns `None` elsewhere.
fn where_mounts_work(folder: &Path, script: &str, arguments: &[&str]) -> Option<Outcome> {
    let unshared = |script: &str| {
        let mut command = Command::new("unshare");
        command.args(["--mount", "sh", "-c", script, env!("CARGO_BIN_EXE_lipz")]).args(arguments);
        command.current_dir(folder).env("NO_COLOR", "1").env_remove("CLICOLOR_FORCE");
        command.output().ok()
    };
    if unshared("mount -t tmpfs none /proc").is_none_or(|output| !output.status.success()) {
        eprintln!("skipped: nothing can be mounted here");
        return None;
    }
    unshared(script).map(Outcome::from)
}

#[test]
fn unpacking_needs_no_proc() {
    let scene = scene();
    let script = r#"mount -t tmpfs none /proc && exec "$0" "$@""#;
    let Some(outcome) = where_mounts_work(scene.path(), script, &["unpack", "old.lipzbank", "-o", "out"]) else {
        return;
    };
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    assert_eq!(tree(&scene.path().join("out")).iter().filter(|name| name.ends_with(".lipz")).count(), 3);
}

#[test]
fn a_full_disk_is_an_error_and_the_old_files_stay() {
    let scene = scene();
    scene.write("full/keep", "");
    // 40 KB of files on a disk of 64 KB. The script lists the files after the command, and compares the sources.
    let script = r#"mount -t tmpfs -o size=64k none full && cp -r voices old.lipzbank full && head -c 100000 /dev/zero > full/filler 2>/dev/null
        cp old.lipzbank before; "$0" "$@"; code=$?
        cmp full/old.lipzbank before && diff -r voices full/voices && find full -name '.*' ; exit $code"#;
    let commands: &[&[&str]] = &[
        &["pack", "voices", "-o", "full/old.lipzbank"],
        &["pack", "voices", "-o", "full/new/b.lipzbank", "--config", "split-locales=true"],
        &["unpack", "old.lipzbank", "-o", "full/out"],
        &["fmt", "full/voices"],
        &["convert", "full/voices", "--viseme-type", "toonboom", "--in-place"],
        &["import", "visemes", "rhubarb-tsv", "mouth.tsv", "-o", "full/imported"],
    ];
    for arguments in commands {
        let arguments = [*arguments, &["--quiet"]].concat();
        let Some(outcome) = where_mounts_work(scene.path(), script, &arguments) else { return };
        assert_eq!(outcome.code, 2, "{arguments:?}: {}{}", outcome.stdout, outcome.stderr);
        for part in ["error[LZ0904]", "full/", "No space left on device", "free some space"] {
            assert!(outcome.stderr.contains(part), "{arguments:?}: no {part} in\n{}", outcome.stderr);
        }
        assert_eq!(outcome.stdout, "", "{arguments:?}: what is not whole, and temporary files");
    }
}
