const SLAB = 0.22, stage = at("scene");
function add(parent, name, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) { element.setAttribute(key, value); }
  parent.appendChild(element);
  return element;
}
// Levels of the floors; storeys that stand on the ground stand side by side.
let columns = 0;
for (const floor of data.floors) {
  const below = floor.below === null ? null : data.floors[floor.below];
  floor.column = below === null ? columns++ : below.column;
  floor.from = below === null ? 0 : below.level + SLAB;
  floor.level = floor.from + floor.height;
}
const width = Math.max(...data.floors.map(floor => floor.width));
const left = floor => floor.column * (width + 3) - width / 2;
const parapets = Math.max(0, ...data.walls.filter(wall => wall.hinge === null).map(wall => wall.height));
const high = Math.max(...data.floors.map(floor => floor.level)) + SLAB + 1.3 * parapets + 0.4;
const reach = columns * (width + 3) - 3, low = -0.9, side = Math.max(1.6, 0.8 * parapets);
stage.setAttribute("viewBox", `${-width / 2 - side} ${-high} ${reach + 2 * side} ${high - low}`);
const line = 0.004 * (reach + 2 * side);
const world = add(stage, "g", { transform: "scale(1 -1)", "stroke-width": line });
add(world, "rect", { class: "slab", x: -99, y: low - 50, width: 999, height: 50 - low });
for (const floor of data.floors) {
  floor.columns = [0, 1].map(() => add(world, "path", { class: "column", "stroke-width": 3 * line }));
  floor.group = add(world, "g", {});
  add(floor.group, "rect",
    { class: "slab", x: left(floor) - 0.15, y: floor.level, width: width + 0.3, height: SLAB });
  const label = add(floor.group, "text",
    { class: "label", transform: "scale(1 -1)", x: left(floor) + 0.6, y: 0.5 - floor.level });
  label.textContent = floor.name;
}
for (const wall of data.walls) {
  const names = wall.hinge === null ? ["lower"] : ["lower", "upper"];
  wall.group = add(world, "g", {});
  const size = part => part === "upper" ? wall.height - wall.hinge : wall.hinge ?? wall.height;
  wall.parts = wall.shape === null ? names.map(part => add(wall.group, "rect",
    { class: "body", x: -wall.thickness / 2, y: part === "upper" ? wall.hinge : 0,
      width: wall.thickness, height: size(part) })) : wall.shape.bodies.map(parts => {
    const body = add(wall.group, "g", {});
    parts.forEach(corners => add(body, "polygon", { class: "body", points: corners.join(" ") }));
    return body;
  });
}
const isFalling = (wall, frame) => wall.falls !== null && data.t[frame] >= wall.falls;
const readout = [["t (s)", (frame) => data.t[frame].toFixed(2)],
  ["ground (m/s²)", (frame) => data.ground[frame].toFixed(2)],
  ...data.floors.slice(-1).map(floor => [`${floor.name} (m/s²)`, frame => floor.a[frame].toFixed(2)]),
  ...data.walls.map(wall => [`${wall.name} u (mm)`, frame =>
    isFalling(wall, frame) ? "falls" : (1000 * wall.u[frame]).toFixed(0)])];
function show(frame) {
  const factor = Number(at("sway").value), rocking = Number(at("rocking").value);
  const sway = index => index === null ? 0 : factor * data.floors[index].x[frame];
  data.floors.forEach((floor, index) => {
    const x = sway(index), below = sway(floor.below);
    floor.group.setAttribute("transform", `translate(${x} 0)`);
    floor.columns.forEach((column, end) => {
      const foot = left(floor) + 0.2 + end * (width - 0.4), middle = (floor.from + floor.level) / 2;
      const start = foot + below, tip = foot + x;
      column.setAttribute("d",
        `M${start} ${floor.from}C${start} ${middle} ${tip} ${middle} ${tip} ${floor.level}`);
    });
  });
  for (const wall of data.walls) {
    const floor = wall.bottom === null ? null : data.floors[wall.bottom];
    const edge = (floor === null ? -width / 2 : left(floor)) + 0.5;
    const x = edge + wall.place * (width - 1) + sway(wall.bottom);
    const y = floor === null ? 0 : floor.level + SLAB;
    wall.group.setAttribute("transform", `translate(${x} ${y})`);
    const drift = wall.top === null ? 0 : sway(wall.top) - sway(wall.bottom);
    turnWall(wall, wall.parts, (isFalling(wall, frame) ? 1 : rocking) * wall.u[frame], drift);
  }
  moveCursors(data.t[frame], [0, 0]);
}
startPlayer(data.t, show, readout, data.open);
