"""The table of docs/physics-conformance.md: written from runs of both engines, or compared with them.

document.py write|check FOLDER PAGE: FOLDER holds jet-physics.json and physics-box2d.json, as jet-physics-conformance
--json writes them. "check" compares all but the numbers that were measured: those may be others elsewhere.
"""
import json
import re
import sys

HEAD = """# What the engines do, and how well

`build/release/bin/jet-physics-conformance [--physics ID] [--only TEXT] [--json FILE] [--markdown FILE]` puts any engine plugin through the checks below: each builds a scene whose outcome a formula or brute force tells, and answers how far off the engine is. Less is better; *at most* is what counts as supported. What JET's engine does eight times better and more has a bound of its own in its test (*JET at most*, `--bounds tests/physics-conformance/bounds-jet-physics.json`), some four times what it does, so that it stays so.
What an engine refuses with a sentence is *not supported*. It is exit code 1 when anything *falls short*; `--known NAME` excepts what is known, and is an error where NAME does not fall short. Both engines are put through it by the tests, which compare this table's verdicts and bounds with what they find.

An engine of your own: `jet-physics-conformance --plugin-path DIR --physics ID`.

| | check | measured in | at most | JET at most | JET | Box2D 2.4.1 |
|---|---|---|---|---|---|---|"""


def number(value):
    return f"{value:.1e}" if value != 0 and (abs(value) < 1e-3 or abs(value) >= 1e5) else f"{value:.3g}"


def cell(check):
    if check["verdict"] == "not supported":
        return "not supported"
    text = number(check["value"]) if check["unit"] else "yes"
    return text if check["verdict"] == "supported" else f"**falls short**: {text if check['unit'] else check['note']}"


def page(jet, box2d):
    lines, group = [HEAD], ""
    for a, b in zip(jet, box2d, strict=True):
        unit = a["unit"] or b["unit"]
        bound = (a if a["unit"] else b)["bound_of_all"]
        own = number(a["bound"]) if unit and a["unit"] and a["bound"] != a["bound_of_all"] else ""
        lines.append(
            f"| {'' if a['group'] == group else a['group']} | {a['name']} | {unit or 'yes or no'} "
            f"| {number(bound) if unit else ''} | {own} | {cell(a)} | {cell(b)} |"
        )
        group = a["group"]
    count = lambda checks, verdict: sum(check["verdict"] == verdict for check in checks)
    lines.append("")
    lines.append(
        f"Of {len(jet)} checks JET's engine supports {count(jet, 'supported')} ({count(jet, 'falls short')} fall short), "
        f"Box2D's {count(box2d, 'supported')} ({count(box2d, 'falls short')} fall short). "
        "Steps of 1/60 s, default settings; worlds are made of circles, boxes and drawn outlines of 1 to 100 units. "
        "`tests/physics-conformance/update-docs` writes this page."
    )
    return "\n".join(lines) + "\n"


def without_measurements(line):
    """Of a row: both engines' cells as verdicts."""
    cells = line.split(" | ")
    if len(cells) != 7:
        return line
    verdicts = [re.sub(r"^(\*\*falls short\*\*).*|^[-+.e0-9]+$", lambda m: m[1] or "supported", c.removesuffix(" |")) for c in cells[5:]]
    return " | ".join(cells[:5] + verdicts)


def main(mode, folder, file):
    jet, box2d = (json.load(open(f"{folder}/{engine}.json", encoding="utf-8"))["checks"] for engine in ("jet-physics", "physics-box2d"))
    if mode == "write":
        open(file, "w", encoding="utf-8").write(page(jet, box2d))
        return 0
    is_now = [without_measurements(line) for line in page(jet, box2d).splitlines()]
    told = [without_measurements(line) for line in open(file, encoding="utf-8").read().splitlines()]
    differing = [(a, b) for a, b in zip(told, is_now) if a != b]
    for a, b in differing:
        print(f"{file} says\n    {a}\nand a run\n    {b}")
    if len(told) != len(is_now):
        print(f"{file} has {len(told)} lines, a run gives {len(is_now)}")
    if differing or len(told) != len(is_now):
        print("tests/physics-conformance/update-docs writes the page anew.")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
