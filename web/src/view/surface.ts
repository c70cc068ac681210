/** The surface of bodies: oak, iron and granite made of noise, or a flat colour of a layer. */
import {
  Data3DTexture, LinearFilter, MeshDepthMaterial, MeshLambertMaterial, MeshStandardMaterial, RedFormat, RepeatWrapping, RGBADepthPacking,
  type Material, type Texture, type WebGLProgramParametersWithUniforms,
} from 'three';

/** Which pattern a material gets; anything unknown is painted. */
export function patternOf(material: string): number {
  const name = material.toLowerCase();
  if (/oak|wood|pine|beech|plank/.test(name)) return 0;
  if (/iron|steel|metal|alumin|copper/.test(name)) return 1;
  if (/granite|stone|rock|concrete|marble/.test(name)) return 2;
  return 3;
}

export interface SurfaceUniforms {
  /** 0 = the material's pattern, 1 = the flat colour of the instance */
  uFlat: { value: number };
  uNoise: { value: Data3DTexture };
}

const noiseSize = 32;

/** A tile of random values; the hardware's interpolation turns it into smooth noise. */
function makeNoise(): Data3DTexture {
  const data = new Uint8Array(noiseSize ** 3);
  let state = 12345;
  for (let i = 0; i < data.length; i++) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    data[i] = state >>> 24;
  }
  const texture = new Data3DTexture(data, noiseSize, noiseSize, noiseSize);
  texture.format = RedFormat;
  texture.wrapS = texture.wrapT = texture.wrapR = RepeatWrapping;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

const varyings = /* glsl */ `
varying vec3 vTint;
varying vec3 vKind; // pattern, seed, emphasis
varying vec3 vHalf; // half extents of a box [m]; a negative x marks a round body, a negative y as well a ball
varying vec3 vInner; // [m, B]
`;
/** Turns the half that a ball is drawn as to a direction, both in B. */
const turnDome = /* glsl */ `
vec3 turnDome(vec3 p, vec3 axis) {
  vec3 x = normalize(cross(abs(axis.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0), axis));
  return p.x * x + p.y * cross(axis, x) + p.z * axis;
}
`;
/** Away from the sun, in W: shadows are cast by the half that it does not see. */
const shadeward = '-vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2])';
/** From W to B, for balls. */
const intoBall = (direction: string): string => `normalize(transpose(mat3(instanceMatrix)) * (${direction}))`;
const instancedHead = /* glsl */ `
attribute vec3 aTint;
attribute vec3 aKind;
attribute vec3 aHalf;
${varyings}
vec3 onSurface; // of the unit shape
${turnDome}
`;
const instancedNormal = /* glsl */ `
onSurface = position;
if (aHalf.y < 0.0) onSurface = turnDome(position, ${intoBall('cameraPosition - instanceMatrix[3].xyz')});
#include <beginnormal_vertex>
if (aHalf.y < 0.0) objectNormal = onSurface;
`;
const instancedBody = /* glsl */ `
#include <begin_vertex>
transformed = onSurface;
vTint = aTint;
vKind = aKind;
vHalf = aHalf;
vInner = onSurface * abs(aHalf);
`;

/** Of the texture with the state of merged bodies: the first body's texels stand below each other, the next one's to the right. */
export const texelColumns = 256;
/** position [m] and emphasis; orientation; tint, and 1 if it is there; half extents, and the pattern plus the seed */
export const texelsPerBody = 4;
const mergedHead = /* glsl */ `
attribute float aBody;
uniform highp sampler2D uBodies;
${varyings}
vec3 inner; // [m, B]
vec3 outward; // normal, in B
${turnDome}
vec4 stateOf(int k) {
  int body = int(aBody + 0.5);
  return texelFetch(uBodies, ivec2(body % ${texelColumns}, (body / ${texelColumns}) * ${texelsPerBody} + k), 0);
}
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
// Balls and boxes have only the part that is seen from a direction, in B.
void findSurface(vec3 point, vec3 normal, vec3 extents, vec3 towards) {
  outward = normal;
  if (extents.y < 0.0) {
    point = outward = turnDome(point, normalize(towards));
  } else if (extents.x > 0.0 && dot(normal, towards) < 0.0) {
    vec3 other = normal.yzx;
    point -= 2.0 * (dot(point, normal) * normal + dot(point, other) * other);
    outward = -normal;
  }
  inner = point * abs(extents);
}
`;
const mergedNormal = /* glsl */ `
vec4 place = stateOf(0), turn = stateOf(1), tint = stateOf(2), form = stateOf(3);
findSurface(position, normal, form.xyz, turned(turn * vec4(-1.0, -1.0, -1.0, 1.0), cameraPosition - place.xyz));
vec3 objectNormal = turned(turn, outward);
`;
const mergedBody = /* glsl */ `
vec3 transformed = place.xyz + tint.w * turned(turn, inner);
vTint = tint.rgb;
vKind = vec3(floor(form.w), fract(form.w), place.w);
vHalf = form.xyz;
vInner = inner;
`;
const mergedShade = /* glsl */ `
vec4 place = stateOf(0), turn = stateOf(1), form = stateOf(3);
findSurface(position, normal, form.xyz, turned(turn * vec4(-1.0, -1.0, -1.0, 1.0), ${shadeward}));
vec3 transformed = place.xyz + stateOf(2).w * turned(turn, inner);
`;

