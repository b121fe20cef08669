// Who wants to know of a change, and the one who tells them.
//
//   const changed = bell();
//   const off = changed.heard((what) => …);
//   changed.ring(what);

export function bell() {
  const ears = new Set();
  return {
    heard(ear) {
      ears.add(ear);
      return () => ears.delete(ear);
    },
    ring(what) {
      for (const ear of [...ears]) ear(what);
    },
  };
}
