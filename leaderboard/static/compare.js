// The compare page. Files hold all policies: those of the address, ?p=DIGEST, are shown.
"use strict";
(() => {
  const form = document.getElementById("choice");
  const selects = [...form.querySelectorAll("select")];
  form.addEventListener("submit", () => {  // Empty choices are left out of the address.
    for (const select of selects) select.disabled = !select.value;
  });
  addEventListener("pageshow", () => { for (const select of selects) select.disabled = false; });
  const comparison = document.getElementById("comparison");
  if (!comparison) return;
  if (!comparison.hidden) return window.coliftDraw([...new Set(selects.map((select) => select.value).filter(Boolean))]);
  const known = new Set([...selects[0].options].map((option) => option.value).filter(Boolean));
  const named = new URLSearchParams(location.search).getAll("p");
  const asked = (named.length ? named : [...known].slice(0, 2)).filter((digest) => known.has(digest));
  const chosen = [...new Set(asked)].slice(0, selects.length);
  selects.forEach((select, i) => { select.value = chosen[i] || ""; });
  const enough = chosen.length > 1;
  document.getElementById("few").hidden = enough;
  comparison.hidden = !enough;
  for (const row of comparison.querySelectorAll("[data-p]"))
    row.toggleAttribute("hidden", !row.dataset.p.split(" ").every((digest) => chosen.includes(digest)));
  // Each chosen policy gets its place in the picture, and the colour and the shape of that place.
  const apart = Number(comparison.querySelector(".dots").dataset.apart);
  chosen.forEach((digest, k) => {
    for (const drawn of comparison.querySelectorAll(`.series[data-p="${digest}"], [data-p="${digest}"] > .marker`)) {
      drawn.classList.remove("s0", "s1", "s2", "s3");
      drawn.classList.add("s" + k);
      for (const use of drawn.querySelectorAll("use")) use.setAttribute("href", "#s" + k);
      if (drawn.matches(".series")) drawn.setAttribute("transform", `translate(0 ${apart * (k - (chosen.length - 1) / 2)})`);
    }
  });
  if (enough) window.coliftDraw(chosen);
})();
