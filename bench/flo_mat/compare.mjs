// medial beside flo-mat: the same SVG files, one run, warm, one thread. Prints Markdown.
// node compare.mjs MEDIAL [--rounds N] [--tolerance T | equal] [FILE.svg | FILE.wkt ...]; see README.md.

import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';

let tolerance = 1e-6;      // of medial's arcs, relative to the diagonal; 0: as exact as flo-mat is
const finest = 1e-9;     // the axis that both are measured against
const copies = 20;       // of a shape in one run of medial
const share = 0.99;      // of an axis' points whose error counts
const near = 1e-3;       // ends of branches at the same place, relative to the diagonal

let flo;
try {
  flo = await import('flo-mat');
} catch (error) {
  console.log(`skipped: flo-mat is not installed (npm install in bench/flo_mat): ${error.message}`);
  process.exit(0);
}

const words = process.argv.slice(2);
const medial = words.shift();
let rounds = 3;
while (words[0] === '--rounds' || words[0] === '--tolerance') {
  const [name, value] = words.splice(0, 2);
  if (name === '--rounds') rounds = Number(value);
  else tolerance = value === 'equal' ? 0 : Number(value);
}
if (!medial || !existsSync(medial) || !(rounds >= 1) || !(tolerance >= 0)) {
  console.error('usage: node compare.mjs MEDIAL [--rounds N] [--tolerance T | equal] [FILE.svg | FILE.wkt ...]');
  process.exit(2);
}

