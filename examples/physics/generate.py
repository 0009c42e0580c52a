#!/usr/bin/env python3
"""Writes the demo projects of this folder, one a feature of the physics, each with what must come out (expect.json).

    examples/physics/generate.py [JET]     JET: the program, build/release/bin/jet if not given

Scenes are 640 x 360 units. `jet project save` brings each into the form in which JET writes it, and `jet play --snapshot`
makes the pictures of the README.
"""
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
           "joint": "org.jet.items.physics", "force-field": "org.jet.items.physics"}


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

    def script(self, name, code):
        self.item("script", name, "", {"code": code})

    def ground(self):
        self.fixed("Ground", rectangle(320, 345, 660, 50))


def write(name, title, scene, steps, expect, engines=BOTH, picture=None):
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
    (folder / "scenes" / f"{title}.scene").write_text(f'''<?xml version="1.0" encoding="UTF-8"?>
<scene version="1">
  <settings>
    <property id="background">#eef3f8</property>
    <property id="page-height">360</property>
    <property id="page-width">640</property>
  </settings>
  <item type="layer" id="1" name="Layer">
{body}
  </item>
</scene>
''')
    (folder / "expect.json").write_text(
        json.dumps({"steps": steps, "engines": engines, "expect": expect}, indent=1, ensure_ascii=False) + "\n")
    subprocess.run([JET, "project", "save", folder], check=True, stdout=subprocess.DEVNULL)
    # `picture` is the step of the README's picture.
    subprocess.run([JET, "play", folder, "--steps", str(picture or steps), "--width", "640", "--height", "360", "--physics",
                    engines[0], "--snapshot", HERE / "pictures" / f"{name}.png"], check=True, stdout=subprocess.DEVNULL)


def stack():
    s = Scene()
    s.ground()
    for i in range(10):
        s.rigid(f"Box {i + 1}", rectangle(320, 308 - 24 * i, 24, 24), [WOOD, GOLD][i % 2])
    write("stack", "Stack", s, 600, [{"count": "Box *", "inside": [306, 60, 334, 322], "is": 10},
                                     {"item": "Box 10", "y": [85, 100]}])


def joints():
    s = Scene()
    s.fixed("Beam", rectangle(320, 30, 620, 12), STEEL)
    s.rigid("Bob", circle(120, 90, 14), RED, 2)
    s.joint("Pivot", line((60, 90), (60, 90), (120, 90)), "revolute")
    s.rigid("Slider", rectangle(200, 60, 24, 24), BLUE)
    s.joint("Rail", line((200, 30), (200, 60)), "prismatic", axis=(0.3, 1), limited=True, lower=0, upper=150)
    s.rigid("Sign", rectangle(330, 120, 70, 20), GREEN)
    s.joint("Weld", line((295, 34), (300, 120)), "weld")
    s.rigid("Light", circle(420, 200, 12), GOLD, 1)
    s.rigid("Heavy", circle(500, 200, 18), STEEL, 1.6)
    s.joint("Pulley", line((420, 200), (420, 60), (500, 60), (500, 200)), "pulley")
    s.rigid("Lantern", circle(590, 60, 12), RED)
    s.joint("Rope", line((570, 32), (590, 60)), "rope", length=120)
    s.ground()
    write("joints", "Joints", s, 150, [
        {"item": "Bob", "distance": [60, 90], "from": [58, 62]},
        {"item": "Slider", "y": [150, 215]}, {"item": "Sign", "y": [118, 123], "angle": [-0.05, 0.05]},
        {"item": "Heavy", "y": [255, 285]}, {"item": "Light", "y": [115, 145]},
        {"item": "Lantern", "distance": [570, 32], "from": [60, 122]}], picture=40)


def motors():
    s = Scene()
    s.fixed("Stand", rectangle(160, 260, 16, 120), STEEL, group=1)
    s.rigid("Mill", polygon([(90, 193), (153, 193), (153, 130), (167, 130), (167, 193), (230, 193), (230, 207), (167, 207),
                             (167, 270), (153, 270), (153, 207), (90, 207)]), RED, 4, group=1)
    s.joint("Axle", line((40, 100), (160, 200), (100, 200)), "revolute", driven=True, motor_speed=4, max_torque=1e6)
    s.fixed("Rail", rectangle(440, 300, 300, 10), STEEL)
    s.rigid("Carriage", rectangle(320, 280, 40, 24), BLUE, 2)
    s.joint("Drive", line((440, 304), (320, 280), (310, 280)), "prismatic", axis=(1, 0), limited=True, lower=0, upper=220,
            driven=True, motor_speed=80, max_force=1e5)
    s.ground()
    write("motors", "Motors", s, 240, [{"item": "Mill", "omega": [3.9, 4.1]}, {"item": "Carriage", "x": [530, 545]}], picture=100)


