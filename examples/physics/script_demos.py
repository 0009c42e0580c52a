"""What scripts do with the physics: queries, joints, touches; and what a scene's settings and forces do."""
from scene import BLUE, BOTH, GOLD, GREEN, GREY, JET_ALONE, RED, STEEL, WOOD, Scene, circle, line, polygon, rectangle, write

FIND = """var top = ItemUtils.getTopGroup(script);
function find(name) { return ItemUtils.getItemByName(name, top); }
"""


def driving():
    s = Scene()
    hills = [(-200, 360), (-200, 180), (-180, 180), (-180, 300), (150, 300), (215, 280), (280, 300), (340, 306), (400, 285), (460, 300),
             (820, 300), (820, 180), (840, 180), (840, 360)]
    s.fixed("Road", polygon(hills))
    s.rigid("Chassis", polygon([(40, 262), (60, 262), (72, 246), (104, 246), (112, 262), (128, 262), (128, 278), (40, 278)]), RED, 2)
    for name, x in (("Rear", 58), ("Front", 112)):
        s.rigid(f"{name} wheel", circle(x, 286, 12), "#303338", 0.5, group=1)
        s.joint(f"{name} axle", line((x, 270), (x, 286), (x, 290)), "wheel", axis=(0, 1), hertz=4, damping_ratio=0.7, max_torque=20000)
    s.script("Driver", FIND + """// Right and Left drive, Down brakes; without a key the car rolls.
var axles = [find("Rear axle").joint, find("Front axle").joint], chassis = find("Chassis").body;
var keys = { right: Keyboard.getKey("Right"), left: Keyboard.getKey("Left"), down: Keyboard.getKey("Down") };
var speed = 0;
JetSystem.addEventListener("onStep", function () {
    var way = (keys.right.isPressed() ? 1 : 0) - (keys.left.isPressed() ? 1 : 0);
    speed = way === 0 ? 0 : Math.max(-12, Math.min(12, speed + 0.2 * way));
    axles.forEach(function (axle) { axle.setMotor(way !== 0 || keys.down.isPressed(), speed); });
});
var view = CC.getScene("Driving").GC.swingSimulationGP;
JetSystem.addEventListener("onPostPaint", function (event) {
    view.setViewAnchor(chassis.position.x - 0.5 * view.getWidth() / view.getViewScale(), 0);
    if (event.step % 120 === 0) print("at", Math.round(chassis.position.x), "springs",
        axles.map(function (axle) { return axle.value.toFixed(1); }).join(" "));
});
""")
    # Two seconds' rest, five to the right over the hills, two of braking, then back for two.
    keys = [(120, "Right", True), (420, "Right", False), (420, "Down", True), (540, "Down", False), (540, "Left", True), (660, "Left", False)]
    write("driving", "Driving", s, 540, [{"item": "Chassis", "x": [480, 800], "y": [255, 275], "angle": [-0.1, 0.1]}], keys=keys, picture=250,
          view=(640, 360))


def rays():
    s = Scene()
    s.ground()
    s.fixed("Lamp", rectangle(40, 180, 30, 20), STEEL)
    s.fixed("Glass", rectangle(200, 180, 8, 180), "#b8d8f0", layer=2)
    s.fixed("Wall", rectangle(560, 190, 20, 260), GREY)
    for name, x, y, color in (("Low crate", 420, 300, WOOD), ("Tall crate", 480, 280, WOOD)):
        s.rigid(name, rectangle(x, y, 36, 640 - 2 * y), color)
    s.rigid("Intruder", circle(300, 40, 16), RED, gravity_scale=0, velocity=(0, 60))
    s.rigid("Light", circle(80, 180, 5), GOLD, kinematic=True, sensor=True)
    s.script("Watchman", FIND + """// A beam from the lamp, seen where it ends. It passes through glass, which is on layer 2.
var lamp = find("Lamp"), light = find("Light").body, seen = null;
JetSystem.addEventListener("onStep", function (event) {
    var from = lamp.getBoundingArea().getCenter();
    var to = new Vec2d(800, 0).rotate(0.15 * Math.sin(event.time)).add(from);
    var hit = ctx.rayCast(from, to, { mask: ~2, except: lamp });
    light.setPosition(hit ? hit.point : to);
    if (hit && hit.item !== seen) print(event.step, "the beam meets", hit.item);
    seen = hit && hit.item;
    if (event.step === 1) {
        print("through glass", ctx.rayCast(from, new Vec2d(800, 180), { except: lamp }).item);
        print("room for", ctx.shapeCast({ center: from, radius: 12 }, new Vec2d(0, 200), { except: lamp }).distance.toFixed(0));
        print("crates", ctx.overlapping({ x: 400, y: 200, width: 100, height: 100 }).join(", "));
        print("nearest", ctx.nearest(new Vec2d(540, 100), 50).item);
    }
});
""")
    write("rays", "Rays", s, 300, [{"output": "through glass Glass"}, {"output": "room for 128"}, {"output": "crates Low crate, Tall crate"},
                                  {"output": "nearest Wall"}, {"output": "0 the beam meets Wall"},
                                  {"said": "the beam meets Intruder"}, {"item": "Light", "x": [540, 560]}], picture=130)


