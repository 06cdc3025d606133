// Geometry of the 3D view: bodies of robots and fixtures as three.js meshes.
import * as THREE from 'three';
import {mergeGeometries} from 'three/examples/jsm/utils/BufferGeometryUtils.js';

const up = new THREE.Vector3(0, 1, 0);
const a = new THREE.Vector3();
const b = new THREE.Vector3();
const along = new THREE.Vector3();

/** Ends of capsule `i` of a frame's list, to `a` and `b`. */
function readEnds(ends, i) {
  a.fromArray(ends, 6 * i);
  b.fromArray(ends, 6 * i + 3);
}

/** A capsule as long as the one number `i` of `ends` [m]. */
export function capsuleGeometry(ends, i, radius, segments = 20) {
  readEnds(ends, i);
  return new THREE.CapsuleGeometry(radius, a.distanceTo(b), 6, segments);
}

/** Moves `mesh`, a capsule, to where `ends` has number `i`. */
export function placeCapsule(mesh, ends, i) {
  readEnds(ends, i);
  mesh.position.addVectors(a, b).multiplyScalar(0.5);
  along.subVectors(b, a);
  if (along.lengthSq() > 1e-12) mesh.quaternion.setFromUnitVectors(up, along.normalize());
}

/** All capsules of several postures in one piece, which is drawn at one stroke. */
export function bodiesGeometry(postures, radii) {
  const place = new THREE.Object3D();
  const parts = postures.flatMap((ends) =>
    radii.map((radius, i) => {
      placeCapsule(place, ends, i);
      place.updateMatrix();
      readEnds(ends, i);
      return new THREE.CapsuleGeometry(radius, a.distanceTo(b), 4, 12).applyMatrix4(place.matrix);
    }),
  );
  return mergeGeometries(parts);
}

export function ghostMaterial(looks) {
  return new THREE.MeshBasicMaterial({transparent: true, depthWrite: false, ...looks});
}

function fixtureGeometry(fixture) {
  switch (fixture.kind) {
    case 'box':
      return new THREE.BoxGeometry(...fixture.size);
    case 'sphere':
      return new THREE.SphereGeometry(fixture.radius, 32, 16);
    case 'cylinder':
      return new THREE.CylinderGeometry(fixture.radius, fixture.radius, fixture.length, 40).rotateX(Math.PI / 2); // about z
    case 'mesh': {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.Float32BufferAttribute(fixture.vertices, 3));
      geometry.setIndex(fixture.triangles);
      const flat = geometry.toNonIndexed();
      flat.computeVertexNormals();
      return flat;
    }
    default: {
      const size = 4; // a plane goes on for ever; so much of it is shown [m]
      const normal = new THREE.Vector3(...fixture.normal);
      const plane = new THREE.PlaneGeometry(size, size);
      plane.applyQuaternion(new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal));
      return plane.translate(...normal.multiplyScalar(fixture.offset).toArray());
    }
  }
}

/** A fixture where it stands. */
export function fixtureMesh(fixture, colour) {
  const thin = fixture.kind === 'plane';
  const material = new THREE.MeshLambertMaterial({
    color: colour,
    side: THREE.DoubleSide,
    transparent: thin,
    opacity: thin ? 0.25 : 1,
    depthWrite: !thin,
  });
  const mesh = new THREE.Mesh(fixtureGeometry(fixture), material);
  mesh.position.fromArray(fixture.pose.p);
  const [w, x, y, z] = fixture.pose.q;
  mesh.quaternion.set(x, y, z, w);
  return mesh;
}

/** Frees what `object` and everything in it holds on the graphics card. */
export function dispose(object) {
  object.traverse((each) => {
    each.geometry?.dispose();
    each.material?.dispose();
  });
}
