// The drawn wall: its bodies turn as the history says, and cursors follow.
let factor = 1;
// `asked` are the parameters of the run.
function draw(wall, asked) {
  const { height: h, thickness: b, hinge, overburden } = wall, falls = shown.summary.falls !== null;
  const arm = hinge === null ? h / 2 : Math.min(hinge, h - hinge);
  const largest = shown.summary.u_max / arm;
  factor = falls ? 1 : [10, 5, 2, 1].find(one => one * largest <= 0.3) ?? 1;
  at("shown").textContent =
    factor === 1 ? "To scale" : `Wall to scale, displacement enlarged ${factor}\u00a0times`;
  const half = falls ? 1.05 * h : Math.max(0.5 * h, 1.4 * b);
  const top = 0.16 * h, below = 0.1 * h, line = 0.006 * h;
  const rect = (name, x, y, width, height) =>
    `<rect class="${name}" x="${x}" y="${y}" width="${width}" height="${height}"/>`;
  const load = overburden > 0 ? `<path class="load" d="M0 ${h + line}l${-3 * line} ${6 * line}h${2 * line}` +
    `v${0.08 * h}h${2 * line}v${-0.08 * h}h${2 * line}z"/>` : "";
  const support = hinge === null ? "" : rect("support", -20 * h, h, 20 * h - b, 0.05 * h) +
    rect("support", b, h, 20 * h, 0.05 * h);
  const bodies = hinge === null ? `<g id="lower">${rect("body", -b / 2, 0, b, h)}${load}</g>`
    : `<g id="lower">${rect("body", -b / 2, 0, b, hinge)}</g>` +
      `<g id="upper">${rect("body", -b / 2, hinge, b, h - hinge)}${load}</g>`;
  // ties pull towards the side that they hold the wall from
  const sides = shown.frames.tie?.sides ?? [];
  const ties = sides.map(({ sign }) => `<path class="tie" data-edge="${-sign * half}"/>`).join("");
  const stop = { one_sided_positive: -20 * h - b / 2, one_sided_negative: b / 2 }[asked.rocking];
  const transverse = stop === undefined ? "" : rect("support", stop, 0, 20 * h, 0.94 * h);
  at("wall").setAttribute("viewBox", `${-half} ${-(h + top)} ${2 * half} ${h + top + below}`);
  at("wall").innerHTML = `<g transform="scale(1 -1)" stroke-width="${line}">` +
    rect("support", -20 * h, -20 * h, 40 * h, 20 * h) + `<path class="line" d="M${-20 * h} 0H${20 * h}"/>` +
    `${transverse}${ties}${support}` +
    `<path class="line" stroke-dasharray="${4 * line}" d="M0 0V${1.1 * h}"/>${bodies}</g>`;
}
// Turns the bodies: the point of a body at the height `arm` is displaced by u.
function pose(frame) {
  const { wall, frames, summary } = shown;
  const u = frames.u[frame], t = frames.t[frame];
  const angle = arm => within(factor * u / arm);
  const b = wall.thickness, toe = (u < 0 ? -1 : 1) * b / 2;
  if (wall.hinge === null) {
    const turn = angle(wall.height / 2);
    at("lower").setAttribute("transform", `rotate(${-turn * degrees} ${toe} 0)`);
    if (frames.tie !== null) {
      const x = toe - toe * Math.cos(turn) + Math.sin(turn) * frames.tie.y;
      drawTies(frames.tie, frame, x, b, factor);
    }
  } else {
    openHinge(at("lower"), at("upper"), angle(wall.hinge), angle(wall.height - wall.hinge), toe, wall.hinge);
  }
  const ratio = u / wall.u_ins[u < 0 ? 1 : 0];
  at("time").value = frame;
  at("time").setAttribute("aria-valuetext", `${t.toFixed(2)} s`);
  const fallen = summary.falls !== null && t >= summary.falls;
  at("now").textContent = `${t.toFixed(2)} s: ` + (fallen && Math.abs(ratio) > 1.05 ? "falling"
    : `${(1000 * u).toFixed(1)} mm, ${ratio.toFixed(2)} u_ins`);
  at("tie_now").textContent = frames.tie === null ? "" : `tie: ${statesOf(frames.tie, frame)}, ` +
    `${frames.tie.force[frame].toFixed(1)} kN` +
    (frames.tie.yields ? `, longer by ${longerBy(frames.tie, frame)} mm` : "");
  moveCursors(t, [ratio, frames.f[frame]]);
}
let playing = null;
function stop() {
  cancelAnimationFrame(playing);
  playing = null;
  at("play").textContent = "Play";
}
function play() {
  const last = () => shown.frames.t.length - 1;
  if (Number(at("time").value) >= last()) { pose(0); }
  let time = shown.frames.t[Number(at("time").value)], before = performance.now();
  const tick = now => {
    time += Math.max(0, now - before) / 1000;
    before = now;
    let frame = Math.min(Number(at("time").value), last());
    while (frame < last() && shown.frames.t[frame + 1] <= time) { frame += 1; }
    pose(frame);
    if (frame >= last()) { stop(); } else { playing = requestAnimationFrame(tick); }
  };
  at("play").textContent = "Pause";
  playing = requestAnimationFrame(tick);
}
function scrub(event) {
  if (shown === null || (event.type === "pointermove" && event.buttons === 0)) { return; }
  const time = timeUnder(event, event.currentTarget);
  stop();
  pose(Math.max(0, shown.frames.t.findLastIndex(one => one <= time)));
}
// Lets a pointer on a history choose the time.
function scrubbed(plot) {
  for (const kind of ["pointerdown", "pointermove"]) { plot.addEventListener(kind, scrub); }
  return plot;
}