const fragmentHead = /* glsl */ `
uniform float uFlat;
uniform highp sampler3D uNoise;
${varyings}
float surfaceRoughness;
float surfaceMetalness;
float noiseAt(vec3 p) { return texture(uNoise, p * ${(1 / noiseSize).toFixed(6)}).r; }
vec3 oak(vec3 p, float seed) {
  vec3 q = p + vec3(0.06 + 0.05 * fract(seed * 7.13), 0.05 * fract(seed * 3.71) - 0.1, 0.4 * seed);
  float wobble = noiseAt(vec3(q.xy * 14.0, q.z * 5.0) + seed * 17.0) - 0.5;
  float ring = length(q.xy) * 95.0 + wobble * 1.6;
  float late = smoothstep(0.35, 0.95, fract(ring)) * (1.0 - smoothstep(0.95, 1.0, fract(ring)));
  float fibre = noiseAt(vec3(q.xy * 700.0, q.z * 22.0));
  vec3 light = mix(vec3(0.56, 0.335, 0.15), vec3(0.47, 0.255, 0.10), fract(seed * 5.3));
  vec3 wood = mix(light, light * vec3(0.58, 0.52, 0.46), 0.75 * late);
  surfaceRoughness = 0.62 + 0.15 * fibre;
  surfaceMetalness = 0.0;
  return wood * (0.86 + 0.26 * fibre);
}
vec3 iron(vec3 p, float seed) {
  float broad = noiseAt(p * 40.0 + seed * 9.0);
  float fine = noiseAt(p * 300.0);
  surfaceRoughness = 0.34 + 0.22 * broad + 0.06 * fine;
  surfaceMetalness = 0.9;
  return vec3(0.30, 0.315, 0.335) * (0.82 + 0.3 * broad);
}
vec3 granite(vec3 p, float seed) {
  vec3 q = p * 260.0 + seed * 13.0;
  float a = noiseAt(q), b = noiseAt(q * 0.53 + 7.7), c = noiseAt(p * 9.0);
  vec3 stone = mix(vec3(0.37, 0.36, 0.36), vec3(0.50, 0.47, 0.45), c);
  stone = mix(stone, vec3(0.09, 0.09, 0.10), 0.75 * smoothstep(0.62, 0.75, a));
  stone = mix(stone, vec3(0.72, 0.68, 0.66), 0.6 * smoothstep(0.66, 0.8, b));
  surfaceRoughness = 0.7;
  surfaceMetalness = 0.0;
  return stone;
}
vec3 surfaceColour() {
  surfaceRoughness = 0.6;
  surfaceMetalness = 0.0;
  vec3 colour = vTint;
  if (uFlat < 0.5) {
    if (vKind.x < 0.5) colour = oak(vInner, vKind.y);
    else if (vKind.x < 1.5) colour = iron(vInner, vKind.y);
    else if (vKind.x < 2.5) colour = granite(vInner, vKind.y);
  } else if (vHalf.x < 0.0) {
    // Two halves of a round body differ a little, so that one sees it roll.
    colour *= 0.88 + 0.24 * smoothstep(-0.02, 0.02, vInner.x / -vHalf.x);
  }
  if (vHalf.x > 0.0) {
    vec3 gap = vHalf - abs(vInner);
    float edge = min(max(gap.x, gap.y), min(max(gap.y, gap.z), max(gap.x, gap.z)));
    float width = 0.05 * min(vHalf.x, min(vHalf.y, vHalf.z)) + 0.7 * fwidth(edge);
    colour *= mix(0.62, 1.0, smoothstep(0.0, width, edge));
  }
  return colour * (1.0 + 0.35 * vKind.z) + vKind.z * vec3(0.02, 0.10, 0.2);
}
`;
const fragmentColour = /* glsl */ `
#include <color_fragment>
diffuseColor.rgb = surfaceColour();
`;

type Shader = WebGLProgramParametersWithUniforms;

function paintFragments(shader: Shader): void {
  shader.fragmentShader = fragmentHead + shader.fragmentShader
    .replace('#include <color_fragment>', fragmentColour)
    .replace('#include <roughnessmap_fragment>', 'float roughnessFactor = surfaceRoughness;')
    .replace('#include <metalnessmap_fragment>', 'float metalnessFactor = surfaceMetalness;');
}

/** The materials of all bodies: a good one for instances, and one for merged bodies that software rendering can afford. */
export class Surfaces {
  readonly uniforms: SurfaceUniforms = { uFlat: { value: 0 }, uNoise: { value: makeNoise() } };
  readonly fine = new MeshStandardMaterial();
  /** of the shadows of balls: the half that looks away from the sun, as of other bodies */
  readonly ballDepth = new MeshDepthMaterial({ depthPacking: RGBADepthPacking });

  constructor() {
    this.fine.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      shader.vertexShader = instancedHead + shader.vertexShader
        .replace('#include <beginnormal_vertex>', instancedNormal)
        .replace('#include <begin_vertex>', instancedBody);
      paintFragments(shader);
    };
    this.ballDepth.onBeforeCompile = (shader) => {
      shader.vertexShader = turnDome + shader.vertexShader.replace('#include <begin_vertex>',
        `vec3 transformed = turnDome(position, ${intoBall(shadeward)});`);
    };
  }

  /** @param bodies the state of the bodies */
  makeMerged(bodies: Texture): Material {
    const material = new MeshLambertMaterial();
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms, { uBodies: { value: bodies } });
      shader.vertexShader = mergedHead + shader.vertexShader
        .replace('#include <beginnormal_vertex>', mergedNormal)
        .replace('#include <begin_vertex>', mergedBody);
      paintFragments(shader);
    };
    return material;
  }

  makeMergedDepth(bodies: Texture): Material {
    const material = new MeshDepthMaterial({ depthPacking: RGBADepthPacking });
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, { uBodies: { value: bodies } });
      shader.vertexShader = mergedHead + shader.vertexShader.replace('#include <begin_vertex>', mergedShade);
    };
    return material;
  }
}
