/** The bicycle with its rider in three dimensions, on a road on which its path is drawn. */

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Values } from "./data";

type Point = THREE.Vector3;
const UP = new THREE.Vector3(0, 1, 0);
const TRAIL = 1500;

/** The field's axes (x forward, y right, z down) in those of the picture (x forward, y up, z right). */
const toPicture = (x: number, y: number, z: number): Point => new THREE.Vector3(x, -z, y);

const COLOURS = { frame: 0x2f4858, front: 0xb5487d, tyre: 0x222222, rider: 0xd9882b, skin: 0xe8b48a, torso: 0x3b7aa8 };
const PATHS = { rear: 0x0072b2, front: 0xd55e00 };

/** Rods between skeleton points: first point, second, radius (m), colour. */
const FRAME_RODS: [number, number, number, number][] = [
  [2, 5, 0.011, COLOURS.frame],
  [5, 10, 0.016, COLOURS.frame],
  [2, 10, 0.009, COLOURS.frame],
  [5, 11, 0.019, COLOURS.frame],
  [10, 12, 0.016, COLOURS.frame],
  [10, 13, 0.013, COLOURS.frame],
  [11, 12, 0.019, COLOURS.front],
  [7, 11, 0.013, COLOURS.front],
  [12, 16, 0.014, COLOURS.front],
  [17, 18, 0.012, COLOURS.front],
  [17, 19, 0.012, COLOURS.front],
  [18, 20, 0.012, COLOURS.front],
];
const LIMBS: [number, number, string, number][] = [
  [21, 23, "upper_arm", COLOURS.torso],
  [22, 24, "upper_arm", COLOURS.torso],
  [23, 19, "lower_arm", COLOURS.skin],
  [24, 20, "lower_arm", COLOURS.skin],
  [30, 28, "upper_leg", COLOURS.rider],
  [31, 29, "upper_leg", COLOURS.rider],
  [28, 26, "lower_leg", COLOURS.rider],
  [29, 27, "lower_leg", COLOURS.rider],
];

/** What the scene shows at an instant; angles in rad, lengths in m. */
export interface Pose {
  points: Float64Array | null;
  lean: number;
  steer: number;
  heading: number;
  x: number;
  y: number;
  rolled: number;
}

