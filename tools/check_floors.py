#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Reads every #include and reports violations of the layers. A layer ("floor") is a folder of host/.
# A file may include headers of its own folder and of lower layers, but not in a cycle. In cycles,
# NAME.c and NAME.h count as one unit, so two units must not include each other through their .c
# files. A kernel file may include only files that precede it in the list in CMakeLists.txt. NAME.h
# declares only functions of NAME.c.
import argparse
import pathlib
import re
import sys

# The layers that each layer may include besides itself. image is beside scene, not above it.
BELOW = {
    "base": [],
    "image": ["base"],
    "compare": ["base", "image"],
    "mesh": ["base"],
    "scene": ["base", "mesh"],
    "foreign": ["base", "image", "mesh"],
    "accel": ["base", "mesh", "scene"],
    "device": ["base", "mesh", "scene", "accel"],
    "render": ["base", "mesh", "scene", "accel", "device", "image"],
}
TRACING = [*BELOW["render"], "render"]
BELOW |= {
    "refine": TRACING,
    "session": [*TRACING, "refine"],
}

# The clients of the session. None of them includes accel, device, render or refine.
CLIENT = ["base", "image", "mesh", "scene", "session"]
BELOW |= {
    "check": CLIENT,
    "explain": CLIENT,
    "library": [*CLIENT, "check"],
    "view": [*CLIENT, "explain"],
    "cli/options": [*CLIENT, "compare"],
    "jobs": CLIENT,
    "cli": [*CLIENT, "check", "compare", "explain", "jobs", "view", "cli/options"],
}

# The core runs under sanitizers and fuzzers, so it includes no driver and no other large library.
CORE = ["base", "mesh", "scene", "accel"]
FOREIGN = re.compile(r"(CL|OpenCL|GL|GLFW|epoxy|OpenImageIO|assimp)/|(dlfcn|pthread|jansson|png)\.h$")

# In the core, only thread_pool.c starts threads, and only foreign.c asks the loader for the path of
# clrt's library.
EXCEPTIONS = [("base/thread_pool.c", "pthread.h"), ("base/foreign.c", "dlfcn.h")]

# Host and kernels share one header. Only one host file includes it, for all layers above.
SHARED = "../kernels/shared.h"
SHARED_BY = "scene/scene.h"

# The header of libclrt declares the requests of the session, and includes nothing of the host. The
# device chooses kernels by it, and every layer above the session may include it too.
PUBLIC = "library/clrt.h"

