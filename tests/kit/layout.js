// What a person sees at a glance, and a program can say, of the page that this is evaluated in.
(() => {
  const seen = (one) => one.checkVisibility({ opacityProperty: true, visibilityProperty: true });
  const said = (one) => one.outerHTML.slice(0, 160);
  const scrolls = (one) => getComputedStyle(one).overflow !== "visible";
  const onTop = ".dialog, .drone-card, .result-card, .questions, .notices"; // is meant to lie over a page
  const over = (one) => ({ dialog: ".dialog, .notices", notices: ".notices" })[one.classList[0]] ?? onTop; // what it may not cover

  return {
    covered() {
      const found = [];
      const all = "button, [role=button], a[href], input, select, summary, [role=tab], [role=option]";
      for (const one of document.querySelectorAll(all)) {
        if (!seen(one) || one.closest("svg.floor-picture")) continue; // what flies may fly over what is there
        const box = one.getBoundingClientRect();
        if (!box.width || !box.height) continue;
        const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
        if (x < 0 || y < 0 || x > innerWidth - 1 || y > innerHeight - 1) continue; // no element is found at the very edge
        let clipped = false; // by a list that scrolls
        for (let up = one.parentElement; up; up = up.parentElement) {
          const edge = up.getBoundingClientRect();
          if (scrolls(up) && (x < edge.left || x > edge.right || y < edge.top || y > edge.bottom)) clipped = true;
        }
        if (clipped) continue;
        const top = document.elementFromPoint(x, y);
        const lies = top?.closest(onTop); // it may cover the page, and a dialog what lies on it; nothing covers a Stop
        if (lies && !one.closest(".fly") && !one.closest(over(lies))) continue;
        let stays = false; // what is scrolled goes under a head that stays
        for (let up = top; up; up = up.parentElement) stays ||= getComputedStyle(up).position === "sticky";
        if (stays) continue;
        const same = one.contains(top) || top?.contains(one) || top?.closest("label")?.control === one;
        if (!same) found.push(`${said(one)} lies under ${top && said(top)}`);
      }
      return found;
    },
    smallTargets(least, thumb) {
      const atThumb = ".fly .button, .head .tab, .dialog-foot .button, .transport .button, .opener, .questions .button";
      return [...document.querySelectorAll("button, [role=button], [role=tab], select, input, summary")]
        .filter((one) => seen(one) && !one.closest("svg"))
        .filter((one) => getComputedStyle(one).display !== "inline" && !one.matches(".mark-button")) // two buttons lead to the marks
        .map((one) => [one, (one.closest("label") ?? one).getBoundingClientRect(), one.matches(atThumb) ? thumb : least])
        .filter(([, box]) => box.width && box.height)
        .filter(([, box, enough]) => box.width < enough || box.height < enough)
        .map(([one, box]) => `${Math.round(box.width)} x ${Math.round(box.height)}: ${said(one)}`);
    },
    cutOff() {
      const words = "button, [role=tab], h1, h2, h3, th, label, .chip, .why > *, .title, .standing-word, dd, dt, .empty, .hint";
      return [...document.querySelectorAll(words)].filter((one) => seen(one) && one.clientWidth && scrolls(one)
        && !one.closest(".cell, .thumb-button, .link") // shortened on purpose: all of it is said where it leads to
        && (one.scrollWidth > one.clientWidth + 1 || one.scrollHeight > one.clientHeight + 3)).map(said);
    },
    sticksOut() {
      const found = [];
      for (const one of document.querySelectorAll(".station *")) {
        if (one.closest("svg, .unseen") || !seen(one)) continue;
        const box = one.getBoundingClientRect();
        const within = box.left > -1 && box.top > -1 && box.right < innerWidth + 1 && box.bottom < innerHeight + 1;
        if (within || !box.width || !box.height) continue;
        let up = one.parentElement; // what a list scrolls is not out
        while (up && !scrolls(up) && !up.matches(".unseen")) up = up.parentElement;
        if (!up || up === document.documentElement) found.push(`sticks out: ${said(one)}`);
      }
      const parts = [...document.querySelectorAll(".head > *, .lost-line, main")].filter((one) => seen(one))
        .map((one) => [one, one.getBoundingClientRect()]).filter(([, box]) => box.width > 1 && box.height > 1);
      for (const [one, a] of parts) {
        for (const [other, b] of parts) {
          const apart = a.right <= b.left + 1 || b.right <= a.left + 1 || a.bottom <= b.top + 1 || b.bottom <= a.top + 1;
          if (one !== other && !apart) found.push(`${said(one)} overlaps ${said(other)}`);
        }
      }
      return found;
    },
    sideways() {
      return [...document.querySelectorAll(".station *")]
        .filter((one) => seen(one) && ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
        .filter((one) => one.scrollWidth > one.clientWidth + 1 && one.clientWidth > 0 && !one.matches(".report-table"))
        .map((one) => `${one.scrollWidth} in ${one.clientWidth}: ${said(one)}`);
    },
    names() {
      const stage = document.querySelector(".page:not([hidden]) .floor");
      if (!stage) return [];
      const found = [];
      const names = [...stage.querySelectorAll(".names .name")].map((one) => [one, one.getBoundingClientRect()]);
      names.forEach(([one, a], at) => names.slice(at + 1).forEach(([other, b]) => {
        const apart = a.right <= b.left + 1 || b.right <= a.left + 1 || a.bottom <= b.top + 1 || b.bottom <= a.top + 1;
        if (!apart) found.push(`the name ${one.textContent} lies over ${other.textContent}`);
      }));
      const named = new Set(names.map(([one]) => one.textContent.split(" ")[0]));
      for (const { dataset: { drone, status } } of stage.querySelectorAll(".drone")) {
        if (status === "LOST" && !named.has(drone)) found.push(`${drone} is lost and has no name`);
      }
      return found;
    },
    mapShare() {
      const box = document.querySelector(".monitor-page:not([hidden]) .floor")?.getBoundingClientRect();
      return box ? (box.width * box.height) / (innerWidth * innerHeight) : 1;
    },
  };
})()
