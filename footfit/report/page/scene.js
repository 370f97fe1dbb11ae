"use strict";
// Draws the foot in its last; the pointer, the keys and the buttons turn it. It uses WebGL or, on
// a machine without, a 2D canvas that paints far triangles first. Nothing is fetched.
(() => {
  const canvas = document.getElementById("scene-view");
  if (!canvas) return;
  const scene = JSON.parse(canvas.dataset.scene);
  const status = document.getElementById("scene-status");
  const view = { azimuth: scene.view[0], elevation: scene.view[1], zoom: 1, foot: true, last: true };

  const bytes = (text) => Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0)).buffer;
  const unpacked = (mesh) => {
    const places = new Uint16Array(bytes(mesh.vertices));
    const faces = new Uint16Array(bytes(mesh.faces));
    const points = Float32Array.from(places, (v, i) => mesh.origin[i % 3] + v * mesh.step);
    const normals = new Float32Array(points.length);
    for (let f = 0; f < faces.length; f += 3) {
      const [a, b, c] = [3 * faces[f], 3 * faces[f + 1], 3 * faces[f + 2]];
      const u = [0, 1, 2].map((k) => points[b + k] - points[a + k]);
      const v = [0, 1, 2].map((k) => points[c + k] - points[a + k]);
      const n = [0, 1, 2].map((k) => u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
      for (const at of [a, b, c]) for (let k = 0; k < 3; k++) normals[at + k] += n[k];
    }
    for (let i = 0; i < normals.length; i += 3) {
      const size = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
      for (let k = 0; k < 3; k++) normals[i + k] /= size;
    }
    const clearance = mesh.clearance ? new Int16Array(bytes(mesh.clearance)) : null;
    return { points, normals, faces, clearance };
  };
  const foot = unpacked(scene.foot), last = unpacked(scene.last);
  const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);
  const palette = scene.colours.map(rgb), grey = rgb(scene.grey);
  const LIGHT = scene.light, SHADE = scene.shade, UNKNOWN = scene.unknown, GLASS = [0.36, 0.44, 0.52];

  // Rows: the picture's right, its up, the direction to the eye.
  const axes = () => {
    const a = (view.azimuth * Math.PI) / 180, e = (view.elevation * Math.PI) / 180;
    return [
      [-Math.sin(a), Math.cos(a), 0],
      [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)],
      [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)],
    ];
  };
  const scale = () => (view.zoom * Math.min(canvas.width / scene.size[0], canvas.height / scene.size[1]));

  const program = (gl, vertex, fragment) => {
    const made = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    return gl.getProgramParameter(made, gl.LINK_STATUS) ? made : null;
  };
  const VERTEX = `attribute vec3 place, normal; attribute float clearance, known;
    uniform mat3 axes; uniform vec3 centre; uniform vec2 scale;
    varying vec3 facing; varying float mm, judged;
    void main() {
      vec3 seen = axes * (place - centre);
      facing = axes * normal; mm = clearance; judged = known;
      gl_Position = vec4(seen.xy * scale, -seen.z / 1000.0, 1.0);
    }`;
  const STEPS = scene.breaks.map((mm, i) => `if (mm >= ${mm.toFixed(3)}) colour = vec3(${palette[i + 1].map((v) => v.toFixed(4))});`);
  const HEAT = `precision mediump float; varying vec3 facing; varying float mm, judged;
    void main() {
      vec3 colour = vec3(${palette[0].map((v) => v.toFixed(4))});
      ${STEPS.join("\n")}
      if (judged < 0.999) colour = vec3(${grey.map((v) => v.toFixed(4))});
      float light = max(dot(normalize(facing), vec3(${LIGHT})), 0.0);
      gl_FragColor = vec4(colour * (1.0 - ${SHADE} * (1.0 - light)), 1.0);
    }`;
  const SHELL = `precision mediump float; varying vec3 facing; varying float mm, judged;
    void main() {
      float edge = 1.0 - abs(normalize(facing).z);
      float alpha = 0.07 + 0.55 * edge * edge * edge;
      gl_FragColor = vec4(vec3(${GLASS}) * alpha, alpha);
    }`;

  const webgl = () => {
    const gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
    if (!gl) return null;
    const programs = { heat: program(gl, VERTEX, HEAT), shell: program(gl, VERTEX, SHELL) };
    if (!programs.heat || !programs.shell) return null;
    const buffer = (kind, data) => {
      const made = gl.createBuffer();
      gl.bindBuffer(kind, made);
      gl.bufferData(kind, data, gl.STATIC_DRAW);
      return made;
    };
    const loaded = (mesh) => ({
      place: buffer(gl.ARRAY_BUFFER, mesh.points),
      normal: buffer(gl.ARRAY_BUFFER, mesh.normals),
      clearance: mesh.clearance && buffer(gl.ARRAY_BUFFER, Float32Array.from(mesh.clearance, (v) => (v === UNKNOWN ? 0 : v / 100))),
      known: mesh.clearance && buffer(gl.ARRAY_BUFFER, Float32Array.from(mesh.clearance, (v) => (v === UNKNOWN ? 0 : 1))),
      faces: buffer(gl.ELEMENT_ARRAY_BUFFER, mesh.faces),
      count: mesh.faces.length,
    });
    const meshes = { foot: loaded(foot), last: loaded(last) };
    const feed = (use, name, source, size) => {
      const at = gl.getAttribLocation(use, name);
      if (at < 0) return;
      if (!source) { gl.disableVertexAttribArray(at); gl.vertexAttrib1f(at, 0); return; }
      gl.bindBuffer(gl.ARRAY_BUFFER, source);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
    };
    const paint = (use, mesh) => {
      gl.useProgram(use);
      const rows = axes();
      const columns = [0, 1, 2].flatMap((k) => rows.map((row) => row[k]));
      gl.uniformMatrix3fv(gl.getUniformLocation(use, "axes"), false, columns);
      gl.uniform3fv(gl.getUniformLocation(use, "centre"), scene.centre);
      gl.uniform2f(gl.getUniformLocation(use, "scale"), (2 * scale()) / canvas.width, (2 * scale()) / canvas.height);
      feed(use, "place", mesh.place, 3);
      feed(use, "normal", mesh.normal, 3);
      feed(use, "clearance", mesh.clearance, 1);
      feed(use, "known", mesh.known, 1);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.faces);
      gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_SHORT, 0);
    };
    return () => {
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(1, 1, 1, 1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST);
      gl.disable(gl.BLEND);
      gl.depthMask(true);
      if (view.foot) paint(programs.heat, meshes.foot);
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      gl.depthMask(false);
      if (view.last) paint(programs.shell, meshes.last);
      gl.depthMask(true);
    };
  };

  const flat = () => {
    const context = canvas.getContext("2d");
    if (!context) return null;
    const step = (mm) => scene.breaks.filter((edge) => mm >= edge).length;
    const triangles = (mesh, rows) => {
      const turn = (list, at) => rows.map((row) => row.reduce((sum, v, k) => sum + v * (list[at + k] - (list === mesh.points ? scene.centre[k] : 0)), 0));
      const seen = [], facing = [];
      for (let i = 0; i < mesh.points.length; i += 3) { seen.push(turn(mesh.points, i)); facing.push(turn(mesh.normals, i)); }
      const front = [];
      for (let f = 0; f < mesh.faces.length; f += 3) {
        const ids = [mesh.faces[f], mesh.faces[f + 1], mesh.faces[f + 2]];
        const [a, b, c] = ids.map((id) => seen[id]);
        if ((b[0] - a[0]) * (c[1] - a[1]) <= (b[1] - a[1]) * (c[0] - a[0])) continue;
        front.push({ ids, corners: [a, b, c], depth: a[2] + b[2] + c[2], facing });
      }
      return front.sort((a, b) => a.depth - b.depth);
    };
    const fill = (triangle, style, outlined) => {
      const k = scale(), at = ([x, y]) => [canvas.width / 2 + k * x, canvas.height / 2 - k * y];
      context.beginPath();
      triangle.corners.map(at).forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
      context.closePath();
      context.fillStyle = style;
      context.fill();
      if (outlined) { context.strokeStyle = style; context.stroke(); }
    };
    const mean = (triangle) => [0, 1, 2].map((k) => triangle.ids.reduce((sum, id) => sum + triangle.facing[id][k] / 3, 0));
    const heat = (triangle) => {
      const corners = triangle.ids.map((id) => foot.clearance[id]);
      const known = !corners.includes(UNKNOWN);
      const colour = known ? palette[step(corners.reduce((sum, v) => sum + v / 300, 0))] : grey;
      const n = mean(triangle), size = Math.hypot(...n) || 1;
      const light = Math.max(n.reduce((sum, v, k) => sum + (v * LIGHT[k]) / size, 0), 0);
      return `rgb(${colour.map((v) => Math.round(255 * v * (1 - SHADE * (1 - light))))})`;
    };
    const glass = (triangle) => {
      const n = mean(triangle), edge = 1 - Math.abs(n[2] / (Math.hypot(...n) || 1));
      return `rgba(${GLASS.map((v) => Math.round(255 * v))},${(0.1 + 0.55 * edge ** 3).toFixed(3)})`;
    };
    return () => {
      const rows = axes();
      context.fillStyle = "#fff";
      context.fillRect(0, 0, canvas.width, canvas.height);
      if (view.foot) for (const triangle of triangles(foot, rows)) fill(triangle, heat(triangle), true);
      if (view.last) for (const triangle of triangles(last, rows)) fill(triangle, glass(triangle), false);
    };
  };

  let waiting = false;
  const painted = webgl() || flat();
  if (!painted) return;
  const draw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; painted(); });
  };
  const fit = () => {
    const sharp = Math.min(window.devicePixelRatio || 1, 2);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * sharp));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * sharp));
    draw();
  };
  const turn = (azimuth, elevation) => {
    view.azimuth = (view.azimuth + azimuth) % 360;
    view.elevation = Math.max(-90, Math.min(90, view.elevation + elevation));
    draw();
  };
  const zoom = (factor) => { view.zoom = Math.max(0.5, Math.min(8, view.zoom * factor)); draw(); };

  let held = null;
  canvas.addEventListener("pointerdown", (event) => { held = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    turn((held[0] - event.clientX) * 0.5, (event.clientY - held[1]) * 0.5);
    held = [event.clientX, event.clientY];
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { held = null; });
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas) return;
    event.preventDefault();
    zoom(Math.exp(-event.deltaY / 600));
  }, { passive: false });
  const KEYS = { ArrowLeft: [10, 0], ArrowRight: [-10, 0], ArrowUp: [0, 10], ArrowDown: [0, -10] };
  canvas.addEventListener("keydown", (event) => {
    if (KEYS[event.key]) { event.preventDefault(); turn(...KEYS[event.key]); }
    if (event.key === "+" || event.key === "-") zoom(event.key === "+" ? 1.2 : 1 / 1.2);
  });
  for (const box of document.querySelectorAll("[data-show]")) {
    box.addEventListener("change", () => { view[box.dataset.show] = box.checked; draw(); });
  }
  for (const button of document.querySelectorAll("[data-view]")) {
    button.addEventListener("click", () => {
      [view.azimuth, view.elevation] = button.dataset.view.split(",").map(Number);
      view.zoom = 1;
      draw();
    });
  }
  window.addEventListener("resize", fit);
  document.getElementById("scene").hidden = false;
  if (status) status.textContent = "Drag to turn. Click, then scroll to zoom. Arrow keys turn, + and - zoom.";
  fit();
})();
