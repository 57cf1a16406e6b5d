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
