#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Provokes the faults of docs/troubleshooting.md and compares the messages with the messages on the
# page. Usage: test_troubleshooting.py CLRT 1|0, with 0 for a build without the window
import re
import sys
import unittest

from models import ply
from work import NO_OPENCL, ROOT, SCENE, Work, main

PAGE = (ROOT / "docs/troubleshooting.md").read_text()
HAS_WINDOW = sys.argv[2] == "1"
SMALL = ["-s", "16x12", "-o", "a.pfm"]
INSIDE_OUT = ply([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])


class Messages(Work):
    def provoke(self):
        """Yields the output of each fault in the page's order. In builds without the window, the output
        of the window's fault is None."""

        def run(*words, **environment):
            done = self.run_clrt(*words, **environment)
            return done.stdout + done.stderr

        def scene(text, *words):
            self.write(scene_scn=text)
            return run(*(words or SMALL), "scene.scn")

        yield run(SCENE, *SMALL, **NO_OPENCL)
        yield run(SCENE, *SMALL, "--device", "quantum")
        yield run(SCENE, DISPLAY=None, WAYLAND_DISPLAY=None) if HAS_WINDOW else None
        yield scene("material 1\nsphere 0 0 0 1\n")
        yield scene("")
        self.write(a_ply=INSIDE_OUT)
        yield scene("mesh a.ply\n", "check")
        yield scene("mesh models/figure.ply\n")
        yield scene("sphear 0 0 0 1\n")
        yield run(SCENE, *SMALL, "--hash=0123456789abcdef0123456789abcdef")
        yield run(SCENE, *SMALL, "--time", "1e-6")
        yield run(SCENE, *SMALL, "--error", "1e-9")

    def test_the_page_quotes_the_messages(self):
        quoted = re.findall(r"^```\n(.*)\n```$", PAGE, re.MULTILINE)
        printed = list(self.provoke())
        self.assertEqual(len(quoted), len(printed))
        for message, text in zip(quoted, printed):
            if text is None:
                print(f"skipped: this build has no window: {message}")
            else:
                self.assertIn(message, text)


if __name__ == "__main__":
    main(2)
