// What list and map of the Monitor say of each drone.
() => {
  const monitor = document.querySelector(".monitor-page");
  const back = monitor.querySelector("svg.floor-picture g.world").getScreenCTM().inverse();
  const marks = new Map([...monitor.querySelectorAll("svg .drone")].map((mark) => {
    const box = mark.querySelector(".body").getBoundingClientRect();
    const { x, y } = new DOMPoint((box.left + box.right) / 2, (box.top + box.bottom) / 2)
      .matrixTransform(back);
    const label = mark.querySelector("[role=button]").getAttribute("aria-label");
    return [mark.dataset.drone, { x, y, label }];
  }));
  return [...monitor.querySelectorAll("li[data-drone]")].map((line) => ({
    id: line.dataset.drone, x: null, y: null, label: "", ...marks.get(line.dataset.drone),
    word: line.querySelector(".standing-word").textContent,
    why: line.querySelector(".because")?.textContent ?? "",
  }));
}
