"""Demos of rigid bodies and joints: both engines play them."""
import math

from scene import BLUE, GOLD, GREEN, GREY, RED, STEEL, WOOD, Scene, circle, line, polygon, rectangle, turned, write


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


def sleeping():
    s = Scene()
    s.ground()
    for k in range(6):
        s.rigid(f"Box {k + 1}", rectangle(480, 305 - 30 * k, 30, 30), [WOOD, GOLD][k % 2])
    # A quarter of a minute from one side to the other, and still for a while at its turning points.
    s.fixed("Beam", rectangle(200, 40, 160, 10), STEEL)
    s.rigid("Pendulum", circle(280, 214, 22), RED, 40, gravity_scale=0.07)
    s.joint("Pin", line((200, 40), (200, 40), (280, 214)), "revolute")
    write("sleeping", "Sleeping", s, 1000, [
        {"item": "Pendulum", "x": [116, 128], "awake": True}, {"item": "Box 1", "awake": False},
        {"item": "Box 6", "awake": False}, {"count": "Box *", "inside": [464, 130, 496, 322], "is": 6}], picture=500)


def distance():
    s = Scene()
    s.fixed("Beam", rectangle(320, 30, 600, 12), STEEL)
    s.rigid("Pendulum", circle(200, 90, 14), RED, 2)
    s.joint("Rod", line((120, 34), (200, 90)), "distance")
    # A weight sinks by g / (2 pi f)^2: 9.9 units at 0.5 Hz, 2.5 at 1 Hz.
    for name, x, hertz in (("Soft", 270, 0.5), ("Firm", 340, 1)):
        s.rigid(f"{name} weight", rectangle(x, 130, 30, 30), GOLD, 2, fixed_rotation=True)
        s.joint(f"{name} spring", line((x, 34), (x, 130)), "distance", hertz=hertz, damping_ratio=0.3)
    s.rigid("Left end", circle(500, 120, 12), BLUE)
    s.rigid("Right end", circle(560, 80, 12), GREEN)
    s.joint("Bar", line((500, 120), (560, 80)), "distance")
    s.joint("Hanger", line((500, 34), (500, 120)), "distance")
    s.ground()
    write("distance", "Distance joints", s, 600, [
        {"item": "Pendulum", "distance": [120, 34], "from": [97, 98.5]},
        {"item": "Soft weight", "y": [139.4, 140.4]}, {"item": "Firm weight", "y": [132, 133]},
        {"item": "Left end", "distance": [500, 34], "from": [85.5, 86.5]}], picture=45)


def motor_joint():
    s = Scene()
    s.ground()
    # Of the mass 1 and friction 0.6 each, the ground holds a trolley with 59 mass units / s^2.
    for name, y, color, force in (("Strong", 308, BLUE, 200), ("Weak", 308, RED, 30)):
        x = 120 if name == "Strong" else 480
        s.rigid(f"{name} trolley", rectangle(x, y, 50, 24), color, fixed_rotation=True)
        s.joint(f"{name} motor", line((x, 200), (x, y)), "motor", driven=True, motor_velocity=(60, 0), max_force=force)
    s.rigid("Rotor", rectangle(320, 110, 120, 16), GOLD, 2, gravity_scale=0)
    s.joint("Rotor motor", line((320, 40), (320, 110)), "motor", driven=True, motor_speed=3, max_torque=20000, max_force=1e5)
    write("motor-joint", "Motor joints", s, 240, [
        {"item": "Strong trolley", "x": [335, 361]}, {"item": "Weak trolley", "x": [479.5, 480.5]},
        {"item": "Rotor", "omega": [2.99, 3.01], "x": [319.5, 320.5]}], picture=120)