export class Scene {
  /** None in a browser that cannot draw in space: all but this picture works there too. */
  private readonly renderer: THREE.WebGLRenderer | null;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(38, 1, 0.05, 80);
  private readonly orbit: OrbitControls;
  private readonly bicycle = new THREE.Group();
  private readonly rods: THREE.Mesh[] = [];
  private readonly road: THREE.GridHelper;
  private readonly paths: Record<"rear" | "front", { line: THREE.Line; points: Float32Array; count: number }>;
  private wheels: { rear: THREE.Group; front: THREE.Group } | null = null;
  private torso: THREE.Mesh | null = null;
  private head: THREE.Mesh | null = null;
  private values: Values = {};
  follows = true;
  /** Whether something has changed since the last drawing. */
  stale = true;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = rendererOf(canvas);
    this.renderer?.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.camera.position.set(0.4, 1.5, 4.2);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.target.set(0.5, 0.75, 0);
    this.orbit.addEventListener("change", () => (this.stale = true));
    new ResizeObserver(() => (this.stale = true)).observe(canvas);
    this.orbit.enablePan = false;
    this.orbit.minDistance = 1;
    this.orbit.maxDistance = 20;
    const sun = new THREE.DirectionalLight(0xffffff, 2.2);
    sun.position.set(2, 5, 4);
    this.road = new THREE.GridHelper(60, 120, 0x999999, 0xcccccc);
    (this.road.material as THREE.Material).transparent = true;
    (this.road.material as THREE.Material).opacity = 0.45;
    this.paths = { rear: this.makePath(PATHS.rear), front: this.makePath(PATHS.front) };
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x777777, 1.6), sun, this.road, this.bicycle);
    this.bicycle.rotation.order = "YXZ";
  }

  private makePath(colour: number) {
    const points = new Float32Array(3 * TRAIL);
    const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(points, 3));
    const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: colour }));
    line.frustumCulled = false;
    this.scene.add(line);
    return { line, points, count: 0 };
  }

  /** Builds the bodies of a design. */
  build(values: Values, points: Float64Array | null): void {
    this.values = values;
    for (const child of [...this.bicycle.children]) this.bicycle.remove(child);
    this.rods.length = 0;
    this.torso = this.head = null;
    this.wheels = { rear: this.makeWheel(values.rear_wheel_radius), front: this.makeWheel(values.front_wheel_radius) };
    this.bicycle.add(this.wheels.rear, this.wheels.front);
    const rods: [number, number, number, number][] =
      points === null
        ? []
        : [...FRAME_RODS, ...LIMBS.map(([a, b, limb, colour]): [number, number, number, number] => [a, b, this.limbRadius(limb), colour])];
    for (const [, , radius, colour] of rods) this.rods.push(this.addRod(radius, colour));
    if (points === null) this.addBareFrame();
    else if ("rider_mass" in values) this.addTrunk();
  }

  private limbRadius(limb: string): number {
    return (this.values[`${limb}_circumference`] ?? 0.3) / (2 * Math.PI);
  }

  private material(colour: number): THREE.Material {
    return new THREE.MeshStandardMaterial({ color: colour, roughness: 0.65, metalness: 0.1 });
  }

  private addRod(radius: number, colour: number): THREE.Mesh {
    const rod = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, 1, 16), this.material(colour));
    this.bicycle.add(rod);
    return rod;
  }

  private makeWheel(radius: number): THREE.Group {
    const wheel = new THREE.Group();
    const size = Math.max(radius, 0.005);
    wheel.add(new THREE.Mesh(new THREE.TorusGeometry(size * 0.955, size * 0.045, 10, 64), this.material(COLOURS.tyre)));
    const spoke = new THREE.CylinderGeometry(0.0012, 0.0012, size * 0.93, 4);
    for (let k = 0; k < 18; k++) {
      const mesh = new THREE.Mesh(spoke, this.material(0x999999));
      mesh.position.set((Math.cos((k * Math.PI) / 9) * size) / 2, (Math.sin((k * Math.PI) / 9) * size) / 2, 0);
      mesh.rotation.z = (k * Math.PI) / 9 - Math.PI / 2;
      wheel.add(mesh);
    }
    return wheel;
  }

  /** A bicycle without frame geometry: rods from hub to centre of mass to steer axis. */
  private addBareFrame(): void {
    const v = this.values;
    const [tilt, foot] = [v.steer_axis_tilt, v.wheel_base + v.trail];
    const onAxis = (height: number) => toPicture(foot - height * Math.tan(tilt), 0, -height);
    const head = onAxis(Math.max(0.9, -v.front_frame_z));
    const lower = onAxis(2.1 * v.front_wheel_radius || 0.5);
    const centre = toPicture(v.rear_frame_x, 0, v.rear_frame_z);
    const ends: [Point, Point, number][] = [
      [toPicture(0, 0, -v.rear_wheel_radius), centre, COLOURS.frame],
      [centre, lower, COLOURS.frame],
      [toPicture(v.wheel_base, 0, -v.front_wheel_radius), lower, COLOURS.front],
      [lower, head, COLOURS.front],
    ];
    for (const [from, to, colour] of ends) stretch(this.addRod(0.014, colour), from, to);
    const ball = new THREE.Mesh(new THREE.SphereGeometry(0.06), this.material(COLOURS.frame));
    ball.position.copy(centre);
    this.bicycle.add(ball);
  }

  private addTrunk(): void {
    const v = this.values;
    const width = v.torso_width > 0 ? v.torso_width : Math.max(v.shoulder_to_shoulder - v.upper_arm_circumference / Math.PI, 0.1);
    const depth = v.torso_thickness > 0 ? v.torso_thickness : 0.2;
    this.torso = new THREE.Mesh(new THREE.BoxGeometry(depth, v.torso_length, width), this.material(COLOURS.torso));
    this.head = new THREE.Mesh(new THREE.SphereGeometry(v.head_circumference / (2 * Math.PI), 24, 16), this.material(COLOURS.skin));
    this.bicycle.add(this.torso, this.head);
  }

  /** Moves everything to a pose and draws. */
  draw(pose: Pose, trace: boolean): void {
    const points = pose.points;
    if (points !== null) this.moveBodies(points);
    this.moveWheels(pose);
    this.bicycle.position.copy(toPicture(pose.x, pose.y, 0));
    this.bicycle.rotation.set(pose.lean, -pose.heading, 0);
    if (trace) this.extendPaths(pose);
    this.road.position.set(Math.round(pose.x), 0, Math.round(pose.y));
    if (this.follows) {
      const target = toPicture(pose.x + 0.5, pose.y, -0.75);
      this.camera.position.add(target.clone().sub(this.orbit.target));
      this.orbit.target.copy(target);
    }
    this.orbit.update();
    this.stale = false;
    if (this.renderer === null) return;
    this.fit(this.renderer);
    this.renderer.render(this.scene, this.camera);
  }

  private moveBodies(points: Float64Array): void {
    const at = (number: number) => toPicture(points[3 * number - 3], points[3 * number - 2], points[3 * number - 1]);
    FRAME_RODS.forEach(([a, b], k) => stretch(this.rods[k], at(a), at(b)));
    LIMBS.forEach(([a, b], k) => stretch(this.rods[FRAME_RODS.length + k], at(a), at(b)));
    if (this.torso === null || this.head === null) return;
    const [hip, shoulder, right, left] = [at(13), at(15), at(21), at(22)];
    const up = shoulder.clone().sub(hip).normalize();
    const side = right.sub(left).normalize();
    const across = up.clone().cross(side).normalize();
    this.torso.position.copy(hip).add(shoulder).multiplyScalar(0.5);
    this.torso.setRotationFromMatrix(new THREE.Matrix4().makeBasis(across, up, side));
    this.head.position.copy(at(25));
  }

  private moveWheels(pose: Pose): void {
    if (this.wheels === null) return;
    const v = this.values;
    this.wheels.rear.position.copy(toPicture(0, 0, -v.rear_wheel_radius));
    this.wheels.rear.rotation.z = -pose.rolled / (v.rear_wheel_radius || 1);
    const axis = toPicture(Math.sin(v.steer_axis_tilt), 0, Math.cos(v.steer_axis_tilt));
    const foot = toPicture(v.wheel_base + v.trail, 0, 0);
    const hub = toPicture(v.wheel_base, 0, -v.front_wheel_radius).sub(foot).applyAxisAngle(axis, pose.steer).add(foot);
    const turned = new THREE.Quaternion().setFromAxisAngle(axis, pose.steer);
    const rolled = new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), -pose.rolled / (v.front_wheel_radius || 1));
    this.wheels.front.position.copy(hub);
    this.wheels.front.quaternion.copy(turned).multiply(rolled);
  }

  clearPaths(): void {
    for (const path of Object.values(this.paths)) path.count = 0;
  }

  private extendPaths(pose: Pose): void {
    const v = this.values;
    const front = [pose.x + v.wheel_base * Math.cos(pose.heading), pose.y + v.wheel_base * Math.sin(pose.heading)];
    for (const [path, x, y] of [[this.paths.rear, pose.x, pose.y], [this.paths.front, ...front]] as const) {
      if (path.count === TRAIL) path.points.copyWithin(0, 3);
      const place = Math.min(path.count, TRAIL - 1);
      path.points.set([x, 0.003, y], 3 * place);
      path.count = place + 1;
      path.line.geometry.setDrawRange(0, path.count);
      path.line.geometry.attributes.position.needsUpdate = true;
    }
  }

  private fit(renderer: THREE.WebGLRenderer): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = renderer.getPixelRatio();
    if (this.canvas.width === Math.floor(width * ratio) && this.canvas.height === Math.floor(height * ratio)) return;
    renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
  }
}

/** Returns what draws on a canvas, or null, said in its place, where the browser cannot (no WebGL). */
function rendererOf(canvas: HTMLCanvasElement): THREE.WebGLRenderer | null {
  try {
    return new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
  } catch {
    const note = document.createElement("p");
    note.id = "flat";
    note.textContent = "This browser cannot draw in space (WebGL is off), so the rider is not shown; all else works.";
    canvas.before(note);
    canvas.hidden = true;
    return null;
  }
}

/** Puts a rod of length one between two points. */
function stretch(rod: THREE.Mesh, from: Point, to: Point): void {
  const along = to.clone().sub(from);
  const length = along.length();
  rod.position.copy(from).add(to).multiplyScalar(0.5);
  rod.scale.set(1, Math.max(length, 1e-4), 1);
  if (length > 1e-9) rod.quaternion.setFromUnitVectors(UP, along.normalize());
}
