// What scripts get that needs no C++: vectors, areas, scenes, and the names under which all is found. Evaluated once a
// runtime, before any script. The kit brings what is in C++: functions, and prototypes with their accessors (see heap.cpp).
(function (kit) {
    'use strict';
    var global = kit.global;

    function hidden(object, methods) {
        Object.keys(methods).forEach(function (name) {
            Object.defineProperty(object, name, { value: methods[name], writable: true, configurable: true });
        });
        return object;
    }

    // --- Vec2d: the thesis's class. add, sub, scale, ... change the vector and return it; get... return a new one.

    function Vec2d(x, y) {
        if (x === undefined) {
            this.x = 0;
            this.y = 0;
        } else if (typeof x === 'object' && x !== null) {
            this.x = +x.x;
            this.y = +x.y;
        } else {
            this.x = +x;
            this.y = y === undefined ? 0 : +y;
        }
    }

    hidden(Vec2d.prototype, {
        set: function (x, y) { this.x = +x; this.y = +y; return this; },
        become: function (v) { this.x = v.x; this.y = v.y; return this; },
        add: function (v) { this.x += v.x; this.y += v.y; return this; },
        sub: function (v) { this.x -= v.x; this.y -= v.y; return this; },
        scale: function (s) { this.x *= s; this.y *= s; return this; },
        normalize: function () {
            var m = this.getMagnitude();
            return m > 0 ? this.set(this.x / m, this.y / m) : this;
        },
        rotate: function (angle) {
            var c = Math.cos(angle), s = Math.sin(angle), x = this.x;
            this.x = c * x - s * this.y;
            this.y = s * x + c * this.y;
            return this;
        },
        getAdded: function (v) { return new Vec2d(this.x + v.x, this.y + v.y); },
        getSubbed: function (v) { return new Vec2d(this.x - v.x, this.y - v.y); },
        getScaled: function (s) { return new Vec2d(this.x * s, this.y * s); },
        getNormalized: function () { return new Vec2d(this).normalize(); },
        getRotated: function (angle) { return new Vec2d(this).rotate(angle); },
        getPerp: function () { return new Vec2d(-this.y, this.x); },
        getMagnitude: function () { return Math.sqrt(this.x * this.x + this.y * this.y); },
        getDistance: function (v) {
            var dx = this.x - v.x, dy = this.y - v.y;
            return Math.sqrt(dx * dx + dy * dy);
        },
        dot: function (v) { return this.x * v.x + this.y * v.y; },
        cross: function (v) { return this.x * v.y - this.y * v.x; },
        equals: function (v) { return this.x === v.x && this.y === v.y; },
        clone: function () { return new Vec2d(this.x, this.y); },
        toString: function () { return '(' + this.x + ', ' + this.y + ')'; }
    });
    kit.Vec2d = Vec2d.prototype;
    // Vectors that are a body's state: their x and y are accessors in C++.
    [kit.Position, kit.Velocity, kit.Gravity].forEach(function (live) { Object.setPrototypeOf(live, Vec2d.prototype); });
    hidden(global, { Vec2d: Vec2d });

    // --- BoundingArea: what body.getBoundingArea() gives; x and y are its top-left corner.

    kit.BoundingArea = hidden({}, {
        getCenter: function () { return new Vec2d(this.x + this.width * 0.5, this.y + this.height * 0.5); },
        getWidth: function () { return this.width; },
        getHeight: function () { return this.height; },
        contains: function (v) {
            return v.x >= this.x && v.x <= this.x + this.width && v.y >= this.y && v.y <= this.y + this.height;
        },
        toString: function () { return '(' + this.x + ', ' + this.y + ') ' + this.width + ' x ' + this.height; }
    });

    // --- Items, bodies and actuators: most of them is in C++.

    ['body', 'torque', 'spring', 'force', 'joint'].forEach(function (part) { Object.defineProperty(kit.Item, part, { value: null }); });
    hidden(kit.Item, {
        toString: function () { return this.name; },
        getParent: function () { return this.parent; }
    });
    hidden(kit.Body, {
        getPosition: function () { return this.position.clone(); },
        getVelocity: function () { return this.velocity.clone(); },
        toString: function () { return 'body of ' + this.item.name; }
    });

    // The values of springs and motors are the properties of their items, under names of the language.
    function properties(prototype, pairs) {
        pairs.forEach(function (pair) {
            Object.defineProperty(prototype, pair[0], {
                enumerable: true,
                get: function () { return this.item.has(pair[1]) ? this.item.get(pair[1]) : undefined; },
                set: function (value) { this.item.set(pair[1], value); }
            });
        });
    }
    properties(kit.Spring, [['ks', 'ks'], ['kd', 'kd'], ['restLength', 'rest-length'], ['tearRatio', 'tear-ratio'],
        ['restAngle', 'rest-angle']]);
    properties(kit.Force, [['value', 'value']]);
    hidden(kit.Force, {
        getValue: function () { return this.value; },
        setValue: function (x, y) { this.value = typeof x === 'object' ? x : { x: x, y: y }; }
    });
    properties(kit.Joint, [['kind', 'kind'], ['motor', 'driven'], ['motorSpeed', 'motor-speed'], ['maxForce', 'max-force'],
        ['maxTorque', 'max-torque']]);
    hidden(kit.Joint, {
        setMotor: function (on, speed) {
            if (typeof on !== 'boolean') throw new TypeError("setMotor: 'on' must be true or false");
            if (speed !== undefined) this.motorSpeed = speed;  // refuses what is no number before anything changed
            this.motor = on;
        },
        toString: function () { return 'joint ' + this.item.name; }
    });

    // --- Events

    var types = ['onStep', 'onPrePaint', 'onPostPaint', 'onKeyUp', 'onKeyDown', 'onKeyTyped', 'onBodyCollision',
        'onPointerDown', 'onPointerUp', 'onPointerMove', 'onContactBegin', 'onContactEnd'];
    var JetSystem = {};
    types.forEach(function (type) { JetSystem['EVENT_TYPE_' + type.toUpperCase()] = type; });
    JetSystem.addEventListener = kit.addEventListener;
    JetSystem.removeEventListener = kit.removeEventListener;
    JetSystem.playScene = kit.playScene;

    // --- Keyboard

    var keys = Object.create(null);
    var Keyboard = {
        getKey: function (name) {
            name = kit.keyName(name);
            if (!keys[name]) {
                keys[name] = hidden({ name: name }, {
                    isPressed: function () { return kit.isPressed(name); },
                    toString: function () { return name; }
                });
            }
            return keys[name];
        }
    };

    // --- Scenes: the running one, and facades of the others, which only have a name and a view nobody sees.

    var deaf = {
        getWidth: function () { return view.getWidth(); },
        getHeight: function () { return view.getHeight(); },
        getViewScale: function () { return 1; },
        getViewAnchor: function () { return new Vec2d(); },
        setViewScale: function () {},
        setViewAnchor: function () {}
    };
    var view = Object.create(kit.View);
    var scenes = Object.create(null);

    function scene(name, running) {
        return hidden({ name: name, GC: { swingSimulationGP: running ? view : deaf } }, {
            getTopGroup: function () { return running ? kit.topGroup() : null; },
            toString: function () { return name; }
        });
    }

    var CC = {
        getScene: function (name) {
            name = String(name);
            if (scenes[name] === undefined) {
                var found = kit.findScene(name);  // 'running', 'other' or 'none'
                if (found === 'none') return null;
                scenes[name] = scene(name, found === 'running');
            }
            return scenes[name];
        },
        GUIC: { printlnToOutput: kit.print }
    };

    // --- The rest

    var console = { log: kit.print, info: kit.print, debug: kit.print, warn: kit.printWarning, error: kit.printError };
    var System = { currentTimeMillis: Date.now };
    var ItemUtils = {
        getTopGroup: kit.getTopGroup,
        getItemByName: kit.getItemByName,
        getClosestItemByName: kit.getClosestItemByName
    };

    // colTab[a][b]: one row object a body, made when first asked for; whether two touch is asked of the physics engine.
    var row = { get: kit.touching };
    var rows = Object.create(null);
    var colTab = new Proxy({}, {
        get: function (target, cti) {
            return rows[cti] || (rows[cti] = new Proxy({ cti: +cti }, row));
        }
    });
    Object.defineProperty(kit.ctx, 'colTab', { value: colTab, enumerable: true });

    hidden(global, {
        JetSystem: JetSystem, ItemUtils: ItemUtils, Keyboard: Keyboard, CC: CC, System: System, console: console,
        print: kit.print, println: kit.print, ctx: kit.ctx
    });

    // What leads out of the limits or is not the same in each run: coroutines and finalizers (Duktape), wall time, and
    // strings of raw bytes, which could forge hidden keys.
    ['Duktape', 'CBOR', 'performance', 'Buffer'].forEach(function (name) { delete global[name]; });
    delete String.fromBufferRaw;
})
