// Which mission and which photo are looked at: the table, the map and the graph show the same.
export function choice() {
  let chosen = null;
  const told = new Set();
  return {
    get: () => chosen,
    set(name) {
      if (name === chosen) return;
      const before = chosen;
      chosen = name;
      for (const tell of told) tell(chosen, before);
    },
    // tell(now, before) is called at every change.
    watch: (tell) => told.add(tell),
  };
}
