#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Compares man pages and completions with --help and the grammar of scenes. Usage: test_manual.py
# CLRT FOLDER_OF_THE_MANUAL
import fcntl
import os
import pathlib
import pty
import re
import select
import shutil
import signal
import struct
import subprocess
import sys
import termios
import time
import unittest

import grammar
from skips import needs_terminal
from work import CLRT, ROOT, SharedWork, Work, main

MANUAL = pathlib.Path(sys.argv[2])
PAGES = [MANUAL / "clrt.1", ROOT / "tools/manual/clrt-scene.5"]
ENTRY = re.compile(r"^  (?:-(\w), |    )--([a-z-]+)(\[=\S+\]| \S+)?", re.MULTILINE)


def run(*words, **settings):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True, **settings)


def read_page(page):
    """Returns the formatted page as one line."""
    environment = dict(os.environ, MANWIDTH="1000", LC_ALL="C.UTF-8")
    text = run("man", "-E", "ascii", "-l", page, env=environment).stdout
    return re.sub(r"\s+", " ", re.sub(r".\x08", "", text))


HELP = run(CLRT, "--help").stdout
OPTIONS = ENTRY.findall(HELP)
COMMANDS = sorted(set(re.findall(r"^  clrt ([a-z]+)", HELP, re.MULTILINE)))


class Pages(Work):
    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_pages_are_set_without_a_warning(self):
        for page in PAGES:
            done = run("groff", "-mandoc", "-ww", "-b", "-z", "-Tutf8", page)
            self.assertEqual(done.stderr, "")

    @unittest.skipUnless(shutil.which("mandoc"), "mandoc is not installed")
    def test_mandoc_has_nothing_to_warn_of(self):
        for page in PAGES:
            done = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", page], capture_output=True, text=True)
            self.assertEqual((done.stdout, done.returncode), ("", 0))

    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_everything_that_help_and_the_grammar_name_is_in_the_pages(self):
        program, scenes = map(read_page, PAGES)
        for letter, name, value in OPTIONS:
            start = f"-{letter}, " if letter else ""
            self.assertIn(start + "--" + name + value.replace("|", " | "), program)
        for name in ("exact", "bounded", "statistical"):
            self.assertEqual(program.count(f"[{name}]"), HELP.count(f"[{name}]"))
        codes = re.findall(r"(\d+) ", re.search(r"Exit status: (.*)", HELP, re.DOTALL)[1])
        channels = HELP.split("\nChannels of --aov:", 1)[1].split("\n\n", 1)[0]
        self.assertIn("[--quiet | --verbose]", program)
        properties = [f" {name} " for name in grammar.properties()]
        for page, names, pattern in (
            (program, codes, "EXIT STATUS.* {} "), (program, COMMANDS, "COMMANDS .*{} [A-Z]"),
            (program, re.findall(r"\w+", channels), "CHANNELS .* {} .* CLASSES"),
            (scenes, grammar.usages(), r" {} [A-Z0o\[s]"), (scenes, properties, "{}"),
        ):
            self.assertGreater(len(names), 2, pattern)
            for name in names:
                self.assertRegex(page, pattern.format(name))

    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_man_finds_the_pages_of_a_build_folder_in_path(self):
        environment = dict(os.environ, PATH=f"{CLRT.parent}:{os.environ['PATH']}", MANPATH="")
        found = run("man", "-w", "clrt", "clrt-scene", env=environment).stdout.split()
        folder = CLRT.parent / "man"
        self.assertEqual(found, [f"{folder}/man1/clrt.1.gz", f"{folder}/man5/clrt-scene.5.gz"])

    def test_the_readme_shows_a_scene_that_is_there(self):
        self.assertIn((ROOT / "scenes/ball.scn").read_text(), (ROOT / "README.md").read_text())

    def test_links_of_the_docs_lead_somewhere(self):
        for page in [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]:
            for target in re.findall(r"\]\(([^)#]+)\)", page.read_text()):
                self.assertTrue((page.parent / target).exists(), f"{page.name}: {target}")

    def test_the_gallery_has_a_small_picture_for_each_command(self):
        page = (ROOT / "docs/gallery.md").read_text()
        inputs = re.findall(r"`clrt scenes/(\S+) [^`]*`", page)
        pictures = re.findall(r"\]\((gallery/\S+)\)", page)
        self.assertGreaterEqual(len(inputs), 8)
        self.assertEqual(len(inputs), len(pictures))
        for name in inputs:
            self.assertTrue(name.startswith("models/") or (ROOT / "scenes" / name).exists(), name)
        for name in pictures:
            content = (ROOT / "docs" / name).read_bytes()
            self.assertEqual(int.from_bytes(content[16:20], "big"), 320, name)
            self.assertEqual(content[25], 2, f"{name} is not in full color")
            self.assertLessEqual(len(content), 90000, name)

    def test_the_scene_of_the_page_is_drawn(self):
        text = PAGES[1].read_text()
        scene = re.search(r"\.Bd -literal.*?\n(.*?)\.Ed", text, re.DOTALL)[1]
        self.write(a_scn=scene)
        done = self.run_clrt("a.scn", "-s", "16x12", "-o", "a.pfm", "-q")
        self.assertEqual((done.stderr, done.returncode), ("", 0))


