"""Demos of soft bodies and force fields: JET's engine alone plays them."""
import math

from scene import BLUE, GOLD, GREEN, GREY, JET_ALONE, RED, STEEL, WOOD, Scene, circle, line, polygon, rectangle, write


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


def soft_rigid():
    s = Scene()
    s.fixed("Frame", polygon([(120, 200), (134, 200), (134, 316), (506, 316), (506, 200), (520, 200), (520, 330), (120, 330)]), STEEL)
    s.soft("Mattress", rectangle(320, 280, 360, 66), BLUE, mass=3, ks=120, kd=1.5)
    for k, (x, size, mass) in enumerate(((200, 40, 1), (320, 40, 3), (440, 40, 9))):
        s.rigid(f"Box {k + 1}", rectangle(x, 200, size, size), WOOD, mass)
    write("soft-rigid", "Rigid on soft", s, 600, [
        {"item": "Box 1", "above": "Box 2", "by": 1}, {"item": "Box 2", "above": "Box 3", "by": 1},
        {"count": "Box *", "inside": [134, 150, 506, 316], "is": 3}], JET_ALONE, picture=300)


def self_collision():
    s = Scene()
    # The tips of each claw are drawn across each other. A yield out of reach takes away the memory of the shape.
    for name, x, on in (("Ghostly claw", 170, False), ("Solid claw", 470, True)):
        arc = [math.pi * (-0.32 + 1.64 * k / 24) for k in range(25)]  # open at the top
        outer = [(x + 80 * math.cos(t), 200 + 80 * math.sin(t)) for t in arc]
        inner = [(x + 54 * math.cos(t), 200 + 54 * math.sin(t)) for t in arc[::-1]]
        s.soft(name, polygon(outer + inner), [GREY, RED][on], {"gravity-scale": 0}, mass=1, ks=60, kd=1, self_collision=on,
               **{"yield": 100})
        for side, k, way in (("right", 0, -1), ("left", 24, 1)):
            tip = ((outer[k][0] * 3 + inner[24 - k][0]) / 4, (outer[k][1] * 3 + inner[24 - k][1]) / 4 + 3)
            s.item("spring", f"{name}'s {side} string", line(tip, (tip[0] + way * 150, tip[1])), {"ks": 6, "kd": 1, "rest-length": 0})
    write("self-collision", "Self-collision", s, 480, [{"item": "Solid claw", "width": [130, 142]}, {"item": "Ghostly claw", "width": [160, 300]}],
          JET_ALONE)


def area_stiffness():
    s = Scene()
    s.ground()
    for name, x, area in (("Hollow", 180, 0), ("Full", 460, 3000)):
        s.soft(name, circle(x, 270, 48, 5), [GREY, BLUE][area > 0], mass=1, ks=60, kd=1, area_stiffness=area, axis_aligned=False,
               cross=False)
        s.rigid(f"{name}'s load", rectangle(x, 205, 90, 14), STEEL, 4)
    write("area-stiffness", "Area stiffness", s, 600, [{"item": "Full's load", "above": "Hollow's load", "by": 2}], JET_ALONE)


def currents():
    s = Scene()
    s.ground()
    s.field("Belt", rectangle(150, 300, 240, 60), "directional", vector=(90, 0))
    s.fixed("Stop", rectangle(620, 280, 20, 80), STEEL)
    s.rigid("Crate", rectangle(60, 306, 28, 28), WOOD)
    s.soft("Jelly", circle(120, 290, 20, 3), GREEN, mass=0.5, ks=30, kd=0.5)
    rim = [(470 + 115 * math.cos(math.pi * k / 24), 170 + 115 * math.sin(math.pi * k / 24)) for k in range(48)]
    hollow = [(470 + 105 * math.cos(math.pi * k / 24), 170 + 105 * math.sin(math.pi * k / 24)) for k in range(48)]
    s.fixed("Drum", polygon(rim) + " " + polygon(hollow[::-1]), STEEL)
    s.field("Whirl", circle(470, 170, 100), "vortex", strength=60)
    for k in range(3):
        at = 2 * math.pi * k / 3
        s.rigid(f"Leaf {k + 1}", circle(470 + 60 * math.cos(at), 170 + 60 * math.sin(at), 9), [RED, GOLD, BLUE][k], 0.5, gravity_scale=0)
    s.script("Watch", """// How far the first leaf went round, clockwise.
var leaf = ItemUtils.getItemByName("Leaf 1", ItemUtils.getTopGroup(script)).body, turned = 0, last = 0, told = false;
JetSystem.addEventListener("onStep", function () {
    var angle = Math.atan2(leaf.position.y - 170, leaf.position.x - 470), step = angle - last;
    if (step > Math.PI) step -= 2 * Math.PI;
    if (step < -Math.PI) step += 2 * Math.PI;
    turned += step;
    last = angle;
    if (!told && turned > 4 * Math.PI) {
        told = true;
        CC.GUIC.printlnToOutput("twice round");
    }
});
""")
    write("currents", "Vortex and belt", s, 900, [{"output": "twice round"}, {"count": "Leaf *", "inside": [365, 65, 575, 275], "is": 3},
                                                 {"item": "Crate", "x": [200, 640]}, {"item": "Jelly", "x": [150, 640]}], JET_ALONE,
          picture=70)


