"""What the demo projects are made of: paths, scenes with their items, and how a project is written."""
import json
import math
import shutil
import subprocess
import sys
from pathlib import Path
from xml.sax.saxutils import escape

HERE = Path(__file__).resolve().parent
JET = sys.argv[1] if len(sys.argv) > 1 else HERE.parent.parent / "build/release/bin/jet"
BOTH = ["jet-physics", "physics-box2d"]
JET_ALONE = BOTH[:1]  # Box2D has no soft bodies and no fields
GROUND, STEEL, WOOD, RED, BLUE, GREEN, GOLD, GREY = (
    "#8a8f98", "#5b6b7f", "#c08a4e", "#d8433b", "#3b7dd8", "#4aa564", "#e0a92e", "#b8bcc4")


PLUGINS = {"polygon-face": "org.jet.effect.polygon-face", "stroke": "org.jet.effect.stroke",
           "in-path-body": "org.jet.effect.in-path-body", "in-path-rigid-body": "org.jet.effect.in-path-rigid-body",
           "joint": "org.jet.items.physics", "force": "org.jet.items.physics", "force-field": "org.jet.items.physics"}


def text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (tuple, list)):
        return " ".join(f"{v:g}" for v in value)
    if isinstance(value, float) and value.is_integer():
        return str(int(value))  # as JET writes it, not 1e+06
    return f"{value:g}" if isinstance(value, (int, float)) else str(value)


def rectangle(x, y, w, h):
    """By its centre."""
    return polygon([(x - w / 2, y - h / 2), (x + w / 2, y - h / 2), (x + w / 2, y + h / 2), (x - w / 2, y + h / 2)])


def turned(x, y, w, h, angle):
    """A rectangle by its centre, turned clockwise."""
    c, q = math.cos(angle), math.sin(angle)
    return polygon([(x + c * u - q * v, y + q * u + c * v)
                    for u, v in ((-w / 2, -h / 2), (w / 2, -h / 2), (w / 2, h / 2), (-w / 2, h / 2))])


def polygon(points):
    return "M " + " L ".join(f"{x:g} {y:g}" for x, y in points) + " Z"


def circle(x, y, r, intermediate=0):
    k = 0.5522847498307936 * r
    path = (f"M {x + r:g} {y:g} C {x + r:g} {y + k:g} {x + k:g} {y + r:g} {x:g} {y + r:g} "
            f"C {x - k:g} {y + r:g} {x - r:g} {y + k:g} {x - r:g} {y:g} C {x - r:g} {y - k:g} {x - k:g} {y - r:g} {x:g} {y - r:g} "
            f"C {x + k:g} {y - r:g} {x + r:g} {y - k:g} {x + r:g} {y:g} Z")
    return path + (f" n {intermediate} {intermediate} {intermediate} {intermediate}" if intermediate else "")


def line(*points):
    return "M " + " L ".join(f"{x:g} {y:g}" for x, y in points)