const folder = mkdtempSync(join(tmpdir(), 'flo-mat-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

/** The path data of an SVG. Both programs get it without view box and transforms. */
function pathsOf(file) {
  return [...readFileSync(file, 'utf8').matchAll(/\sd="([^"]+)"/g)].map(match => match[1]);
}

/** Writes an SVG with each path so many times, each time a feature of its own. */
function writeSvg(file, paths, copies) {
  const element = d => `<path fill-rule="evenodd" d="${d}"/>\n`;
  writeFileSync(file, '<svg xmlns="http://www.w3.org/2000/svg">\n' +
    paths.map(d => element(d).repeat(copies)).join('') + '</svg>\n');
  return file;
}

/** An SVG with the rings of all polygons of a well-known text. */
function svgOfText(file) {
  const rings = readFileSync(file, 'utf8').match(/\([^()]+\)/g) ?? [];
  const path = rings.map(ring => 'M' + ring.slice(1, -1).split(',').slice(0, -1)
    .map(point => point.trim().replace(/\s+/g, ' ')).join('L') + 'Z').join('\n');
  return writeSvg(join(folder, basename(file).replace(/\.wkt$/, '.svg')), [path], 1);
}

/** What both programs are told to read. */
function inputs() {
  if (words.length > 0) return words.map(f => (f.endsWith('.wkt') ? svgOfText(f) : f));
  execFileSync(medial, ['bench', 'biarc', '--shapes', folder]);
  return ['tree', 'snowflake', 'lettering', 'border'].map(name => join(folder, `${name}.svg`));
}

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** The least milliseconds of processor time of all rounds but the first, which warms up, and the last result. */
function timed(work) {
  let least = Infinity, result;
  for (let round = 0; round <= rounds; ++round) {
    const begin = process.cpuUsage();
    result = work();
    const { user, system } = process.cpuUsage(begin);
    if (round > 0) least = Math.min(least, 1e-3 * (user + system));
  }
  return [least, result];
}

/** Branches as pairs of ends; each branch once. */
function floBranches(mats) {
  const branches = [];
  for (const mat of mats) {
    if (!mat.cpNode) continue;
    for (const branch of flo.getBranches(mat.cpNode)) {
      const center = node => node.cp.circle.center;
      branches.push([center(branch[0]), center(branch[branch.length - 1].next)]);
    }
  }
  return branches;
}

/** The point of a Bezier curve. */
function pointAt(points, t) {
  while (points.length > 1) {
    points = points.slice(1).map(([x, y], i) =>
      [(1 - t) * points[i][0] + t * x, (1 - t) * points[i][1] + t * y]);
  }
  return points[0];
}

/** Points of flo-mat's axis: of each of its curves the end and three in between. */
function floPoints(mats) {
  const points = [];
  for (const mat of mats) {
    if (!mat.cpNode) continue;
    for (const branch of flo.getBranches(mat.cpNode)) {
      for (const node of branch) {
        const curve = flo.CpNodeFs.getMatCurveToNext(node);
        for (const t of [0.25, 0.5, 0.75, 1]) points.push(pointAt(curve, t));
      }
    }
  }
  return points;
}

/** flo-mat's time and branches: its default accuracy, nothing simplified or culled. */
function runFlo(file) {
  const loops = flo.getPathsFromStr(pathsOf(file).join('\n'));
  const options = { applySat: false, simplify: false };
  const [milliseconds, mats] = timed(() => flo.findMats(loops, options));
  const curves = loops.reduce((sum, loop) => sum + loop.length, 0);
  return { milliseconds, curves, branches: floBranches(mats), points: floPoints(mats) };
}

/** medial's axis of one copy of a shape. */
function axisOf(file, tolerance) {
  const axis = join(folder, 'axis.json');
  const once = writeSvg(join(folder, 'once.svg'), pathsOf(file), 1);
  const options = ['--arc-tolerance', `${tolerance}`, '--quiet'];
  execFileSync(medial, ['axis', once, '--threads', '1', ...options, '-o', axis]);
  const verified = spawnSync(medial, ['verify', once, axis, ...options]).status === 0;
  return { verified, native: JSON.parse(readFileSync(axis, 'utf8')) };
}

/** medial's time and its branches. The time is the processor's, on one thread, from Bezier curves
 * to the axis, without reading, as flo-mat's is; warm: what a run with many copies of the shape
 * takes longer than a run with one. */
function runMedial(file, tolerance) {
  const once = writeSvg(join(folder, 'once.svg'), pathsOf(file), 1);
  const often = writeSvg(join(folder, 'often.svg'), pathsOf(file), copies + 1);
  const options = ['--threads', '1', '--arc-tolerance', `${tolerance}`, '--quiet', '--stats', '--json'];
  const run = input => {
    const told = JSON.parse(execFileSync(medial, ['axis', input, ...options], { encoding: 'utf8' }));
    return 1e3 * (told.processor.shape + told.processor.axis);
  };
  const least = input => Math.min(...Array.from({ length: rounds + 1 }, () => run(input)));
  const milliseconds = (least(often) - least(once)) / copies;
  const { verified, native } = axisOf(file, tolerance);
  return { milliseconds, tolerance, verified, native, ...branchesOf(native) };
}

/** Finds how far points are from an axis of many short edges, up to `reach`. */
class Distances {
  constructor(native, reach) {
    this.reach = reach;
    this.cells = new Map();
    for (const { axis } of native.items) {
      for (const [from, to] of axis.edges) {
        const a = axis.nodes[from], b = axis.nodes[to];
        const steps = Math.ceil(distance(a, b) / reach) + 1;
        const names = new Set();
        for (let i = 0; i <= steps; ++i) {
          names.add(this.name(this.cell(a[0] + (b[0] - a[0]) * i / steps),
                              this.cell(a[1] + (b[1] - a[1]) * i / steps)));
        }
        for (const name of names) {
          if (!this.cells.has(name)) this.cells.set(name, []);
          this.cells.get(name).push([a, b]);
        }
      }
    }
  }
  cell(value) { return Math.floor(value / this.reach); }
  name(x, y) { return `${x},${y}`; }
  of(p) {
    let least = this.reach;
    for (let i = -1; i <= 1; ++i) {
      for (let j = -1; j <= 1; ++j) {
        for (const [a, b] of this.cells.get(this.name(this.cell(p[0]) + i, this.cell(p[1]) + j)) ?? []) {
          const d = [b[0] - a[0], b[1] - a[1]];
          const squared = d[0] * d[0] + d[1] * d[1];
          const t = squared > 0 ? ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / squared : 0;
          const s = Math.min(1, Math.max(0, t));
          least = Math.min(least, distance(p, [a[0] + s * d[0], a[1] + s * d[1]]));
        }
      }
    }
    return least;
  }
  /** The distance that so large a share of the points stays below. */
  quantile(points, share) {
    const all = points.map(p => this.of(p)).sort((a, b) => a - b);
    return all[Math.min(all.length - 1, Math.floor(share * all.length))];
  }
}

/** The nodes of a native file. */
function nodesOf(native) {
  return native.items.flatMap(({ axis }) => axis.nodes.map(node => node.slice(0, 2)));
}

/** The coarsest tolerance at which medial's axis is as near to the finest one as flo-mat's is. */
function equalTolerance(file, error, distances) {
  for (let t = 1e-2; t > finest; t /= 10 ** 0.5) {
    if (distances.quantile(nodesOf(axisOf(file, t).native), share) <= error) return t;
  }
  return finest;
}

/** The branches of a native file as pairs of ends, and the diagonal of the shape's vertices. */
function branchesOf(native) {
  const branches = [];
  let low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const { axis, shape } of native.items) {
    for (const [x, y] of shape.points) {
      low = [Math.min(low[0], x), Math.min(low[1], y)];
      high = [Math.max(high[0], x), Math.max(high[1], y)];
    }
    const around = axis.nodes.map(() => []);
    axis.edges.forEach(([from, to], i) => { around[from].push([i, to]); around[to].push([i, from]); });
    const taken = new Set();
    around.forEach((edges, start) => {
      if (edges.length === 2) return;
      for (let [edge, at] of edges) {
        if (taken.has(edge)) continue;
        taken.add(edge);
        while (around[at].length === 2) {
          [edge, at] = around[at].find(([other]) => other !== edge);
          taken.add(edge);
        }
        branches.push([axis.nodes[start].slice(0, 2), axis.nodes[at].slice(0, 2)]);
      }
    });
  }
  return { branches, diagonal: distance(low, high) };
}

/** How many of `wanted`, leaving out short ones, have their two ends at those of one of `found`. */
function matched(wanted, found, radius) {
  const cells = new Map();
  const key = (x, y) => `${x},${y}`;
  const cell = value => Math.floor(value / radius);
  const put = (a, b) => {
    const name = key(cell(a[0]), cell(a[1]));
    if (!cells.has(name)) cells.set(name, []);
    cells.get(name).push([a, b]);
  };
  for (const [a, b] of found) { put(a, b); put(b, a); }
  let count = 0, long = 0;
  for (const [a, b] of wanted) {
    if (distance(a, b) <= radius) continue;
    ++long;
    let here = false;
    for (let i = -1; i <= 1 && !here; ++i) {
      for (let j = -1; j <= 1 && !here; ++j) {
        here = (cells.get(key(cell(a[0]) + i, cell(a[1]) + j)) ?? [])
          .some(([c, d]) => distance(a, c) <= radius && distance(b, d) <= radius);
      }
    }
    if (here) ++count;
  }
  return { count, long };
}

console.log('| shape | curves | tolerance | error medial | error flo-mat | medial ms | flo-mat ms | ratio ' +
            '| branches medial | branches flo-mat | medial\'s found by flo-mat ' +
            '| flo-mat\'s found by medial | medial verified |');
console.log('| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |');
const missed = [];
let failed = false;
for (const file of inputs()) {
  const name = basename(file, '.svg');
  let theirs;
  try {
    theirs = runFlo(file);
  } catch (error) {
    console.log(`| ${name} | | | | | | flo-mat fails: ${error.message} |`);
    missed.push(`${name}: all`);
    continue;
  }
  const finestAxis = axisOf(file, finest).native;
  const { diagonal } = branchesOf(finestAxis);
  const distances = new Distances(finestAxis, near * diagonal);
  const error = distances.quantile(theirs.points, share);
  const ours = runMedial(file, tolerance || equalTolerance(file, error, distances));
  const own = distances.quantile(nodesOf(ours.native), share);
  const radius = near * ours.diagonal;
  const by = matched(ours.branches, theirs.branches, radius);
  const back = matched(theirs.branches, ours.branches, radius);
  const relative = value => (value / diagonal).toExponential(0);
  console.log(`| ${name} | ${theirs.curves} | ${ours.tolerance.toExponential(0)} | ${relative(own)} | ` +
    `${relative(error)} | ${ours.milliseconds.toFixed(2)} | ` +
    `${theirs.milliseconds.toFixed(0)} | ${(theirs.milliseconds / ours.milliseconds).toFixed(0)} | ` +
    `${ours.branches.length} | ${theirs.branches.length} | ${by.count} of ${by.long} | ` +
    `${back.count} of ${back.long} | ${ours.verified ? 'yes' : 'NO'} |`);
  if (by.count < by.long) missed.push(`${name}: ${by.long - by.count} of ${by.long}`);
  failed ||= !ours.verified;
}
console.log(`\nBranches that flo-mat misses: ${missed.join('; ') || 'none'}.`);
process.exit(failed ? 1 : 0);
