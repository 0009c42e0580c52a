// The API of scripts in a playing JET scene, beside the language itself: ECMAScript 5.1, and of later editions what Duktape
// 2.7 has (Proxy, Reflect, Symbol, typed arrays, `**`; no `let`, arrow functions, classes or promises).
//
// Coordinates are scene units with y growing downwards, times are seconds unless a name says otherwise, angles are radians
// growing clockwise on screen. docs/script-api.md shows each part in use.

/** A vector. Methods named by a verb change it and return it; those with `get` return a new one. @since 0.1 */
declare class Vec2d {
    /** The zero vector. */
    constructor();
    constructor(x: number, y: number);
    /** A copy. */
    constructor(v: Point);
    x: number;
    y: number;
    set(x: number, y: number): this;
    /** Takes on the values of another vector. */
    become(v: Point): this;
    add(v: Point): this;
    sub(v: Point): this;
    scale(factor: number): this;
    /** To length 1; the zero vector stays as it is. */
    normalize(): this;
    /** Turns clockwise on screen. */
    rotate(angle: number): this;
    getAdded(v: Point): Vec2d;
    getSubbed(v: Point): Vec2d;
    getScaled(factor: number): Vec2d;
    getNormalized(): Vec2d;
    getRotated(angle: number): Vec2d;
    /** Turned a quarter clockwise on screen: (-y, x). */
    getPerp(): Vec2d;
    getMagnitude(): number;
    getDistance(v: Point): number;
    dot(v: Point): number;
    /** x1 y2 - y1 x2 */
    cross(v: Point): number;
    equals(v: Point): boolean;
    clone(): Vec2d;
    /** `(x, y)` */
    toString(): string;
}

/** Anything with coordinates. @since 0.1 */
interface Point {
    x: number;
    y: number;
}

/** An axis-parallel box; x and y are its top-left corner. @since 0.1 */
interface BoundingArea {
    readonly x: number;
    readonly y: number;
    readonly width: number;
    readonly height: number;
    getCenter(): Vec2d;
    getWidth(): number;
    getHeight(): number;
    contains(point: Point): boolean;
    toString(): string;
}

/** An item of the playing scene. The same item is always the same object; scripts may add fields of their own. @since 0.1 */
interface Item {
    name: string;
    /** As in the scene's file. */
    readonly id: number;
    /** "group", "layer", "shape", "body", "script", "spring", "rspring", "torque", or a plugin's type. */
    readonly type: string;
    visible: boolean;
    readonly locked: boolean;
    /** Null for the top group. */
    readonly parent: Item | null;
    getParent(): Item | null;
    /** The next item of the same parent. */
    getSibling(): Item | null;
    /** The one before it. */
    getPriorSibling(): Item | null;
    getChildList(): Item[];
    /** Of the body where it is now, else of the drawing. */
    getBoundingArea(): BoundingArea;
    /** Has it this property? */
    has(property: string): boolean;
    /** A property by its id, as the Inspector shows them. Throws for an unknown one. */
    get(property: string): any;
    /** Sets a property of the playing copy and its world. Throws where that stays as it is while playing. */
    set(property: string, value: any): void;
    /** Null for an item without a physical body. */
    readonly body: Body | null;
    /** Null for what is no torque item. */
    readonly torque: Torque | null;
    /** Null for what is no spring or angular spring. */
    readonly spring: Spring | null;
    /** Null for what is no constant force, and for one without a body under its centre. */
    readonly force: Force | null;
    /** Null for what is no joint, and for one that could not be made when play started. */
    readonly joint: Joint | null;
    /** The name. */
    toString(): string;
}

