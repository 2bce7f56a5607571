/** A coast: a circle whose radius is a random fractal, as x, y, x, y ... Uses nothing from outside: it runs in pages, too. */
export function coast(n) {
  let state = 1;
  const random = () => (state = (48271 * state) % 0x7fffffff) / 0x7fffffff - 0.5;
  const size = 2 ** Math.ceil(Math.log2(n));
  const height = new Float64Array(size);
  for (let step = size, rough = 0.5; step > 1; step /= 2, rough *= 0.6)
    for (let i = step / 2; i < size; i += step)
      height[i] = (height[i - step / 2] + height[(i + step / 2) % size]) / 2 + rough * random();
  return Float64Array.from({ length: 2 * n }, (_, k) => {
    const angle = (2 * Math.PI * (k >> 1)) / n;
    return 1000 * Math.exp(0.7 * height[Math.floor(((k >> 1) * size) / n)]) * (k % 2 ? Math.sin(angle) : Math.cos(angle));
  });
}
