// The rows of missions as they are drawn, and how the drones on the map stand, at one instant.
// Batteries are left out: a replay has them between what was measured.
async () => {
  const drawn = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  const { world } = await import("/pages/core/station.js");
  const seen = () => [...document.querySelectorAll(".page:not([hidden]) .mission-entry")].map((row) => {
    const shown = row.cloneNode(true);
    shown.querySelectorAll(".battery").forEach((battery) => battery.remove());
    return shown.textContent;
  });
  const drones = () => Object.fromEntries([...document.querySelectorAll(".page:not([hidden]) .drone")]
    .map(({ dataset: { drone, status } }) => [drone, status]));
  for (;;) {
    const { time } = world.state.peek();
    await drawn();
    const view = { time, missions: seen(), drones: drones() };
    if (world.state.peek().time === time) return view;
  }
}
