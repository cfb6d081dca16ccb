//! `cargo xtask editors`: tests Neovim as a client of `lipz lsp`, and checks, tests and packs the extension for Visual
//! Studio Code.

use crate::Failure;
use crate::cargo;
use crate::paths::{temporary_folder, workspace_root};
use crate::tools::{has_program, skip, skip_rest, succeed};
use std::process::Command;

pub(crate) fn run() -> Result<(), Failure> {
    neovim()?;
    visual_studio_code()
}

/// Runs the test of the plugin in a separate folder, without the user's settings.
fn neovim() -> Result<(), Failure> {
    if !has_program("nvim") {
        return skip("nvim");
    }
    let program = cargo::lipz()?;
    let plugin = workspace_root().join("editors/nvim");
    let plugin = plugin.canonicalize().map_err(|error| format!("`{}`: {error}", plugin.display()))?;
    let folder = temporary_folder()?;
    // Paths are passed in the environment, because spaces, quotes and bars would end them on a command line of Neovim.
    let mut nvim = Command::new("nvim");
    nvim.args(["--headless", "-i", "NONE", "-u", "NONE", "--cmd", "lua vim.g.lipz_command = vim.env.LIPZ_PROGRAM"]);
    nvim.args(["--cmd", "lua vim.opt.runtimepath:prepend((vim.env.LIPZ_PLUGIN:gsub(',', '\\\\,')))"]);
    nvim.args(["--cmd", "filetype plugin on", "--cmd", "syntax on"]);
    nvim.args(["-c", "lua dofile(vim.env.LIPZ_PLUGIN .. '/test/client.lua')"]);
    nvim.env("LIPZ_PROGRAM", &program).env("LIPZ_PLUGIN", &plugin);
    succeed(nvim.current_dir(folder.path()), "the test of the plugin for Neovim")
}

/// Checks the types of the extension, packs it, and tests the package, including with the program, which it starts.
fn visual_studio_code() -> Result<(), Failure> {
    if !has_program("npm") {
        return skip_rest("npm, of node 20 or later");
    }
    let program = cargo::lipz()?;
    let folder = workspace_root().join("editors/vscode");
    for arguments in [["ci", "--no-audit"], ["run", "package"], ["run", "test"]] {
        let what = format!("npm {}", arguments.join(" "));
        let mut npm = Command::new("npm");
        npm.args(arguments).arg("--silent").env("LIPZ", &program).current_dir(&folder);
        succeed(&mut npm, &what)?;
    }
    println!("extension: {}", folder.join("lipz.vsix").display());
    Ok(())
}