# bash and zsh complete words only in a terminal, where the tests press the tab key and read the
# completions. fish needs no terminal (ask_fish).
SETUP = {
    "bash": (
        ["bash", "--norc", "--noprofile", "-i"],
        "bind 'set show-all-if-ambiguous on'; bind 'set completion-query-items 0';"
        "bind 'set page-completions off'; bind 'set bell-style none'; source '{folder}/clrt'",
    ),
    "zsh": (
        ["zsh", "-f", "-i"],
        "LISTMAX=0; unsetopt beep list_ambiguous; fpath=('{folder}' $fpath);"
        "autoload -U compinit; compinit -u -D",
    ),
}
ESCAPES = re.compile(r"\x1b(\[[0-9;?]*[a-zA-Z]|[=>])")
READY = "ready to go"


class Terminal:
    """A shell in a terminal of 400 lines."""

    def __init__(self, shell, work):
        words, setup = SETUP[shell]
        self.pid, self.file = pty.fork()
        if self.pid == 0:
            os.chdir(work)
            os.environ.update(TERM="vt100", PS1="", INPUTRC="/dev/null", LC_ALL="C.UTF-8")
            os.execvp(words[0], words)
        fcntl.ioctl(self.file, termios.TIOCSWINSZ, struct.pack("HHHH", 400, 160, 0, 0))
        self.type(setup.format(folder=MANUAL) + "\n")

    def type(self, text):
        os.write(self.file, text.encode())

    def read(self, until, seconds=20):
        """Returns the output once until(output) is true or the time is over."""
        text, end = "", time.monotonic() + seconds
        while time.monotonic() < end and not until(text):
            if select.select([self.file], [], [], 0.2)[0]:
                try:
                    text += os.read(self.file, 65536).decode(errors="replace")
                except OSError:
                    break
        return ESCAPES.sub("", text)

    def close(self):
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self.file)


def ask_terminal(terminal, line):
    terminal.type("\x15echo ready to' 'go\n")  # Ctrl-U deletes the previous line
    terminal.read(lambda text: READY in text)
    terminal.type(line + "\t")
    # If the output has not grown for 0.5 s, the list is complete.
    quiet = [time.monotonic(), 0]

    def is_quiet(text):
        if len(text) != quiet[1]:
            quiet[:] = [time.monotonic(), len(text)]
        return len(text) > len(line) + 2 and time.monotonic() - quiet[0] > 0.5

    return terminal.read(is_quiet)


class Completions(SharedWork):
    """All tests of a shell share a terminal, because zsh starts slowly."""

    terminals = {}

    def prepare(self):
        self.write(room_scn="", bunny_ply="", notes_txt="")

    def offered(self, shell, line):
        """Returns the shell's output, which lists the completions at the end of the line."""
        if shell == "fish":
            command = f"source '{MANUAL}/clrt.fish'; complete -C '{line}'"
            return run("fish", "--no-config", "-c", command, cwd=self.work).stdout
        if shell not in self.terminals:
            self.terminals[shell] = Terminal(shell, self.work)
            self.addClassCleanup(self.terminals[shell].close)
        return ask_terminal(self.terminals[shell], line)

    def check_options(self, shell):
        text = "".join(self.offered(shell, f"clrt {word} --") for word in ("a.scn", *COMMANDS))
        for _, name, _ in OPTIONS:
            self.assertRegex(text, rf"(?<!\w)--{name}(?![\w-])", shell)
        self.assertRegex(self.offered(shell, "clrt check --"), r"--json(?![\w-])")
        self.assertNotIn("--output", self.offered(shell, "clrt check --"))
        self.assertRegex(self.offered(shell, "clrt compare --"), r"--fail(?![\w-])")

    def check_letters(self, shell):
        text = self.offered(shell, "clrt a.scn -")
        for letter in filter(None, (letter for letter, _, _ in OPTIONS)):
            self.assertRegex(text, rf"(?<![\w-])-{letter}(?!\w)", shell)

    def check_words(self, shell):
        # The shells insert the common prefix of the words, and list the words.
        for _, name, value in OPTIONS:
            if "|" not in value:
                continue
            separator = "=" if value.startswith("[") else " "
            text = self.offered(shell, f"clrt a.scn --{name}{separator}")
            for word in value.strip(" [=]").split("|"):
                if word.isupper():
                    continue  # stands for any value
                self.assertRegex(text, rf"(?<!\w){word}(?!\w)", f"{shell} --{name}")
        self.assertIn("pfm", self.offered(shell, "clrt a.scn --format p"))
        text = self.offered(shell, "clrt a.scn --tune ")
        for word in "kernel=packet", "tile=", "bvh=midpoint":
            self.assertIn(word, text, shell)

    def check_files(self, shell):
        text = self.offered(shell, "clrt ")
        for word in ("room.scn", "bunny.ply", "check"):
            self.assertIn(word, text)
        self.assertNotIn("notes.txt", text)
        self.assertIn("notes.txt", self.offered(shell, "clrt a.scn --json=n"))
        self.assertIn("notes.txt", self.offered(shell, "clrt a.scn -o n"))


def add_tests():
    for shell in ("bash", "zsh", "fish"):
        for what in ("options", "letters", "words", "files"):

            def test(self, shell=shell, what=what):
                getattr(self, f"check_{what}")(shell)

            if shell != "fish":
                test = needs_terminal(test)
            here = unittest.skipUnless(shutil.which(shell), f"{shell} is not installed")
            setattr(Completions, f"test_{shell}_completes_{what}", here(test))


add_tests()
if __name__ == "__main__":
    main(2)