class Scene:
    def __init__(self):
        self.items, self.next, self.uses = [], 2, []
        self.materials, self.pairs, self.settings = [], {}, {}

    def item(self, kind, name, path="", properties={}, effects=()):
        self.uses += [kind] * (kind in PLUGINS) + [effect for effect, _ in effects]
        out = [f'    <item type="{kind}" id="{self.next}" name="{escape(name)}">']
        self.next += 1
        if path:
            out.append(f"      <path>{path}</path>")
        out += [self.property(k, v, "      ") for k, v in sorted(properties.items())]
        for effect, values in effects:
            out.append(f'      <effect type="{effect}">')
            out += [self.property(k, v, "        ") for k, v in sorted(values.items())]
            out.append("      </effect>")
        self.items += out + ["    </item>"]

    @staticmethod
    def property(name, value, indent):
        shown = f"<![CDATA[{value}]]>" if name == "code" else escape(text(value))
        return f'{indent}<property id="{name}">{shown}</property>'

    def rigid(self, name, path, color, mass=1, **properties):
        body = {k.replace("_", "-"): v for k, v in properties.items()}
        self.item("body", name, path, body, [("polygon-face", {"color": color}), ("in-path-rigid-body", {"mass": mass})])

    def fixed(self, name, path, color=GROUND, **properties):
        self.rigid(name, path, color, fixed=True, **properties)

    def soft(self, name, path, color, body={}, **properties):
        effect = {k.replace("_", "-"): v for k, v in properties.items()}
        self.item("body", name, path, body, [("polygon-face", {"color": color}), ("in-path-body", effect)])

    def joint(self, name, path, kind, **properties):
        self.item("joint", name, path, {"kind": kind, **{k.replace("_", "-"): v for k, v in properties.items()}})

    def field(self, name, path, kind, **properties):
        self.item("force-field", name, path, {"kind": kind, **{k.replace("_", "-"): v for k, v in properties.items()}})
        # What a game shows of it.
        self.item("shape", name + " area", path, {}, [("stroke", {"color": "#5a3cc8", "dashes": "6 4", "width": 1.5})])

    def plugins(self):
        """The record of the plugins a project uses, as JET writes it."""
        lines = []
        for plugin in sorted({PLUGINS[use] for use in self.uses}):
            mine = [use for use in self.uses if PLUGINS[use] == plugin]
            kind = "itemTypes" if plugin.startswith("org.jet.items") else "effects"
            provides = " ".join(f"{kind}/{use}" for use in sorted(set(mine)))
            lines.append(f'    <plugin id="{plugin}" version="1.0.0" uses="{len(mine)}" provides="{provides}"/>')
        return "\n".join(lines)

    def actuator(self, kind, name, path, **properties):
        """A spring, an angular spring, a torque or a force."""
        self.item(kind, name, path, {k.replace("_", "-"): v for k, v in properties.items()})

    def material_table(self):
        """Each pair of materials; what is not given meets as the defaults do."""
        if not self.materials:
            return ""
        lines = [f'    <material name="{name}"/>' for name in self.materials]
        for i, a in enumerate(self.materials):
            for b in self.materials[i:]:
                friction, restitution, collides = self.pairs.get((a, b), (0.6, 0.1, True))
                lines.append(f'    <pair a="{a}" b="{b}" friction="{friction:g}" restitution="{restitution:g}" '
                             f'collides="{text(collides)}"/>')
        return "  <materials>\n" + "\n".join(lines) + "\n  </materials>\n"

    def script(self, name, code):
        self.item("script", name, "", {"code": code})

    def ground(self):
        self.fixed("Ground", rectangle(320, 345, 660, 50))


def write(name, title, scene, steps, expect, engines=BOTH, picture=None, keys=(), view=()):
    folder = HERE / name
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "scenes").mkdir(parents=True)
    (folder / "project.jet").write_text(f'''<?xml version="1.0" encoding="UTF-8"?>
<jet-project version="1" name="{escape(title)}">
  <plugins>
{scene.plugins()}
  </plugins>
  <filter name="Scenes">
    <scene name="{escape(title)}" file="scenes/{escape(title)}.scene"/>
  </filter>
</jet-project>
''')
    body = "\n".join(scene.items)
    values = {"background": "#eef3f8", "page-height": 360, "page-width": 640, **scene.settings}
    settings = "\n".join(Scene.property(k, v, "    ") for k, v in sorted(values.items()))
    (folder / "scenes" / f"{title}.scene").write_text(f'''<?xml version="1.0" encoding="UTF-8"?>
<scene version="1">
  <settings>
{settings}
  </settings>
{scene.material_table()}  <item type="layer" id="1" name="Layer">
{body}
  </item>
</scene>
''')
    wanted = {"steps": steps, "engines": engines, "expect": expect}
    pressed = []
    if keys:  # (step, key, down?), played by check.py and for the picture
        wanted["input"] = "keys.json"
        pressed = ["--input", folder / "keys.json"]
        events = ",\n".join(f'    {{ "step": {step}, "key": "{key}", "down": {text(down)} }}' for step, key, down in keys)
        (folder / "keys.json").write_text(f'{{ "events": [\n{events}\n] }}\n')
    (folder / "expect.json").write_text(json.dumps(wanted, indent=1, ensure_ascii=False) + "\n")
    subprocess.run([JET, "project", "save", folder], check=True, stdout=subprocess.DEVNULL)
    # `picture` is the step of the README's picture. It shows the page, or where a game moves its camera its `view`.
    sized = ["--width", str(view[0]), "--height", str(view[1])] if view else []
    subprocess.run([JET, "play", folder, "--steps", str(picture or steps), *sized, "--physics", engines[0], *pressed, "--snapshot", HERE / "pictures" / f"{name}.png"], check=True, stdout=subprocess.DEVNULL)
