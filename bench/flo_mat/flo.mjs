// flo-mat in a process of its own, warm: gets paths, sends its time and axis.

import * as flo from 'flo-mat';

const rounds = Number(process.argv[2]);

/** Its default accuracy, nothing simplified or culled. */
const axisOf = paths =>
  flo.findMats(flo.getPathsFromStr(paths.join('\n')), { applySat: false, simplify: false });

/** The least milliseconds of processor time of all rounds but the first, and the axis' curves and branches. */
function run(paths) {
  let milliseconds = Infinity, mats;
  for (let round = 0; round <= rounds; ++round) {
    const begin = process.cpuUsage();
    mats = axisOf(paths);
    const { user, system } = process.cpuUsage(begin);
    if (round > 0) milliseconds = Math.min(milliseconds, 1e-3 * (user + system));
  }
  const branches = mats.flatMap(({ cpNode }) => (cpNode ? flo.getBranches(cpNode) : []));
  const center = node => node.cp.circle.center;
  return {
    milliseconds,
    edges: flo.getPathsFromStr(paths.join('\n')).reduce((sum, loop) => sum + loop.length, 0),
    branches: branches.map(branch => [center(branch[0]), center(branch[branch.length - 1].next)]),
    curves: branches.flatMap(branch => branch.map(node => flo.CpNodeFs.getMatCurveToNext(node))),
  };
}

for (let i = 0; i < 10; ++i) axisOf(['M0 0C30 -20 60 20 100 0L100 40Q50 60 0 40ZM20 10L20 20L40 20L40 10Z']);

process.on('message', paths => {
  try {
    process.send(run(paths));
  } catch (error) {
    process.send({ error: error.message });
  }
});
process.on('disconnect', () => process.exit());