/** The physical body of an item, soft or rigid. @since 0.1 */
interface Body {
    readonly item: Item;
    /** Index into ctx.colTab. */
    readonly cti: number;
    /** Centre of mass. Live: reads and writes the body; copy it with `new Vec2d(body.position)`. */
    position: Vec2d;
    /** Of the centre of mass, units/s. Live. */
    velocity: Vec2d;
    /** Turned since the start of play. */
    readonly angle: number;
    /** rad/s */
    omega: number;
    /** A copy of the position. */
    getPosition(): Vec2d;
    /** A copy of the velocity. */
    getVelocity(): Vec2d;
    setPosition(x: number, y: number): void;
    setPosition(point: Point): void;
    setVelocity(x: number, y: number): void;
    setVelocity(velocity: Point): void;
    setOmega(omega: number): void;
    /** Force at the centre of mass, for the next step only. */
    applyForce(x: number, y: number): void;
    applyForce(force: Point): void;
    /** Changes the velocity by impulse / mass, at once. */
    applyImpulse(x: number, y: number): void;
    applyImpulse(impulse: Point): void;
    getBoundingArea(): BoundingArea;
    contains(x: number, y: number): boolean;
    contains(point: Point): boolean;
    /** Did they touch in the last step? */
    isTouching(other: Body | Item): boolean;
    toString(): string;
}

/** A torque about the centre of its item. Positive turns left, counter-clockwise on screen. @since 0.1 */
interface Torque {
    readonly item: Item;
    value: number;
    getValue(): number;
    setValue(value: number): void;
}

/** A spring's values. @since 0.1 */
interface Spring {
    readonly item: Item;
    /** Stiffness. */
    ks: number;
    /** Damping. */
    kd: number;
    /** Springs: -1 is the length as drawn. */
    restLength: number | undefined;
    /** Springs: tears at this multiple of the rest length; 0 never. */
    tearRatio: number | undefined;
    /** Angular springs. */
    readonly restAngle: number | undefined;
}

/** A constant force on the body under the centre of its item, in directions of the scene. @since 0.1 */
interface Force {
    readonly item: Item;
    /** mass·unit/s². A copy: set it as a whole. */
    value: Vec2d;
    getValue(): Vec2d;
    setValue(x: number, y: number): void;
    setValue(force: Point): void;
}

/** Holds two bodies together, or one to the background. Angles and torques grow clockwise on screen. @since 0.1 */
interface Joint {
    readonly item: Item;
    readonly kind: "revolute" | "prismatic" | "weld" | "distance" | "rope" | "wheel" | "motor" | "mouse" | "pulley";
    /** Angle of b against a in radians, or travel or distance in units, whichever the kind has; since it was made. */
    readonly value: number;
    /** On b, of the last step; mass·unit/s². */
    readonly force: Vec2d;
    /** On b, of the last step. */
    readonly torque: number;
    readonly broken: boolean;
    /** Where it holds the two, in the scene. */
    readonly pointA: Vec2d;
    readonly pointB: Vec2d;
    /** Is the motor on? */
    motor: boolean;
    /** rad/s, or units/s along a slide. */
    motorSpeed: number;
    /** The most the motor or mouse has. */
    maxForce: number;
    maxTorque: number;
    setMotor(on: boolean, speed?: number): void;
    /** Moves the end that holds the background: what a mouse joint pulls to. */
    setTarget(x: number, y: number): void;
    setTarget(point: Point): void;
    /** For good: it holds nothing from the next step on. */
    remove(): void;
    toString(): string;
}

/** What listeners are called with. @since 0.1 */
interface JetEvent {
    type: EventType;
}
/** onStep comes before a step; onPrePaint and then onPostPaint after it and its collisions. @since 0.1 */
interface StepEvent extends JetEvent {
    /** Steps made so far. */
    step: number;
    /** Simulated seconds so far. */
    time: number;
}
/** @since 0.1 */
interface KeyboardEvent extends JetEvent {
    /** As Keyboard.getKey names it. */
    key: string;
    /** What was typed; may be empty. */
    text: string;
    /** Held down, and sent again. */
    repeat: boolean;
    shift: boolean;
    alt: boolean;
    control: boolean;
}
/** @since 0.1 */
interface PointerEvent extends JetEvent {
    /** In the scene. */
    x: number;
    y: number;
    /** In the scene. */
    point: Vec2d;
    /** In the view, from its top-left corner. */
    pixels: Vec2d;
    button: "none" | "left" | "right" | "middle";
    shift: boolean;
    alt: boolean;
    control: boolean;
}
/** Two bodies touch: one event a pair and step. @since 0.1 */
interface CollisionEvent extends JetEvent {
    itemA: Item;
    itemB: Item;
    bodyA: Body;
    bodyB: Body;
    point: Vec2d;
    /** Length 1, from B towards A. */
    normal: Vec2d;
    penetration: number;
    /** Along the normal, of the last step. */
    impulse: number;
}

