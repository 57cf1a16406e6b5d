// Returns the angle of a body whose point at the height `arm` is displaced by u; it lies flat at u = arm.
// With full rotations, s is the horizontal distance from the toe: of a strip's hinge (u - b), or of the far
// corner of a parapet's top (2 u - b).
const angle = (u, arm) => {
  if (!data.full) { return within(u / arm); }
  const b = data.thickness, h = data.hinge === null ? data.height : arm, d = Math.hypot(h, b);
  const s = (data.hinge === null ? 2 : 1) * Math.abs(u) - b;
  return Math.sign(u) * (within(s / d) + within(b / d));
};
// Turns the wall to the displacement u, and returns where its tie is.
function pose(u) {
  const b = data.thickness, shown = u * Number(at("shown").value);
  const side = shown < 0 ? -1 : 1, toe = side * b / 2;
  if (data.hinge === null) {
    const turn = angle(shown, data.height / 2);
    at("lower").setAttribute("transform", `rotate(${-turn * degrees} ${toe} 0)`);
    return toe - toe * Math.cos(turn) + Math.sin(turn) * (data.tie === null ? 0 : data.tie.y);
  }
  const h1 = data.hinge, turn = angle(shown, h1), back = angle(shown, data.height - h1);
  openHinge(at("lower"), at("upper"), turn, back, toe, h1);
  return 0;
}
const states = ["slack", "pulls", "yields", "broken"];
// Draws the ties of a frame to the wall at x: sagging while slack, hanging down once broken. A parabola over
// the span l that is longer by d sags by the root of 3/8 l d.
function drawTies(frame, x) {
  document.querySelectorAll(".tie").forEach((tie, index) => {
    const { state, free } = data.tie.sides[index], y = data.tie.y, edge = Number(tie.dataset.edge);
    const middle = (edge + x) / 2, span = Math.abs(x - edge);
    const face = x + Math.sign(edge) * 0.55 * data.thickness;
    const sag = Math.sqrt(0.375 * span * free[frame] * Number(at("shown").value));
    const to = states[state[frame]] === "broken"
      ? `Q${middle} ${y} ${middle} ${y - span / 2}M${face} ${y}v${-span / 4}`
      : `Q${middle} ${y - 2 * sag} ${x} ${y}`;
    tie.setAttribute("d", `M${9 * edge} ${y}H${edge}${to}`);
    tie.setAttribute("class", `tie ${states[state[frame]]}`);
  });
}
const ratio = frame => data.u[frame] / (data.u[frame] < 0 ? data.u_ins[1] : data.u_ins[0]);
const strip = data.hinge !== null;
const readout = [["t (s)", frame => data.t[frame].toFixed(2)],
  [strip ? "u, hinge (mm)" : "u, mid-height (mm)", frame => (1000 * data.u[frame]).toFixed(1)],
  [strip ? "rotation (%)" : "top (mm)", frame => data.second[frame].toFixed(1)],
  ["u / u_ins", frame => ratio(frame).toFixed(3)],
  [`${strip ? "a, bottom" : "a, base"} (m/s²)`, frame => data.a[frame].toFixed(2)]];
if (data.tie !== null) {
  const ofSides = text => frame => data.tie.sides.map(side => text(side, frame)).join(" / ");
  readout.push(["tie (kN)", frame => data.tie.force[frame].toFixed(1)]);
  readout.push(["tie", ofSides((side, frame) => states[side.state[frame]])]);
  if (data.tie.yields) {
    readout.push(["tie longer by (mm)", ofSides((side, frame) => side.p[frame].toFixed(1))]);
  }
}
function show(frame) {
  const t = data.t[frame];
  drawTies(frame, pose(data.u[frame]));
  const overturned = data.overturned !== null && t >= data.overturned;
  at("overturned").textContent = overturned ? `overturned at t = ${data.overturned.toFixed(3)} s` : "";
  moveCursors(t, [ratio(frame), data.f[frame] / 1000]);
}
startPlayer(data.t, show, readout, data.open);
