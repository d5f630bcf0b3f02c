"""Reads report.html as a reader does, and says what is wrong with it; exit code 1 where something is.
  report_pages.py FOLDER...
Each FOLDER has report.html and summary.json. At most five figures; each stands under a sentence and over a caption; every
mark tells its value under the pointer, and has an entry in the legend; no sentence stands twice; before and after in large
figures are those of summary.json; pictures over an angle have it at the same place."""

import html.parser
import json
import math
import pathlib
import re
import sys

VOID = {"meta", "polyline", "rect", "circle", "path", "br"}
DATA = {"polyline", "rect", "circle"}
GROUND = {"grid", "axis", "rail", "band", "haze", "back", "hit"}
MOST_FIGURES, SENTENCE_WORDS, SAME_WORDS = 5, 4, 6


class Node:
    def __init__(self, tag, attributes, parent):
        self.tag, self.attributes, self.parent = tag, dict(attributes), parent
        self.children = []

    def style(self):
        return self.attributes.get("class", "")

    def text(self, without=()):
        return "".join(c if isinstance(c, str) else "" if c.tag in without else c.text(without) for c in self.children)

    def all(self, *tags):
        for c in self.children:
            if isinstance(c, Node):
                if c.tag in tags:
                    yield c
                yield from c.all(*tags)


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.root = self.at = Node("", [], None)
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        node = Node(tag, attributes, self.at)
        self.at.children.append(node)
        if tag not in VOID:
            self.at = node

    def handle_startendtag(self, tag, attributes):
        self.at.children.append(Node(tag, attributes, self.at))

    def handle_endtag(self, tag):
        if tag not in VOID:
            self.at = self.at.parent

    def handle_data(self, data):
        self.at.children.append(data)


def words(text):
    """Those of letters: a formula has none."""
    return len(re.findall(r"\b[^\W\d_]{2,}\b", text))


def figures_are_few(page):
    figures = list(page.all("figure"))
    if len(figures) > MOST_FIGURES:
        yield f"{len(figures)} figures"
    for figure in figures:
        headings = [h.text() for h in figure.parent.all("h2")]
        captions = [c.text() for c in figure.all("figcaption")]
        if len(headings) != 1 or words(headings[0]) < SENTENCE_WORDS:
            yield f"a figure under {headings}: no sentence"
        if len(captions) != 1 or words(captions[0]) < SENTENCE_WORDS:
            yield f"a figure over {captions}: no caption"


def above(node):
    while node.parent:
        node = node.parent
        yield node


def is_told(mark):
    """Stands in a group that has a title."""
    while mark.parent and mark.parent.tag == "g":
        mark = mark.parent
        if any(isinstance(c, Node) and c.tag == "title" and c.text().strip() for c in mark.children):
            return True
    return False


def legend_of(svg):
    """The marks beside each text of the legend: it stands behind its text where the legend ends at the right."""
    nodes = list(svg.all("path", "rect", "circle", "polyline", "text"))
    for one, other in zip(nodes, nodes[1:]):
        for text, mark in ((one, other), (other, one)):
            if text.tag == "text" and text.style() == "legend" and mark.tag != "text":
                yield mark


def pictures_tell(page):
    for svg in page.all("svg"):
        name = svg.attributes.get("aria-labelledby")
        legend = list(legend_of(svg))
        styles = {m.style() for m in legend}
        marks = [m for m in svg.all(*DATA) if m.style() not in GROUND and not any(m is k for k in legend)]
        strips = [m for m in svg.all("rect") if m.style() == "hit"]
        if not marks:
            yield f"{name}: nothing is drawn"
        for m in strips if strips else marks:
            if not is_told(m):
                yield f"{name}: <{m.tag} {m.style()}> tells nothing"
        for style in {m.style() for m in marks} - styles if len({m.style() for m in marks}) > 1 else ():
            yield f"{name}: {style} is not in the legend"


