// What a page is like as it stands in the browser: one object, read by check.py. The pages themselves have no script.
(() => {
  const luminance = ([r, g, b]) => [r, g, b].map((c) => c / 255)
    .map((c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
    .reduce((sum, c, k) => sum + [0.2126, 0.7152, 0.0722][k] * c, 0);
  const contrast = (a, b) => {
    const [x, y] = [luminance(a), luminance(b)].sort((p, q) => q - p);
    return (x + 0.05) / (y + 0.05);
  };
  const colour = (text) => {
    const found = text.match(/^rgba?\(([^)]*)\)$/);
    if (!found) return null;
    const [r, g, b, a = 1] = found[1].split(/[ ,/]+/).map(Number);
    return [r, g, b, a];
  };
  const over = (top, ground, share) => top.slice(0, 3).map((c, k) => share * c + (1 - share) * ground[k]);
  const ground = (element) => {
    const layers = [];
    for (let e = element; e; e = e.parentElement) {
      const c = colour(getComputedStyle(e).backgroundColor);
      if (c && c[3] > 0) layers.push(c);
      if (c && c[3] === 1) break;
    }
    return layers.reduceRight((below, c) => over(c, below, c[3]), [255, 255, 255]);
  };
  const name = (e) => `<${e.tagName.toLowerCase()} class="${e.getAttribute("class") || ""}"> ${e.textContent.trim().replace(/\s+/g, " ").slice(0, 40)}`;
  const once = (list) => [...new Set(list)];

  // Text: 4.5 to its ground, 3 where it is large. In a picture the paint is the fill.
  const faint = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const e = node.parentElement, style = getComputedStyle(e);
    if (!node.textContent.trim() || ["TITLE", "STYLE", "DESC", "title", "desc"].includes(e.tagName)) continue;
    const inside = e instanceof SVGElement, paint = colour(inside ? style.fill : style.color), below = ground(e);
    if (!paint) { faint.push(`${name(e)}: a paint that is no colour`); continue; }
    const size = parseFloat(style.fontSize), large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    const share = paint[3] * Number(style.opacity) * (inside ? Number(style.fillOpacity) : 1);
    const found = contrast(over(paint, below, share), below);
    if (found < (large ? 3 : 4.5)) faint.push(`${name(e)}: contrast ${found.toFixed(2)}`);
  }

  // Marks: 3 to their ground by the better of fill and stroke. Nothing is read from grid, rail, band, haze and back alone; a hit
  // is a place for the pointer.
  const pale = [];
  for (const e of document.querySelectorAll("svg path, svg polyline, svg rect, svg circle")) {
    const kind = e.getAttribute("class") || "", style = getComputedStyle(e), below = ground(e);
    if (["grid", "rail", "band", "haze", "back", "hit"].includes(kind)) continue;
    const paints = [[style.fill, style.fillOpacity], [style.stroke, style.strokeOpacity]]
      .map(([paint, share]) => [colour(paint), Number(share)]).filter(([c]) => c);
    const found = Math.max(0, ...paints.map(([c, share]) => contrast(over(c, below, c[3] * share), below)));
    if (found < 3) pale.push(`${e.tagName} ${kind}: contrast ${found.toFixed(2)}`);
  }

  // Pictures: named, described, and with a table that follows.
  const pictures = [...document.querySelectorAll("svg")].flatMap((svg) => {
    const label = (attribute) => {
      const target = document.getElementById(svg.getAttribute(attribute) || "-");
      return target && svg.contains(target) ? target.textContent.trim() : "";
    };
    const figure = svg.closest("figure"), table = figure && figure.querySelector("table");
    const after = table && svg.compareDocumentPosition(table) & Node.DOCUMENT_POSITION_FOLLOWING;
    return [
      [svg.getAttribute("role") !== "img", "no role"],
      [label("aria-labelledby").length < 8 || !svg.querySelector("title"), "no title"],
      [label("aria-describedby").length < 20 || !svg.querySelector("desc"), "no description"],
      [!after || table.tBodies[0].rows.length === 0 || !table.caption, "no table follows"],
      [!figure || !figure.querySelector("figcaption") || !/ Numbers: .+ Made from: .+/.test(figure.textContent), "no sources"],
    ].filter(([bad]) => bad).map(([, what]) => `${svg.getAttribute("aria-labelledby")}: ${what}`);
  });

  // Text of a picture: within it, and not over another one. Line boxes of two rows may touch.
  const labels = [...document.querySelectorAll("svg")].flatMap((svg) => {
    const edge = svg.getBoundingClientRect(), id = svg.getAttribute("aria-labelledby");
    const texts = [...svg.querySelectorAll("text")].map((e) => [e.textContent, e.getBoundingClientRect()]);
    const out = texts.filter(([, r]) => r.left < edge.left - 1 || r.right > edge.right + 1 || r.top < edge.top - 1 || r.bottom > edge.bottom + 1);
    const over = texts.filter(([, a], k) => texts.slice(k + 1).some(([, b]) =>
      Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1
      && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 0.4 * Math.min(a.height, b.height)));
    return [...out.map(([t]) => `${id}: cut off: ${t}`), ...over.map(([t]) => `${id}: over another text: ${t}`)];
  });

  const levels = [...document.querySelectorAll("h1,h2,h3,h4,h5,h6")].map((h) => Number(h.tagName[1]));
  const headings = levels.filter((l, k) => (k === 0 ? l !== 1 : l > levels[k - 1] + 1 || l === 1)).length + (levels.length < 4);

  const root = document.documentElement;
  const scrolls = [...document.querySelectorAll("main *")]
    .filter((e) => !(e instanceof SVGElement) && /auto|scroll/.test(getComputedStyle(e).overflow));
  return {
    faint: once(faint), pale: once(pale), pictures, headings, labels,
    count: document.querySelectorAll("svg").length,
    width: root.scrollWidth, window: window.innerWidth,
    unreachable: scrolls.filter((e) => e.tabIndex !== 0 || !e.getAttribute("aria-label")).map(name),
    clipped: scrolls.filter((e) => e.scrollHeight > e.clientHeight + 1 || e.scrollWidth > e.clientWidth + 1).map(name),
    stops: document.querySelectorAll("a[href], summary, [tabindex='0']").length,
  };
})()