/** Two bodies that did not touch begin to, or two that did end; each pair by turns. @since 0.1 */
interface ContactEndEvent extends JetEvent {
    itemA: Item;
    itemB: Item;
    bodyA: Body;
    bodyB: Body;
}
/** @since 0.1 */
interface ContactBeginEvent extends JetEvent {
    itemA: Item;
    itemB: Item;
    bodyA: Body;
    bodyB: Body;
    /** Where they push hardest; null if the engine does not tell. */
    point: Vec2d | null;
    /** Unit, from B to A; null as the point. */
    normal: Vec2d | null;
    /** Of the step in which they began, along their normals. */
    impulse: number;
}

/** @since 0.1 */
type EventType = "onStep" | "onPrePaint" | "onPostPaint" | "onKeyUp" | "onKeyDown" | "onKeyTyped" | "onBodyCollision"
    | "onPointerDown" | "onPointerUp" | "onPointerMove" | "onContactBegin" | "onContactEnd";

/** Events, and the way to another scene. @since 0.1 */
declare var JetSystem: {
    readonly EVENT_TYPE_ONSTEP: "onStep";
    readonly EVENT_TYPE_ONPREPAINT: "onPrePaint";
    readonly EVENT_TYPE_ONPOSTPAINT: "onPostPaint";
    readonly EVENT_TYPE_ONKEYUP: "onKeyUp";
    readonly EVENT_TYPE_ONKEYDOWN: "onKeyDown";
    readonly EVENT_TYPE_ONKEYTYPED: "onKeyTyped";
    readonly EVENT_TYPE_ONBODYCOLLISION: "onBodyCollision";
    readonly EVENT_TYPE_ONPOINTERDOWN: "onPointerDown";
    readonly EVENT_TYPE_ONPOINTERUP: "onPointerUp";
    readonly EVENT_TYPE_ONPOINTERMOVE: "onPointerMove";
    readonly EVENT_TYPE_ONCONTACTBEGIN: "onContactBegin";
    readonly EVENT_TYPE_ONCONTACTEND: "onContactEnd";
    /** Calls the function at each such event, in the order of adding; once, however often it was added. */
    addEventListener(type: "onStep" | "onPrePaint" | "onPostPaint", listener: (event: StepEvent) => void): void;
    addEventListener(type: "onKeyUp" | "onKeyDown" | "onKeyTyped", listener: (event: KeyboardEvent) => void): void;
    addEventListener(type: "onBodyCollision", listener: (event: CollisionEvent) => void): void;
    addEventListener(type: "onContactBegin", listener: (event: ContactBeginEvent) => void): void;
    addEventListener(type: "onContactEnd", listener: (event: ContactEndEvent) => void): void;
    addEventListener(type: "onPointerDown" | "onPointerUp" | "onPointerMove", listener: (event: PointerEvent) => void): void;
    removeEventListener(type: EventType, listener: Function): void;
    /** Goes to another scene after this step. */
    playScene(name: string): void;
};

/** Finding items. @since 0.1 */
declare var ItemUtils: {
    getTopGroup(item: Item): Item;
    /** The first of that name in the tree under `root`, depth first. */
    getItemByName(name: string, root: Item): Item | null;
    /** The nearest of that name: siblings, then their subtrees, then the same one level up, and so on. */
    getClosestItemByName(name: string, from: Item): Item | null;
};

/** @since 0.1 */
declare var Keyboard: {
    /** "A" to "Z", "0" to "9", "Left", "Right", "Up", "Down", "Space", "Enter", "Escape", "F1", ... or a character. */
    getKey(name: string): Key;
};

