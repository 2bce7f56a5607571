// medial beside flo-mat: the same paths, one run, warm, one thread. Prints Markdown.
// node compare.mjs MEDIAL [--rounds N] [--tolerance T | equal] [--vertices LEAST MOST]
//   [FILE.svg | FILE.wkt | FILE.wkt.gz | FOLDER ...]; see README.md.

import { execFileSync, fork, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join } from 'node:path';

import { branchesOf, curvesOf, diagonalOf, Distances, evaluate, matched, nodesOf, samplesOf, spread }
  from './axes.mjs';
import { pathsOf, polygonsOf } from './paths.mjs';

let tolerances = [1e-6];   // of medial's arcs, relative to the diagonal; none: as exact as flo-mat is
const finest = 1e-9;     // the axis that both are measured against
const goal = 300;        // times as fast
const samples = 2000;    // of an axis, by its length
const rounding = 1e-14;  // of coordinates, relative to the diagonal
const patience = 20;     // seconds for flo-mat on one shape, and some for each edge
const near = 1e-3;       // ends of branches at the same place, relative to the diagonal

// What "as exact as" may mean: which distance of medial's must not be above flo-mat's.
const accuracies = {
  'its points': errors => errors.from.most,
  'both ways': errors => Math.max(errors.from.most, errors.to.most),
  'largest': errors => Math.max(errors.from.largest, errors.to.largest),
};

try {
  import.meta.resolve('flo-mat');
} catch (error) {
  console.log(`skipped: flo-mat is not installed (npm install in bench/flo_mat): ${error.message}`);
  process.exit(0);
}

const words = process.argv.slice(2);
const medial = words.shift();
let rounds = 3, fewest = 0, most = Infinity;
while (words[0]?.startsWith('--')) {
  const name = words.shift();
  if (name === '--rounds') rounds = Number(words.shift());
  else if (name === '--vertices') [fewest, most] = words.splice(0, 2).map(Number);
  else if (name === '--tolerance') tolerances = words[0] === 'equal' ? (words.shift(), []) : [Number(words.shift())];
  else rounds = 0;
}
if (!medial || !existsSync(medial) || !(rounds >= 1) || !tolerances.every(t => t > 0)) {
  console.error('usage: node compare.mjs MEDIAL [--rounds N] [--tolerance T | equal] ' +
                '[--vertices LEAST MOST] [FILE | FOLDER ...]');
  process.exit(2);
}

let child;  // where flo-mat runs
const folder = mkdtempSync(join(tmpdir(), 'flo-mat-'));
process.on('exit', () => {
  child?.kill('SIGKILL');
  rmSync(folder, { recursive: true, force: true });
});

/** The shapes to compare: `paths` that are one shape each, by names and kinds. A file of a folder has a
 * shape in each path, any other file is one shape. */
function* inputs() {
  const files = words.flatMap(word => statSync(word).isDirectory()
    ? readdirSync(word).sort().map(name => ({ file: join(word, name), kind: basename(word) }))
    : [{ file: word }]);
  if (words.length === 0) {
    const papers = join(dirname(medial), '..', 'papers', 'medial_papers');
    execFileSync(papers, ['aichholzer_2009', '--quick', '--output', folder]);
    files.push(...['tree', 'snowflake', 'lettering', 'border'].map(
      name => ({ file: join(folder, 'aichholzer_2009', `${name}.svg`) })));
  }
  for (const { file, kind } of files) {
    const name = basename(file).replace(/\.(svg|wkt|wkt\.gz)$/, '');
    const paths = file.endsWith('.svg') ? pathsOf(file) : /\.wkt(\.gz)?$/.test(file) ? polygonsOf(file, fewest, most) : [];
    if (kind === undefined) yield { name, kind: 'files', paths };
    else for (const [i, path] of paths.entries()) {
      yield { name: paths.length > 1 ? `${name}, ${i + 1}` : name, kind, paths: [path] };
    }
  }
}

/** Writes an SVG with each path `copies` times, each time a feature of its own. */
function writeSvg(name, paths, copies) {
  const element = d => `<path d="${d}"/>\n`;
  const file = join(folder, name);
  writeFileSync(file, '<svg xmlns="http://www.w3.org/2000/svg">\n' +
    paths.map(d => element(d).repeat(copies)).join('') + '</svg>\n');
  return file;
}

