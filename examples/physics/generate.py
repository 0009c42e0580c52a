#!/usr/bin/env python3
"""Writes the demo projects of this folder, one a feature of the physics, each with what must come out (expect.json).

    examples/physics/generate.py [JET]     JET: the program, build/release/bin/jet if not given

Scenes are 640 x 360 units. `jet project save` brings each into the form in which JET writes it, and `jet play --snapshot`
makes the pictures of the README.
"""
import sys

sys.dont_write_bytecode = True

import rigid_demos  # noqa: E402
import script_demos  # noqa: E402
import soft_demos  # noqa: E402
from scene import HERE  # noqa: E402

DEMOS = {demo.__name__: demo for module in (rigid_demos, soft_demos, script_demos) for demo in vars(module).values()
         if getattr(demo, "__module__", "") == module.__name__}

if __name__ == "__main__":
    (HERE / "pictures").mkdir(exist_ok=True)
    for name in sys.argv[2:] or DEMOS:
        print(name)
        DEMOS[name]()