/** @since 0.1 */
interface Key {
    readonly name: string;
    isPressed(): boolean;
    toString(): string;
}

/** The control center. @since 0.1 */
declare var CC: {
    /** The running scene by its name; for another scene of the project a facade without items. Null, with a warning, for none. */
    getScene(name: string): Scene | null;
    GUIC: {
        printlnToOutput(text: any): void;
    };
};

/** @since 0.1 */
interface Scene {
    readonly name: string;
    /** The scene's graphics center. */
    GC: {
        /** The view of the running game. */
        swingSimulationGP: SceneView;
    };
    /** Null for a scene that is not running. */
    getTopGroup(): Item | null;
    toString(): string;
}

/** The camera of the running game. @since 0.1 */
interface SceneView {
    /** Pixels. */
    getWidth(): number;
    getHeight(): number;
    /** Pixels a scene unit. */
    getViewScale(): number;
    setViewScale(scale: number): void;
    /** The point of the scene in the view's top-left corner. */
    getViewAnchor(): Vec2d;
    setViewAnchor(x: number, y: number): void;
    setViewAnchor(point: Point): void;
}

/** Where a ray or a shape first meets a body, or the nearest point of one. @since 0.1 */
interface Hit {
    /** Null where no item draws the body. */
    readonly item: Item | null;
    readonly body: Body | null;
    /** In the scene. */
    readonly point: Vec2d;
    /** Length 1, out of the body. */
    readonly normal: Vec2d;
    /** 0 to 1 of the way, or of the reach. */
    readonly fraction: number;
    /** The same in units: how far the shape or ray came, or how far the point is. */
    readonly distance: number;
}

/** Which bodies a query sees. @since 0.1 */
interface QueryOptions {
    /** Bits: the layers that are seen; all, unless it is given. */
    mask?: number;
    /** Is looked through. */
    except?: Item | Body;
    /** Are sensors seen? They are not, unless it is given. */
    sensors?: boolean;
}

/** A circle, a capsule around a line, or a convex polygon of 3 to 8 points; in the scene. @since 0.1 */
type CastShape = { center: Point; radius: number } | { from: Point; to: Point; radius: number } | { points: Point[] };

/** The physical context of the running scene. @since 0.1 */
declare var ctx: {
    /** The first body on the way from one place to another; null for none. */
    rayCast(from: Point, to: Point, options?: QueryOptions): Hit | null;
    /** The first body that a shape meets when it is moved without turning; null for none. */
    shapeCast(shape: CastShape, way: Point, options?: QueryOptions): Hit | null;
    /** Items whose bodies meet the box, in the order of the tree. */
    overlapping(box: { x: number; y: number; width: number; height: number }, options?: QueryOptions): Item[];
    /** The point of any body that is nearest, no farther than `reach`; null for none. */
    nearest(point: Point, reach: number, options?: QueryOptions): Hit | null;
    /** colTab[a.body.cti][b.body.cti] is true while the two touch. */
    readonly colTab: { readonly [cti: number]: { readonly [cti: number]: boolean } };
    /** units/s². Live: `ctx.gravity.y = 0` acts at once. */
    gravity: Vec2d;
    /** Simulated seconds since play started. */
    readonly time: number;
    /** Steps made so far. */
    readonly step: number;
    /** Seconds a step. */
    readonly timeStep: number;
};

/** @since 0.1 */
declare var System: {
    /** Simulated milliseconds since play started, whole; as Date.now(). The same in each run. */
    currentTimeMillis(): number;
};

/** @since 0.1 */
declare var console: {
    log(...values: any[]): void;
    info(...values: any[]): void;
    debug(...values: any[]): void;
    /** With the script's name and line. */
    warn(...values: any[]): void;
    error(...values: any[]): void;
};

/** A line to the Output panel: all values as text, with a space between. @since 0.1 */
declare function print(...values: any[]): void;
/** The same as print. @since 0.1 */
declare function println(...values: any[]): void;

/** The script item whose code this is; in a listener, the one that added it. @since 0.1 */
declare var script: Item;
