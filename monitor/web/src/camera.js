// The camera of the 3D view: mouse and touch by three.js, keys and named views here. World z points up.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {h} from './dom.js';

const views = {
  overview: [1.0, -0.55, 0.75],
  front: [1, 0, 0.08],
  side: [0.05, -1, 0.12],
  top: [0.001, 0, 1],
};
const turn = Math.PI / 24; // of a key

export class Camera {
  /** Calls `onChange` when the picture has to be drawn again. */
  constructor(canvas, buttons, onChange) {
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.05, 60);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', onChange);
    this.centre = new THREE.Vector3();
    this.size = 1;
    canvas.addEventListener('keydown', (event) => this.onKey(event));
    for (const name of Object.keys(views)) {
      buttons.append(h('button', {type: 'button', click: () => this.view(name), text: name}));
    }
  }

  /** Everything of `box` is to be seen. */
  fit(box) {
    box.getCenter(this.centre);
    this.size = box.getSize(new THREE.Vector3()).length();
    this.view('overview');
  }

  view(name) {
    const direction = new THREE.Vector3(...views[name]).normalize();
    const narrow = Math.min(1, this.camera.aspect);
    const distance = (0.4 * this.size) / Math.tan(THREE.MathUtils.degToRad(this.camera.fov) / 2) / narrow;
    this.controls.target.copy(this.centre);
    this.camera.position.copy(this.centre).addScaledVector(direction, distance);
    this.controls.update();
  }

  resize(width, height) {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  onKey(event) {
    const turns = {ArrowLeft: [-turn, 0], ArrowRight: [turn, 0], ArrowUp: [0, -turn], ArrowDown: [0, turn]};
    const zooms = {'+': 0.88, '=': 0.88, '-': 1.14};
    if (event.key === 'Home') this.view('overview');
    else if (turns[event.key]) this.orbit(...turns[event.key], 1);
    else if (zooms[event.key]) this.orbit(0, 0, zooms[event.key]);
    else return;
    event.preventDefault();
  }

  orbit(azimuth, polar, zoom) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    // Spherical counts from y; our z is up.
    const spherical = new THREE.Spherical().setFromCartesianCoords(offset.y, offset.z, offset.x);
    spherical.theta += azimuth;
    spherical.phi = THREE.MathUtils.clamp(spherical.phi + polar, 0.01, Math.PI - 0.01);
    spherical.radius *= zoom;
    const turned = new THREE.Vector3().setFromSpherical(spherical);
    this.camera.position.copy(this.controls.target).add(new THREE.Vector3(turned.z, turned.x, turned.y));
    this.controls.update();
  }
}
