"""Checks the files of the package: package.json, .meta files and assembly definitions.

package.py ROOT           checks
package.py ROOT --write   writes the .meta files that are missing, and guids.txt

Each file that Unity imports needs a .meta file with a guid. Assets of games refer to scripts by their guid, so it never
changes, even if the file is moved. guids.txt lists all guids that were ever committed.
"""

import hashlib
import json
import re
import sys
from pathlib import Path

PACKAGE = "packages/lipz-unity"
IMPORTERS = {
    ".cs": "MonoImporter:\n  externalObjects: {}\n  serializedVersion: 2\n  defaultReferences: []\n"
    "  executionOrder: 0\n  icon: {instanceID: 0}\n",
    ".asmdef": "AssemblyDefinitionImporter:\n  externalObjects: {}\n",
    ".md": "TextScriptImporter:\n  externalObjects: {}\n",
    ".json": "PackageManifestImporter:\n  externalObjects: {}\n",
    "": "folderAsset: yes\nDefaultImporter:\n  externalObjects: {}\n",
}
END = "  userData: \n  assetBundleName: \n  assetBundleVariant: \n"


def imported(package):
    """All files and folders that Unity imports."""
    for path in sorted(package.rglob("*")):
        parts = path.relative_to(package).parts
        is_hidden = any(part.endswith("~") or part.startswith(".") for part in parts)
        if not is_hidden and path.suffix != ".meta":
            yield path


def meta_of(path):
    return path.with_name(path.name + ".meta")


def guid_in(meta):
    found = re.search(r"^guid: ([0-9a-f]{32})$", meta.read_text(), re.M)
    return found and found.group(1)


def write_metas(package):
    for path in imported(package):
        meta = meta_of(path)
        if meta.exists():
            continue
        guid = hashlib.md5(f"lipz/{path.relative_to(package).as_posix()}".encode()).hexdigest()
        importer = IMPORTERS["" if path.is_dir() else path.suffix]
        meta.write_text(f"fileFormatVersion: 2\nguid: {guid}\n{importer}{END}")


def guids(package):
    """The guid of each file."""
    for path in imported(package):
        yield path.relative_to(package).as_posix(), guid_in(meta_of(path))


def check_metas(package):
    for path in imported(package):
        assert meta_of(path).exists(), f"{path} has no .meta file: run package.py ROOT --write"
    for meta in package.rglob("*.meta"):
        assert meta.with_suffix("").exists(), f"{meta} has no file"
    now = dict(guids(package))
    assert None not in now.values(), now
    assert len(set(now.values())) == len(now), "two files have the same guid"
    listed = dict(line.split(" ")[::-1] for line in (package / "test~/guids.txt").read_text().splitlines())
    for path, guid in listed.items():
        assert guid in now.values(), f"the guid {guid} of {path} has changed"
    unlisted = set(now.values()) - set(listed.values())
    assert not unlisted, f"run package.py ROOT --write, and commit guids.txt: {unlisted}"
    return len(now)


def write_guids(package):
    file = package / "test~/guids.txt"
    lines = dict(line.split(" ") for line in file.read_text().splitlines()) if file.exists() else {}
    lines.update((guid, path) for path, guid in guids(package))
    rows = sorted(lines.items(), key=lambda row: row[1])
    file.write_text("".join(f"{guid} {path}\n" for guid, path in rows))


def check_manifest(root, package):
    """The rules of OpenUPM, and the version of the workspace."""
    manifest = json.loads((package / "package.json").read_text())
    assert re.fullmatch(r"com(\.[a-z0-9-]+){2,}", manifest["name"]), manifest["name"]
    assert re.fullmatch(r"\d+\.\d+\.\d+", manifest["version"]), manifest["version"]
    workspace = re.search(r'^version = "([^"]+)"', (root / "Cargo.toml").read_text(), re.M).group(1)
    assert manifest["version"] == workspace, f"{manifest['version']} is not {workspace}"
    assert re.fullmatch(r"20\d\d\.\d", manifest["unity"])
    assert manifest["license"] == "MIT OR Apache-2.0"
    assert {"displayName", "description", "keywords", "author", "repository"} <= manifest.keys()
    for sample in manifest["samples"]:
        assert list((package / sample["path"]).glob("*.cs")), sample["path"]
    mit = (root / "LICENSE-MIT").read_text().strip()
    assert mit in (package / "LICENSE.md").read_text(), "LICENSE.md lacks the text of LICENSE-MIT"


def check_assemblies(package):
    """Each folder of sources has an assembly, with the references that run.sh compiles it with."""
    script = (package / "test~/run.sh").read_text()
    engine = {"UnityEngine", "UnityEditor", "nunit.framework"}
    count = 0
    for path in imported(package):
        if path.suffix == ".cs":
            folders = list(path.relative_to(package).parents)[:-1]
            assert any(list((package / folder).glob("*.asmdef")) for folder in folders), f"{path} has no assembly"
        if path.suffix != ".asmdef":
            continue
        definition = json.loads(path.read_text())
        assert definition["name"] == path.stem
        assert not definition["allowUnsafeCode"]
        line = re.search(rf"^compile {re.escape(path.stem)}\.dll .*$", script, re.M).group(0)
        compiled = set(line.partition(" -- ")[2].split()) - engine
        stated = {name for name in definition["references"] if not name.endswith(".TestRunner")}
        assert compiled == stated, f"{path.stem}: {compiled} is not {stated}"
        count += 1
    return count


def check_lines(package):
    """Sources are short, and their lines are at most 120 columns wide."""
    count = 0
    for path in sorted(package.rglob("*.cs")):
        lines = path.read_text().splitlines()
        count += len(lines) if "Reader" in path.parts else 0
        wide = [number for number, line in enumerate(lines, 1) if len(line) > 120]
        assert not wide, f"{path}:{wide[0]} is too wide"
    return count


def main(arguments):
    root = Path(arguments[0])
    package = root / PACKAGE
    if "--write" in arguments:
        write_metas(package)
        write_guids(package)
    check_manifest(root, package)
    metas, assemblies, lines = check_metas(package), check_assemblies(package), check_lines(package)
    print(f"package: {metas} files with a .meta, {assemblies} assemblies, {lines} lines of the reader")


main(sys.argv[1:])
