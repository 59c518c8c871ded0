// What the list lacks, painted over the picture of the list: where the picture of everything shows a triangle that is not listed. A single row of such pixels is where
// corners were rounded to parts of a pixel, along an edge of what is visible; only places that are wider are painted.
import * as THREE from 'three';
import { GLARE, rgb } from './labels.js';

const vertexShader = 'void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }';
const fragmentShader = `
uniform sampler2D numbers;
uniform vec2 corner, size;
uniform vec3 glaring;
uniform float hatching, patternSize;
bool lacking(vec2 at) {
  vec2 place = clamp(at, vec2(0.5), size - 0.5) / size;
  float tag = floor(texture2D(numbers, place).w * 255.0 + 0.5);
  return tag < 64.0;  // neither listed, nor nothing, nor in solid mode a back
}
void main() {
  vec2 at = gl_FragCoord.xy - corner;
  if (!lacking(at)) discard;
  int around = 0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      if ((i != 0 || j != 0) && lacking(at + vec2(i, j))) ++around;
  if (around < 4) discard;
  float stripe = mod(gl_FragCoord.x + gl_FragCoord.y, patternSize);
  gl_FragColor = vec4(hatching > 0.5 && stripe < patternSize * 0.28 ? glaring * 0.72 : glaring, 1.0);
}`;

export class Glare {
  constructor() {
    this.material = new THREE.ShaderMaterial({
      vertexShader, fragmentShader, depthTest: false, depthWrite: false,
      uniforms: {
        numbers: { value: null }, corner: { value: new THREE.Vector2() }, size: { value: new THREE.Vector2() }, glaring: { value: new THREE.Vector3(...rgb(GLARE)) },
        hatching: { value: 1 }, patternSize: { value: 9 },
      },
    });
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
    const triangle = new THREE.Mesh(geometry, this.material);
    triangle.frustumCulled = false;
    this.scene = new THREE.Scene();
    this.scene.add(triangle);
    this.camera = new THREE.Camera();
  }
  // `target` has triangle numbers and tags of everything; `corner` of the picture, from below, in pixels of the canvas.
  draw(renderer, target, corner, like) {
    const { uniforms } = this.material;
    uniforms.numbers.value = target.texture;
    uniforms.corner.value.set(...corner);
    uniforms.size.value.set(target.width, target.height);
    uniforms.hatching.value = like.hatching.value;
    uniforms.patternSize.value = like.patternSize.value;
    renderer.render(this.scene, this.camera);
  }
}
