"""The numbers of files of results beside those that are kept.

    kept.py FOLDER KEPT            compares, names each file and column that differs, ends with 1 if there is one
    kept.py FOLDER KEPT --renew    writes KEPT anew: after a change of results that was meant

KEPT has a line for each column of a CSV, each kind of numbers of a JSON and each kind of shape of a picture: how many numbers,
their sum and two weighted sums, which are compared to 1e-6 of the sum of their sizes (pictures: 1e-4, they are rounded), and
the words of a picture or header without their numbers as a CRC. Words of summaries and reports are not compared.
"""
import csv
import json
import math
import pathlib
import re
import sys
import zipfile
import zlib

NUMBER = re.compile(r"(?<![\w#.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
LEFT_OUT = re.compile(r"checksum|crc|digest|version|seconds|time_limit|work|worst_order")  # the last: of two that are as bad either


def is_number(text):
    return bool(NUMBER.fullmatch(text.strip()))


def sums(numbers):
    """Weights of both signs, so that what is exchanged is seen too."""
    weights = [math.cos(1.0 + 2.399963 * k) for k in range(len(numbers))]
    return [len(numbers), sum(numbers), sum(w * x for w, x in zip(weights, numbers)), sum(w * x * x for w, x in zip(weights, numbers)),
            sum(map(abs, numbers)), sum(x * x for x in numbers)]


def is_nothing(row, k, rows):
    """A phase of an amplitude, which stands before it, that is rounding alone."""
    sizes = [abs(float(r[k - 1])) for r in rows[1:] if k < len(r) and is_number(r[k - 1])]
    return k > 0 and is_number(row[k - 1]) and abs(float(row[k - 1])) < 1e-6 * max(sizes)


def of_table(path):
    with open(path, newline="") as file:
        rows = [row for row in csv.reader(line for line in file if not line.startswith("#")) if row]
    for k, name in enumerate(rows[0]):
        cells = [row[k] for row in rows[1:] if k < len(row) and not ("phase_rad" in name and is_nothing(row, k, rows))]
        yield name, sums([float(c) for c in cells if is_number(c)]), sum(not is_number(c) and c != "" for c in cells)


def numbers_of(value, name=""):
    if isinstance(value, dict):
        for key, inner in value.items():
            if not LEFT_OUT.search(key):
                yield from numbers_of(inner, f"{name}.{key}")
    elif isinstance(value, list):
        for inner in value:
            yield from numbers_of(inner, name)
    elif isinstance(value, (int, float)):
        yield name, float(value)


def of_json(path):
    found = {}
    for name, number in numbers_of(json.loads(path.read_text())):
        found.setdefault(name, []).append(number)
    for name, numbers in found.items():
        yield name[1:], sums(numbers), 0


def of_picture(path):
    """Each kind of element of its own, and the words."""
    found, words = {}, []
    for tag, inside in re.findall(r"<(\w+)([^<]*)", re.sub(r"hci-solve [\d.]+|</?sub>", "", path.read_text())):
        found.setdefault(tag, []).extend(float(x) for x in NUMBER.findall(inside))
        words.append(tag + NUMBER.sub("0", inside))
    for tag, numbers in found.items():
        yield tag, sums(numbers), 0
    if path.suffix == ".svg":
        yield "words", sums([]), zlib.crc32("\n".join(words).encode())


def of_text(name, text):
    return name, sums([float(x) for x in NUMBER.findall(text)]), zlib.crc32(NUMBER.sub("0", text).encode())


def of_source(path):
    """The code, and the words around it without what changes with each version."""
    whole = re.sub(r"0x[0-9a-fA-F]+", "", path.read_text())
    comment = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
    yield of_text("numbers", comment.sub("", whole))
    yield of_text("comments", re.sub(r"\b[0-9a-f]{8,}\b|hci-solve [\d.]+", "", "\n".join(comment.findall(whole))))


def of_bytes(path):
    """What begins it, and its size: floats differ in their last bit, and with them the checksum."""
    yield "bytes", sums([float(x) for x in path.read_bytes()[:8]] + [float(path.stat().st_size)]), 0


def of_archive(path):
    """What an FMU says of its machine; its identifier is a digest of that."""
    archive = zipfile.ZipFile(path)
    for name in ("modelDescription.xml", "sources/hci_data.c"):
        text = re.sub(r"\{[-0-9a-fA-F]+\}|hci-solve [\d.]+|generationDateAndTime=\S+", "", archive.read(name).decode())
        yield name, sums([float(x) for x in NUMBER.findall(text)]), zlib.crc32(NUMBER.sub("0", text).encode())


READERS = {".fmu": of_archive, ".csv": of_table, ".json": of_json, ".svg": of_picture, ".html": of_picture, ".h": of_source, ".c": of_source, ".ini": of_source, ".yaml": of_source, ".cfg": of_source, ".bin": of_bytes, ".txt": of_source}


def lines_of(folder):
    for path in sorted(p for p in folder.rglob("*") if p.suffix in READERS and p.is_file()):
        for name, numbers, words in READERS[path.suffix](path):
            if path.name.endswith(".fmu.said.json") and name == "bytes":
                continue  # of a package that has the sources of the core in it
            yield f"{path.relative_to(folder)} {name.replace(' ', '_') or '-'}", numbers, words


def is_near(now, kept, share):
    scales = [0.0, kept[4], kept[4], kept[5], kept[4], kept[5]]
    return all(abs(a - b) <= share * scale + 1e-9 for a, b, scale in zip(now, kept, scales))


def main(folder, kept, *renew):
    now = {name: (numbers, words) for name, numbers, words in lines_of(pathlib.Path(folder))}
    if renew:
        pathlib.Path(kept).write_text("".join(f"{name} {words} {' '.join(f'{x:.9g}' for x in numbers)}\n" for name, (numbers, words) in now.items()))
        return 0
    before = {}
    for line in pathlib.Path(kept).read_text().splitlines():
        file, name, words, *numbers = line.split()
        before[f"{file} {name}"] = [float(x) for x in numbers], int(words)
    wrong = [name for name in before if name not in now or now[name][1] != before[name][1]
             or not is_near(now[name][0], before[name][0], 1e-4 if ".svg" in name or ".html" in name else 1e-6)]
    wrong += [f"{name} (new)" for name in now if name not in before]
    print("".join(f"{name}\n    now  {now.get(name)}\n    kept {before.get(name)}\n" for name in wrong[:20]), end="")
    print(f"{len(before)} kept, {len(wrong)} differ")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
