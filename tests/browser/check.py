"""Opens pages in a headless Chromium and says what is wrong with them; exit code 1 where something is.
  check.py CHROMIUM PROFILE [--pictures FOLDER] [CHECK=]PAGE...
PROFILE: an empty folder for the browser. CHECK: the only one to be made of the page; see CHECKS. --pictures: leaves each
page there as PNG in the light, in the dark and on a telephone, and as PDF, for eyes."""

import json
import os
import pathlib
import re
import sys

sys.dont_write_bytecode = True
from chromium import Chromium  # noqa: E402

MEASURE = (pathlib.Path(__file__).parent / "measure.js").read_text()
PHONE, DESK, PAPER = (390, 844), (1280, 900), (718, 1000)  # paper: A4 less margins at 96 dots an inch
MOST_PAGES = 3


def noises(events):
    """What the console would show of it: errors and warnings."""
    for event in events:
        p = event["params"]
        if event["method"] == "Log.entryAdded" and p["entry"]["level"] in ("error", "warning"):
            yield "console: " + p["entry"]["text"]
        if event["method"] == "Runtime.consoleAPICalled" and p["type"] in ("error", "warning", "assert"):
            yield "console: " + " ".join(str(a.get("value", "")) for a in p["args"])
        if event["method"] == "Runtime.exceptionThrown":
            yield "exception: " + p["exceptionDetails"]["text"]


def requests(events, page):
    """What is fetched beside the page itself."""
    for event in events:
        if event["method"] == "Network.requestWillBeSent":
            url = event["params"]["request"]["url"]
            if url != page:
                yield "request: " + url[:120]


def net_log_requests(path):
    """Of all pages, from the browser's network log. Those of the browser itself have no origin; they find no name."""
    for event in json.loads(pathlib.Path(path).read_text())["events"]:
        p = event.get("params", {})
        if p.get("initiator", "not an origin") != "not an origin" and not p["url"].startswith(("file:", "data:")):
            yield "network log: " + p["url"][:120]


def stops(browser, expected):
    """Goes through the page by the tabulator key: everything that can be scrolled or followed is reached, and shows it."""
    ringless = set()
    for place in range(expected):
        browser.key("Tab", 9)
        found = browser.evaluate("""(() => { const e = document.activeElement, s = getComputedStyle(e);
            return [e === document.body, s.outlineStyle !== "none" && parseFloat(s.outlineWidth) >= 2, e.className,
                    e.getBoundingClientRect().top >= 0]; })()""")
        if found[0]:
            yield f"keyboard: stop {place + 1} of {expected} is not reached"
            return
        if place == 0 and (found[2] != "skip" or not found[3]):
            yield "keyboard: the first stop is not a visible link past the summary"
        if not found[1]:
            ringless.add(found[2])
    for kind in ringless:
        yield f"keyboard: no ring about the focus of {kind!r}"


def unfold(browser):
    """What is folded away is looked at too."""
    browser.evaluate("document.querySelectorAll('details').forEach((d) => { d.open = true; })")


def measured(browser, url, scheme):
    browser.screen(*DESK)
    browser.media("", scheme)
    browser.open(url)
    unfold(browser)
    return browser.evaluate(MEASURE)


def is_readable_in_the_dark(browser, url):
    found = measured(browser, url, "dark")
    yield from (f"dark: {text}" for text in found["faint"] + found["pale"])


def is_readable(browser, url):
    found = measured(browser, url, "light")
    yield from noises(browser.events)
    yield from requests(browser.events, url)
    yield from (f"light: {text}" for text in found["faint"] + found["pale"])
    yield from found["pictures"]
    yield from found["labels"]
    yield from (f"cannot be scrolled by keys, or has no name: {text}" for text in found["unreachable"])
    if found["headings"]:
        yield "headings are not in order"
    if found["count"] < 2:
        yield f"{found['count']} pictures"
    yield from stops(browser, found["stops"])


def is_narrow(browser, url):
    browser.screen(*PHONE, phone=True)
    browser.media()
    browser.open(url)
    unfold(browser)
    found = browser.evaluate(MEASURE)
    if found["width"] > PHONE[0] or found["window"] > PHONE[0]:
        yield f"wider than a telephone: {max(found['width'], found['window'])} of {PHONE[0]} pixels"
    yield from found["labels"]


def is_whole_on_paper(browser, url):
    browser.screen(*PAPER)
    browser.media("print")
    browser.open(url)
    unfold(browser)
    found = browser.evaluate(MEASURE)
    yield from (f"cut off on paper: {text}" for text in found["clipped"])
    if found["width"] > PAPER[0]:
        yield f"wider than paper: {found['width']} of {PAPER[0]} pixels"
    # What stays in one piece and does not fit any more leaves the page empty below.
    for height in browser.evaluate("[...document.querySelectorAll('body *')].filter((e) => getComputedStyle(e).breakInside === 'avoid')"
                                   ".map((e) => Math.round(e.getBoundingClientRect().height))"):
        if height > 0.4 * PAPER[1]:
            yield f"in one piece on paper: {height} of {PAPER[1]} pixels of a page"
    browser.open(url)  # folded, as it is printed
    paper = browser.pdf()
    if not paper.startswith(b"%PDF"):
        yield "cannot be printed"
    pages = len(re.findall(rb"/Type\s*/Page[^s]", paper))
    if pages > MOST_PAGES:
        yield f"{pages} pages on paper"


def needs_no_script(browser, url):
    def shown():
        browser.open(url)
        root = browser.call("DOM.getDocument")["root"]["nodeId"]
        return browser.call("DOM.getOuterHTML", nodeId=root)["outerHTML"], browser.picture(whole=False)

    browser.media()
    browser.screen(*DESK)
    with_scripts = shown()
    browser.call("Emulation.setScriptExecutionDisabled", value=True)
    if shown() != with_scripts:
        yield "different without JavaScript"
    browser.call("Emulation.setScriptExecutionDisabled", value=False)


def take_pictures(browser, url, stem):
    for name, scheme, size in (("light", "light", DESK), ("dark", "dark", DESK), ("phone", "light", PHONE)):
        browser.media("", scheme)
        browser.screen(*size, phone=size == PHONE)
        browser.open(url)
        browser.screen(size[0], browser.evaluate("document.documentElement.scrollHeight"), phone=size == PHONE)
        pathlib.Path(f"{stem}-{name}.png").write_bytes(browser.picture(whole=False))
    browser.media()
    browser.screen(*DESK)
    pathlib.Path(f"{stem}.pdf").write_bytes(browser.pdf())


CHECKS = {"light": is_readable, "dark": is_readable_in_the_dark, "phone": is_narrow, "paper": is_whole_on_paper,
          "script": needs_no_script}


def main(program, profile, *arguments):
    folder = arguments[1] if arguments[0] == "--pictures" else None
    wrong = 0
    with Chromium(program, profile) as browser:
        for argument in arguments[2:] if folder else arguments:
            only, _, page = argument.rpartition("=")
            url = pathlib.Path(page).resolve().as_uri()
            found = [text for name, check in CHECKS.items() if only in ("", name) for text in check(browser, url)]
            if folder:
                take_pictures(browser, url, os.path.join(folder, pathlib.Path(page).resolve().parent.name))
            for text in found:
                print(f"{page}: {text}")
            wrong += len(found)
    for text in sorted(set(net_log_requests(browser.net_log))):
        print(text)
        wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
