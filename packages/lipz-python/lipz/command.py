"""Runs commands of the program `lipz`, and returns their findings as objects."""

from __future__ import annotations

import json
import os
import re
import subprocess
import tempfile
import threading
from typing import IO, Any, Callable, Optional

from .program import path as installed_program

# The number of completed files, and the number of all files.
Progress = Callable[[int, int], None]

_INTERRUPTED = 130
_POLL_SECONDS = 0.05
# The progress bar of the program, which it shows only on a terminal: `3/1,234 files`.
_BAR = re.compile(rb"([\d,]+)/([\d,]+) files")
# Text that the program has cleared from the terminal.
_CLEARED = re.compile(rb"[^\n]*\r\x1b\[2K")


class Finding:
    """A diagnostic (docs/reference/diagnostics.md, "For programs").

    `severity` is `error` or `warning`. `line` and `column` count from 1, or are None if the finding is about a whole
    file. `path` is empty if it is not about a file. `data` has all fields of the JSON output, such as a fix.
    """

    __slots__ = ("code", "name", "severity", "message", "path", "line", "column", "notes", "help", "data")

    def __init__(self, data: dict[str, Any]) -> None:
        start = (data["span"] or {}).get("start", {})
        self.code: str = data["code"]
        self.name: str = data["name"]
        self.severity: str = data["severity"]
        self.message: str = data["message"]
        self.path: str = data["path"]
        self.line: int | None = start.get("line")
        self.column: int | None = start.get("column")
        self.notes: list[str] = data["notes"]
        self.help: str | None = data["help"]
        self.data = data

    def __str__(self) -> str:
        position = ":".join(str(part) for part in (self.path, self.line, self.column) if part)
        return f"{position + ': ' if position else ''}{self.severity}[{self.code}]: {self.message}"


class Report:
    """The result of a command. `output` is what it printed apart from its findings."""

    __slots__ = ("findings", "exit_code", "output")

    def __init__(self, findings: list[Finding], exit_code: int, output: str) -> None:
        self.findings = findings
        self.exit_code = exit_code
        self.output = output

    @property
    def errors(self) -> list[Finding]:
        return [finding for finding in self.findings if finding.severity == "error"]

    @property
    def is_ok(self) -> bool:
        """Whether there are no errors."""
        return self.exit_code == 0

    @property
    def is_cancelled(self) -> bool:
        """Whether the command was cancelled. All files are complete."""
        return self.exit_code == _INTERRUPTED


def run(
    *arguments: str,
    cwd: str | None = None,
    progress: Optional[Progress] = None,
    cancel: threading.Event | None = None,
    program: str | None = None,
) -> Report:
    """Runs a command of the program in the folder `cwd`.

    Calls `progress` whenever files are completed; never on Windows, where the program cannot report them. After
    `cancel` is set, for example by another thread, the command ends without leaving half-written files.

    Raises FileNotFoundError without the program, and RuntimeError if it prints no report.
    """
    command = [program or installed_program(), *arguments, "--output-format", "json"]
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        terminal = _Terminal(progress) if progress is not None and os.name == "posix" else None
        process = subprocess.Popen(
            command, cwd=cwd, stdin=subprocess.DEVNULL, stdout=out, stderr=terminal.end if terminal else errors
        )
        try:
            is_cancelled = _wait(process, terminal, cancel)
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
            if terminal:
                terminal.close()
        exit_code = _INTERRUPTED if is_cancelled else process.returncode
        return _report(_read(out), terminal.text if terminal else _read(errors), exit_code)


def _wait(process: subprocess.Popen[bytes], terminal: _Terminal | None, cancel: threading.Event | None) -> bool:
    """Waits for the end of a process. Returns whether it was cancelled before."""
    is_cancelled = False
    while True:
        if terminal:
            terminal.read()
        try:
            process.wait(_POLL_SECONDS)
            break
        except subprocess.TimeoutExpired:
            if cancel is not None and cancel.is_set() and not is_cancelled:
                # A program that was started in the background may ignore SIGINT.
                process.terminate()
                is_cancelled = True
    if terminal:
        terminal.read()
    # The process may have ended before the request.
    return is_cancelled and process.returncode != 0


class _Terminal:
    """A terminal on which the program shows its progress. Not on Windows."""

    def __init__(self, progress: Progress) -> None:
        import pty

        self._progress = progress
        self._last = (-1, -1)
        self._begun, self.end = pty.openpty()
        os.set_blocking(self._begun, False)
        self._bytes = b""

    def read(self) -> None:
        """Reads what the program has printed, and reports the latest progress."""
        while True:
            try:
                found = os.read(self._begun, 1 << 16)
            except OSError:
                break
            if not found:
                break
            self._bytes += found
        bars = _BAR.findall(self._bytes)
        if bars:
            done, count = (int(number.replace(b",", b"")) for number in bars[-1])
            if (done, count) != self._last:
                self._last = done, count
                self._progress(done, count)

    @property
    def text(self) -> str:
        """What the program has printed, without progress."""
        return _CLEARED.sub(b"", self._bytes).replace(b"\r\n", b"\n").decode("utf-8", "replace")

    def close(self) -> None:
        os.close(self.end)
        os.close(self._begun)


def _read(file: IO[bytes]) -> str:
    file.seek(0)
    return file.read().decode("utf-8", "replace")


def _report(out: str, errors: str, exit_code: int) -> Report:
    """Returns the report on standard output, or on standard error if the result is on standard output."""
    for document, output in ((out, errors), (errors, out)):
        try:
            findings = json.loads(document)["diagnostics"]
        except (ValueError, KeyError, TypeError):
            continue
        return Report([Finding(found) for found in findings], exit_code, output)
    # A cancelled command prints no report.
    if exit_code == _INTERRUPTED:
        return Report([], exit_code, out + errors)
    raise RuntimeError(f"lipz ended with {exit_code}, without a report: {(errors or out)[-1000:]}")


def check(*arguments: str, **options: Any) -> Report:
    """Runs `lipz check` with these arguments. The options are those of `run`."""
    return run("check", *arguments, **options)


def pack(*arguments: str, **options: Any) -> Report:
    """Runs `lipz pack` with these arguments. The options are those of `run`."""
    return run("pack", *arguments, **options)


def sync(*arguments: str, **options: Any) -> Report:
    """Runs `lipz sync` with these arguments. The options are those of `run`."""
    return run("sync", *arguments, **options)


def import_(what: str, *arguments: str, **options: Any) -> Report:
    """Runs `lipz import` for `visemes`, `texts` or `subtitles`. The options are those of `run`."""
    return run("import", what, *arguments, **options)


def export(what: str, *arguments: str, **options: Any) -> Report:
    """Runs `lipz export` for `visemes`, `weights`, `texts` or `subtitles`. The options are those of `run`."""
    return run("export", what, *arguments, **options)
