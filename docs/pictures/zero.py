#!/usr/bin/env python3
"""Draws zero_axes.svg, zero_voltages.svg and zero_hold.svg of docs/tutorials/zero.md beside this file."""

import math
import pathlib

STYLE = """svg{font:13px system-ui,'Helvetica Neue',Arial,sans-serif;background:#fff}text{fill:#1c1f23}.q{fill:#5a6068}.m{text-anchor:middle}
.e{text-anchor:end}.b{font-weight:600}path,polyline,circle,rect{fill:none;stroke:#8b9099}.grid{stroke:#e4e6ea}.a{stroke:#0072b2;stroke-width:2}
.c2{stroke:#b87a00;stroke-width:1.6}.c3{stroke:#009e73;stroke-width:1.6}.l{stroke:#767c86;stroke-dasharray:5 4;stroke-width:1.6}.z{stroke:#c04a00;stroke-width:1.8}
.n{fill:#c04a00;stroke:none}.s{fill:#c3c7cd;stroke:none}.d{stroke:#c04a00;stroke-width:2.4}.t{fill:#c04a00;font-weight:600}.f{fill:#eceef1;stroke:#8b9099}.p{fill:#f2b795;stroke:none}.k{stroke:#1c1f23;stroke-width:2}"""


def picture(name, title, width, height, parts):
    body = "\n".join(parts)
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" aria-label="{title}">\n'
            f"<title>{title}</title>\n<style>{STYLE}</style>\n{body}\n</svg>\n")
    (pathlib.Path(__file__).parent / name).write_text(text, encoding="utf-8")


def label(x, y, text, style=""):
    return f'<text class="{style}" x="{x:.1f}" y="{y:.1f}">{text}</text>'


def line(x1, y1, x2, y2, style):
    return f'<path class="{style}" d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}"/>'


def arrow(x1, y1, x2, y2, style):
    angle, parts = math.atan2(y2 - y1, x2 - x1), [line(x1, y1, x2, y2, style)]
    for side in (2.7, -2.7):
        parts.append(line(x2, y2, x2 + 9 * math.cos(angle + side), y2 + 9 * math.sin(angle + side), style))
    return "\n".join(parts)


def curve(box, function, style):
    left, top, right, bottom = box
    points = " ".join(f"{left + (right - left) * k / 180:.1f},{0.5 * (top + bottom) - 0.5 * (bottom - top) * function(math.radians(2 * k)):.1f}"
                      for k in range(181))
    return f'<polyline class="{style}" points="{points}"/>'


def axes(box):
    left, top, right, bottom = box
    parts = []
    for degrees in range(0, 361, 30):
        x = left + (right - left) * degrees / 360
        parts.append(line(x, top, x, bottom, "grid"))
        if degrees % 60 == 0:
            parts.append(label(x, bottom + 18, f"{degrees}°", "q m"))
    parts.append(line(left, 0.5 * (top + bottom), right, 0.5 * (top + bottom), ""))
    parts.append(label(0.5 * (left + right), bottom + 36, "electrical angle θ", "q m"))
    return parts


def machine(x, y, theta, name):
    """Phase axes at 0°, 120°, 240°; the magnets' north, the d axis, stands opposite to the axis of a at θ = 0."""
    parts = [f'<circle class="f" cx="{x}" cy="{y}" r="74"/>', f'<circle cx="{x}" cy="{y}" r="52" style="fill:#fff"/>']
    for k, phase in enumerate("abc"):
        angle = math.radians(120 * k)
        style = ("a", "c2", "c3")[k]
        parts.append(arrow(x + 78 * math.cos(angle), y - 78 * math.sin(angle), x + 100 * math.cos(angle), y - 100 * math.sin(angle), style))
        parts.append(label(x + 112 * math.cos(angle), y - 112 * math.sin(angle) + 4, phase, "b m"))
    d = math.radians(theta + 180)
    parts.append(f'<path class="p" d="M{x + 46 * math.sin(d):.1f} {y + 46 * math.cos(d):.1f}A46 46 0 0 0 {x - 46 * math.sin(d):.1f} {y - 46 * math.cos(d):.1f}z"/>')
    parts.append(f'<circle cx="{x}" cy="{y}" r="46"/>')
    parts.append(arrow(x, y, x + 40 * math.cos(d), y - 40 * math.sin(d), "k"))
    parts.append(label(x + 24 * math.cos(d + 0.5), y - 24 * math.sin(d + 0.5) + 4, "d", "b m"))
    parts.append(label(x, y + 138, name, "m"))
    return parts


def main():
    parts = []
    for k, (theta, words) in enumerate(((0, "θ = 0: d against a"), (90, "θ = 90°: e_a is largest"), (180, "θ = 180°: d on a"))):
        parts += machine(140 + 260 * k, 125, theta, words)
    picture("zero_axes.svg", "Rotor and phase axes at three electrical angles", 800, 280, parts)

    box = (50, 40, 770, 240)
    parts = axes(box)
    parts += [curve(box, lambda t, k=k: 0.52 * math.sin(t - k * 2 * math.pi / 3), style) for k, style in enumerate(("a", "c2", "c3"))]
    parts.append(curve(box, lambda t: 0.9 * math.sin(t + math.pi / 6), "l"))
    for degrees, words, at, style in ((0, "e_a rises: θ = 0", 8, "t"), (330, "v_ab rises: θ = −30°", -6, "t e")):
        x = 50 + 720 * degrees / 360
        parts += [line(x, 40, x, 240, "z"), label(x + at, 232 if degrees == 0 else 56, words, style)]
    for k, (words, style) in enumerate((("e_a", "a"), ("e_b", "c2"), ("e_c", "c3"), ("v_ab, between two terminals", "l"))):
        x = 50 + (0, 80, 160, 240)[k]
        parts += [line(x, 20, x + 22, 20, style), label(x + 28, 24, words)]
    picture("zero_voltages.svg", "Open-circuit voltages over the electrical angle", 800, 290, parts)

    parts = axes(box)
    parts.append(curve(box, lambda t: 0.85 * math.sin(t), "a"))
    parts.append(curve(box, lambda t: 0.85 * math.sin(t + math.pi / 6), "l"))
    parts.append(curve(box, lambda t: 0.12 * math.sin(6 * t + 0.8), "c2"))
    for degrees, words in ((180, "a to b and c: 180°"), (150, "a to b: 150°")):
        x = 50 + 720 * degrees / 360
        parts += [f'<circle class="n" cx="{x}" cy="140" r="5"/>', label(x + (8 if degrees == 180 else -8), 128 if degrees == 180 else 162, words, "t" if degrees == 180 else "t e")]
    for k, (words, style) in enumerate((("current from a to b and c", "a"), ("from a to b", "l"), ("cogging pulls it off", "c2"))):
        x = 50 + (0, 215, 330)[k]
        parts += [line(x, 20, x + 22, 20, style), label(x + 28, 24, words)]
    picture("zero_hold.svg", "Torque of a direct current over the electrical angle, and where the rotor comes to rest", 800, 290, parts)


if __name__ == "__main__":
    main()
