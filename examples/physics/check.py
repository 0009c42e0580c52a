#!/usr/bin/env python3
"""Plays the demo projects without a window and compares what comes out with their expect.json.

    examples/physics/check.py JET [DEMO...]
"""
import fnmatch
import json
import math
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def within(value, limits):
    return limits[0] <= value <= limits[1]


class Outcome:
    def __init__(self, state):
        self.items = {item["name"]: item for item in state["items"]}
        self.output = state["output"]

    def fault(self, wanted):
        """What is not as wanted; none: all is."""
        if "output" in wanted:
            return None if wanted["output"] in self.output else f"'{wanted['output']}' was not printed"
        if "said" in wanted:
            return None if any(wanted["said"] in said for said in self.output) else f"'{wanted['said']}' is in nothing printed"
        if "count" in wanted:
            x0, y0, x1, y1 = wanted["inside"]
            inside = [item for name, item in self.items.items() if fnmatch.fnmatch(name, wanted["count"])
                      and within(item["position"][0], (x0, x1)) and within(item["position"][1], (y0, y1))]
            return None if len(inside) == wanted["is"] else f"{len(inside)} of {wanted['is']} '{wanted['count']}' are inside"
        item = self.items[wanted["item"]]
        x, y = item["position"]
        x0, y0, x1, y1 = item["bounds"]
        values = {"x": x, "y": y, "angle": item["angle"], "omega": item["omega"], "width": x1 - x0, "height": y1 - y0}
        for key, value in values.items():
            if key in wanted and not within(value, wanted[key]):
                return f"'{wanted['item']}': {key} is {value:.3f}, not within {wanted[key]}"
        if "awake" in wanted and item["awake"] != wanted["awake"]:
            return f"'{wanted['item']}' is {'awake' if item['awake'] else 'asleep'}"
        if "distance" in wanted:
            far = math.dist((x, y), wanted["distance"])
            if not within(far, wanted["from"]):
                return f"'{wanted['item']}' is {far:.2f} from {wanted['distance']}, not {wanted['from']}"
        for key, difference in (("above", lambda other: other["position"][1] - y),
                                ("taller", lambda other: (y1 - y0) - (other["bounds"][3] - other["bounds"][1]))):
            if key in wanted and difference(self.items[wanted[key]]) < wanted["by"]:
                return (f"'{wanted['item']}' is {difference(self.items[wanted[key]]):.2f} {key} '{wanted[key]}', "
                        f"not {wanted['by']}")
        return None


def play(jet, folder, engine, steps, keys):
    pressed = ["--input", folder / keys] if keys else []
    run = subprocess.run([jet, "--json", "play", folder, "--steps", str(steps), "--physics", engine, *pressed],
                         capture_output=True, text=True)
    if run.returncode != 0 or run.stderr:
        return None, run.stderr.strip() or f"exit code {run.returncode}"
    return json.loads(run.stdout), None


def main():
    jet, names = sys.argv[1], sys.argv[2:]
    faults = 0
    for expect in sorted(HERE.glob("*/expect.json")):
        folder = expect.parent
        if names and folder.name not in names:
            continue
        wanted = json.loads(expect.read_text())
        for engine in wanted["engines"]:
            state, problem = play(jet, folder, engine, wanted["steps"], wanted.get("input"))
            found = [problem] if problem else [f for f in map(Outcome(state).fault, wanted["expect"]) if f]
            print(f"{folder.name} on {engine}: {'; '.join(found) or 'as expected'}")
            faults += len(found)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