def platform():
    s = Scene()
    s.ground()
    s.fixed("Platform", rectangle(320, 200, 200, 8), GREEN, one_sided=(0, -1))
    s.rigid("Jumper", circle(280, 300, 12), RED, velocity=(0, -170))
    s.rigid("Faller", rectangle(360, 60, 22, 22), GOLD)
    write("platform", "One-sided platform", s, 360,
          [{"item": "Jumper", "y": [182, 186]}, {"item": "Faller", "y": [183, 187]}], picture=55)


def bullets():
    s = Scene()
    s.fixed("Wall", rectangle(560, 160, 2, 300), STEEL)
    s.rigid("Plate", rectangle(480, 200, 3, 100), BLUE, 3, velocity=(-100, 0), gravity_scale=0)
    for i in range(5):
        s.rigid(f"Bullet {i + 1}", circle(40 + 7 * i, 60 + 55 * i, 4), RED, 0.2, velocity=(9000, 0), gravity_scale=0)
    write("bullets", "Bullets", s, 30, [{"count": "Bullet *", "inside": [-1e9, -1e9, 560, 1e9], "is": 5}], picture=1)


def car():
    s = Scene()
    hills = [(-10, 360), (-10, 300), (120, 300), (170, 285), (220, 300), (270, 306), (330, 280), (390, 300), (650, 300), (650, 360)]
    s.fixed("Road", polygon(hills))
    s.rigid("Chassis", polygon([(40, 262), (60, 262), (72, 246), (104, 246), (112, 262), (128, 262), (128, 278), (40, 278)]), BLUE, 2)
    for name, x in (("Rear", 58), ("Front", 112)):
        s.rigid(f"{name} wheel", circle(x, 286, 12), "#303338", 0.5, group=1)
        s.joint(f"{name} axle", line((x, 270), (x, 286), (x, 290)), "wheel", axis=(0, 1), hertz=4, damping_ratio=0.7,
                driven=name == "Rear", motor_speed=9, max_torque=20000)
    s.fixed("Finish", rectangle(560, 270, 10, 60), GREEN, sensor=True)
    s.script("Judge", """var finish = ItemUtils.getItemByName("Finish", ItemUtils.getTopGroup(script));
var car = ItemUtils.getItemByName("Chassis", ItemUtils.getTopGroup(script));
var done = false;
JetSystem.addEventListener("onStep", function () {
    if (!done && ctx.colTab[car.body.cti][finish.body.cti]) {
        done = true;
        CC.GUIC.printlnToOutput("finished");
    }
});
""")
    write("car", "Wheel car", s, 720, [{"output": "finished"}, {"item": "Chassis", "x": [540, 1e9]}], picture=200)