def mouse():
    s = Scene()
    s.ground()
    s.fixed("Sill", rectangle(320, 200, 12, 120), STEEL)
    for name, x, color, force in (("Pulled", 160, RED, 5000), ("Heavy", 480, GREY, 50)):
        s.rigid(name, rectangle(x, 306, 28, 28), color)
        s.joint(f"Hand at {name}", line((x + (60 if x < 320 else -60), 120), (x, 306)), "mouse", hertz=2, damping_ratio=0.7,
                max_force=force)
    write("mouse", "Mouse joints", s, 300, [{"item": "Pulled", "distance": [220, 120], "from": [0, 1]},
                                           {"item": "Heavy", "y": [300, 310]}], picture=40)


def torque():
    s = Scene()
    s.ground()
    # Two seconds at torque / moment of inertia = 2 rad / s^2; positive turns left.
    for name, x, value in (("Left", 180, 1800), ("Right", 460, -1800)):
        s.rigid(f"{name} turner", rectangle(x, 130, 108 ** 0.5 * 5, 108 ** 0.5 * 5), [RED, BLUE][value < 0], 2, gravity_scale=0)
        s.actuator("torque", f"{name} torque", rectangle(x, 130, 20, 20), value=value)
    s.rigid("Wheel", circle(120, 290, 30), GOLD, 2)
    s.actuator("torque", "Drive", rectangle(120, 290, 16, 16), value=-2000)
    write("torque", "Torques", s, 120, [{"item": "Left turner", "omega": [-4.05, -3.95]}, {"item": "Right turner", "omega": [3.95, 4.05]},
                                        {"item": "Wheel", "x": [150, 240], "omega": [0.5, 4]}])


def angular_spring():
    s = Scene()
    s.settings = {"angular-damping": 4}
    s.fixed("Post", rectangle(65, 180, 50, 300), STEEL, group=1)
    for name, y, color, ks in (("Soft", 80, RED, 8e4), ("Firm", 200, BLUE, 1e6)):
        s.rigid(f"{name} lever", rectangle(170, y, 200, 12), color, 4, group=1)
        s.joint(f"{name} hinge", line((60, y), (80, y), (170, y)), "revolute")
        s.actuator("rspring", f"{name} spring", line((80, y - 30), (80, y), (170, y)), ks=ks, kd=0)
    # Held at a right angle, though nothing else joins them.
    s.rigid("Arm", rectangle(440, 150, 120, 10), GOLD, 2, group=2)
    s.rigid("Hand", rectangle(495, 205, 10, 100), GREEN, 1, group=2)
    s.joint("Elbow", line((440, 150), (495, 155), (495, 205)), "revolute")
    s.joint("Shoulder", line((385, 60), (385, 150), (440, 150)), "weld")
    s.actuator("rspring", "Elbow spring", line((440, 150), (495, 155), (495, 205)), ks=3e5, kd=3e3)
    s.ground()
    # ks angle = m g l cos(angle): 0.4056 and 0.0353
    write("angular-spring", "Angular springs", s, 600, [
        {"item": "Firm lever", "angle": [0.035, 0.041]}, {"item": "Soft lever", "angle": [0.4, 0.412]},
        {"item": "Hand", "angle": [-0.02, 0.02]}], picture=300)


def materials():
    s = Scene()
    s.materials = ["default", "ice", "wood", "rubber", "ghost"]
    s.pairs = {("default", "ice"): (0.02, 0, True), ("default", "wood"): (0.4, 0.5, True), ("default", "rubber"): (0.9, 0.9, True),
               ("default", "ghost"): (0, 0, False)}
    s.fixed("Slope", polygon([(40, 60), (340, 160), (340, 176), (40, 76)]), STEEL)  # tan = 1/3: between ice and wood
    angle, out = math.atan2(100, 300), 12
    for name, along, color in (("rubber", 60, RED), ("wood", 120, WOOD), ("ice", 180, BLUE)):
        s.rigid(f"Block of {name}", turned(40 + along * math.cos(angle) + out * math.sin(angle),
                                           60 + along * math.sin(angle) - out * math.cos(angle), 26, 24, angle), color, material=name)
    s.ground()
    for name, x, color in (("ice", 430, BLUE), ("wood", 490, WOOD), ("rubber", 550, RED), ("ghost", 610, GREY)):
        s.rigid(f"Ball of {name}", circle(x, 150, 14), color, material=name)
    write("materials", "Materials", s, 135, [
        {"item": "Block of rubber", "x": [97, 102]}, {"item": "Block of wood", "x": [153, 160]}, {"item": "Block of ice", "x": [280, 1e9]},
        {"item": "Ball of ice", "y": [304, 308]}, {"item": "Ball of rubber", "above": "Ball of wood", "by": 25},
        {"item": "Ball of wood", "above": "Ball of ice", "by": 10}, {"item": "Ball of ghost", "y": [380, 1e9]}])


