const MAX_SEGMENT = 4096;
const MIN_SEGMENT = 16;

/** The discrete Fourier transform in place; the length is a power of two. */
export function transform(real, imaginary) {
  const length = real.length;
  for (let index = 1, reversed = 0; index < length; index += 1) {
    let bit = length >> 1;
    for (; reversed & bit; bit >>= 1) {
      reversed ^= bit;
    }
    reversed ^= bit;
    if (index < reversed) {
      [real[index], real[reversed]] = [real[reversed], real[index]];
      [imaginary[index], imaginary[reversed]] = [imaginary[reversed], imaginary[index]];
    }
  }
  for (let size = 2; size <= length; size *= 2) {
    const half = size / 2;
    for (let step = 0; step < half; step += 1) {
      const angle = (-2 * Math.PI * step) / size;
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      for (let low = step; low < length; low += size) {
        const high = low + half;
        const re = real[high] * cos - imaginary[high] * sin;
        const im = real[high] * sin + imaginary[high] * cos;
        real[high] = real[low] - re;
        imaginary[high] = imaginary[low] - im;
        real[low] += re;
        imaginary[low] += im;
      }
    }
  }
}

/** Values at even times, by straight lines between the samples. */
function resampled(times_s, values, period_s) {
  const count = Math.floor((times_s.at(-1) - times_s[0]) / period_s) + 1;
  const even = new Float64Array(count);
  for (let index = 0, after = 1; index < count; index += 1) {
    const time_s = times_s[0] + index * period_s;
    while (after < times_s.length - 1 && times_s[after] < time_s) {
      after += 1;
    }
    const width_s = times_s[after] - times_s[after - 1];
    const share = width_s > 0 ? (time_s - times_s[after - 1]) / width_s : 0;
    even[index] = values[after - 1] + (values[after] - values[after - 1]) * Math.min(share, 1);
  }
  return even;
}

/**
 * The amplitude spectrum by Welch's method: Hann windows that overlap by half, their power averaged,
 * mean removed. A sine of amplitude 1 gives a peak of 1. Null: too few values.
 * @returns {{frequencies_hz: Float64Array, amplitudes: Float64Array, rate_hz: number, segments: number} | null}
 */
export function spectrumOf(times_s, values) {
  if (times_s.length < MIN_SEGMENT) {
    return null;
  }
  const periods = Float64Array.from({ length: times_s.length - 1 }, (_, index) => times_s[index + 1] - times_s[index]);
  const period_s = periods.sort()[periods.length >> 1];
  // A silence of many periods would fill the memory with a straight line.
  if (!(period_s > 0) || (times_s.at(-1) - times_s[0]) / period_s > 8 * times_s.length) {
    return null;
  }
  const even = resampled(times_s, values, period_s);
  const size = Math.min(MAX_SEGMENT, 2 ** Math.floor(Math.log2(even.length)));
  if (size < MIN_SEGMENT) {
    return null;
  }
  const hann = Float64Array.from({ length: size }, (_, index) => 0.5 - 0.5 * Math.cos((2 * Math.PI * index) / size));
  const power = new Float64Array(size / 2);
  let segments = 0;
  for (let begin = 0; begin + size <= even.length; begin += size / 2) {
    const part = even.subarray(begin, begin + size);
    const mean = part.reduce((sum, each) => sum + each, 0) / size;
    const real = part.map((each, index) => (each - mean) * hann[index]);
    const imaginary = new Float64Array(size);
    transform(real, imaginary);
    power.forEach((_, index) => {
      power[index] += real[index] ** 2 + imaginary[index] ** 2;
    });
    segments += 1;
  }
  return {
    frequencies_hz: power.map((_, index) => index / size / period_s),
    // Half of a sine's amplitude is at its negative frequency; the mean of the window is a half.
    amplitudes: power.map((each) => (Math.sqrt(each / segments) * 4) / size),
    rate_hz: 1 / period_s,
    segments,
  };
}