def nothing_stands_twice(page):
    """Of what is not folded away; a path is no word of a sentence."""
    seen = set()
    for node in page.all("h1", "h2", "p", "li", "figcaption"):
        if any(a.tag == "details" for a in above(node)):
            continue
        for sentence in re.split(r"(?<=[.;:]) ", re.sub(r"\S*/\S*", "", node.text())):
            sentence = " ".join(sentence.split()).rstrip(".;:").lower()
            if words(sentence) >= SAME_WORDS and sentence in seen:
                yield f"twice: {sentence}"
            seen.add(sentence)


def numbers(text):
    return [float(n.replace("\u2212", "-")) for n in re.findall(r"\u2212?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text)]


def compared(page):
    """The large figures: name of the row, and what stands in its cells."""
    for table in page.all("table"):
        if table.style() == "compare":
            for row in list(table.all("tr"))[1:]:
                yield next(row.all("th")).text(), [d.text(("small",)) for d in row.all("td")]


def figures_of(summary):
    """(row, cell, value) of a summary, of `tune` and of `solve`."""
    if summary.get("command") == "tune" and "after" in summary:
        before, after, expected = summary["before"], summary["after"], summary["expected"]
        table = after["table_peak_to_peak_Nm"]
        yield "Torque ripple", 0, before["peak_to_peak_Nm"]
        yield "Torque ripple", 1, after["peak_to_peak_Nm"] if table is None else table
        yield "Torque ripple", 2, expected["peak_to_peak_Nm_95"] if expected["known"] else None
        yield "Mean torque", 1, after["mean_Nm"]
        yield "Peak phase current", 0, before["peak_phase_A"]
        yield "Peak phase current", 1, after["peak_phase_A"]
        yield "Copper loss", 1, after["loss_ratio_to_plain"]


def figures_agree(page, summary):
    rows = list(compared(page))
    for name, cell, value in figures_of(summary):
        found = [numbers(cells[cell]) for row, cells in rows if row.startswith(name)]
        if value is None:
            if found and found[0]:
                yield f"{name}, column {cell + 1}: {found}, and it is not known"
            continue
        if not found or len(found[0]) != 1:
            yield f"{name}, column {cell + 1}: {found} for {value}"
        elif cell == 2:  # a bound: two digits, rounded up
            if not value <= found[0][0] * (1 + 1e-9) <= 1.1 * value:
                yield f"{name}: at most {found[0][0]}, and it is {value}"
        elif abs(found[0][0] - value) > 6e-4 * abs(value) and not math.isclose(found[0][0], value, abs_tol=1e-9):
            yield f"{name}, column {cell + 1}: {found[0][0]}, and it is {value}"


def angle_of(svg):
    """Where the upright lines of the grid stand; nothing where the picture has another axis."""
    if not any(t.text().startswith("electrical angle") for t in svg.all("text")):
        return None
    lines = [re.fullmatch(r"M([-\d.]+) ([-\d.]+)L([-\d.]+) ([-\d.]+)", p.attributes["d"]) for p in svg.all("path")
             if p.style() in ("grid", "axis")]
    return tuple(sorted(float(m[1]) for m in lines if m and m[1] == m[3]))


def angles_are_aligned(page):
    places = {}
    for svg in page.all("svg"):
        width, at = svg.attributes["viewbox"].split()[2], angle_of(svg)
        if at is not None and places.setdefault(width, at) != at:
            yield f"{svg.attributes.get('aria-labelledby')}: its angle is at {at}, that of others at {places[width]}"


def main(*folders):
    wrong = 0
    for folder in map(pathlib.Path, folders):
        page = Page((folder / "report.html").read_text()).root
        summary = json.loads((folder / "summary.json").read_text())
        checks = [figures_are_few(page), pictures_tell(page), nothing_stands_twice(page), figures_agree(page, summary),
                  angles_are_aligned(page)]
        if summary.get("command") == "tune" and "after" in summary:
            first = next(page.all("svg")).attributes.get("aria-labelledby")
            if first != "torque-title":
                checks.append([f"the first picture is {first}"])
        for text in (text for check in checks for text in check):
            print(f"{folder.name}: {text}")
            wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
