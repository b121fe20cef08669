// All that a page of another site can try; what came of each.
async (station) => {
  const stop = JSON.stringify({ id: "evil", how: "land" });
  const outcome = (attempt) => attempt.then(
    async (answer) => `${answer.type} ${answer.status} ${await answer.text()}`,
    () => "nothing",
  );
  const post = (more) => outcome(fetch(`${station}/api/stop`, { method: "POST", body: stop, ...more }));
  const loaded = (made) => new Promise((done) => {
    made.onload = () => done("loaded");
    made.onerror = () => done("nothing");
    document.body.append(made);
  });
  const element = (name, given) => Object.assign(document.createElement(name), given);
  const form = element("form", { method: "POST", action: `${station}/api/stop`, target: "inside",
    enctype: "text/plain" });
  form.append(element("input", { name: stop.slice(0, -1) + ', "x": "', value: '"}' }));
  const inside = element("iframe", { name: "inside" });
  document.body.append(form, inside);
  const sent = new Promise((done) => { inside.onload = done; });
  form.submit();
  await sent;
  const socket = await new Promise((done) => {
    const line = new WebSocket(`${station.replace("http", "ws")}/api/live`);
    line.onopen = () => line.send(JSON.stringify({ flight: "", seen: 0, log: 0, results: 0 }));
    line.onmessage = (event) => done(event.data);
    line.onerror = () => done("nothing");
  });
  const frame = element("iframe", { src: `${station}/` });
  await loaded(frame);
  let seen = "nothing";
  try { seen = frame.contentDocument.body.textContent || "nothing"; } catch { /* as it should be */ }
  return {
    plain: await post({ mode: "no-cors" }),
    typed: await post({ headers: { "Content-Type": "application/json", "X-Pluto": "1" } }),
    beacon: navigator.sendBeacon(`${station}/api/stop`, stop),
    socket,
    frame: seen,
    app: await outcome(fetch(`${station}/api/app`)),
    plan: await outcome(fetch(`${station}/api/plan`, { mode: "no-cors" })),
    script: await loaded(element("script", { src: `${station}/api/plan` })),
    map: await loaded(element("img", { src: `${station}/map` })),
  };
}