def layers():
    s = Scene()
    # Layers are bits: red things are on 2, blue ones on 4. A floor meets its colour alone; both sides must agree.
    for name, y, color, bit in (("Red", 150, RED, 2), ("Blue", 250, BLUE, 4)):
        s.fixed(f"{name} floor", rectangle(320, y, 420, 10), color, layer=bit, mask=bit)
    for k in range(6):
        name, color, bit = [("Red", RED, 2), ("Blue", BLUE, 4)][k % 2]
        s.rigid(f"{name} ball {k // 2 + 1}", circle(170 + 60 * k, 60, 14), color, layer=bit, mask=6, gravity_scale=1)
    for k in range(2):
        s.rigid(f"Box {k + 1}", rectangle(250 + 140 * k, 30, 22, 22), WOOD)  # on layer 1: neither floor meets it
    s.ground()
    write("layers", "Layers and masks", s, 240, [
        {"count": "Red ball *", "inside": [110, 125, 530, 145], "is": 3}, {"count": "Blue ball *", "inside": [110, 225, 530, 245], "is": 3},
        {"count": "Box *", "inside": [110, 300, 530, 320], "is": 2}], picture=90)


def kinematic():
    s = Scene()
    s.ground()
    s.rigid("Lift", rectangle(140, 220, 160, 12), STEEL, kinematic=True, velocity=(30, 0))
    for k in range(3):
        s.rigid(f"Rider {k + 1}", rectangle(110 + 30 * k, 201, 24, 24), [WOOD, GOLD, WOOD][k])
    s.rigid("Mill", polygon([(470, 174), (554, 174), (554, 186), (470, 186)]), RED, kinematic=True, omega=3)
    s.rigid("Ball", circle(520, 60, 12), BLUE)
    s.script("Driver", """// A kinematic body goes on as it was told, whatever lies in its way; a script tells it to turn back.
var lift = ItemUtils.getItemByName("Lift", ItemUtils.getTopGroup(script)).body;
JetSystem.addEventListener("onStep", function () {
    if (lift.position.x > 300) lift.setVelocity(-30, 0);
    if (lift.position.x < 140) lift.setVelocity(30, 0);
});
""")
    write("kinematic", "Kinematic bodies", s, 420, [
        {"count": "Rider *", "inside": [180, 195, 380, 206], "is": 3}, {"item": "Lift", "y": [219.9, 220.1]},
        {"item": "Mill", "omega": [2.99, 3.01], "x": [511.9, 512.1]}, {"item": "Ball", "y": [200, 1e9]}], picture=100)


def fixed_rotation():
    s = Scene()
    s.ground()
    for name, x, color, never in (("Turner", 180, GREY, False), ("Upright", 460, RED, True)):
        s.fixed(f"{name} edge", rectangle(x - 12, 270, 30, 100), STEEL)
        s.rigid(name, rectangle(x + 10, 180, 20, 60), color, fixed_rotation=never)
    write("fixed-rotation", "Never turning", s, 360, [{"item": "Upright", "angle": [-1e-6, 1e-6]},
                                                      {"item": "Turner", "angle": [1, 2]}], picture=150)
