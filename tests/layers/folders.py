#!/usr/bin/env python3
"""The order of the folders: tests/layers/order, from includes and from object files.

    folders.py SOURCE_DIR [OBJECT_DIR...]

Each offence is one line `RULE: ...` on standard output, and the exit code is 1 if there is any:

    order-include   a file includes one of a folder that comes after its own
    order-symbol    an object takes a symbol from a folder that comes after its own
    circle-include  files that include each other in a circle; a .c and a private .h of its name are one, while a public
                    header stands for itself, since what is behind it may be several files that share its types
    circle-symbol   objects that need each other in a circle
    folder-size     more than MOST_FILES .c files in one folder
    folder-unknown  a folder of the sources that the order does not name, or the other way round
    folder-unnamed  DESIGN.md does not name the folder
    table-include   hci/table.h includes something of the project, or hci/loop.h more than that: they are given away
                    together with emitted tables
    empty           nothing to judge

OBJECT_DIR is a folder below which CMake put objects, such as build/dev/src/core; NM names the tool.
"""

import os
import re
import subprocess
import sys

MOST_FILES = 20
MOST_FILES_OF_A_LIST = 32  # where one file is one entry of a list, and none knows another
LISTS = {"core/effects"}
FREE = {"hci/status.h", "hci/version.h", "hci/table.h", "hci/loop.h"}  # at the root of include/hci: for everybody

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]([^">]+)[">]', re.MULTILINE)
OBJECT = re.compile(r"(?:^|/)(core|host|cli)/CMakeFiles/[^/]+\.dir/(.*\.c)\.o(?:bj)?$")


def read_order(path):
    """The folders in their order."""
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if line.strip() and not line.startswith("#")]
    return [line.split(":")[0].strip() for line in lines]


def folder_of(path):
    """Folder of a file as the order names it, from its path below SOURCE_DIR."""
    folder, _ = os.path.split(path)
    for prefix, name in (("src/", ""), ("include/hci/host", "host"), ("include/hci", "core")):
        if folder.startswith(prefix):
            return name + folder[len(prefix):]
    return folder


def sources(root):
    """Paths below root of all .c and .h of the project, sorted."""
    found = []
    for top in ("src", "include", "cli"):
        for folder, _, files in os.walk(os.path.join(root, top)):
            found += [os.path.relpath(os.path.join(folder, f), root) for f in files if f.endswith((".c", ".h"))]
    return sorted(found)


def includes(root, files):
    """{file: [files of the project that it includes]}"""
    known = set(files)
    result = {}
    for path in files:
        with open(os.path.join(root, path), encoding="utf-8") as file:
            names = INCLUDE.findall(file.read())
        candidates = ([os.path.normpath(os.path.join(base, name)) for base in (os.path.dirname(path), "src", "include", "")]
                      for name in names)
        result[path] = [next(c for c in tried if c in known) for tried in candidates if known.intersection(tried)]
    return result


def circles(graph):
    """Groups of two or more nodes that reach each other, each sorted (Tarjan)."""
    number, lowest, stack, found = {}, {}, [], []

    def visit(node):
        number[node] = lowest[node] = len(number)
        stack.append(node)
        for other in sorted(graph.get(node, ())):
            if other not in number:
                visit(other)
                lowest[node] = min(lowest[node], lowest[other])
            elif other in stack:
                lowest[node] = min(lowest[node], number[other])
        if lowest[node] == number[node]:
            group = [stack.pop()]
            while group[-1] != node:
                group.append(stack.pop())
            if len(group) > 1:
                found.append(sorted(group))

    sys.setrecursionlimit(10000)
    for node in sorted(graph):
        if node not in number:
            visit(node)
    return sorted(found)


def say_circles(rule, graph):
    """One line for each circle, with the arrows in it."""
    for group in circles(graph):
        arrows = [f"{a} -> {b}" + (f" ({graph[a][b]})" if graph[a][b] else "")
                  for a in group for b in sorted(graph[a]) if b in group]
        yield f"{rule}: " + ", ".join(arrows)


