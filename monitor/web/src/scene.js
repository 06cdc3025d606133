// The cell in 3D: bodies coloured by clearance, fixtures, and as ghosts what is going to move where.
import * as THREE from 'three';
import {Camera} from './camera.js';
import {h, setText} from './dom.js';
import {mm} from './format.js';
import {clearanceColour, clearanceStops, robotColour} from './palette.js';
import {bodiesGeometry, capsuleGeometry, dispose, fixtureMesh, ghostMaterial, placeCapsule} from './solids.js';
import {robotIndex} from './store.js';

const reach = 0.6; // shown in front of each base [m]
const softwarePeriod = 60; // [ms]
const labelAbove = 0.2; // the highest body [m]

function themeColour(name) {
  return new THREE.Color(getComputedStyle(document.documentElement).getPropertyValue(name).trim());
}

/** Without a graphics card every pixel costs: then fewer of them are drawn. */
function drawnBySoftware() {
  const gl = document.createElement('canvas').getContext('webgl');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class Scene {
  constructor(canvas, labels, buttons, legend) {
    this.canvas = canvas;
    this.labels = labels;
    this.world = new THREE.Scene();
    this.fixed = new THREE.Group();
    this.arms = new THREE.Group();
    this.ghosts = new THREE.Group();
    this.world.add(this.fixed, this.arms, this.ghosts, new THREE.HemisphereLight(0xffffff, 0x8899aa, 2.2));
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    sun.position.set(2, -1.5, 4);
    this.world.add(sun);
    this.robots = [];
    this.pictures = [];
    this.dirty = false;
    try {
      this.software = drawnBySoftware();
      this.renderer = new THREE.WebGLRenderer({canvas, antialias: !this.software, alpha: true, powerPreference: 'high-performance'});
    } catch {
      canvas.parentElement.append(h('p', {class: 'no-webgl', text: 'This browser shows no 3D; everything else works.'}));
    }
    this.camera = new Camera(canvas, buttons, () => this.redraw());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.picture && this.build(this.picture));
    this.showLegend(legend);
    this.resize();
  }

  showLegend(legend) {
    const bar = h('span', {class: 'ramp', 'aria-hidden': 'true'});
    const css = clearanceStops.map(([, [r, g, b]]) => `rgb(${r} ${g} ${b})`).join(', ');
    bar.style.background = `linear-gradient(to right, ${css})`;
    const ends = clearanceStops.map(([d]) => d);
    legend.append(
      h('span', {class: 'key'}, 'nearest other body: touching ', bar, ` ${mm(ends[ends.length - 1])} or more`),
      h('span', {class: 'key'}, h('span', {class: 'ghost-key', 'aria-hidden': 'true'}), 'ghost: decided motion and its goal'),
      h('span', {class: 'key'}, h('span', {class: 'ghost-key wire', 'aria-hidden': 'true'}), 'cage: goal of an escape, out of the way of another'),
    );
  }

  /** The cell from the start: fixtures, floor, bases; the arms come with the first pose. */
  build(picture) {
    this.picture = picture;
    dispose(this.fixed);
    dispose(this.arms);
    this.fixed.clear();
    this.arms.clear();
    const box = new THREE.Box3();
    this.robots = picture.cell.robots.map((robot, index) => {
      const base = new THREE.Vector3().fromArray(robot.base.p);
      box.expandByPoint(base.clone().add(new THREE.Vector3(reach, 0.2, 0.6)));
      box.expandByPoint(base.clone().sub(new THREE.Vector3(0.25, 0.2, 0)));
      const ring = new THREE.Mesh(new THREE.RingGeometry(0.13, 0.17, 48), new THREE.MeshBasicMaterial({color: robotColour(index), side: THREE.DoubleSide}));
      ring.position.copy(base).add(new THREE.Vector3(0, 0, 0.002));
      this.fixed.add(ring);
      return {name: robot.name, meshes: null, label: null};
    });
    for (const fixture of picture.cell.fixtures) this.fixed.add(fixtureMesh(fixture, themeColour('--fixture')));
    const grid = new THREE.GridHelper(4, 16, themeColour('--grid-strong'), themeColour('--grid'));
    grid.rotation.x = Math.PI / 2;
    grid.position.copy(box.getCenter(new THREE.Vector3())).setZ(box.min.z);
    this.fixed.add(grid);
    this.labels.replaceChildren(
      ...this.robots.map((robot, index) => {
        robot.label = h('span', {class: 'label', text: robot.name});
        robot.label.style.borderColor = robotColour(index);
        return robot.label;
      }),
    );
    const key = picture.cell.cell + picture.cell.robots.map((robot) => robot.base.p).join();
    if (key !== this.fitted) this.camera.fit(box);
    this.fitted = key;
    this.draw(picture);
    this.drawGhosts(picture);
  }

  draw(picture) {
    picture.pose?.robots.forEach((pose, index) => {
      const robot = this.robots[index];
      if (!robot || !pose) return;
      const {radii} = picture.bodies.get(robot.name);
      if (!robot.meshes || robot.meshes.length !== radii.length) this.makeArm(robot, pose, radii);
      robot.meshes.forEach((mesh, i) => {
        placeCapsule(mesh, pose.ends, i);
        mesh.material.color.setRGB(...clearanceColour(pose.clearance[i]), THREE.SRGBColorSpace);
        mesh.material.opacity = pose.silent ? 0.35 : 1;
        mesh.material.transparent = pose.silent;
      });
      let top = pose.ends.slice(0, 3);
      for (let i = 0; i < pose.ends.length; i += 3) if (pose.ends[i + 2] > top[2]) top = pose.ends.slice(i, i + 3);
      robot.top = top;
      setText(robot.label, pose.silent ? `${robot.name} silent` : robot.name);
    });
    this.redraw();
  }

  makeArm(robot, pose, radii) {
    for (const mesh of robot.meshes ?? []) {
      this.arms.remove(mesh);
      dispose(mesh);
    }
    robot.meshes = radii.map((radius, i) => {
      const mesh = new THREE.Mesh(capsuleGeometry(pose.ends, i, radius), new THREE.MeshLambertMaterial());
      this.arms.add(mesh);
      return mesh;
    });
  }

  drawGhosts(picture) {
    dispose(this.ghosts);
    this.ghosts.clear();
    for (const motion of picture.motions.values()) this.ghosts.add(this.ghostOf(motion, robotColour(robotIndex(picture, motion.robot))));
    this.redraw();
  }

  ghostOf(motion, colour) {
    const group = new THREE.Group();
    const points = motion.path.map((p) => new THREE.Vector3().fromArray(p));
    const line = new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), new THREE.LineDashedMaterial({color: colour, dashSize: 0.03, gapSize: 0.02}));
    line.computeLineDistances();
    group.add(line);
    const goal = motion.ghosts[motion.ghosts.length - 1];
    const sweep = motion.ghosts.slice(0, -1).filter((ends, step) => step % 2 === 1);
    group.add(new THREE.Mesh(bodiesGeometry(sweep, motion.radii), ghostMaterial({color: colour, opacity: 0.08})));
    group.add(new THREE.Mesh(bodiesGeometry([goal], motion.radii), ghostMaterial({color: colour, opacity: motion.escape ? 0.6 : 0.24, wireframe: motion.escape})));
    return group;
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.renderer?.setPixelRatio(this.software ? 1 : Math.min(devicePixelRatio, 2));
    this.renderer?.setSize(width, height, false);
    this.camera.resize(width, height);
    this.redraw();
  }

  /** Draws once before the next picture of the screen, however often it is asked to. */
  redraw() {
    if (this.dirty) return;
    this.dirty = true;
    // What software draws takes the processor from everything else: half as often is still a movement.
    const pause = this.software ? Math.max(0, (this.pictures.at(-1) ?? 0) + softwarePeriod - performance.now()) : 0;
    const next = pause > 0 ? (draw) => setTimeout(() => requestAnimationFrame(draw), pause) : requestAnimationFrame;
    next((now) => {
      this.dirty = false;
      this.renderer?.render(this.world, this.camera.camera);
      this.placeLabels();
      this.pictures.push(now);
      while (this.pictures[0] < now - 2000) this.pictures.shift();
      if (this.robots.some((robot) => robot.meshes)) document.documentElement.dataset.drawn ??= `${Math.round(performance.now())}`;
    });
  }

  placeLabels() {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    for (const robot of this.robots) {
      if (!robot.top) continue;
      const p = new THREE.Vector3().fromArray(robot.top).add(new THREE.Vector3(0, 0, labelAbove)).project(this.camera.camera);
      robot.label.style.transform = `translate(-50%, -50%) translate(${((p.x + 1) / 2) * width}px, ${((1 - p.y) / 2) * height}px)`;
    }
  }

  framesPerSecond() {
    return Math.round(this.pictures.length / 2);
  }
}
