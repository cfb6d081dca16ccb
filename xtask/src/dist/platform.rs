//! The platforms of the packages, with their names in each registry.

use crate::paths::target_folder;
use std::path::Path;
use std::process::Command;

/// The oldest glibc on which the programs for Linux run: that of manylinux2014.
pub(super) const GLIBC: (u32, u32) = (2, 17);

/// A platform for which `lipz` is built.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Platform {
    /// The target of the compiler.
    pub(super) target: &'static str,
    /// The last part of a wheel's name.
    pub(super) wheel_tag: &'static str,
    /// The names of operating system and processor in node.
    pub(super) node: [&'static str; 2],
    /// Whether a release contains it. The others are for tests on a different system.
    pub(super) is_released: bool,
}

/// All platforms.
pub(super) static PLATFORMS: [Platform; 6] = [
    Platform {
        target: "x86_64-unknown-linux-gnu",
        wheel_tag: "manylinux_2_17_x86_64.manylinux2014_x86_64",
        node: ["linux", "x64"],
        is_released: true,
    },
    Platform {
        target: "aarch64-unknown-linux-gnu",
        wheel_tag: "manylinux_2_17_aarch64.manylinux2014_aarch64",
        node: ["linux", "arm64"],
        is_released: true,
    },
    Platform { target: "x86_64-pc-windows-msvc", wheel_tag: "win_amd64", node: ["win32", "x64"], is_released: true },
    // The same packages, built on Linux.
    Platform { target: "x86_64-pc-windows-gnu", wheel_tag: "win_amd64", node: ["win32", "x64"], is_released: false },
    Platform {
        target: "aarch64-apple-darwin",
        wheel_tag: "macosx_11_0_arm64",
        node: ["darwin", "arm64"],
        is_released: true,
    },
    Platform {
        target: "x86_64-apple-darwin",
        wheel_tag: "macosx_10_12_x86_64",
        node: ["darwin", "x64"],
        is_released: true,
    },
];

impl Platform {
    /// Returns the platform of this machine, if there are packages for it.
    pub(super) fn host() -> Option<&'static Platform> {
        let system = match std::env::consts::OS {
            "linux" => "unknown-linux-gnu",
            "windows" => "pc-windows-msvc",
            "macos" => "apple-darwin",
            _ => return None,
        };
        let target = format!("{}-{system}", std::env::consts::ARCH);
        PLATFORMS.iter().find(|platform| platform.target == target)
    }

    pub(super) fn is_linux(&self) -> bool {
        self.node[0] == "linux"
    }

    pub(super) fn is_windows(&self) -> bool {
        self.node[0] == "win32"
    }

    /// Returns the name of the program's file.
    pub(super) fn program(&self) -> &'static str {
        if self.is_windows() { "lipz.exe" } else { "lipz" }
    }

    /// Returns the name of the npm package with the program.
    pub(super) fn npm_package(&self) -> String {
        let [system, processor] = self.node;
        format!("@lipz/cli-{system}-{processor}")
    }

    /// Returns a command that runs a program of this platform, in an emulator if necessary. Returns `None` without one.
    pub(super) fn runner(&self, program: &Path) -> Option<Command> {
        if Platform::host() == Some(self) || self.target == "x86_64-apple-darwin" && cfg!(target_os = "macos") {
            return Some(Command::new(program));
        }
        emulated(self.target, program)
    }
}

/// Returns a command that runs a program for a target in an emulator, if there is one.
pub(super) fn emulated(target: &str, program: &Path) -> Option<Command> {
    let mut command = match target {
        "aarch64-unknown-linux-gnu" => emulator("/usr/bin/qemu-aarch64", &["-L", "/usr/aarch64-linux-gnu"]),
        "aarch64-unknown-linux-musl" => emulator("/usr/bin/qemu-aarch64", &[]),
        "x86_64-pc-windows-gnu" => emulator("/usr/lib/wine/wine64", &[]),
        _ => None,
    }?;
    command.arg(program);
    Some(command)
}

/// Returns the extension of an archive for a target.
pub(super) fn archive_extension(target: &str) -> &'static str {
    if target.contains("windows") { "zip" } else { "tar.gz" }
}

/// The Debian packages with the emulators.
pub(super) const EMULATORS: &str = "Debian's qemu-user, libc6-arm64-cross and wine64";

/// The folder of libraries for Wine, below that of the target.
pub(super) const WINE_LIBRARIES: &str = "wine-libraries";

/// Returns a command of an emulator, if it is installed.
fn emulator(path: &str, arguments: &[&str]) -> Option<Command> {
    let mut command = Path::new(path).exists().then(|| Command::new(path))?;
    // Wine keeps a drive there. Its messages are about Wine, not about the program.
    command.args(arguments).env("WINEPREFIX", std::path::absolute(target_folder().join("wine")).ok()?);
    command.env("WINEDEBUG", "-all");
    let libraries = std::path::absolute(target_folder().join(WINE_LIBRARIES)).ok()?;
    command.env("WINEPATH", format!("Z:{}", libraries.to_string_lossy().replace('/', "\\")));
    Some(command)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn released_packages_have_different_names() {
        for (number, platform) in PLATFORMS.iter().enumerate() {
            for other in &PLATFORMS[..number] {
                assert_ne!(platform.target, other.target);
                assert!(!(platform.is_released && other.is_released && platform.wheel_tag == other.wheel_tag));
                assert!(!(platform.is_released && other.is_released && platform.npm_package() == other.npm_package()));
            }
        }
    }
}