/** flo-mat's time, curves and branches of one shape, from a process that is ended where it takes too long. */
async function runFlo(paths) {
  child ??= fork(new URL('flo.mjs', import.meta.url).pathname, [`${rounds}`], { serialization: 'advanced' });
  const edges = paths.join('').match(/[A-Z]/g).length;
  const seconds = patience + 0.02 * (rounds + 1) * edges;
  const result = await new Promise(resolve => {
    const exit = () => resolve({ error: 'ends' });
    const timer = setTimeout(() => resolve({ error: `takes more than ${seconds.toFixed(0)} s` }), 1e3 * seconds);
    child.once('exit', exit);
    child.once('message', message => { child.off('exit', exit); clearTimeout(timer); resolve(message); });
    child.send(paths);
  });
  if (!result.curves) {
    child.kill('SIGKILL');
    child = undefined;
    throw new Error(result.error);
  }
  return result;
}

/** medial's axis of one copy of a shape, and whether it is verified if that is asked for. */
function axisOf(paths, options, tolerance, verify = false) {
  const axis = join(folder, 'axis.json');
  const once = writeSvg('once.svg', paths, 1);
  const all = [...options, '--arc-tolerance', `${tolerance}`, '--quiet'];
  execFileSync(medial, ['axis', once, '--threads', '1', ...all, '-o', axis], { stdio: 'pipe' });
  const verified = verify && spawnSync(medial, ['verify', once, axis, ...all]).status === 0;
  return { verified, native: JSON.parse(readFileSync(axis, 'utf8')) };
}

/** How medial has to read paths that cross themselves; flo-mat always mends them. */
function optionsFor(paths) {
  try {
    axisOf(paths, [], 1e-6);
    return [];
  } catch {
    return ['--repair=non-zero'];
  }
}

/** medial's milliseconds: of the processor, on one thread, from Bezier curves to the axis, without
 * reading, as flo-mat's are; warm: what a run with many copies of the shape takes longer than a run with
 * one. */
function timeOf(paths, options, tolerance, edges) {
  const copies = Math.max(20, Math.min(500, Math.round(20000 / edges)));
  const once = writeSvg('once.svg', paths, 1);
  const often = writeSvg('often.svg', paths, copies + 1);
  const all = [...options, '--threads', '1', '--arc-tolerance', `${tolerance}`, '--quiet', '--stats', '--json'];
  const run = input => {
    const told = JSON.parse(execFileSync(medial, ['axis', input, ...all], { encoding: 'utf8' }));
    return 1e3 * (told.processor.shape + told.processor.axis);
  };
  const least = input => Math.min(...Array.from({ length: rounds + 1 }, () => run(input)));
  return (least(often) - least(once)) / copies;
}

/** How far an axis is from the true one, and the true one from it. `points` are the axis' own. */
function errorsOf(points, curves, truth) {
  const own = new Distances(curves, truth.diagonal);
  const from = spread(points.map(point => truth.distances.of(point) / truth.diagonal));
  const away = truth.samples.map(point => own.of(point) / truth.diagonal);
  return { from, to: spread(away), missed: away.filter(d => d > near).length / away.length };
}

const pointsOf = native => nodesOf(native).concat(samplesOf(curvesOf(native), samples));

/** The coarsest tolerances at which medial's axis is as near to the true one as flo-mat's is. */
function equalTolerances(paths, options, theirs, truth) {
  const names = Object.keys(accuracies);
  const found = {};
  for (let t = 1e-2; names.some(name => !(name in found)); t /= 10 ** 0.5) {
    const last = t < 2 * finest;
    const { native } = axisOf(paths, options, last ? finest : t);
    const errors = errorsOf(pointsOf(native), curvesOf(native), truth);
    for (const name of names.filter(name => !(name in found))) {
      if (last || accuracies[name](errors) <= accuracies[name](theirs) + rounding) found[name] = last ? finest : t;
    }
  }
  return names.map(name => found[name]);
}