def dragging():
    s = Scene()
    s.ground()
    for k in range(3):
        s.rigid(f"Crate {k + 1}", rectangle(420, 304 - 33 * k, 32, 32), WOOD)
    s.rigid("Ball", circle(160, 296, 24), RED, 2)
    s.joint("Hand", line((160, 296), (160, 100)), "mouse", hertz=4, damping_ratio=0.8, max_force=20000)
    s.script("Pointer", FIND + """// Drag the ball with the mouse. Until you do, the demo drags it once itself.
var ball = find("Ball").body, hand = find("Hand").joint, strength = hand.maxForce, mine = false;
hand.maxForce = 0;
function grab(point) { hand.setTarget(point); hand.maxForce = strength; }
function drop() { hand.maxForce = 0; }
JetSystem.addEventListener("onPointerDown", function (event) {
    mine = true;
    if (ball.contains(event.point)) grab(event.point);
});
JetSystem.addEventListener("onPointerMove", function (event) { if (mine && hand.maxForce > 0) hand.setTarget(event.point); });
JetSystem.addEventListener("onPointerUp", function () {
    if (mine && hand.maxForce > 0) print("dropped at", ball.position.x.toFixed(0), ball.position.y.toFixed(0));
    drop();
});
JetSystem.addEventListener("onStep", function (event) {
    if (mine) return;
    var t = event.time - 1;
    if (event.step === 60) grab(ball.position);
    if (t > 0 && t < 3) hand.setTarget(160 + 40 * t, 296 - 60 * Math.min(t, 2));
    if (event.step === 240) { print("pull", hand.force.getMagnitude() < strength, "apart", hand.value < 20); drop(); }
});
""")
    write("dragging", "Dragging", s, 480, [{"output": "pull true apart true"}, {"item": "Ball", "x": [270, 420], "y": [294, 298]}], picture=200)


def touches():
    s = Scene()
    s.ground()
    for x in (30, 610):
        s.fixed("Side", rectangle(x, 220, 20, 200), STEEL)
    s.fixed("Gate", rectangle(320, 160, 580, 12), "#bfe3c6", sensor=True)
    for k in range(12):
        s.rigid(f"Ball {k + 1}", circle(90 + 42 * k, 90 - 37 * (k % 3), 12), [RED, BLUE, GOLD][k % 3])
    s.script("Counter", FIND + """// How many touch the ground, and how many went through the gate.
var ground = find("Ground"), gate = find("Gate"), on = 0, passed = 0, hardest = 0;
JetSystem.addEventListener("onContactBegin", function (event) {
    hardest = Math.max(hardest, event.impulse);
    if (event.itemA === ground || event.itemB === ground) on++;
});
JetSystem.addEventListener("onContactEnd", function (event) {
    if (event.itemA === ground || event.itemB === ground) on--;
    if (event.itemA === gate || event.itemB === gate) passed++;
});
JetSystem.addEventListener("onPostPaint", function (event) {
    if (event.step === 600) print("passed", passed, "on the ground", on, "hard", hardest > 100);
});
""")
    write("touches", "Touches", s, 600, [{"said": "passed 12 on the ground 12 hard true"}], picture=95)


def teaching():
    s = Scene()
    # Twenty steps a second, so that the method is seen: after two seconds y = g dt^2 n (n + 1) / 2 = 201.1, not g t^2 / 2 = 196.2.
    s.settings = {"method": "semi-implicit-euler", "time-step": 0.05, "substeps": 1, "allow-sleep": False}
    s.rigid("Falling", circle(200, 40, 14), RED)
    s.fixed("As by Galilei", rectangle(300, 236.2, 80, 2), STEEL, sensor=True)
    s.fixed("As by Euler", rectangle(300, 241.1, 80, 2), GREEN, sensor=True)
    s.rigid("Swinging", rectangle(480, 140, 28, 28), BLUE)
    s.actuator("spring", "Spring", line((480, 60), (480, 140)), ks=10, kd=0)
    write("teaching", "Teaching mode", s, 40, [{"item": "Falling", "y": [241.05, 241.15]}, {"item": "Swinging", "x": [479, 481]}], JET_ALONE)


def forces():
    s = Scene()
    s.ground()
    # Half of its weight, all of it, and a push off the centre.
    for name, x, value, y in (("Half", 120, (0, -49.05), 120), ("Floating", 280, (0, -98.1), 120)):
        s.rigid(name, rectangle(x, y, 40, 40), [RED, BLUE][name == "Floating"])
        s.actuator("force", f"{name} lift", rectangle(x, y, 8, 8), value=value)
    s.rigid("Rocket", polygon([(430, 300), (430, 250), (440, 230), (450, 250), (450, 300)]), GOLD, fixed_rotation=True)
    s.actuator("force", "Engine", rectangle(440, 275, 8, 8), value=(0, 0))
    s.script("Start", FIND + """var engine = find("Engine").force;
JetSystem.addEventListener("onStep", function (event) {
    if (event.step === 30) engine.setValue(0, -150);
    if (event.step === 90) { print("engine off", engine.value); engine.setValue(0, 0); }
});
""")
    write("forces", "Forces", s, 120, [{"item": "Half", "y": [216, 221]}, {"item": "Floating", "y": [119, 121]},
                                      {"item": "Rocket", "y": [180, 262]}, {"output": "engine off (0, -150)"}], BOTH, picture=70)
