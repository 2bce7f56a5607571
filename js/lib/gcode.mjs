// Plain G-code, as the command line writes it.

const SHORTEST_ARC = 1e-3; // six decimals do not hold the centre of a shorter one

function decimal(value) {
  const text = value.toFixed(6).replace(/\.?0+$/, "");
  return text === "-0" ? "0" : text;
}

/** The centre of an arc, from its start. */
function center([x0, y0], [x1, y1], bulge) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const across = (1 - bulge * bulge) / (4 * bulge);
  return [0.5 * dx - across * dy, 0.5 * dy + across * dx];
}

/** The program of some paths, in millimetres with z 0 on the surface. */
export function gcode(paths, { safe = 5, feed = 1000, plunge = 300, spindle = 0, yDown = false } = {}) {
  const lines = ["(medial carve: millimetres, z 0 on the surface)", "G21 G90 G17 G94"];
  if (spindle > 0) lines.push(`M3 S${decimal(spindle)}`);
  lines.push(`G0 Z${decimal(safe)}`);
  let at = [0, 0, 0];
  let down = false;
  let current = 0;
  const lift = () => {
    if (down) lines.push(`G0 Z${decimal(safe)}`);
    down = false;
  };
  const move = (bulge, to) => {
    const [x, y, z] = to.map(decimal);
    const same_place = x === decimal(at[0]) && y === decimal(at[1]);
    const same_height = z === decimal(at[2]);
    if (same_place && same_height && Math.abs(bulge) < 1) return;
    let text = `G1${same_place ? "" : ` X${x} Y${y}`}${same_height ? "" : ` Z${z}`}`;
    if (bulge !== 0 && Math.hypot(to[0] - at[0], to[1] - at[1]) > SHORTEST_ARC) {
      const [i, j] = center(at, to, bulge);
      text = `${bulge > 0 ? "G3" : "G2"} X${x} Y${y} I${decimal(i)} J${decimal(j)}`;
    }
    const wanted = same_place && to[2] < at[2] ? plunge : feed;
    if (wanted !== current) text += ` F${decimal(wanted)}`;
    current = wanted;
    lines.push(text);
  };
  for (const { points } of paths) {
    const upright = points.map(([x, y, z, bulge]) => (yDown ? [x, -y, z, -bulge] : [x, y, z, bulge]));
    const [x, y, z] = upright[0];
    if (!down || x !== at[0] || y !== at[1] || z !== at[2]) {
      lift();
      lines.push(`G0 X${decimal(x)} Y${decimal(y)}`, `G1 Z${decimal(z)} F${decimal(plunge)}`);
      current = plunge;
      down = true;
    }
    at = [x, y, z];
    upright.slice(1).forEach((row, i) => {
      move(upright[i][3], row.slice(0, 3));
      at = row.slice(0, 3);
    });
  }
  lift();
  if (spindle > 0) lines.push("M5");
  return `${lines.join("\n")}\nM2\n`;
}