/** Everything about one shape. */
async function compare(paths) {
  const theirs = await runFlo(paths);
  if (theirs.curves.length === 0) throw new Error('finds no axis');
  const options = optionsFor(paths);
  const { native } = axisOf(paths, options, finest);
  const truth = { diagonal: diagonalOf(native), samples: samplesOf(curvesOf(native), samples) };
  truth.distances = new Distances(curvesOf(native), truth.diagonal);
  const floPoints = theirs.curves.flatMap(curve => [0.25, 0.5, 0.75, 1].map(t => evaluate(curve, t).point));
  const errors = errorsOf(floPoints, theirs.curves, truth);
  const wanted = tolerances.length > 0 ? tolerances : equalTolerances(paths, options, errors, truth);
  const times = new Map();
  for (const tolerance of wanted) {
    if (!times.has(tolerance)) times.set(tolerance, timeOf(paths, options, tolerance, theirs.edges));
  }
  const ours = axisOf(paths, options, wanted[0], true);
  const branches = branchesOf(ours.native);
  const radius = near * truth.diagonal;
  return {
    theirs, errors, branches, times, verified: ours.verified, repaired: options.length > 0,
    tolerances: wanted, ratios: wanted.map(t => theirs.milliseconds / times.get(t)),
    by: matched(branches, theirs.branches, radius), back: matched(theirs.branches, branches, radius),
  };
}

const power = value => value.toExponential(0);
const names = tolerances.length > 0 ? tolerances.map(power) : Object.keys(accuracies);
const columns = ['shape', 'edges', 'flo-mat: error', 'true axis to it', 'farthest', 'beyond 1e-3', 'flo-mat ms',
  ...names.flatMap(name => [`${name}: tolerance`, 'medial ms', 'ratio']), 'branches medial', 'branches flo-mat',
  'medial\'s found by flo-mat', 'flo-mat\'s found by medial', 'verified'];
console.log(`| ${columns.join(' | ')} |`);
console.log(`| --- |${' ---: |'.repeat(columns.length - 2)} --- |`);

const missed = [], kinds = new Map();
let failed = false;
for (const { name, kind, paths } of inputs()) {
  if (!kinds.has(kind)) kinds.set(kind, { failures: [], refused: [], ratios: names.map(() => []) });
  const summary = kinds.get(kind);
  let result;
  try {
    result = await compare(paths);
  } catch (error) {
    const text = (error.stderr?.toString() || error.message).trim().split('\n')[0];
    (error.stderr ? summary.refused : summary.failures).push(`${name} (${text})`);
    continue;
  }
  const { theirs, errors, branches, times, by, back } = result;
  console.log('| ' + [name + (result.repaired ? ' (repaired)' : ''), theirs.edges, power(errors.from.most),
    power(errors.to.most), power(errors.to.largest), `${(100 * errors.missed).toFixed(1)} %`,
    theirs.milliseconds.toFixed(0), ...result.tolerances.flatMap((tolerance, i) =>
      [power(tolerance), times.get(tolerance).toFixed(3), result.ratios[i].toFixed(0)]),
    branches.length, theirs.branches.length, `${by.count} of ${by.long}`, `${back.count} of ${back.long}`,
    result.verified ? 'yes' : 'NO'].join(' | ') + ' |');
  result.ratios.forEach((ratio, i) => summary.ratios[i].push(ratio));
  if (by.count < by.long || errors.missed > 0) {
    missed.push(`${name}: ${by.long - by.count} of ${by.long} (${(100 * errors.missed).toFixed(1)} %)`);
  }
  failed ||= !result.verified;
}

console.log(`\n| kind | accuracy | shapes | ${goal} times or more | median | least | flo-mat fails | medial refuses |`);
console.log('| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |');
for (const [kind, { failures, refused, ratios }] of kinds) {
  ratios.forEach((all, i) => {
    const sorted = [...all].sort((a, b) => a - b);
    const enough = sorted.filter(ratio => ratio >= goal).length;
    const text = value => (value ?? NaN).toFixed(0);
    console.log(`| ${kind} | ${names[i]} | ${sorted.length} | ${enough} | ` +
      `${text(sorted[Math.floor(sorted.length / 2)])} | ${text(sorted[0])} | ${failures.length} | ${refused.length} |`);
  });
}
for (const [kind, { failures, refused }] of kinds) {
  if (failures.length > 0) console.log(`\nflo-mat fails (${kind}): ${failures.join('; ')}.`);
  if (refused.length > 0) console.log(`\nmedial refuses (${kind}): ${refused.join('; ')}.`);
}
console.log('\nBranches that flo-mat misses (and how much of the true axis is more than 1e-3 away from its): ' +
            `${missed.join('; ') || 'none'}.`);
process.exit(failed ? 1 : 0);
