# SPDX-License-Identifier: MIT
# Reads the words of scene files from the tables of the parser's source.
import pathlib
import re

SCENE = pathlib.Path(__file__).resolve().parents[2] / "host/scene"


def usages():
    """Returns the usage text of every statement by its keyword."""
    rows = re.findall(r'^    \{"(\w+)",((?:\s*"[^"]*")+),', (SCENE / "scn.c").read_text(), re.MULTILINE)
    return {keyword: "".join(re.findall(r'"([^"]*)"', usage)) for keyword, usage in rows}


def properties():
    """Returns the properties of materials."""
    table = re.search(r"properties\[\] = \{(.*?)\};", (SCENE / "material_text.c").read_text(), re.DOTALL)[1]
    return re.findall(r'"(\w+)"', table)


def value_words():
    """Returns the other words of scene files: fixed words of the usages, and properties."""
    usage = " ".join(text.split(" ", 1)[1] for text in usages().values())
    return {*re.findall(r"(?<![\w-])-?[a-z_]+\b", usage), *properties()}
