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
