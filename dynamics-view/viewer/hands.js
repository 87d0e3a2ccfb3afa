// Mouse and touch: one finger turns, two move and zoom; with the mouse, shift or the right button move. The wheel zooms,
// unless it is left to the page that `scrolls`.
function watch(surface, scrolls) {
  const fingers = new Map();
  surface.onpointerdown = (event) => {
    surface.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
  };
  surface.onpointerup = surface.onpointercancel = (event) => fingers.delete(event.pointerId);
  surface.oncontextmenu = (event) => event.preventDefault();
  surface.onpointermove = (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const now = [event.clientX, event.clientY], [dx, dy] = [now[0] - last[0], now[1] - last[1]];
    const spread = () => {
      const [a, b] = [...fingers.values()];
      return Math.hypot(a[0] - b[0], a[1] - b[1]);
    };
    const pan = (part) => {
      const meters = (part * eye.distance * eye.ratio) / eye.focus;
      camera.shift = add(camera.shift, add(scale(eye.right, -dx * meters), scale(eye.up, dy * meters)));
    };
    if (fingers.size === 2) {
      const wide = spread();
      fingers.set(event.pointerId, now);
      zoom(wide / Math.max(1, spread()));
      pan(0.5);
    } else if (event.shiftKey || event.buttons & 2) pan(1);
    else turn(-0.008 * dx, 0.008 * dy);
    fingers.set(event.pointerId, now);
    soon();
  };
  surface.addEventListener("wheel", (event) => {
    if (scrolls && !event.ctrlKey && document.activeElement !== surface) return;
    event.preventDefault();
    zoom(Math.exp(0.0012 * event.deltaY * (event.deltaMode ? 20 : 1)));
  }, { passive: false });
  surface.ondblclick = () => { resetCamera(); soon(); };
}
function turn(azimuth, height) {
  camera.azimuth += azimuth;
  camera.height = Math.min(1.55, Math.max(-1.55, camera.height + height));
  soon();
}
function zoom(factor) {
  camera.zoom = Math.min(20, Math.max(0.05, camera.zoom * factor));
  soon();
}

for (const plot of plots) {
  const go = (event) => { play(false); seek(plot.t(event.clientX - plot.surface.getBoundingClientRect().left)); };
  plot.surface.onpointerdown = (event) => { plot.surface.setPointerCapture(event.pointerId); go(event); };
  plot.surface.onpointermove = (event) => event.buttons && go(event);
}