def against(order, user, used):
    """True when folder `used` comes after folder `user`."""
    return user in order and used in order and order.index(used) > order.index(user)


def module(path):
    """What counts as one file in a circle."""
    return path if path.startswith("include/") else os.path.splitext(path)[0]


def check_includes(order, included):
    modules = {}
    for path, others in included.items():
        for other in others:
            if path == "include/hci/table.h" or (path == "include/hci/loop.h" and other != "include/hci/table.h"):
                yield f"table-include: {path} includes {other}"
            if other.removeprefix("include/") in FREE:
                continue
            if against(order, folder_of(path), folder_of(other)):
                yield f"order-include: {path} includes {other}"
            if module(path) != module(other):
                modules.setdefault(module(path), {})[module(other)] = None
    yield from say_circles("circle-include", modules)


def check_folders(root, order, files):
    found = {}
    for path in files:
        if path.removeprefix("include/") not in FREE:
            found.setdefault(folder_of(path), []).append(path)
    for folder in sorted(set(found) - set(order)):
        yield f"folder-unknown: tests/layers/order does not name {folder}"
    for folder in order:
        if folder not in found:
            yield f"folder-unknown: there is no {folder}, which tests/layers/order names"
    for folder, paths in sorted(found.items()):
        count = sum(path.endswith(".c") for path in paths)
        most = MOST_FILES_OF_A_LIST if folder in LISTS else MOST_FILES
        if count > most:
            yield f"folder-size: {folder} has {count} .c files, at most {most}"
    with open(os.path.join(root, "DESIGN.md"), encoding="utf-8") as file:
        named = set(re.findall(r"`([^`\n]+)`", file.read()))
    for folder in order:
        if not {folder, folder + "/", "src/" + folder, "src/" + folder + "/"} & named:
            yield f"folder-unnamed: DESIGN.md does not name `{folder}`"


def symbols(root, folders):
    """({object: symbols it takes}, {symbol: object that has it}); objects of sources that are gone are left out."""
    objects = {}
    for top in folders:
        for folder, _, files in os.walk(os.path.abspath(top)):
            for name in files:
                match = OBJECT.search(os.path.join(folder, name))
                source = match and "/".join(match.groups())
                if match and any(os.path.exists(os.path.join(root, base, source)) for base in ("src", "")):
                    objects[os.path.join(folder, name)] = source[:-2]
    if not objects:
        return {}, {}
    listing = subprocess.run([os.environ.get("NM", "nm"), "-A", "-P", *sorted(objects)],
                             check=True, capture_output=True, text=True).stdout
    takes, has = {}, {}
    for line in listing.splitlines():
        path, symbol, kind = re.match(r"(.*\.o(?:bj)?): (\S+) (\S)", line).groups()
        if kind in "Uwv":
            takes.setdefault(objects[path], set()).add(symbol)
        elif kind.isupper():
            has[symbol] = objects[path]
    return takes, has


def check_symbols(order, takes, has):
    graph = {}
    for user, names in sorted(takes.items()):
        for name in sorted(names):
            owner = has.get(name, user)
            if owner == user:
                continue
            graph.setdefault(user, {}).setdefault(owner, name)
            if against(order, os.path.dirname(user), os.path.dirname(owner)):
                yield f"order-symbol: {user} takes {name} from {owner}"
    yield from say_circles("circle-symbol", graph)


def offences(root, object_folders):
    order = read_order(os.path.join(root, "tests/layers/order"))
    files = sources(root)
    if not files:
        yield f"empty: no sources in {root}"
        return
    yield from check_folders(root, order, files)
    yield from check_includes(order, includes(root, files))
    if object_folders:
        takes, has = symbols(root, object_folders)
        if not has:
            yield "empty: no objects in " + " ".join(object_folders)
        yield from check_symbols(order, takes, has)


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: folders.py SOURCE_DIR [OBJECT_DIR...]")
    said = list(offences(sys.argv[1], sys.argv[2:]))
    print("\n".join(said), end="\n" if said else "")
    sys.exit(1 if said else 0)


if __name__ == "__main__":
    main()
