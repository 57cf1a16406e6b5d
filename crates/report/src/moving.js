const at = id => document.getElementById(id);
const data = JSON.parse(at("data").textContent);
const degrees = 180 / Math.PI;
const within = sine => Math.asin(Math.max(-1, Math.min(1, sine)));
// Turns the bodies of a strip. The hinge opens on the other face: the corner (-toe, h1) of the lower body
// carries the upper one.
function openHinge(lower, upper, turn, back, toe, h1) {
  lower.setAttribute("transform", `rotate(${-turn * degrees} ${toe} 0)`);
  const x = toe + Math.cos(turn) * (-2 * toe) + Math.sin(turn) * h1;
  const y = Math.sin(turn) * 2 * toe + Math.cos(turn) * h1;
  upper.setAttribute("transform",
    `translate(${x + toe} ${y - h1}) rotate(${back * degrees} ${-toe} ${h1})`);
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
// Lets slider, button, choices and histories show the frames of the times, from the frame `open` on;
// page.html#t=9.2 opens there. `readout` has a name and the text at a frame for each number below the slider.
function startPlayer(times, show, readout, open) {
  const last = times.length - 1, slider = at("time"), button = at("play");
  const numbers = readout.map(([name, text], index) => {
    const box = at("now").appendChild(document.createElement("div"));
    const number = box.appendChild(document.createElement("b"));
    number.id = `now_${index}`;
    box.appendChild(document.createElement("span")).textContent = name;
    return frame => { number.textContent = text(frame); };
  });
  const shown = frame => { slider.value = frame; show(frame); numbers.forEach(write => write(frame)); };
  for (const choice of document.querySelectorAll(".controls select:not(#speed)")) {
    choice.addEventListener("change", () => show(Number(slider.value)));
  }
  let playing = null;
  const stop = () => { cancelAnimationFrame(playing); playing = null; button.textContent = "Play"; };
  const play = () => {
    let frame = Number(slider.value) >= last ? 0 : Number(slider.value);
    let time = times[frame], before = performance.now();
    button.textContent = "Pause";
    const tick = now => {
      time += (now - before) / 1000 * Number(at("speed").value);
      before = now;
      while (frame < last && times[frame + 1] <= time) { frame += 1; }
      shown(frame);
      if (frame >= last) { stop(); } else { playing = requestAnimationFrame(tick); }
    };
    playing = requestAnimationFrame(tick);
  };
  button.addEventListener("click", () => playing === null ? play() : stop());
  const go = frame => { stop(); shown(frame); };
  const frameAt = time => Math.max(0, times.findLastIndex(t => t <= time));
  slider.addEventListener("input", () => go(Number(slider.value)));
  for (const { parentElement: plot } of document.querySelectorAll(".cursor")) {
    for (const kind of ["pointerdown", "pointermove"]) {
      plot.addEventListener(kind, event => {
        if (kind === "pointerdown" || event.buttons !== 0) { go(frameAt(timeUnder(event, plot))); }
      });
    }
  }
  const wanted = /^#t=([0-9.]+)$/.exec(location.hash);
  shown(wanted === null ? open : frameAt(Number(wanted[1])));
}
