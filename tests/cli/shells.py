# SPDX-License-Identifier: MIT
# Runs each shell in its own terminal, and reads its completions after the tab key.
import fcntl
import os
import pty
import re
import select
import shutil
import signal
import struct
import subprocess
import termios
import time

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


def is_here(shell):
    return shutil.which(shell) is not None


class Terminal:
    """A shell in a terminal of 400 lines."""

    def __init__(self, words, work):
        self.pid, self.file = pty.fork()
        if self.pid == 0:
            os.chdir(work)
            os.environ.update(TERM="vt100", PS1="", INPUTRC="/dev/null", LC_ALL="C.UTF-8")
            os.execvp(words[0], words)
        fcntl.ioctl(self.file, termios.TIOCSWINSZ, struct.pack("HHHH", 400, 160, 0, 0))

    def type(self, text):
        os.write(self.file, text.encode())

    def read(self, until, seconds=20):
        """Reads output until until(output) is true or the time is over. Returns the output."""
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


def ask_terminal(shell, folder, line, work):
    words, setup = SETUP[shell]
    terminal = Terminal(words, work)
    try:
        terminal.type(setup.format(folder=folder) + "; echo ready to' 'go\n")
        terminal.read(lambda text: READY in text)
        terminal.type(line + "\t")
        # If the shell echoes the next line, the list is complete.
        quiet = [time.monotonic(), 0]

        def is_quiet(text):
            if len(text) != quiet[1]:
                quiet[:] = [time.monotonic(), len(text)]
            return len(text) > len(line) + 2 and time.monotonic() - quiet[0] > 0.5

        return terminal.read(is_quiet)
    finally:
        terminal.close()


def ask_fish(folder, line, work):
    command = f"source '{folder}/clrt.fish'; complete -C '{line}'"
    return subprocess.run(
        ["fish", "--no-config", "-c", command], cwd=work, capture_output=True, text=True, check=True
    ).stdout


def complete(shell, folder, line, work):
    """Returns the completions at the end of the line, with their descriptions."""
    if shell == "fish":
        return ask_fish(folder, line, work)
    return ask_terminal(shell, folder, line, work)
