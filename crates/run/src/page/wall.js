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
const ratio = frame => data.u[frame] / (data.u[frame] < 0 ? data.u_ins[1] : data.u_ins[0]);
const strip = data.hinge !== null;
const readout = [["t (s)", frame => data.t[frame].toFixed(2)],
  [strip ? "u, hinge (mm)" : "u, mid-height (mm)", frame => (1000 * data.u[frame]).toFixed(1)],
  [strip ? "rotation (%)" : "top (mm)", frame => data.second[frame].toFixed(1)],
  ["u / u_ins", frame => ratio(frame).toFixed(3)],
  [`${strip ? "a, bottom" : "a, base"} (m/s²)`, frame => data.a[frame].toFixed(2)]];
if (data.tie !== null) {
  readout.push(["tie (kN)", frame => data.tie.force[frame].toFixed(1)]);
  readout.push(["tie", frame => statesOf(data.tie, frame)]);
  if (data.tie.yields) { readout.push(["tie longer by (mm)", frame => longerBy(data.tie, frame)]); }
}
function show(frame) {
  const t = data.t[frame];
  drawTies(data.tie, frame, pose(data.u[frame]), data.thickness, Number(at("shown").value));
  const overturned = data.overturned !== null && t >= data.overturned;
  at("overturned").textContent = overturned ? `overturned at t = ${data.overturned.toFixed(3)} s` : "";
  moveCursors(t, [ratio(frame), data.f[frame] / 1000]);
}
startPlayer(data.t, show, readout, data.open);
