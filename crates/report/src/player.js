// Starts a page at the frame `open`, or at the time of page.html#t=9.2. `readout` has a name and the text at
// a frame for each number below the slider.
function startPlayer(times, show, readout, open) {
  const numbers = readout.map(([name, text], index) => {
    const box = at("now").appendChild(document.createElement("div"));
    const number = box.appendChild(document.createElement("b"));
    number.id = `now_${index}`;
    box.appendChild(document.createElement("span")).textContent = name;
    return frame => { number.textContent = text(frame); };
  });
  const shown = frame => { at("time").value = frame; show(frame); numbers.forEach(write => write(frame)); };
  for (const choice of document.querySelectorAll(".controls select:not(#speed)")) {
    choice.addEventListener("change", () => show(Number(at("time").value)));
  }
  const { frameAt } = player(() => times, shown), wanted = /^#t=([0-9.]+)$/.exec(location.hash);
  shown(wanted === null ? open : frameAt(Number(wanted[1])));
}