def soft_balls():
    s = Scene()
    s.fixed("Bin", polygon([(180, 120), (190, 120), (190, 320), (450, 320), (450, 120), (460, 120), (460, 335), (180, 335)]))
    for i in range(9):
        s.soft(f"Ball {i + 1}", circle(235 + 85 * (i % 3), 285 - 75 * (i // 3), 32, 3), [RED, BLUE, GOLD][i % 3], mass=1, ks=60,
               kd=0.6)
    write("soft-balls", "Soft balls", s, 480, [{"count": "Ball *", "inside": [185, 60, 455, 325], "is": 9}], JET_ALONE)


def gas():
    s = Scene()
    s.ground()
    for name, x, pressure in (("Empty", 180, 0), ("Full", 440, 12)):
        s.soft(f"{name} tyre", circle(x, 270, 48, 5), [GREY, RED][pressure > 0], mass=1, ks=120, kd=1, pressure=pressure,
               axis_aligned=False, cross=False)
        s.rigid(f"{name} load", rectangle(x, 205, 90, 14), STEEL, 4)
    write("gas", "Gas pressure", s, 600, [{"item": "Full load", "above": "Empty load", "by": 4}], JET_ALONE)


def plastic():
    s = Scene()
    s.ground()
    for name, x, flow in (("Rubber", 180, 0), ("Clay", 440, 0.03)):
        s.soft(f"{name}", rectangle(x, 280, 80, 78), [RED, WOOD][flow > 0], mass=1, ks=60, kd=1, **({"yield": flow, "creep": 30}))
        s.rigid(f"{name} weight", rectangle(x, 150, 60, 30), STEEL, 6)
    s.script("Crane", """// After two seconds the weights are taken away.
var steps = 0;
JetSystem.addEventListener("onStep", function () {
    if (++steps !== 120) return;
    ["Rubber weight", "Clay weight"].forEach(function (name) {
        var weight = ItemUtils.getItemByName(name, ItemUtils.getTopGroup(script));
        weight.body.setVelocity(name === "Clay weight" ? 500 : -500, -260);
    });
});
""")
    write("plastic", "Plastic bodies", s, 600, [{"item": "Rubber", "taller": "Clay", "by": 3}], JET_ALONE)


def composite():
    s = Scene()
    s.ground()
    for name, x, twin in (("Loose wheel", 180, 0), ("Wheel", 440, 40)):
        s.soft(name, circle(x, 270, 48, 5), [GREY, RED][twin > 0], mass=1, ks=4, kd=0.2, border_to_inside=0,
               axis_aligned=False, cross=False, shape_stiffness=twin, shape_damping=0.4)
        s.rigid(f"{name}'s load", rectangle(x, 180, 70, 14), STEEL, 2)
    write("composite", "Composite bodies", s, 600, [{"item": "Wheel", "taller": "Loose wheel", "by": 10},
                                                    {"item": "Wheel's load", "above": "Loose wheel's load", "by": 10}], JET_ALONE)


def fields():
    s = Scene()
    s.ground()
    s.field("Wind", rectangle(120, 150, 200, 120), "drag", vector=(80, -20), strength=3)
    s.soft("Leaf", circle(60, 140, 16, 3), GREEN, mass=0.3, ks=20)
    s.field("Water", rectangle(430, 270, 180, 100), "buoyancy", strength=2, drag=3)
    s.rigid("Raft", rectangle(430, 180, 60, 16), WOOD)
    s.field("Well", circle(540, 90, 80), "radial", strength=-160)
    s.rigid("Moon", circle(500, 60, 8), GOLD, gravity_scale=0)
    write("fields", "Force fields", s, 300, [{"item": "Leaf", "x": [130, 400]}, {"item": "Raft", "y": [205, 250]},
                                             {"item": "Moon", "distance": [540, 90], "from": [0, 60]}], JET_ALONE)


def tearing():
    s = Scene()
    s.fixed("Left bank", rectangle(60, 280, 120, 160))
    s.fixed("Right bank", rectangle(580, 280, 120, 160))
    for i, (name, tear) in enumerate((("Strong", 0), ("Weak", 1.02))):
        y = 90 + 100 * i
        s.soft(f"{name} bridge", polygon([(150 + 20 * k, y) for k in range(18)] + [(490 - 20 * k, y + 14) for k in range(18)]),
               [STEEL, WOOD][i], mass=1, ks=150, kd=1)
        for side, x, out in (("left", 152, -36), ("right", 488, 36)):
            s.item("spring", f"{name} {side} rope", line((x, y + 7), (x + out, y - 20)),
                   {"ks": 400, "kd": 4, "tear-ratio": tear})
    s.rigid("Light ball", circle(320, 40, 14), GOLD, 1)
    s.rigid("Heavy ball", circle(320, 160, 14), RED, 12)
    write("tearing", "Tearing", s, 420, [{"item": "Heavy ball", "y": [300, 1e9]}, {"item": "Light ball", "y": [0, 185]}],
          JET_ALONE, picture=75)


def shape():
    s = Scene()
    s.ground()
    star = []
    for i in range(10):
        r = 60 if i % 2 == 0 else 30
        star.append((320 + r * math.sin(math.pi * i / 5), 200 - r * math.cos(math.pi * i / 5)))
    s.soft("Star", polygon(star), GOLD, mass=1, ks=40, kd=0.5)
    s.rigid("Hammer", rectangle(320, 60, 70, 40), STEEL, 5, velocity=(0, 250))
    s.script("Hand", """// The hammer strikes once and goes away.
var steps = 0;
JetSystem.addEventListener("onStep", function () {
    if (++steps === 60) ItemUtils.getItemByName("Hammer", ItemUtils.getTopGroup(script)).body.setVelocity(400, -300);
});
""")
    write("shape", "Shape memory", s, 600, [{"item": "Star", "width": [108, 118], "height": [100, 118]}], JET_ALONE, picture=40)


def breaking():
    s = Scene()
    s.fixed("Left bank", rectangle(60, 250, 120, 220))
    s.fixed("Right bank", rectangle(580, 250, 120, 220))
    for k in range(10):
        s.rigid(f"Plank {k + 1}", rectangle(140 + 40 * k, 146, 38, 8), WOOD, 1)
    for k in range(11):
        x = 120 + 40 * k
        left, right = x - (8 if k > 0 else 4), x + (8 if k < 10 else 4)
        s.joint(f"Hinge {k + 1}", line((left, 146), (x, 146), (right, 146)), "revolute", break_force=30000)
    s.rigid("Light ball", circle(240, 110, 10), GOLD, 1)
    s.rigid("Heavy ball", circle(400, 20, 18), RED, 60)
    write("breaking", "Breaking joints", s, 360, [{"item": "Heavy ball", "y": [300, 1e9]}], picture=110)


def sensors():
    s = Scene()
    s.ground()
    s.fixed("Ramp", polygon([(0, 120), (300, 220), (300, 232), (0, 132)]), STEEL)
    s.fixed("Gate", rectangle(400, 260, 40, 120), GREEN, sensor=True)
    for k in range(4):
        s.rigid(f"Ball {k + 1}", circle(30 + 45 * k, 110 + 15 * k - 6, 12), [RED, GOLD, BLUE, STEEL][k])
    s.script("Counter", """// Counts who comes through; a sensor is felt and does not hold.
var group = ItemUtils.getTopGroup(script), gate = ItemUtils.getItemByName("Gate", group), seen = {}, count = 0;
JetSystem.addEventListener("onStep", function () {
    for (var i = 1; i <= 4; ++i) {
        var ball = ItemUtils.getItemByName("Ball " + i, group);
        if (!seen[i] && ctx.colTab[ball.body.cti][gate.body.cti]) {
            seen[i] = true;
            CC.GUIC.printlnToOutput("through: " + ++count);
        }
    }
});
""")
    write("sensors", "Sensors", s, 600, [{"output": "through: 4"}], picture=150)


def soft_rigid():
    s = Scene()
    s.fixed("Frame", polygon([(120, 200), (134, 200), (134, 316), (506, 316), (506, 200), (520, 200), (520, 330), (120, 330)]), STEEL)
    s.soft("Mattress", rectangle(320, 280, 360, 66), BLUE, mass=3, ks=120, kd=1.5)
    for k, (x, size, mass) in enumerate(((200, 40, 1), (320, 40, 3), (440, 40, 9))):
        s.rigid(f"Box {k + 1}", rectangle(x, 200, size, size), WOOD, mass)
    write("soft-rigid", "Rigid on soft", s, 600, [
        {"item": "Box 1", "above": "Box 2", "by": 1}, {"item": "Box 2", "above": "Box 3", "by": 1},
        {"count": "Box *", "inside": [134, 150, 506, 316], "is": 3}], JET_ALONE, picture=300)


def sleeping():
    s = Scene()
    s.ground()
    for k in range(6):
        s.rigid(f"Box {k + 1}", rectangle(480, 305 - 30 * k, 30, 30), [WOOD, GOLD][k % 2])
    # A quarter of a minute from one side to the other, and still for a while at its turning points.
    s.fixed("Beam", rectangle(200, 40, 160, 10), STEEL)
    s.rigid("Pendulum", circle(280, 214, 22), RED, 40, gravity_scale=0.07)
    s.joint("Pin", line((200, 40), (200, 40), (280, 214)), "revolute")
    write("sleeping", "Sleeping", s, 1000, [{"item": "Pendulum", "x": [116, 128]}, {"count": "Box *", "inside": [464, 130, 496, 322], "is": 6}],
          picture=500)


DEMOS = {f.__name__: f for f in (stack, joints, motors, platform, bullets, car, soft_balls, gas, plastic, composite, fields, tearing, shape,
                                breaking, sensors, soft_rigid, sleeping)}

if __name__ == "__main__":
    (HERE / "pictures").mkdir(exist_ok=True)
    for name in sys.argv[2:] or DEMOS:
        print(name)
        DEMOS[name]()
