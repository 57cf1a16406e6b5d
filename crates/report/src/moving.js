const degrees = 180 / Math.PI;
const within = sine => Math.asin(Math.max(-1, Math.min(1, sine)));
// Turns the bodies of a wall to the displacement u, with its top displaced by `drift` from its foot, and
// returns the function of the height that says where ties hold it. A strip's hinge opens on the other face:
// that edge of the lower body, a corner of a rectangle, carries the upper one. The wall says its height,
// thickness, hinge, whether rotations are full, and, unless it is a rectangle, its shape: toes, edges of the
// hinge, the height of u, and of one body the arms of the centroid from its toes.
function turnWall(wall, [lower, upper], u, drift = 0) {
  const { height: h, thickness: b, hinge: h1, full, shape } = wall, side = u < 0 ? 1 : 0;
  const toe = (shape?.toes ?? [b / 2, -b / 2])[side];
  // The angle of a body whose point at the height `arm` is displaced by u; it lies flat at u = arm. With full
  // rotations, s is the horizontal distance from the toe: of a strip's hinge (u - b), of the centroid of a
  // body of parts (u - x), or of the far corner of a rectangle's top (2 u - b).
  const angle = (u, arm) => {
    if (!full) { return within(u / arm); }
    const corner = h1 === null && !shape, far = shape?.arms?.[side] ?? b;
    const d = Math.hypot(corner ? h : arm, far), s = (corner ? 2 : 1) * Math.abs(u) - far;
    return Math.sign(u) * (within(s / d) + within(far / d));
  };
  const turn = h1 === null ? angle(u, shape?.centroid ?? h / 2) : angle(u + drift * h1 / h, h1);
  lower.setAttribute("transform", `rotate(${-turn * degrees} ${toe} 0)`);
  if (h1 === null) { return height => toe - toe * Math.cos(turn) + Math.sin(turn) * height; }
  const h2 = h - h1, back = angle(u - drift * h2 / h, h2), edge = shape?.edges[side] ?? -toe;
  const x = toe + Math.cos(turn) * (edge - toe) + Math.sin(turn) * h1;
  const y = Math.sin(turn) * (toe - edge) + Math.cos(turn) * h1;
  upper.setAttribute("transform",
    `translate(${x - edge} ${y - h1}) rotate(${back * degrees} ${edge} ${h1})`);
  return height => height <= h1 ? toe - toe * Math.cos(turn) + Math.sin(turn) * height
    : (toe - toe * Math.cos(turn) + Math.sin(turn) * h1) * (h - height) / h2;
}
function place(element, x, y) {
  element.style.left = 100 * x + "%";
  if (y !== undefined) { element.style.top = 100 * y + "%"; }
}
// Moves the cursors of all plots to the time t, and the dot of one over other quantities to `point`.
function moveCursors(t, point) {
  for (const plot of document.querySelectorAll(".plot")) {
    const [left, right, top, bottom] = JSON.parse(plot.dataset.area);
    const [x0, x1, y0, y1] = JSON.parse(plot.dataset.ranges);
    const cursor = plot.querySelector(".cursor"), dot = plot.querySelector(".dot");
    if (cursor) {
      const part = (t - x0) / (x1 - x0);
      cursor.hidden = part > 1;
      place(cursor, left + (right - left) * part);
    }
    if (dot) {
      const px = (point[0] - x0) / (x1 - x0), py = (y1 - point[1]) / (y1 - y0);
      dot.hidden = px < 0 || px > 1 || py < 0 || py > 1;
      place(dot, left + (right - left) * px, top + (bottom - top) * py);
    }
  }
}
// Returns the time at which the pointer is on a history.
function timeUnder(event, plot) {
  const [left, right] = JSON.parse(plot.dataset.area), [from, to] = JSON.parse(plot.dataset.ranges);
  const box = plot.getBoundingClientRect();
  return from + (to - from) * ((event.clientX - box.left) / box.width - left) / (right - left);
}
// ---- ties, as run::page::tie describes them
const tieStates = ["slack", "pulls", "yields", "broken"];
const ofSides = (ties, text) => ties.flatMap(tie => tie.sides.map(text)).join(" / ");
const statesOf = (ties, frame) => ofSides(ties, side => tieStates[side.state[frame]]);
const longerBy = (ties, frame) => ofSides(ties, side => side.p[frame].toFixed(1));
const forcesOf = (ties, frame) => ties.map(tie => tie.force[frame].toFixed(1)).join(" / ");
// Draws the ties of a frame to the wall, which `place` says where to find at a height, with displacements
// enlarged by `factor`: sagging while slack, hanging down once broken. A parabola over the span l that is
// longer by d sags by the root of 3/8 l d.
function drawTies({ ties, thickness }, frame, place, factor) {
  const sides = ties.flatMap(tie => tie.sides.map(side => ({ y: tie.y, ...side })));
  document.querySelectorAll(".tie").forEach((line, index) => {
    const { y, state, free } = sides[index], x = place(y), edge = Number(line.dataset.edge);
    const middle = (edge + x) / 2, span = Math.abs(x - edge);
    const face = x + Math.sign(edge) * 0.55 * thickness;
    const sag = Math.sqrt(0.375 * span * free[frame] * factor);
    const to = tieStates[state[frame]] === "broken"
      ? `Q${middle} ${y} ${middle} ${y - span / 2}M${face} ${y}v${-span / 4}`
      : `Q${middle} ${y - 2 * sag} ${x} ${y}`;
    line.setAttribute("d", `M${9 * edge} ${y}H${edge}${to}`);
    line.setAttribute("class", `tie ${tieStates[state[frame]]}`);
  });
}
// ---- time
// Lets slider, button and histories show frames, of which `times` returns the times. Returns whether it
// plays, and which frame a time has.
function player(times, show) {
  const slider = at("time"), button = at("play"), last = () => times().length - 1;
  let playing = null;
  const stop = () => { cancelAnimationFrame(playing); playing = null; button.textContent = "Play"; };
  const play = () => {
    if (Number(slider.value) >= last()) { show(0); }
    let time = times()[Number(slider.value)], before = performance.now();
    const tick = now => {
      time += Math.max(0, now - before) / 1000 * Number(at("speed")?.value ?? 1);
      before = now;
      let frame = Math.min(Number(slider.value), last());
      while (frame < last() && times()[frame + 1] <= time) { frame += 1; }
      show(frame);
      if (frame >= last()) { stop(); } else { playing = requestAnimationFrame(tick); }
    };
    button.textContent = "Pause";
    playing = requestAnimationFrame(tick);
  };
  const go = frame => { stop(); show(frame); };
  const frameAt = time => Math.max(0, times().findLastIndex(t => t <= time));
  button.addEventListener("click", () => playing === null ? play() : stop());
  slider.addEventListener("input", () => go(Number(slider.value)));
  for (const kind of ["pointerdown", "pointermove"]) {
    document.addEventListener(kind, event => {
      const plot = event.target.closest?.(".plot:has(.cursor)") ?? null;
      if (plot !== null && (kind === "pointerdown" || event.buttons !== 0)) {
        go(frameAt(timeUnder(event, plot)));
      }
    });
  }
  return { isPlaying: () => playing !== null, frameAt };
}
