/** Colour scales that look even: equal steps in value are equal steps in the OKLab colour space. */

const STEPS = 256;
/** Power of the value that opacity is where a scale fades: what is weak is seen, too. */
const FADING = 0.85;
const RISING = 0.5;

/**
 * OKLCH (lightness, chroma, hue in degrees) to OKLab.
 *
 * @param {number[]} colour
 */
function lab([lightness, chroma, hue]) {
  const angle = hue * Math.PI / 180;
  return [lightness, chroma * Math.cos(angle), chroma * Math.sin(angle)];
}

/**
 * OKLab to sRGB, each 0 to 255, clipped to what a screen shows.
 *
 * @param {number[]} colour
 */
function labToRgb([l, a, b]) {
  const long = (l + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const medium = (l - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const short = (l - 0.0894841775 * a - 1.2914855480 * b) ** 3;
  return [
    4.0767416621 * long - 3.3077115913 * medium + 0.2309699292 * short,
    -1.2684380046 * long + 2.6097574011 * medium - 0.3413193965 * short,
    -0.0041960863 * long - 0.7034186147 * medium + 1.7076147010 * short,
  ].map(linear => {
    const value = Math.min(1, Math.max(0, linear));
    return Math.round(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));
  });
}

/** Points from OKLCH stop to OKLCH stop at equal distances along the path, as `STEPS` OKLab colours. */
function even(stops) {
  const path = [];
  for (let i = 0; i + 1 < stops.length; i++) {
    for (let step = 0; step < STEPS; step++) {
      const share = step / STEPS;
      path.push(lab(stops[i].map((from, k) => from + share * (stops[i + 1][k] - from))));
    }
  }
  path.push(lab(stops.at(-1)));
  const length = [0];
  for (let i = 1; i < path.length; i++) {
    length.push(length[i - 1] + Math.hypot(...path[i].map((value, k) => value - path[i - 1][k])));
  }
  const scale = [];
  let at = 0;
  for (let step = 0; step < STEPS; step++) {
    const wanted = length.at(-1) * step / (STEPS - 1);
    while (at + 1 < path.length - 1 && length[at + 1] < wanted) {
      at++;
    }
    const share = (wanted - length[at]) / (length[at + 1] - length[at]);
    scale.push(path[at].map((from, k) => from + share * (path[at + 1][k] - from)));
  }
  return scale;
}

/** Scales as `STEPS` colours in OKLab. */
export const SCALES = {
  /** Little to much: deep blue, teal, pale yellow. */
  sequential: even([[0.38, 0.125, 264], [0.53, 0.12, 240], [0.68, 0.105, 200], [0.83, 0.12, 155], [0.95, 0.12, 108]]),
  /** Contracted, at rest, stretched: blue, grey, orange. */
  diverging: even([[0.55, 0.17, 255], [0.92, 0, 255], [0.92, 0, 40], [0.62, 0.19, 40]]),
  /** Turning right, not, left: violet, grey, green. */
  turning: even([[0.6, 0.22, 305], [0.92, 0, 305], [0.92, 0, 150], [0.64, 0.18, 150]]),
};

/** The colours of a scale as RGBA bytes, for a texture. */
export function scaleBytes(scale) {
  return Uint8Array.from(scale.flatMap(colour => [...labToRgb(colour), 255]));
}

/** The colour of a scale at a share from 0 to 1, as three numbers from 0 to 1. */
export function colourAt(scale, share) {
  const index = Math.round(Math.min(1, Math.max(0, share)) * (STEPS - 1));
  return labToRgb(scale[index]).map(value => value / 255);
}

/**
 * A scale that goes from one colour through nothing to another, by which what is behind shows through.
 *
 * @returns {Uint8ClampedArray} RGBA as `scaleBytes`, less and less opaque to the middle
 */
export function fadingBytes(scale) {
  const ends = [0, scale.length - 1].map(i => labToRgb(scale[i]));
  return Uint8ClampedArray.from(scale.flatMap((_, i) => {
    const share = 2 * i / (scale.length - 1) - 1;
    return [...ends[share < 0 ? 0 : 1], 255 * Math.abs(share) ** FADING];
  }));
}

/** A scale of which what is little shows what is behind: as `fadingBytes`, from nothing to opaque. */
export function risingBytes(scale) {
  return Uint8ClampedArray.from(scale.flatMap((colour, i) => [...labToRgb(colour), 255 * (i / (scale.length - 1)) ** RISING]));
}

/** Such bytes as the CSS of a gradient from left to right. */
export function bytesGradient(bytes) {
  const stops = Array.from({length: 17}, (_, i) => {
    const [red, green, blue, alpha] = bytes.subarray(4 * Math.round(i * (STEPS - 1) / 16));
    return `rgb(${red} ${green} ${blue} / ${(alpha / 255).toFixed(3)})`;
  });
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

/** A scale as the CSS of a gradient from left to right. */
export function cssGradient(scale) {
  const stops = [];
  for (let i = 0; i <= 16; i++) {
    stops.push(`rgb(${labToRgb(scale[Math.round(i * (STEPS - 1) / 16)]).join(' ')})`);
  }
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

/** Warm colours from head to tail, neighbours apart in lightness: three numbers from 0 to 1 for each of `count`. */
export function clusterColours(count) {
  return Array.from({length: count}, (_, i) => {
    const hue = count < 2 ? 40 : 12 + 88 * i / (count - 1);
    return labToRgb(lab([i % 2 === 0 ? 0.64 : 0.77, 0.16, hue])).map(value => value / 255);
  });
}
