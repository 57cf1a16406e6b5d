const ratio = frame => data.u[frame] / (data.u[frame] < 0 ? data.u_ins[1] : data.u_ins[0]);
const strip = data.hinge !== null;
const measured = strip ? "hinge" : data.shape ? "centroid" : "mid-height";
const readout = [["t (s)", frame => data.t[frame].toFixed(2)],
  [`u, ${measured} (mm)`, frame => (1000 * data.u[frame]).toFixed(1)],
  [strip ? "rotation (%)" : "top (mm)", frame => data.second[frame].toFixed(1)],
  ["u / u_ins", frame => ratio(frame).toFixed(3)],
  [`${strip ? "a, bottom" : "a, base"} (m/s²)`, frame => data.a[frame].toFixed(2)]];
if (data.ties.length > 0) {
  readout.push(["tie (kN)", frame => forcesOf(data.ties, frame)]);
  readout.push(["tie", frame => statesOf(data.ties, frame)]);
  if (data.ties.some(tie => tie.yields)) {
    readout.push(["tie longer by (mm)", frame => longerBy(data.ties, frame)]);
  }
}
function show(frame) {
  const t = data.t[frame];
  const factor = Number(at("shown").value);
  drawTies(data, frame, turnWall(data, [at("lower"), at("upper")], factor * data.u[frame]), factor);
  const overturned = data.overturned !== null && t >= data.overturned;
  at("overturned").textContent = overturned ? `overturned at t = ${data.overturned.toFixed(3)} s` : "";
  moveCursors(t, [ratio(frame), data.f[frame] / 1000]);
}
startPlayer(data.t, show, readout, data.open);