def pins():
    s = Scene()
    s.ground()
    # A joint to the background pins the particles at its point.
    cloth = [(170 + 20 * k, 70) for k in range(16)] + [(470 - 20 * k, 130) for k in range(16)]
    s.soft("Cloth", polygon(cloth), BLUE, mass=1, ks=60, kd=0.6)
    for k, x in enumerate((170, 470)):
        s.joint(f"Pin {k + 1}", line((x, 40), (x, 70), (x + (2 if k == 0 else -2), 72)), "revolute")
    s.rigid("Ball", circle(320, 20, 16), RED, 1)
    s.soft("Loose", rectangle(560, 100, 60, 40), GREY, mass=1, ks=60, kd=0.6)
    write("pins", "Pins", s, 480, [{"item": "Cloth", "y": [60, 220]}, {"item": "Ball", "y": [0, 260]}, {"item": "Loose", "y": [285, 315]}],
          JET_ALONE, picture=200)


def jelly():
    s = Scene()
    s.ground()
    # Three that fall, wobble, and come to rest, with what lies on them; one may not sleep.
    s.soft("Lower", rectangle(160, 270, 90, 50), RED, mass=2, ks=300, kd=6, shape_stiffness=600, shape_damping=3)
    s.soft("Upper", rectangle(165, 190, 70, 50), GOLD, mass=1, ks=300, kd=6, shape_stiffness=600, shape_damping=3)
    s.rigid("Plank", rectangle(160, 130, 60, 14), WOOD, 0.5)
    s.soft("Alone", polygon([(285, 240), (355, 240), (340, 180), (300, 180)]), GREEN, mass=1, ks=300, kd=6, shape_stiffness=600, shape_damping=3)
    s.soft("Never", rectangle(480, 280, 60, 60), BLUE, {"allow-sleep": False}, mass=1, ks=300, kd=6, shape_stiffness=600,
           shape_damping=3)
    write("jelly", "Jelly", s, 900, [
        {"item": name, "awake": False} for name in ("Lower", "Upper", "Plank", "Alone")] + [
        {"item": "Never", "awake": True}, {"item": "Lower", "y": [285, 300]}, {"item": "Upper", "above": "Lower", "by": 35}],
        JET_ALONE, picture=75)


def regions():
    s = Scene()
    s.ground()
    s.fixed("Wall", rectangle(40, 170, 30, 260), STEEL)
    # The same bars, welded to the wall by what is nearest, and by regions that reach farther and farther in.
    for name, y, radius, color in (("Nearest", 80, 0, GREY), ("Small", 150, 24, BLUE), ("Large", 220, 60, GREEN)):
        s.soft(f"{name} bar", rectangle(165, y, 200, 30), color, mass=1, ks=400, kd=6)
        s.joint(f"{name} weld", line((50, y), (75, y), (76, y)), "weld", radius=radius)
    # A lamp on a soft arm: the joint takes a patch of the arm along, and the arm bends.
    s.soft("Arm", rectangle(480, 80, 200, 20), WOOD, mass=1, ks=800, kd=10)
    s.joint("Arm weld", line((400, 40), (400, 80), (402, 80)), "weld", radius=30)
    s.rigid("Lamp", circle(570, 140, 14), GOLD, 0.3)
    s.joint("Cord", line((570, 80), (570, 140)), "rope", radius=14)
    write("regions", "Regions", s, 400, [
        {"item": "Nearest bar", "angle": [0.06, 0.1]}, {"item": "Small bar", "angle": [0.025, 0.045]},
        {"item": "Large bar", "angle": [0.012, 0.03]}, {"item": "Arm", "angle": [0.03, 0.08]},
        {"item": "Lamp", "y": [140, 155]}], JET_ALONE, picture=300)
