// medial beside flo-mat: the same SVG files, one run, warm, one thread. Prints Markdown.
// node compare.mjs MEDIAL [--rounds N] [--tolerance T] [FILE.svg | FILE.wkt ...]; see README.md.

import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';

let tolerance = 1e-6;      // of medial's arcs, relative to the diagonal
const copies = 20;       // of a shape in one run of medial
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
  else tolerance = Number(value);
}
if (!medial || !existsSync(medial) || !(rounds >= 1) || !(tolerance > 0)) {
  console.error('usage: node compare.mjs MEDIAL [--rounds N] [--tolerance T] [FILE.svg | FILE.wkt ...]');
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

/** flo-mat's time and branches: its default accuracy, nothing simplified or culled. */
function runFlo(file) {
  const loops = flo.getPathsFromStr(pathsOf(file).join('\n'));
  const options = { applySat: false, simplify: false };
  const [milliseconds, mats] = timed(() => flo.findMats(loops, options));
  const curves = loops.reduce((sum, loop) => sum + loop.length, 0);
  return { milliseconds, curves, branches: floBranches(mats) };
}

/** Milliseconds of processor time of a child, all of it. */
function processorTime(...command) {
  const script = 'TIMEFORMAT="%U %S"; time "$@" > /dev/null';
  const done = spawnSync('bash', ['-c', script, 'bash', ...command],
                         { encoding: 'utf8', env: { ...process.env, LC_ALL: 'C' } });
  const [user, system] = done.stderr.trim().split('\n').pop().split(' ').map(Number);
  if (done.status !== 0) throw new Error(done.stderr);
  return 1e3 * (user + system);
}

/** medial's time and its branches. Warm: what a run with many copies of the shape takes longer than
 * a run with one, reading included. */
function runMedial(file) {
  const axis = join(folder, 'axis.json');
  const once = writeSvg(join(folder, 'once.svg'), pathsOf(file), 1);
  const often = writeSvg(join(folder, 'often.svg'), pathsOf(file), copies + 1);
  const arguments_ = ['--threads', '1', '--arc-tolerance', `${tolerance}`, '--quiet'];
  const least = input => Math.min(...Array.from(
    { length: rounds + 1 }, () => processorTime(medial, 'axis', input, ...arguments_)));
  const milliseconds = (least(often) - least(once)) / copies;
  execFileSync(medial, ['axis', once, ...arguments_, '-o', axis]);
  let verified = true;
  try {
    execFileSync(medial, ['verify', once, axis, '--arc-tolerance', `${tolerance}`, '--quiet'],
                 { stdio: 'ignore' });
  } catch {
    verified = false;
  }
  return { milliseconds, verified, ...branchesOf(JSON.parse(readFileSync(axis, 'utf8'))) };
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

console.log('| shape | curves | medial ms | flo-mat ms | ratio | branches medial | branches flo-mat ' +
            '| medial\'s found by flo-mat | flo-mat\'s found by medial | medial verified |');
console.log('| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |');
const missed = [];
let failed = false;
for (const file of inputs()) {
  const name = basename(file, '.svg');
  const ours = runMedial(file);
  let theirs;
  try {
    theirs = runFlo(file);
  } catch (error) {
    console.log(`| ${name} | | ${ours.milliseconds.toFixed(2)} | flo-mat fails: ${error.message} |`);
    missed.push(`${name}: all`);
    continue;
  }
  const radius = near * ours.diagonal;
  const by = matched(ours.branches, theirs.branches, radius);
  const back = matched(theirs.branches, ours.branches, radius);
  console.log(`| ${name} | ${theirs.curves} | ${ours.milliseconds.toFixed(2)} | ` +
    `${theirs.milliseconds.toFixed(0)} | ${(theirs.milliseconds / ours.milliseconds).toFixed(0)} | ` +
    `${ours.branches.length} | ${theirs.branches.length} | ${by.count} of ${by.long} | ` +
    `${back.count} of ${back.long} | ${ours.verified ? 'yes' : 'NO'} |`);
  if (by.count < by.long) missed.push(`${name}: ${by.long - by.count} of ${by.long}`);
  failed ||= !ours.verified;
}
console.log(`\nBranches that flo-mat misses: ${missed.join('; ') || 'none'}.`);
process.exit(failed ? 1 : 0);