# A header declares only functions of the file with its name, except these headers.
SHARED_HEADERS = {
    "cli/commands.h": "one function for each command, in the file of that command",
    "cli/options/option.h": "the table of options, and the files that read and check it",
    "cli/options/options.h": "the result of the whole folder",
    "library/clrt.h": "the public header",
    "library/handles.h": "the data behind clrt.h",
    "refine/ladder_state.h": "the ladder's data, which its files share",
    "refine/thin_places.h": "the data of thin parts, which its files share",
    "session/session.h": "the session, whose scene has a file of its own",
    "view/viewer_inside.h": "the viewer's data, which its files share",
    "view/worker_inside.h": "the worker's data, which its files share",
}

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(["<])([^">]+)[">]', re.MULTILINE)


def read_includes(file):
    """Yields the line number, '"' or '<', and the path of each #include."""
    text = file.read_text()
    for match in INCLUDE.finditer(text):
        yield text.count("\n", 0, match.start()) + 1, match[1], match[2]


def floor_of(name):
    """Returns the layer of a file. cli/options is a layer of its own; all other subfolders belong
    to their parent's layer."""
    return "cli/options" if name.startswith("cli/options/") else name.split("/")[0]


def judge_own(name, target):
    """Returns the fault of a host file's include of another host file, or None."""
    floor, other = floor_of(name), floor_of(target)
    if not target.endswith(".h"):
        return f"{target} is not a header"
    if target == PUBLIC and (floor in ("device", "session") or "session" in BELOW[floor]):
        return None
    if other != floor and other not in BELOW[floor]:
        return f"{other} is not below {floor}"
    return None


def judge_outside(name, quote, target):
    """Returns the fault of a host file's include of any other file, or None."""
    if quote == '"':
        if target != SHARED:
            return f"{target} is not a header of host/"
        return None if name == SHARED_BY else f"only {SHARED_BY} includes {SHARED}"
    if (name, target) in EXCEPTIONS:
        return None
    if floor_of(name) in CORE and FOREIGN.match(target):
        return f"the core must not include <{target}>"
    return None


def find_cycle(graph):
    """Returns a cycle of includes as a list of names, or None."""
    finished = set()

    def visit(name, path):
        if name in path:
            return path[path.index(name) :] + [name]
        if name in finished:
            return None
        for target in graph.get(name, []):
            cycle = visit(target, path + [name])
            if cycle:
                return cycle
        finished.add(name)
        return None

    return next(filter(None, (visit(name, []) for name in graph)), None)


def unit_graph(graph):
    """Joins NAME.c and NAME.h, the units of the host. A header without a .c file of its name
    declares what other units define, so its own includes count for the files that include it."""
    units = {}
    sources = {name.rpartition(".")[0] for name in graph if not name.endswith(".h")}

    def targets(name):
        for target in graph[name]:
            unit = target.rpartition(".")[0]
            yield from [unit] if unit in sources else targets(target)

    for name in graph:
        unit = name.rpartition(".")[0]
        if unit in sources:
            units.setdefault(unit, set()).update(target for target in targets(name) if target != unit)
    return {unit: sorted(units[unit]) for unit in sorted(units)}


def check_host(host):
    files = {
        file.relative_to(host).as_posix(): file
        for file in sorted(host.rglob("*"))
        if file.suffix in (".c", ".h", ".cpp")
    }
    if not files:
        yield f"{host}: no source files"
    graph = {name: [] for name in files}
    for name, file in files.items():
        if floor_of(name) not in BELOW:
            yield f"host/{name}: tools/check_floors.py lists no layer for this folder"
            continue
        for line, quote, target in read_includes(file):
            own = target in files
            problem = judge_own(name, target) if own else judge_outside(name, quote, target)
            if problem:
                yield f"host/{name}:{line}: {problem}"
            elif own:
                graph[name].append(target)
    cycle = find_cycle(graph) or find_cycle(unit_graph(graph))
    if cycle:
        yield "host: a cycle of includes: " + " -> ".join(cycle)


def check_headers(host):
    """Yields functions that are declared in a header of another file."""
    comment = re.compile(r"//.*")
    declared = re.compile(r"\b(\w+)\([^;{}]*\)\s*;")
    defined = re.compile(r"^(?!static|typedef|#)\w[\w *]*?\b(\w+)\([^;{}]*\)\n\{", re.MULTILINE)
    homes = {}
    for file in sorted(host.rglob("*.c")):
        for match in defined.finditer(comment.sub("", file.read_text())):
            homes.setdefault(match[1], file)
    for header in sorted(host.rglob("*.h")):
        name = header.relative_to(host).as_posix()
        text = comment.sub("", header.read_text())
        text = re.sub(r"static inline [^{;]*\{.*?\n\}", "", text, flags=re.DOTALL)
        for match in declared.finditer(text):
            home = homes.get(match[1])
            if home and home != header.with_suffix(".c") and name not in SHARED_HEADERS:
                yield f"host/{name}: {match[1]} belongs into the header of {home.name}"


def check_kernels(root):
    match = re.search(r"set\(kernels\s+([^)]*)\)", (root / "CMakeLists.txt").read_text())
    order = match[1].split() if match else []
    present = sorted(file.name for file in (root / "kernels").iterdir())
    if sorted(order) != present:
        yield f"CMakeLists.txt lists the kernels {order}, but kernels/ holds {present}"
        return
    for place, name in enumerate(order):
        for line, quote, target in read_includes(root / "kernels" / name):
            if quote == '"' and target not in order[:place]:
                yield f"kernels/{name}:{line}: {target} does not precede {name} in CMakeLists.txt"


def main():
    parser = argparse.ArgumentParser(description="Fails if an #include violates the layers.")
    own_root = pathlib.Path(__file__).resolve().parent.parent
    parser.add_argument("--root", type=pathlib.Path, default=own_root, help="the checkout to read")
    root = parser.parse_args().root
    problems = [*check_host(root / "host"), *check_headers(root / "host"), *check_kernels(root)]
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
